/// What runs tell of castings that come later, of fixed steps, of keys that are gone and of steady states
/// that nothing holds; and friction of cold metal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const solidus::testing::CaseFolder k_here("told_by_runs");

const std::string k_plain = R"(title = "A metal"
density = "7800 kg/m3"
conductivity = "30 W/m/K"
specific_heat = "600 J/kg/K"
)",
                  k_alloy = R"(title = "An alloy"
density = "2500 kg/m3"
conductivity = "120 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "freezing"
solidification = true
latent_heat = "390 kJ/kg"
fraction = { kind = "linear", solidus = "560 degC", liquidus = "610 degC" }
)";

/// A bar in one dimension, heated at one end and cooled at the other by fluxes.
std::string between_fluxes(const std::string& time, double in, double out) {
  return R"(title = "Between fluxes"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
divisions = [8, 2]
[time]
)" + time +
         R"(
[[body]]
name = "block"
material = "plain.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "in"
group = "x_min"
kind = "flux"
flux = ")" +
         std::to_string(in) + R"( W/m2"
[[thermal_condition]]
name = "out"
group = "x_max"
kind = "flux"
flux = ")" +
         std::to_string(out) + R"( W/m2"
)";
}

TEST(SteadyState, OfFluxesThatNothingHoldsIsRefusedBeforeTheRun) {
  k_here.write("plain.toml", k_plain);
  EXPECT_THAT(k_here.refusal("unbalanced", between_fluxes("steady = true", 3e5, -2e5)),
              HasSubstr("nothing holds a temperature in 'block': there is no steady state, for 1000 W more "
                        "come in than go out"));
  ::testing::internal::CaptureStderr();
  const auto run = k_here.run("balanced", between_fluxes("steady = true", 3e5, -3e5));
  EXPECT_THAT(
      ::testing::internal::GetCapturedStderr(),
      HasSubstr("nothing holds a temperature in 'block': the steady state is fixed up to a constant"));
  EXPECT_TRUE(run.finished) << run.reason;
}

/// The error of the first step is that of the quench; it falls with the step.
TEST(FixedSteps, TellTheirErrorOfTime) {
  k_here.write("plain.toml", k_plain);
  const auto error = [](const std::string& step) {
    const auto run =
        k_here.run("fixed_" + step, between_fluxes("end = \"4 s\"\nstep = \"" + step + " s\"", 3e5, -3e5));
    EXPECT_TRUE(run.finished) << run.reason;
    return run.steps.at("temperature_error[K]");
  };
  const std::vector<double> coarse = error("2"), fine = error("0.5");
  for (const auto& errors : {coarse, fine})
    for (const double e : errors) EXPECT_GT(e, 0);
  EXPECT_GT(coarse[0], 2 * fine[0]);
  EXPECT_THAT(solidus::testing::read_text(k_here.root() / "fixed_2" / "summary.json"),
              HasSubstr("\"largest_step_error\""));
}

TEST(KeysThatAreGone, SayWhatToDoInstead) {
  k_here.write("plain.toml", k_plain);
  const std::string refusal =
      k_here.refusal("gone", between_fluxes("steady = true", 1, -1) + "[heat]\nexact_conductivity = true\n");
  EXPECT_THAT(refusal, HasSubstr("the key 'exact_conductivity' of [heat] is gone"));
  EXPECT_THAT(refusal, HasSubstr("leave it out"));
}

/// Field files name the components of tensors as probes do.
TEST(AxisymmetricTensors, HaveCylindricalNamesInFieldFiles) {
  k_here.write("elastic.toml", k_plain +
                                   "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\n"
                                   "expansion = \"1e-5 1/K\"\n");
  const auto run = k_here.run("cylindrical", R"(title = "A disc under pressure"
[analysis]
kind = "axisymmetric"
physics = "mechanics"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
divisions = [2, 1]
[time]
end = "1 s"
step = "1 s"
[[body]]
name = "block"
material = "elastic.toml"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "axis"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "table"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "press"
group = "y_max"
kind = "pressure"
pressure = "10 MPa"
[[probe]]
name = "axial"
kind = "mean"
field = "nodal_stress"
component = "zz"
group = "y_max"
unit = "MPa"
[[probe]]
name = "hoop"
kind = "mean"
field = "nodal_stress"
component = "tt"
group = "y_max"
unit = "MPa"
)");
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(run.history.at("axial[MPa]").back(), -10, 1e-3);
  EXPECT_NEAR(run.history.at("hoop[MPa]").back(), 0, 1e-3);
  std::string files;
  for (const auto& file : std::filesystem::directory_iterator(k_here.root() / "cylindrical" / "fields"))
    files += solidus::testing::read_text(file.path());
  EXPECT_THAT(files, HasSubstr("ComponentName1=\"ZZ\" ComponentName2=\"TT\""));
}

/// What is not computed is refused with the way round.
TEST(WhatIsNotComputed, IsRefusedWithTheWayRound) {
  const std::string plain = between_fluxes("steady = true", 1, -1);
  k_here.write("plain.toml", k_plain);
  std::string stressed = plain;
  stressed.insert(stressed.find("[[thermal_condition]]"), "prestress = \"1 MPa\"\n");
  const std::string of_stress = k_here.refusal("stressed", stressed);
  EXPECT_THAT(of_stress, HasSubstr("the key 'prestress' of [[body]] is not there"));
  EXPECT_THAT(of_stress, HasSubstr("[[stage]]"));
  const std::string load = R"([[mechanical_condition]]
name = "load"
group = "y_max"
kind = "metallostatic"
density = "2400 kg/m3"
level = { formula = "0.1 + x" }
)";
  const std::string of_load = k_here.refusal("placed", plain + load);
  EXPECT_THAT(of_load, HasSubstr("'level' is a formula or a file, which this key does not take"));
  EXPECT_THAT(of_load, HasSubstr("[[mesh.group]]"));
}

/// A plate is cast, and 40 s later another one on top of it.
const std::string k_two_pours = R"(title = "Two pours"
stage = [{ name = "first_pour", duration = "40 s" }, { name = "second_pour", duration = "100 s" }]
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
gap = "0 mm"
lower = ["4 mm", "10 mm"]
lower_divisions = [1, 10]
upper = ["4 mm", "15 mm"]
upper_divisions = [1, 15]
[time]
adaptive = true
step = "0.5 s"
[[body]]
name = "lower"
material = "alloy.toml"
initial_temperature = "700 degC"
[[body]]
name = "upper"
material = "alloy.toml"
initial_temperature = "720 degC"
stages = "second_pour"
[[thermal_condition]]
name = "mould"
group = "lower_y_min"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "weld"
slave = "upper_bottom"
master = "lower_top"
stages = "second_pour"
[contact.heat]
conductance = "5000 W/m2/K"
gap_law = "constant"
)";

TEST(CastingsThatComeLater, AreToldAsTheyAre) {
  k_here.write("alloy.toml", k_alloy);
  ::testing::internal::CaptureStderr();
  const auto run = k_here.run("two_pours", k_two_pours);
  const std::string told = ::testing::internal::GetCapturedStderr();
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_THAT(told, HasSubstr("'upper' comes new"));
  EXPECT_THAT(told, Not(HasSubstr("'upper' leaves")));
  const std::string summary = solidus::testing::read_text(k_here.root() / "two_pours" / "summary.json");
  const auto frozen = [&](const std::string& body) {
    const std::size_t casting = summary.find('"' + body + "\": {", summary.find("\"castings\""));
    const std::size_t at = summary.find("\"value[s]\": ", casting);
    return std::stod(summary.substr(at + 12));
  };
  // Both from their own pours, and the first one in its own stage.
  EXPECT_GT(frozen("lower"), 3);
  EXPECT_LT(frozen("lower"), 40);
  EXPECT_GT(frozen("upper"), frozen("lower"));
  EXPECT_LT(frozen("upper"), 100);
}

/// Two blocks that slide on each other, cold, with or without a phase change in their card.
std::string sliding(const std::string& card) {
  return R"(title = "Cold blocks that rub"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
gap = "0 mm"
lower = ["10 mm", "20 mm"]
lower_divisions = [2, 20]
upper = ["10 mm", "20 mm"]
upper_divisions = [2, 20]
[time]
end = "5 s"
step = "0.5 s"
[[body]]
name = "lower"
material = ")" +
         card + R"("
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = ")" +
         card + R"("
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "lower"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "slide"
group = "upper"
kind = "displacement"
ux = { of = "time", points = [["0 s", "0 mm"], ["5 s", "0.5 mm"]] }
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "press"
group = "upper_y_max"
kind = "displacement"
uy = "-0.01 mm"
[[thermal_condition]]
name = "cool"
group = "lower_y_min"
kind = "temperature"
temperature = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
wet = false
[contact.heat]
conductance = "20000 W/m2/K"
gap_law = "constant"
[contact.friction]
coefficient = 0.3
[[probe]]
name = "T"
kind = "mean"
field = "temperature"
group = "lower_top"
unit = "degC"
)";
}

const std::string k_elastic = R"(young_modulus = "70 GPa"
poisson_ratio = 0.0
expansion = "0 1/K"
)";

TEST(FrictionOfColdMetal, WarmsItAlikeWhetherItsCardCouldMeltOrNot) {
  const std::string head = k_alloy.substr(0, k_alloy.find("[[phase_change]]")),
                    freezing = k_alloy.substr(k_alloy.find("[[phase_change]]"));
  k_here.write("solid.toml", head + k_elastic);
  k_here.write("fusible.toml", head + k_elastic + freezing);
  const auto solid = k_here.run("cold_solid", sliding("solid.toml")),
             fusible = k_here.run("cold_fusible", sliding("fusible.toml"));
  ASSERT_TRUE(solid.finished && fusible.finished) << solid.reason << fusible.reason;
  const std::vector<double>&of_solid = solid.history.at("T[degC]"),
        &of_fusible = fusible.history.at("T[degC]");
  ASSERT_EQ(of_solid.size(), of_fusible.size());
  EXPECT_GT(of_solid.back(), 20.01);
  for (std::size_t n = 0; n < of_solid.size(); ++n)
    EXPECT_NEAR(of_fusible[n] - 20, of_solid[n] - 20, 0.01 * (of_solid.back() - 20)) << n;
}

}  // namespace
