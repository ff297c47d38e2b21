/// Further problems with a closed form that only say what they are, of bodies that cool and freeze: nothing
/// numerical is set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "case_folder.hpp"
#include "quarter_ball.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;

/// A ball of the radius R that a film cools: T by Fourier's series (H. S. Carslaw, J. C. Jaeger, Conduction
/// of Heat in Solids, 1959, § 9.4), the hoop stress in its middle and at its skin (S. P. Timoshenko, J. N.
/// Goodier, Theory of Elasticity, 1951, § 136):
///
///   2/3 E α/(1 − ν) (mean of T − T_middle),   E α/(1 − ν) (mean of T − T_skin).
struct Ball {
  double radius, conductivity, capacity, film, start, ambient;
  std::vector<double> roots;  ///< of 1 − z cot z = h R/k

  Ball(double r, double k, double rho_c, double h, double from, double to)
      : radius(r), conductivity(k), capacity(rho_c), film(h), start(from), ambient(to) {
    constexpr int k_terms = 60;
    for (int n = 0; n < k_terms; ++n) {
      double low = n * std::numbers::pi + 1e-12, high = (n + 1) * std::numbers::pi - 1e-12;
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (1 - middle / std::tan(middle) > film * radius / conductivity ? high : low) = middle;
      }
      roots.push_back(0.5 * (low + high));
    }
  }
  template <class Shape>
  double sum(double time, const Shape& shape) const {
    double all = 0;
    for (const double z : roots)
      all += 4 * (std::sin(z) - z * std::cos(z)) / (2 * z - std::sin(2 * z)) * shape(z) *
             std::exp(-z * z * conductivity / capacity * time / (radius * radius));
    return ambient + (start - ambient) * all;
  }
  double middle(double time) const {
    return sum(time, [](double) { return 1.0; });
  }
  double skin(double time) const {
    return sum(time, [](double z) { return std::sin(z) / z; });
  }
  double mean(double time) const {
    return sum(time, [](double z) { return 3 * (std::sin(z) - z * std::cos(z)) / (z * z * z); });
  }
};

CaseRun quenched_ball(const CaseFolder& folder, const std::string& name, double size, double step) {
  folder.write(name + ".geo", solidus::testing::quarter_ball(size));
  const std::string hoop = "tt";
  return folder.run(name, fmt::format(R"(title = "A ball is quenched"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
file = "{}.geo"
unit = "mm"
[time]
end = "80 s"
step = "{} s"
[[body]]
name = "ball"
material = "steel.toml"
initial_temperature = "300 degC"
[[thermal_condition]]
name = "water"
group = "skin"
kind = "film"
coefficient = "3200 W/m2/K"
ambient = "20 degC"
[[mechanical_condition]]
name = "equator"
group = "equator"
kind = "displacement"
uz = "0 mm"
)",
                                      name, step) +
                              solidus::testing::probe_on_equator("T_middle", "temperature", "", 0, "degC") +
                              solidus::testing::probe_on_equator("T_skin", "temperature", "", 50, "degC") +
                              solidus::testing::probe_on_equator("s_middle", "nodal_stress", hoop, 0, "MPa") +
                              solidus::testing::probe_on_equator("s_skin", "nodal_stress", hoop, 50, "MPa"));
}

TEST(ClosedFormsOfHeat, AQuenchedBallHasTheTemperaturesAndStressesOfItsSeries) {
  const CaseFolder folder("closed_forms_ball");
  folder.write("steel.toml",
               "density = \"7800 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
               "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\nexpansion = \"1e-6 1/K\"\n"
               "expansion_reference = \"300 degC\"\n");
  const Ball ball(0.05, 40, 7800 * 500, 3200, 300, 20);
  constexpr double k_scale = 1e-6 * 200e9 / (1 - 0.3) * 1e-6;  // E α/(1 − ν) [MPa/K]
  std::vector<std::array<double, 2>> worst;                    // [K], [MPa]
  for (const auto& [name, size, step] : {std::tuple{"coarse", 5.0, 2.0}, std::tuple{"fine", 2.5, 1.0}}) {
    const CaseRun run = quenched_ball(folder, name, size, step);
    ASSERT_TRUE(run.finished) << run.reason;
    auto& [temperature, stress] = worst.emplace_back();
    for (const double time : {10.0, 40.0, 80.0}) {
      const double mean = ball.mean(time), middle = ball.middle(time), skin = ball.skin(time);
      const auto off = [&](const char* column, double exact) {
        return std::abs(at(run.history, column, time) - exact);
      };
      temperature = std::max({temperature, off("T_middle[degC]", middle), off("T_skin[degC]", skin)});
      stress = std::max({stress, off("s_middle[MPa]", 2 * k_scale / 3 * (mean - middle)),
                         off("s_skin[MPa]", k_scale * (mean - skin))});
    }
  }
  RecordProperty("worst", fmt::format("{:.3g} and {:.3g} K of 280, {:.3g} and {:.3g} MPa of 24", worst[0][0],
                                      worst[1][0], worst[0][1], worst[1][1]));
  EXPECT_LT(worst[1][0], 0.3);
  EXPECT_LT(worst[1][1], 0.15);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(worst[1][i], 0.45 * worst[0][i]) << i;  // mesh and step halved
}

/// The frozen part of a square of the width `width`, of which two sides that meet are kept cold: that behind
/// the front y = [λ^m + C/(x^m − λ^m)]^(1/m), lengths over √(4 a t), with λ = 0.70766, C = 0.159, m = 5.02
/// for L/(c ΔT) = 0.25 and a superheat of 0.3 ΔT, a fit of its authors (K. A. Rathjen, L. M. Jiji, J. Heat
/// Transfer 93 (1971) 101).
double frozen_part(double width, double diffusivity, double time) {
  constexpr double k_lambda = 0.70766, k_fit = 0.159, k_power = 5.02;
  constexpr int k_cells = 20000;
  const double side = width / std::sqrt(4 * diffusivity * time);
  // Cells of equal ratio in x − λ.
  const double from = std::log(1e-9), cell = (std::log(side - k_lambda) - from) / k_cells;
  double area = k_lambda * side;
  for (int i = 0; i < k_cells; ++i) {
    const double beyond = std::exp(from + (i + 0.5) * cell), x = k_lambda + beyond;
    const double lambda_m = std::pow(k_lambda, k_power);
    area += std::min(side, std::pow(lambda_m + k_fit / (std::pow(x, k_power) - lambda_m), 1 / k_power)) *
            beyond * cell;
  }
  return area / (side * side);
}

TEST(ClosedFormsOfHeat, ACornerFreezesAsRathjenAndJijiHaveIt) {
  const CaseFolder folder("closed_forms_corner");
  folder.write("melt.toml",
               "density = \"7000 kg/m3\"\nconductivity = \"30 W/m/K\"\nspecific_heat = \"700 J/kg/K\"\n"
               "[[phase_change]]\nname = \"solidification\"\nsolidification = true\n"
               "latent_heat = \"87.5 kJ/kg\"\n[phase_change.fraction]\nsolidus = \"600 degC\"\n"
               "liquidus = \"600 degC\"\n");
  const auto cold = [](const std::string& group) {
    return fmt::format(
        "[[thermal_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"temperature\"\n"
        "temperature = \"100 degC\"\n",
        group);
  };
  const CaseRun run = folder.run("corner", R"(title = "A corner freezes"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["60 mm", "60 mm"]
divisions = [60, 60]
[time]
end = "12 s"
step = "0.25 s"
[[body]]
name = "block"
material = "melt.toml"
initial_temperature = "750 degC"
)" + cold("x_min") + cold("y_min"));
  ASSERT_TRUE(run.finished) << run.reason;
  for (const double time : {6.0, 9.0, 12.0}) {
    const double exact = frozen_part(0.06, 30 / (7000. * 700), time);
    const double found = at(run.history, "solid_fraction[1]", time);
    RecordProperty(fmt::format("at_{}", time), fmt::format("{:.4g} for {:.4g}", found, exact));
    EXPECT_NEAR(found, exact, 0.015 * exact) << time << " s";
  }
}

}  // namespace
