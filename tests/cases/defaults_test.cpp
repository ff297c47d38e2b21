/// Results without any numerical settings: small problems with a known answer, with the default scheme,
/// order, tolerances and elements.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
namespace logging = solidus::logging;

/// A bar that is held in length is heated, 1 K a second; flow stress 400 − 4 T, linear hardening
/// (code_aster V7.22.100, HSNV100): σ = −(400 − 4 T + H p), 2 T = |σ| + E p in N/mm² and °C, E = 200 000,
/// H = 200 000/3. At 80 °C −100 N/mm² and p = 3e-4, at 90 °C −75 and 5.25e-4.
const std::string k_bar = R"(
title = "A bar held in length"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["10 mm", "10 mm", "10 mm"]
divisions = [1, 1, 1]
[time]
end = "90 s"
step = "1 s"
[criteria]
follow = false
[[body]]
name = "block"
material = "softening.toml"
initial_temperature = "0 degC"
[[thermal_condition]]
name = "left"
group = "x_min"
kind = "temperature"
temperature = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 0], [100, 100]] }
[[thermal_condition]]
name = "right"
group = "x_max"
kind = "temperature"
temperature = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 0], [100, 100]] }
[[mechanical_condition]]
name = "bottom"
group = "z_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "top"
group = "z_max"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "symmetry_x"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_y"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[probe]]
name = "stress"
unit = "MPa"
kind = "mean"
field = "stress"
component = "zz"
group = "block"
[[probe]]
name = "plastic"
unit = "1"
kind = "mean"
field = "equivalent_plastic_strain"
group = "block"
)";

const std::string k_softening = R"(
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1e-5 1/K"
expansion_reference = "0 degC"
[plasticity]
isotropic_hardening = "linear"
hardening_modulus = "66666.6666667 MPa"
[plasticity.flow_stress]
of = "temperature"
unit = "MPa"
argument_unit = "degC"
points = [[0, 400], [95, 20], [100, 1]]
)";

TEST(Defaults, AHeldBarWhoseFlowStressFallsWhileItIsHeatedHasTheStressOfItsTime) {
  const CaseFolder folder("defaults_bar");
  folder.write("softening.toml", k_softening);
  const CaseRun run = folder.run("bar", k_bar);
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(at(run.history, "stress[MPa]", 80), -100, 1e-4 * 100);
  EXPECT_NEAR(at(run.history, "stress[MPa]", 90), -75, 1e-4 * 100);
  EXPECT_NEAR(at(run.history, "plastic[1]", 80), 3e-4, 2e-7);
  EXPECT_NEAR(at(run.history, "plastic[1]", 90), 5.25e-4, 2e-7);
}

// What a split keeps of plastic flow in the thermal phase is the default because it is the nearer one to what
// the stress should be, at the same cost (docs/theory/coupling.md).
TEST(Defaults, KeepingTheFlowInTheThermalPhaseIsNearerThanMappingItAgain) {
  const CaseFolder folder("defaults_flow");
  folder.write("softening.toml", k_softening);
  for (const std::string order : {"heat_first", "mechanics_first"}) {
    const CaseRun kept = folder.run(order + "_kept", k_bar, {"coupling.order=\"" + order + "\""}),
                  restarted =
                      folder.run(order + "_restarted", k_bar,
                                 {"coupling.order=\"" + order + "\"", "coupling.thermal_flow=\"restarted\""});
    ASSERT_TRUE(kept.finished && restarted.finished) << kept.reason << restarted.reason;
    const auto error = [](const CaseRun& run) {
      return std::max(std::abs(at(run.history, "stress[MPa]", 80) + 100),
                      std::abs(at(run.history, "stress[MPa]", 90) + 75));
    };
    RecordProperty(order, std::to_string(error(kept)) + " and " + std::to_string(error(restarted)));
    EXPECT_LT(error(kept), 0.5 * error(restarted)) << order;
  }
}

/// Two bars between fixed ends that are heated until the gap between them has closed.
const std::string k_bars = R"(
title = "Two bars whose gap closes"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
gap = "10 um"
lower = ["10 mm", "50 mm"]
lower_divisions = [2, 10]
upper = ["10 mm", "50 mm"]
upper_divisions = [2, 10]
[time]
end = "100 s"
step = "2 s"
[criteria]
follow = false
[[body]]
name = "upper"
material = "h13_tool_steel"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "h13_tool_steel"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "above"
group = "upper_y_max"
kind = "temperature"
temperature = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 20], [100, 120]] }
[[thermal_condition]]
name = "below"
group = "lower_y_min"
kind = "temperature"
temperature = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 20], [100, 120]] }
[[mechanical_condition]]
name = "foot"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "head"
group = "upper_y_max"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "symmetry_lower"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_upper"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.03 W/m/K"
)";

TEST(Defaults, TheForceBetweenBarsWhoseGapClosesIsThatOfATightTolerance) {
  const CaseFolder folder("defaults_bars");
  const CaseRun usual = folder.run("usual", k_bars),
                tight = folder.run("tight", k_bars,
                                   {"mechanics.tolerance=1e-10", "mechanics.displacement_tolerance=1e-7",
                                    "heat.tolerance=1e-11"});
  ASSERT_TRUE(usual.finished && tight.finished) << usual.reason << tight.reason;
  const auto &found = usual.history.at("contact_force[N]"), &exact = tight.history.at("contact_force[N]");
  ASSERT_EQ(found.size(), exact.size());
  EXPECT_GT(exact.back(), 1e5);  // of a metre of depth
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], exact[i], 1e-3 * exact[i]) << i;
}

/// Two blocks on top of each other, held at their sides, that the upper end presses together; the meshes do
/// not match. The pressure is that of uniaxial strain, E (1 − ν)/((1 + ν)(1 − 2ν)) × approach/height.
const std::string k_box = R"(
title = "Two blocks in a box"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["10 mm", "10 mm"]
lower_divisions = [5, 4]
upper = ["10 mm", "10 mm"]
upper_divisions = [3, 3]
[time]
end = "2 s"
step = "1 s"
[[body]]
name = "upper"
material = "block.toml"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "block.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "head"
group = "upper_y_max"
kind = "displacement"
uy = "-20 um"
[[mechanical_condition]]
name = "left_below"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "right_below"
group = "lower_x_max"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "left_above"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "right_above"
group = "upper_x_max"
kind = "displacement"
ux = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
)";

const std::string k_block = R"(
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "1e-5 1/K"
expansion_reference = "20 degC"
)";

// With the penalty alone it lacks 1.4 % (Truchas' contact-box), with friction and in large sliding 1.7 %.
TEST(Defaults, AnApproachThatPressesTwoBlocksTogetherHasItsPressure) {
  const CaseFolder folder("defaults_box");
  folder.write("block.toml", k_block);
  constexpr double k_young = 200e9, k_poisson = 0.3, k_strain = 1e-3, k_face = 0.01;  // of a metre of depth
  const double exact =
      k_young * (1 - k_poisson) / ((1 + k_poisson) * (1 - 2 * k_poisson)) * k_strain * k_face;
  const std::string large = "formulation = \"large_sliding\"\n",
                    rubs = "[contact.friction]\ncoefficient = 0.3\n";
  for (const auto& [name, more] : std::vector<std::pair<std::string, std::string>>{
           {"small", ""}, {"large", large}, {"rubbing", rubs}, {"large_rubbing", large + rubs}}) {
    const CaseRun usual = folder.run(name, k_box + more),
                  penalty =
                      folder.run(name + "_penalty", k_box + more, {"contact.interface.normal=\"penalty\""});
    ASSERT_TRUE(usual.finished && penalty.finished) << usual.reason << penalty.reason;
    for (const double time : {1.0, 2.0}) {
      EXPECT_NEAR(at(usual.history, "contact_force[N]", time), exact, 1e-3 * exact) << name << ", " << time;
      EXPECT_LT(at(penalty.history, "contact_force[N]", time), (1 - 1e-2) * exact) << name << ", " << time;
    }
  }
}

/// A free block that is so strongly coupled that it stores more heat by its expansion than at rest, between
/// surroundings that warm it by 100 K in 20 steps.
const std::string k_strong = R"(
title = "Strongly coupled"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["10 mm", "10 mm", "10 mm"]
divisions = [1, 1, 1]
[time]
end = "20 s"
step = "1 s"
[criteria]
follow = false
[[body]]
name = "block"
material = "strong.toml"
initial_temperature = "400 degC"
[[thermal_condition]]
name = "oil"
group = "x_max"
kind = "film"
coefficient = "60000 W/m2/K"
ambient = { of = "time", argument_unit = "s", unit = "degC", points = [[0, 400], [20, 500]] }
[[mechanical_condition]]
name = "symmetry_x"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_y"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "symmetry_z"
group = "z_min"
kind = "displacement"
uz = "0 mm"
[[probe]]
name = "T"
unit = "degC"
kind = "mean"
field = "temperature"
group = "block"
)";

// What heat first lags where deformation takes up much of the heat is reported with its number: what δ_K
// exceeds the expansion that is expected, (δ_K − ½)/1.5 steps with backward Euler, half of it with the two
// stages of the default.
TEST(Defaults, ASplitSaysByHowManyStepsTemperaturesLagWhereTheCouplingIsStrong) {
  const CaseFolder folder("defaults_strong");
  folder.write("strong.toml", R"(
density = "7800 kg/m3"
conductivity = "40000 W/m/K"
specific_heat = "500 J/kg/K"
specific_heat_at = "constant_strain"
young_modulus = "200 GPa"
poisson_ratio = 0.3
expansion = "8e-5 1/K"
expansion_reference = "400 degC"
)");
  const CaseRun together = folder.run("together", k_strong, {"coupling.scheme=\"simultaneous\""});
  ASSERT_TRUE(together.finished) << together.reason;
  // 9 alpha^2 k Θ/C, at 500 degC.
  const double bulk = 200e9 / (3 * (1 - 2 * 0.3)), strength = 9 * 8e-5 * 8e-5 * bulk * 773.15 / (7800 * 500);
  const auto& exact = together.history.at("T[degC]");
  const double step = exact.back() - exact[exact.size() - 2];
  using ::testing::Contains, ::testing::HasSubstr, ::testing::Not;
  const double late = (strength - 0.5) / 1.5;
  for (const auto& [stepping, steps] : {std::pair{"sdirk2", 0.5 * late}, std::pair{"backward_euler", late}}) {
    logging::clear_warnings();
    const CaseRun split = folder.run(stepping, k_strong, {std::string("heat.stepping=\"") + stepping + "\""});
    ASSERT_TRUE(split.finished) << split.reason;
    EXPECT_NEAR((exact.back() - split.history.at("T[degC]").back()) / step, steps, 0.15 * steps) << stepping;
    const auto says = Contains(HasSubstr(fmt::format("lag by {:.2g} steps", steps)));
    if (steps / 20 > 0.03)
      EXPECT_THAT(logging::warnings(), says) << stepping;
    else
      EXPECT_THAT(logging::warnings(), Not(says)) << stepping;
  }
  logging::clear_warnings();
  folder.run("weak", k_strong, {"time.step=\"0.2 s\""});
  folder.run("with_both", k_strong, {"coupling.scheme=\"block_iterative\""});
  EXPECT_THAT(logging::warnings(), Not(Contains(HasSubstr("lag by"))));
}

// In the first step of 2 s a gap opens through which the heat of the step has passed as if it were closed;
// the step is then solved again with the mean gap.
TEST(Defaults, AGapThatOpensWithinAStepConductsAsInStepsAHundredTimesAsShort) {
  struct Shock {
    double loss;  ///< of the upper block in 2 s [K]
    bool warned;
  };
  const auto shock = [](const std::string& name, std::vector<std::string> settings) -> Shock {
    settings.insert(settings.end(), {"time.end=\"2 s\"", "output.every=\"2 s\""});
    logging::clear_warnings();
    const CaseRun run =
        solidus::testing::run("cases/two_blocks/case.toml", "defaults_shock_" + name, settings);
    EXPECT_TRUE(run.finished) << run.reason;
    return {450 - at(run.history, "T_upper[degC]", 2),
            ::testing::Matches(::testing::Contains(::testing::HasSubstr("gaps changed within steps")))(
                logging::warnings())};
  };
  const Shock brief = shock("short", {"time.step=\"0.02 s\""}), usual = shock("whole", {}),
              once = shock("once", {"coupling.gap_tolerance=1"});
  EXPECT_NEAR(usual.loss, brief.loss, 0.03 * brief.loss);
  EXPECT_GT(once.loss, 1.4 * brief.loss);
  EXPECT_TRUE(once.warned);
  EXPECT_FALSE(usual.warned || brief.warned);
  EXPECT_FALSE(shock("iterated", {"coupling.scheme=\"block_iterative\""}).warned);
}

}  // namespace
