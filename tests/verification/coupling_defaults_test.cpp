/// Coupled schemes without any numerical settings: a layer between rigid walls is held to its series, and the
/// schemes that solve a phase more than once in a step to the solution of both fields at once.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "../cases/case_folder.hpp"
#include "analytic/coupled_layer.hpp"
#include "linear_strip.hpp"

namespace solidus {
namespace {

using testing::at;
using testing::CaseFolder;
using testing::CaseRun;

const std::vector<std::string> k_tight{"mechanics.tolerance=1e-10", "mechanics.displacement_tolerance=1e-7",
                                       "heat.tolerance=1e-11"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// The largest difference of a column at any time from `from` on, as a part of the range of the second one.
double difference(const CaseRun& found, const CaseRun& exact, const std::string& column, double from = 0) {
  const auto &x = found.history.at(column), &y = exact.history.at(column);
  const auto& time = exact.history.at("time[s]");
  if (x.size() != y.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 1; i < y.size(); ++i)
    if (time[i] >= from) largest = std::max(largest, std::abs(x[i] - y[i]));
  const auto [low, high] = std::minmax_element(y.begin() + 1, y.end());
  return largest / (*high - *low);
}

constexpr double k_coupling = 0.36;             // δ
constexpr double k_length = 0.1;                // [m]
constexpr double k_diffusion_time = 100;        // l²/a [s]
constexpr std::array k_times{5.0, 10.0, 20.0};  // [s]

/// The layer of analytic/coupled_layer.hpp as a case, with probes at quarters of its length; as many steps
/// over a fifth of the time l²/a of diffusion as there are elements.
std::string layer_case(int quads) {
  std::string text = fmt::format(R"(
title = "A coupled layer between rigid walls"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["100 mm", "{} mm"]
divisions = [{}, 1]
[time]
end = "20 s"
step = "{} s"
[[body]]
name = "layer"
group = "block"
material = "layer_material.toml"
initial_temperature = "300 K"
[[thermal_condition]]
name = "hot"
group = "x_max"
kind = "temperature"
temperature = "300.1 K"
[[probe]]
name = "stress"
kind = "mean"
field = "stress"
component = "xx"
group = "block"
unit = "Pa"
)",
                                 100.0 / quads, quads, 20.0 / quads);
  for (const auto& [group, component] :
       {std::pair{"x_min", "ux"}, {"x_max", "ux"}, {"y_min", "uy"}, {"y_max", "uy"}})
    text += fmt::format(
        "[[mechanical_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"displacement\"\n{1} = \"0 "
        "mm\"\n",
        group, component);
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "[[probe]]\nname = \"T{0}\"\nfield = \"temperature\"\npoint = [\"{1} mm\", \"0 mm\"]\nunit = \"K\"\n"
        "[[probe]]\nname = \"u{0}\"\nfield = \"displacement\"\ncomponent = \"x\"\n"
        "point = [\"{1} mm\", \"0 mm\"]\nunit = \"nm\"\n",
        i, 25 * i);
  return text;
}

/// The solid of linear_strip.hpp, whose stiffness and capacity it has, with heat that crosses 0.1 m in 100 s.
std::string layer_material() {
  const material::Material m = verification::LinearSolid{k_coupling}.material();
  return fmt::format(
      "density = \"1000 kg/m3\"\nconductivity = \"{} W/m/K\"\nspecific_heat = \"{} J/kg/K\"\n"
      "specific_heat_at = \"constant_strain\"\nyoung_modulus = \"{} Pa\"\npoisson_ratio = {}\n"
      "expansion = \"{} 1/K\"\nexpansion_reference = \"300 K\"\n",
      verification::LinearSolid::k_capacity * k_length * k_length / k_diffusion_time,
      verification::LinearSolid::k_capacity / 1000, m.young_modulus.max_value(), m.poisson_ratio.max_value(),
      m.expansion.max_value());
}

/// The largest errors of the probes at k_times: temperature over its rise, displacement over its largest of
/// the time, pressure on the walls over βΔΘ.
struct Errors {
  double temperature = 0, displacement = 0, pressure = 0;
};
Errors errors(const CaseRun& run) {
  using verification::LinearSolid;
  const LinearSolid solid{k_coupling};
  const analytic::CoupledLayer exact(k_coupling, 1, 1);
  Errors e;
  for (const double seconds : k_times) {
    const double time = seconds / k_diffusion_time;
    double largest = 0, u = 0;
    for (int i = 0; i <= 100; ++i) largest = std::max(largest, std::abs(exact.displacement(0.01 * i, time)));
    for (int i = 0; i < 4; ++i) {
      const double rise = at(run.history, fmt::format("T{}[K]", i), seconds) - LinearSolid::k_start;
      e.temperature =
          std::max(e.temperature, std::abs(rise / LinearSolid::k_rise - exact.temperature(0.25 * i, time)));
      const double moved = 1e-9 * at(run.history, fmt::format("u{}[nm]", i), seconds);
      u = std::max(u,
                   std::abs(moved / (solid.displacement() * k_length) - exact.displacement(0.25 * i, time)));
    }
    e.displacement = std::max(e.displacement, u / largest);
    e.pressure = std::max(e.pressure, std::abs(-at(run.history, "stress[Pa]", seconds) / solid.stress() -
                                               exact.mean_temperature(time)));
  }
  return e;
}

// Once errors of a layer whose steps and elements were halved grew with order −0.5, since a step was taken as
// converged when it was small against all that the layer carries.
TEST(CouplingDefaults, ACoupledLayerNearsItsSeriesWhenStepsAndElementsAreHalved) {
  auto out = verification::table("coupling_defaults_layer", "quads,T[rise],u[largest],pressure[beta rise]");
  const CaseFolder folder("coupling_defaults_layer");
  folder.write("layer_material.toml", layer_material());
  std::vector<Errors> all;
  for (const int quads : {40, 80, 160}) {
    const std::string name = fmt::format("quads_{}", quads);
    const CaseRun usual = folder.run(name, layer_case(quads)),
                  tight = folder.run(name + "_tight", layer_case(quads), k_tight);
    ASSERT_TRUE(usual.finished && tight.finished) << usual.reason << tight.reason;
    for (const std::string column :
         {"T0[K]", "T1[K]", "T2[K]", "T3[K]", "u1[nm]", "u2[nm]", "u3[nm]", "stress[Pa]"})
      EXPECT_LT(difference(usual, tight, column), 2e-5) << column << ", " << quads;
    const Errors e = all.emplace_back(errors(usual));
    out << quads << "," << e.temperature << "," << e.displacement << "," << e.pressure << "\n";
  }
  EXPECT_LT(all.back().temperature, 1e-3);
  EXPECT_LT(all.back().displacement, 1.6e-3);
  EXPECT_LT(all.back().pressure, 4e-4);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NEAR(verification::order(all[i - 1].temperature, all[i].temperature), 1.05, 0.1);
    EXPECT_NEAR(verification::order(all[i - 1].displacement, all[i].displacement), 1.1, 0.1);
    EXPECT_NEAR(verification::order(all[i - 1].pressure, all[i].pressure), 1.15, 0.15);
  }
}

/// Section 7.1 of the monograph, in steps of 10 s, with no numerical settings.
std::string cylinder_case(const std::string& material) {
  std::string text = fmt::format(R"(
title = "Thick-walled cylinder"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
origin = ["100 mm", "0 mm"]
size = ["100 mm", "1 mm"]
divisions = [50, 1]
[time]
end = "1000 s"
step = "10 s"
[[body]]
name = "wall"
group = "block"
material = "{}/cases/thick_cylinder/materials/{}.toml"
initial_temperature = "593 K"
[[thermal_condition]]
name = "coolant"
group = "x_min"
kind = "film"
coefficient = "1160 W/m2/K"
ambient = "293 K"
[[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = "10 W/m2/K"
ambient = "293 K"
[[mechanical_condition]]
name = "pressure"
group = "x_min"
kind = "pressure"
pressure = "200 MPa"
[[mechanical_condition]]
name = "lower_face"
group = "y_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "upper_face"
group = "y_max"
kind = "displacement"
uz = "0 mm"
)",
                                 SOLIDUS_SOURCE_DIR, material);
  for (const auto& [name, radius] : {std::pair{"inner", 100}, {"outer", 200}})
    text += fmt::format(
        "[[probe]]\nname = \"u_{0}\"\nfield = \"displacement\"\ncomponent = \"r\"\n"
        "point = [\"{1} mm\", \"0 mm\"]\nunit = \"mm\"\n"
        "[[probe]]\nname = \"T_{0}\"\nfield = \"temperature\"\npoint = [\"{1} mm\", \"0 mm\"]\nunit = "
        "\"K\"\n",
        name, radius);
  return text;
}

constexpr std::array k_probes{"u_inner[mm]", "u_outer[mm]", "T_inner[K]", "T_outer[K]"};

TEST(CouplingDefaults, PassesThatAgreeAreTheTightSolutionOfBothFieldsAtOnce) {
  auto out = verification::table("coupling_defaults_iterated", "material,probe,difference[range]");
  const CaseFolder folder("coupling_defaults_iterated");
  for (const std::string material : {"te_x1", "te_x6", "tp_x1", "tp_x6"}) {
    const CaseRun passes = folder.run(material + "_passes", cylinder_case(material),
                                      {"coupling.scheme=\"block_iterative\""}),
                  at_once = folder.run(material + "_at_once", cylinder_case(material),
                                       with({"coupling.scheme=\"simultaneous\""}, k_tight));
    ASSERT_TRUE(passes.finished && at_once.finished) << passes.reason << at_once.reason;
    for (const std::string probe : k_probes) {
      const double d = difference(passes, at_once, probe);
      EXPECT_LT(d, 1.2e-7) << material << ", " << probe;
      out << material << "," << probe << "," << d << "\n";
    }
  }
}

// The double pass and two stages of both fields at once are different methods of second order: what is left
// of their difference is the step's, most of it in the first steps after the jump of the film's temperature.
TEST(CouplingDefaults, TheDoublePassIsThatOfTightToleranceAndNearBothFieldsAtOnce) {
  auto out = verification::table("coupling_defaults_double_pass", "material,probe,from_tight[range]");
  const CaseFolder folder("coupling_defaults_double_pass");
  const std::string double_pass = "coupling.scheme=\"double_pass\"";
  for (const std::string material : {"te_x1", "te_x6", "tp_x1", "tp_x6"}) {
    const std::string text = cylinder_case(material);
    const CaseRun usual = folder.run(material, text, {double_pass}),
                  tight = folder.run(material + "_tight", text, with({double_pass}, k_tight));
    ASSERT_TRUE(usual.finished && tight.finished) << usual.reason << tight.reason;
    for (const std::string probe : k_probes) {
      const double d = difference(usual, tight, probe);
      EXPECT_LT(d, 2e-4) << material << ", " << probe;
      out << material << "," << probe << "," << d << "\n";
    }
    if (material != "te_x1") continue;
    const CaseRun at_once =
        folder.run(material + "_at_once", text,
                   with({"coupling.scheme=\"simultaneous\"", "coupling.integration=\"sdirk2\""}, k_tight));
    ASSERT_TRUE(at_once.finished) << at_once.reason;
    for (const std::string probe : k_probes) {
      EXPECT_LT(difference(usual, at_once, probe, 100), 8e-5) << probe;
      EXPECT_LT(difference(usual, at_once, probe), probe == "T_inner[K]" ? 4e-3 : 8e-5) << probe;
    }
  }
}

// The pressure is there at once and makes the bore yield in the first step: were that plastic strain carried
// on to the second stage, 1 + √2 times it would remain, whatever the step (0.290 and 0.372 mm here).
TEST(CouplingDefaults, TwoStagesOfBothFieldsDoNotMultiplyTheFlowOfALoadThatJumps) {
  const CaseFolder folder("coupling_defaults_jump");
  const std::string text = cylinder_case("tp_x1");
  const std::vector<std::string> brief{"time.step=\"2.5 s\"", "time.end=\"100 s\""};
  const CaseRun stages = folder.run(
                    "stages", text,
                    with({"coupling.scheme=\"simultaneous\"", "coupling.integration=\"sdirk2\""}, brief)),
                passes = folder.run("double_pass", text, with({"coupling.scheme=\"double_pass\""}, brief));
  ASSERT_TRUE(stages.finished && passes.finished) << stages.reason << passes.reason;
  for (const double time : {2.5, 100.0}) {
    const double u = at(passes.history, "u_inner[mm]", time);
    EXPECT_NEAR(at(stages.history, "u_inner[mm]", time), u, (time < 3 ? 1e-2 : 3e-3) * u) << time;
  }
}

}  // namespace
}  // namespace solidus
