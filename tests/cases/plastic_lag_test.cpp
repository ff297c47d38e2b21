/// Metal that yields while its temperature changes keeps the strain of each step: what a split takes for the
/// temperature of the step stays in the shape of the part. With nothing numerical set it is that of closed
/// forms.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "case_folder.hpp"
#include "results/overview.hpp"

namespace {

using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double k_young = 70e9, k_expansion = 2.3e-5, k_length = 0.02;  // [Pa], [1/K], [m]

std::string metal(const std::string& plasticity) {
  return fmt::format(
      "density = \"2700 kg/m3\"\nconductivity = \"200 W/m/K\"\nspecific_heat = \"900 J/kg/K\"\n"
      "young_modulus = \"{} Pa\"\npoisson_ratio = 0.3\nexpansion = \"{} 1/K\"\n[plasticity]\n{}",
      k_young, k_expansion, plasticity);
}

/// A bar between walls cools from 420 to 120 degC in 60 s and yields; then one wall is gone, and it cools to
/// 20 degC.
/// @param skin  the thermal condition of its surface
std::string held_bar(const std::string& skin) {
  return R"(title = "A bar that yields as it cools between walls"
stage = [{ name = "held", duration = "60 s", step = "2 s" }, { name = "free", duration = "60 s", step = "2 s" }]
[analysis]
kind = "axisymmetric"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["2 mm", "20 mm"]
divisions = [2, 4]
[time]
adaptive = true
[[body]]
name = "bar"
group = "block"
material = "metal.toml"
initial_temperature = "420 degC"
[[thermal_condition]]
name = "skin"
group = "x_max"
)" + skin +
         R"(
[[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "head"
group = "y_max"
kind = "displacement"
uz = "0 mm"
stages = "held"
[[probe]]
name = "uz"
field = "displacement"
component = "z"
kind = "mean"
group = "y_max"
unit = "m"
)";
}

const std::string k_surroundings =
    R"({ of = "time", argument_unit = "s", unit = "degC", points = [[0, 420], [60, 120], [120, 20]] })";

struct FlowRun {
  std::string name, plasticity;
  double stress;         ///< at the end of the first stage [Pa]
  double hardening = 0;  ///< [Pa]
};

class PlasticLag : public ::testing::TestWithParam<FlowRun> {};

// What is plastic when the wall goes is α 300 K less the elastic part of the stress there.
TEST_P(PlasticLag, OfABarThatYieldsAsItCoolsIsNoneByDefault) {
  const FlowRun& flow = GetParam();
  const CaseFolder folder("plastic_lag_" + flow.name);
  folder.write("metal.toml", metal(flow.plasticity));
  const double plastic = (k_expansion * 300 - flow.stress / k_young) / (1 + flow.hardening / k_young);
  const double exact = k_length * (plastic - k_expansion * 400);
  const std::string text = held_bar("kind = \"temperature\"\ntemperature = " + k_surroundings);
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{}, {"time.adaptive=false"}, {"coupling.scheme=isothermal"}}) {
    const CaseRun run = folder.run("bar", text, settings);
    ASSERT_TRUE(run.finished) << run.reason;
    EXPECT_NEAR(run.history.at("uz[m]").back(), exact, 4e-3 * std::abs(exact))
        << (settings.empty() ? "default" : settings[0]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, PlasticLag,
    ::testing::Values(FlowRun{"perfect", "flow_stress = \"80 MPa\"\n", 80e6},
                      FlowRun{"softening",
                              "flow_stress = { argument_unit = \"degC\", unit = \"MPa\", "
                              "points = [[120, 100], [420, 40]] }\n",
                              100e6},
                      FlowRun{"hardening",
                              "flow_stress = \"80 MPa\"\nisotropic_hardening = \"linear\"\n"
                              "hardening_modulus = \"2 GPa\"\n",
                              80e6, 2e9},
                      FlowRun{"viscous",
                              "flow_stress = \"80 MPa\"\nrate_dependence = \"perzyna\"\n"
                              "viscosity = \"1.1594202898550725e11 Pa s\"\n",
                              100e6}),
    [](const auto& of) { return of.param.name; });

// A film: the bar follows its surroundings with a lag of its own, and what conducts and what deforms both
// count.
TEST(PlasticLagOfAFilm, IsWithinAPerMilleOfTheSolutionOfBothFieldsAtOnceInShortSteps) {
  const CaseFolder folder("plastic_lag_film");
  folder.write("metal.toml", metal("flow_stress = \"80 MPa\"\n"));
  const std::string text =
      held_bar("kind = \"film\"\ncoefficient = \"2000 W/m2/K\"\nambient = " + k_surroundings);
  const CaseRun exact = folder.run("exact", text,
                                   {"coupling.scheme=simultaneous", "time.adaptive=false",
                                    "stage=[{name=\"held\",duration=\"60 s\",step=\"0.1 s\"},"
                                    "{name=\"free\",duration=\"60 s\",step=\"0.1 s\"}]"});
  const CaseRun usual = folder.run("usual", text);
  ASSERT_TRUE(exact.finished && usual.finished) << exact.reason << usual.reason;
  const double there = exact.history.at("uz[m]").back();
  EXPECT_NEAR(usual.history.at("uz[m]").back(), there, 5e-3 * std::abs(there));
}

TEST(PlasticLagOfABar, ARunThatGoesOnEndsWithTheSameBits) {
  const CaseFolder folder("plastic_lag_restart");
  folder.write("metal.toml", metal("flow_stress = \"80 MPa\"\n"));
  folder.expect_exact_restart("bar", held_bar("kind = \"temperature\"\ntemperature = " + k_surroundings), 5);
}

/// Two blocks that rub on each other.
std::string rubbing(const std::string& friction, const std::string& coupling = "") {
  return R"(title = "Blocks that rub"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "5 mm"]
lower_divisions = [4, 1]
upper = ["10 mm", "5 mm"]
upper_divisions = [2, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "upper"
material = "metal.toml"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "metal.toml"
initial_temperature = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "1 W/m2/K"
gap_law = "constant"
[contact.friction]
)" + friction +
         "\n" + coupling;
}

TEST(PlasticLagOfFriction, BodiesThatYieldConductHeatFirst) {
  const CaseFolder folder("plastic_lag_order");
  const auto overview = [&](const std::string& name, const std::string& material) {
    folder.write("metal.toml", material);
    // Cold bodies have no heat but that of friction: upper and lower start apart.
    std::string text = rubbing("coefficient = 0.2");
    const std::string cold = "initial_temperature = \"20 degC\"";
    text.replace(text.find(cold), cold.size(), "initial_temperature = \"200 degC\"");
    const std::string file = folder.write(name + ".toml", text);
    return solidus::results::text(solidus::run::check_run(solidus::setup::load_case(file)).overview);
  };
  const std::string elastic = metal("");
  EXPECT_THAT(overview("elastic", elastic.substr(0, elastic.find("[plasticity]"))),
              HasSubstr("(mechanics_first)"));
  EXPECT_THAT(overview("plastic", metal("flow_stress = \"80 MPa\"\n")), Not(HasSubstr("mechanics_first")));
}

TEST(PlasticLagOfFriction, ThePrintedThermalPhaseOfFrictionGoesWithMechanicsFirst) {
  const CaseFolder folder("plastic_lag_printed");
  folder.write("metal.toml", metal("flow_stress = \"80 MPa\"\n"));
  const std::string printed = "coefficient = 0.2\nthermal_return_mapping = true";
  EXPECT_THAT(folder.refusal("refused", rubbing(printed, "[coupling]\norder = \"heat_first\"\n")),
              HasSubstr("thermal_return_mapping with heat first"));
  const std::string file = folder.write("chosen.toml", rubbing(printed));
  EXPECT_THAT(solidus::results::text(solidus::run::check_run(solidus::setup::load_case(file)).overview),
              HasSubstr("(mechanics_first)"));
}

}  // namespace
