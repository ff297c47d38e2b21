/// Ambient temperature, admissible conditions, and what is reported of the isothermal split.
#include "setup/admissible.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../cases/small_case.hpp"
#include "check/coupling_estimate.hpp"
#include "coupling/state.hpp"
#include "run/audit_watch.hpp"
#include "system/log.hpp"

namespace solidus::setup {
namespace {

using test::bar_case;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* k_film = R"toml([[thermal_condition]]
name = "film"
group = "left"
kind = "film"
coefficient = "10 W/(m2 K)"
ambient = "293 K"
)toml";

TEST(AmbientTemperature, IsTheInitialOneOfAnInsulatedBody) {
  EXPECT_EQ(admissibility(bar_case()).ambient_temperature, 600);
  EXPECT_TRUE(admissibility(bar_case()).holds());
}

TEST(AmbientTemperature, IsThatOfTheSurroundings) {
  const Admissibility a = admissibility(bar_case(k_film));
  EXPECT_NEAR(a.ambient_temperature, 293, 1e-9);
  EXPECT_THAT(a.violations, IsEmpty());
}

TEST(AmbientTemperature, MayBeGiven) {
  const Admissibility a =
      admissibility(bar_case(std::string("[coupling]\nambient_temperature = \"300 K\"\n") + k_film));
  EXPECT_EQ(a.ambient_temperature, 300);
  EXPECT_THAT(a.violations, ElementsAre(HasSubstr("'film' is not the ambient one")));
}

TEST(Admissible, IsNothingThatFeedsABody) {
  const Admissibility a = admissibility(bar_case(std::string(k_film) + R"([[thermal_condition]]
name = "burner"
group = "right"
kind = "flux"
flux = "1000 W/m2"
[[mechanical_condition]]
name = "jack"
group = "top"
kind = "displacement"
uy = "1 mm"
[[mechanical_condition]]
name = "press"
group = "right"
kind = "pressure"
pressure = { of = "time", argument_unit = "s", unit = "MPa", points = [[0, 0], [10, 5]] }
)"));
  EXPECT_THAT(a.violations, ElementsAre(HasSubstr("'burner' is a flux"), HasSubstr("'jack' moves"),
                                        HasSubstr("'press' varies")));
}

TEST(Admissible, AreDeadLoadsAndSupportsAtRest) {
  EXPECT_TRUE(admissibility(bar_case(R"([[mechanical_condition]]
name = "support"
group = "bottom"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "weight"
group = "top"
kind = "pressure"
pressure = "3 MPa"
)"))
                  .holds());
}

/// Returns the warnings that are logged during `action`.
std::vector<std::string> warned(const std::function<void()>& action) {
  logging::clear_warnings();
  logging::set_sink([](logging::Level, std::string_view) {});
  action();
  logging::set_sink({});
  return logging::warnings();
}

TEST(StabilityWatch, WarnsOnceWhenTheFunctionalGrowsBeyondResiduals) {
  const cases::CaseSpec spec = bar_case("[coupling]\nscheme = \"isothermal\"\n");
  coupling::StepRecord step;
  step.number = 7;
  step.time = 7;
  step.stability = {.mechanical = 3, .thermal = -2, .tolerance = 0.5};
  const auto warnings = warned([&] {
    run::StabilityWatch watch(spec);
    watch.step(step, {});
    watch.step(step, {});
  });
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("t = 7 s, step 7"), HasSubstr("grew by 1 J"),
                                          HasSubstr("isentropic"))));
  step.stability.tolerance = 2;
  EXPECT_THAT(warned([&] { run::StabilityWatch(spec).step(step, {}); }), IsEmpty());
}

TEST(StabilityWatch, IsSilentWhereSomethingFeedsTheBody) {
  const cases::CaseSpec spec = bar_case(R"([[thermal_condition]]
name = "oven"
group = "bar"
kind = "source"
power = "1 W/m3"
)");
  coupling::StepRecord step;
  step.stability.thermal = 10;
  EXPECT_THAT(warned([&] { run::StabilityWatch(spec).step(step, {}); }), IsEmpty());
}

TEST(FirstLawWatch, WarnsWhereMoreIsLostThanResidualsExplain) {
  coupling::StepRecord step;
  step.energy.stored_heat = 100.5;
  step.energy.heat_in = 100;
  step.energy.heat_exchanged = 100;
  const auto run = [&](const cases::CaseSpec& spec) {
    return warned([&] {
      run::FirstLawWatch watch(spec);
      watch.step(step, {});
      watch.end({});
    });
  };
  const cases::CaseSpec energy = bar_case(),
                        entropy = bar_case("[coupling]\nstructural_heating = \"entropy\"\n");
  EXPECT_THAT(run(energy), ElementsAre(HasSubstr("violated by 0.005 of the heat exchanged, 0.5 J")));
  EXPECT_THAT(run(entropy), ElementsAre(HasSubstr("structural_heating = \"energy\"")));
  step.energy.unbalanced = 0.6;  // Newton's criterion of the mechanical phase
  EXPECT_THAT(run(energy), IsEmpty());
  step.energy.unbalanced = 0;
  step.energy.stored_heat = 100.01;  // a printed form loses that much
  EXPECT_THAT(run(entropy), IsEmpty());
}

TEST(IsothermalPasses, AreAnnouncedByTheirCouplingNumber) {
  check::CouplingEstimate e;
  e.body = "wall";
  e.initial = e.worst = 593;
  e.plane = true;
  e.at_initial = e.at_worst = {.uniaxial = 0.04, .plane = 0.056, .bound = 0.065};
  const cases::CaseSpec isothermal = bar_case("[coupling]\nscheme = \"isothermal\"\n");
  EXPECT_THAT(warned([&] { check::announce_isothermal(isothermal, {e}); }), IsEmpty());
  EXPECT_THAT(check::text(e), HasSubstr("stable: 2 (1 - nu) delta = 0.0560"));
  e.at_worst = {.uniaxial = 1.44, .plane = 2.02, .bound = 2.33};
  EXPECT_THAT(warned([&] { check::announce_isothermal(isothermal, {e}); }),
              ElementsAre(AllOf(HasSubstr("unstable"), HasSubstr("scheme = \"isentropic\""))));
  EXPECT_THAT(warned([&] { check::announce_isothermal(bar_case(), {e}); }), IsEmpty());
}

TEST(IsothermalPasses, WithInertiaAreWarnedOfHoweverWeakTheCouplingUnlessBackwardEulerDamps) {
  check::CouplingEstimate e;
  e.at_initial = e.at_worst = {.uniaxial = 0.04, .plane = 0.056, .bound = 0.065};
  const std::string inertia = "[coupling]\nscheme = \"isothermal\"\n[dynamics]\nmethod = ";
  EXPECT_THAT(warned([&] { check::announce_isothermal(bar_case(inertia + "\"trapezoidal\"\n"), {e}); }),
              ElementsAre(HasSubstr("by newmark")));  // the trapezoidal rule is one of Newmark's methods
  EXPECT_THAT(warned([&] { check::announce_isothermal(bar_case(inertia + "\"backward_euler\"\n"), {e}); }),
              IsEmpty());
}

}  // namespace
}  // namespace solidus::setup
