/// Further problems with a closed form that only say what they are, of bodies without contact: nothing
/// numerical is set.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using ::testing::HasSubstr;

std::string steel(const std::string& more = "") {
  return "density = \"7800 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
         "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\nexpansion = \"1e-6 1/K\"\n"
         "expansion_reference = \"300 degC\"\n" +
         more;
}

std::string held(const std::string& group, const std::string& direction) {
  return fmt::format(
      "[[mechanical_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"displacement\"\n{1} = \"0 mm\"\n",
      group, direction);
}

std::string probe(const std::string& name, const std::string& field, const std::string& component,
                  const std::string& point, const std::string& unit) {
  return fmt::format("[[probe]]\nname = \"{}\"\nfield = \"{}\"\n{}point = {}\nunit = \"{}\"\n", name, field,
                     component.empty() ? "" : fmt::format("component = \"{}\"\n", component), point, unit);
}

/// A plate of half the thickness L that a film cools on both sides: T by Fourier's series, and across it the
/// stress E α/(1 − ν) (mean of T − T) of a plate that may expand but not bend (S. P. Timoshenko, J. N.
/// Goodier, Theory of Elasticity, 1951, § 131, 133).
struct Plate {
  double half, conductivity, capacity, film, start, ambient;
  std::vector<double> roots;  ///< of z tan z = h L/k

  Plate(double l, double k, double rho_c, double h, double from, double to)
      : half(l), conductivity(k), capacity(rho_c), film(h), start(from), ambient(to) {
    constexpr int k_terms = 60;
    for (int n = 0; n < k_terms; ++n) {
      double low = n * std::numbers::pi, high = low + std::numbers::pi / 2;
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (middle * std::tan(middle) > film * half / conductivity ? high : low) = middle;
      }
      roots.push_back(0.5 * (low + high));
    }
  }
  template <class Shape>
  double sum(double time, const Shape& shape) const {
    double all = 0;
    for (const double z : roots)
      all += 4 * std::sin(z) / (2 * z + std::sin(2 * z)) * shape(z) *
             std::exp(-z * z * conductivity / capacity * time / (half * half));
    return ambient + (start - ambient) * all;
  }
  double temperature(double x, double time) const {
    return sum(time, [&](double z) { return std::cos(z * x / half); });
  }
  double mean(double time) const {
    return sum(time, [](double z) { return std::sin(z) / z; });
  }
};

CaseRun quenched_plate(const CaseFolder& folder, int divisions, const std::string& step) {
  return folder.run("plate_" + std::to_string(divisions),
                    fmt::format(R"(
title = "A plate is quenched"
[analysis]
kind = "solid"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["50 mm", "5 mm", "5 mm"]
divisions = [{}, 1, 1]
[time]
end = "100 s"
step = "{}"
[[body]]
name = "block"
material = "steel.toml"
initial_temperature = "300 degC"
[[thermal_condition]]
name = "water"
group = "x_max"
kind = "film"
coefficient = "3200 W/m2/K"
ambient = "20 degC"
[[mechanical_condition]]
name = "plane_y"
group = "y_max"
kind = "plane"
[[mechanical_condition]]
name = "plane_z"
group = "z_max"
kind = "plane"
)",
                                divisions, step) +
                        held("x_min", "ux") + held("y_min", "uy") + held("z_min", "uz") +
                        probe("T_middle", "temperature", "", R"(["0 mm", "2.5 mm", "2.5 mm"])", "degC") +
                        probe("T_skin", "temperature", "", R"(["50 mm", "2.5 mm", "2.5 mm"])", "degC") +
                        probe("s_middle", "nodal_stress", "yy", R"(["0 mm", "2.5 mm", "2.5 mm"])", "MPa") +
                        probe("s_skin", "nodal_stress", "yy", R"(["50 mm", "2.5 mm", "2.5 mm"])", "MPa"));
}

TEST(ClosedFormsOfSolids, AQuenchedPlateHasTheStressesOfItsTemperatures) {
  const CaseFolder folder("closed_forms_plate");
  folder.write("steel.toml", steel());
  const Plate plate(0.05, 40, 7800 * 500, 3200, 300, 20);
  constexpr double k_scale = 1e-6 * 200e9 / (1 - 0.3) * 1e-6;  // E α/(1 − ν) [MPa/K]
  std::vector<double> worst;
  for (const auto& [divisions, step] : {std::pair{12, "2 s"}, std::pair{25, "1 s"}}) {
    const CaseRun run = quenched_plate(folder, divisions, step);
    ASSERT_TRUE(run.finished) << run.reason;
    worst.push_back(0);
    for (const double time : {10.0, 50.0, 100.0})
      for (const auto& [x, place] : {std::pair{0.0, "middle"}, std::pair{0.05, "skin"}}) {
        const double exact = plate.temperature(x, time), stress = k_scale * (plate.mean(time) - exact);
        const double found = at(run.history, std::string("s_") + place + "[MPa]", time);
        worst.back() = std::max(worst.back(), std::abs(found - stress));
        if (divisions < 25) continue;
        EXPECT_NEAR(at(run.history, std::string("T_") + place + "[degC]", time), exact, 0.3) << place << time;
        EXPECT_NEAR(found, stress, 0.01 * 33) << place << ' ' << time << " s";  // of the largest stress
      }
  }
  RecordProperty("worst", fmt::format("{:.3g} and {:.3g} MPa of 33", worst[0], worst[1]));
  EXPECT_LT(worst[1], 0.45 * worst[0]);  // first order and better, in mesh and step together
}

std::string tube(const std::string& material, const std::string& pressure, const std::string& time) {
  return R"(
title = "A tube under pressure"
[analysis]
kind = "axisymmetric"
physics = "mechanics"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
origin = ["10 mm", "0 mm"]
size = ["10 mm", "0.5 mm"]
divisions = [20, 1]
[time]
)" + time +
         "[[body]]\nname = \"block\"\nmaterial = \"" + material + "\"\ninitial_temperature = \"300 degC\"\n" +
         "[[mechanical_condition]]\nname = \"inside\"\ngroup = \"x_min\"\nkind = \"pressure\"\npressure = " +
         pressure + "\n" + held("y_min", "uz") + held("y_max", "uz") +
         probe("hoop_bore", "nodal_stress", "tt", R"(["10 mm", "0.25 mm"])", "MPa") +
         probe("hoop_skin", "nodal_stress", "tt", R"(["20 mm", "0.25 mm"])", "MPa");
}

// Steady creep by a power law of the overstress with next to no yield stress, in plane strain:
// σ_t = p ((2/n − 1) (b/r)^(2/n) + 1)/((b/a)^(2/n) − 1)  (I. Finnie, W. R. Heller, Creep of Engineering
// Materials, 1959, ch. 7).
TEST(ClosedFormsOfSolids, ATubeThatCreepsHasTheStressesOfThePowerLaw) {
  const CaseFolder folder("closed_forms_creep");
  constexpr double n = 4, p = 50, ratio = 2;
  folder.write("creeping.toml",
               steel("[plasticity]\nflow_stress = \"1 kPa\"\nrate_dependence = \"perzyna\"\n"
                     "rate_exponent = 4\ndrag_stress = \"100 MPa\"\nviscosity = \"1e11 Pa s\"\n"));
  const CaseRun run =
      folder.run("creep", tube("creeping.toml", "\"50 MPa\"", "end = \"200 s\"\nstep = \"4 s\"\n"));
  ASSERT_TRUE(run.finished) << run.reason;
  const double all = std::pow(ratio, 2 / n) - 1;
  EXPECT_NEAR(at(run.history, "hoop_bore[MPa]", 200), p * ((2 / n - 1) * std::pow(ratio, 2 / n) + 1) / all,
              0.2);
  EXPECT_NEAR(at(run.history, "hoop_skin[MPa]", 200), p * (2 / n) / all, 0.2);
}

// A bar that is pulled at once and held at its length relaxes by σ' = −E √⅔ D/η (√⅔ σ/D)^n (F. H. Norton, The
// Creep of Steel at High Temperatures, 1929). Nothing moves while it does: steps follow the error of stress,
// and where that is let go they grow until the answer is off.
TEST(ClosedFormsOfSolids, ABarHeldAtItsLengthRelaxesByThePowerLawInAdaptiveSteps) {
  const CaseFolder folder("closed_forms_relaxation");
  constexpr double young = 200e3, n = 4, drag = 100, viscosity = 1e7, pulled = 100;  // [MPa], [MPa s]
  folder.write("creeping.toml",
               steel("[plasticity]\nflow_stress = \"1 kPa\"\nrate_dependence = \"perzyna\"\n"
                     "rate_exponent = 4\ndrag_stress = \"100 MPa\"\nviscosity = \"1e13 Pa s\"\n"));
  const auto exact = [&](double t) {
    const double share = std::sqrt(2.0 / 3);
    const double rate = young * share * drag / viscosity * std::pow(share / drag, n);
    return std::pow(std::pow(pulled, 1 - n) + (n - 1) * rate * t, 1 / (1 - n));
  };
  const std::string text = R"(
title = "A bar is held at its length"
[analysis]
kind = "solid"
physics = "mechanics"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["10 mm", "10 mm", "10 mm"]
divisions = [1, 1, 1]
[output]
every = "100 s"
[time]
end = "1000 s"
step = "10 s"
adaptive = true
[[body]]
name = "block"
material = "creeping.toml"
initial_temperature = "300 degC"
[[mechanical_condition]]
name = "pull"
group = "x_max"
kind = "displacement"
ux = "0.005 mm"
)" + held("x_min", "ux") + held("y_min", "uy") +
                           held("z_min", "uz") +
                           probe("s", "stress", "xx", R"(["5 mm", "5 mm", "5 mm"])", "MPa");
  const auto worst = [&](const std::string& name, const std::vector<std::string>& settings) {
    const CaseRun run = folder.run(name, text, settings);
    EXPECT_TRUE(run.finished) << run.reason;
    double largest = 0;
    for (std::size_t i = 1; i < run.history.at("time[s]").size(); ++i)
      largest =
          std::max(largest, std::abs(run.history.at("s[MPa]")[i] / exact(run.history.at("time[s]")[i]) - 1));
    return largest;
  };
  EXPECT_GT(worst("unbounded", {"time.stress_error=1"}), 0.035);
  EXPECT_LT(worst("default", {}), 0.03);
  EXPECT_LT(worst("tight", {"time.stress_error=0.0005"}), 0.01);
}

// Beyond 2/√3 σ_0 ln(b/a) a tube of a metal that yields without hardening has no equilibrium (R. Hill, The
// Mathematical Theory of Plasticity, 1950, ch. V). The run ends there and says why, and where.
TEST(ClosedFormsOfSolids, ATubeThatYieldsCollapsesAtItsLimitLoadAndTheRunSaysSo) {
  const CaseFolder folder("closed_forms_limit");
  folder.write("perfect.toml", steel("[plasticity]\nflow_stress = \"100 MPa\"\n"));
  const CaseRun run = folder.run(
      "limit", tube("perfect.toml",
                    "{ of = \"time\", argument_unit = \"s\", unit = \"MPa\", points = [[0, 0], [100, 100]] }",
                    "end = \"100 s\"\nstep = \"2 s\"\n"));
  const double limit = 2 / std::sqrt(3.0) * 100 * std::log(2.0);
  EXPECT_FALSE(run.finished);
  EXPECT_NEAR(run.history.at("time[s]").back(), limit, 1e-3 * limit);  // 1 MPa/s
  EXPECT_THAT(run.reason, HasSubstr("is at its limit load: "));
  EXPECT_THAT(run.reason, HasSubstr("of its volume flows plastically"));
  EXPECT_THAT(run.reason, HasSubstr("where: node "));
  EXPECT_THAT(run.reason, HasSubstr("beyond its limit load a body that yields has no equilibrium"));
  EXPECT_THAT(run.reason, ::testing::Not(HasSubstr("is every body held")));
}

}  // namespace
