/// The order in time of the simultaneous scheme on a smooth coupled problem: the cylinder of 7.1 with three
/// times its expansion, its pressure and the temperature outside rising and falling smoothly, elastic.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using coupling::SimultaneousOptions;
using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::Surfaces;

constexpr double k_end = 20;  // [s]

/// base + height sin²(π t/period) as a table so fine that its corners are 1e-7 of it.
Table swell(double base, double height, double period) {
  std::vector<double> t, value;
  constexpr int n = 2000;
  for (int i = 0; i <= n; ++i) {
    t.push_back(k_end * i / n);
    const double s = std::sin(std::numbers::pi * t.back() / period);
    value.push_back(base + height * s * s);
  }
  return {t, value};
}

Coupled smooth(SimultaneousOptions::Integration integration) {
  Coupled c;
  c.mesh = test::make_mesh({.shape = mesh::Shape::quad4,
                            .cells = {10, 1, 1},
                            .size = {0.1, 0.01, 1},
                            .map = [](const mesh::Point& x) {
                              return mesh::Point{x[0] + 0.1, x[1], 0};
                            }});
  c.kind = AnalysisKind::axisymmetric;
  c.materials = {verification::steel(3, false)};
  c.start = {593};
  c.hold("bottom", 1);
  c.hold("top", 1);
  c.mechanical.pressures.push_back({"left", swell(0, 2e8, 25)});
  c.thermal.films.push_back({"inner", "left", {1160.0}, swell(593, -250, 30)});
  c.mapping = Mapping::simultaneous;
  c.form = StructuralForm::energy;
  c.simultaneous.integration = integration;
  return c;
}

Surfaces end_of(SimultaneousOptions::Integration integration, int n_steps) {
  const Coupled c = smooth(integration);
  const auto run = verification::march(c, k_end, n_steps);
  return verification::surfaces(c.mesh, run.end);
}

TEST(SimultaneousScheme, IsOfFirstOrderWithBackwardEulerAndOfSecondWithTwoStages) {
  using Integration = SimultaneousOptions::Integration;
  auto out = verification::table(
      "coupling_order", "step[s],backward_euler: T[K],backward_euler: u[mm],sdirk2: T[K],sdirk2: u[mm]");
  const Surfaces exact = end_of(Integration::sdirk2, 640);
  const std::vector<int> n_steps{10, 20, 40, 80};
  std::map<Integration, std::vector<std::pair<double, double>>> errors;
  for (const int n : n_steps) {
    out << k_end / n;
    for (const auto integration : {Integration::backward_euler, Integration::sdirk2}) {
      const Surfaces s = end_of(integration, n);
      const double t = std::abs(s.temperature[0] - exact.temperature[0]), u = std::abs(s.u[1] - exact.u[1]);
      errors[integration].emplace_back(t, u);
      out << "," << t << "," << u;
    }
    out << "\n";
  }
  for (const auto& [integration, of] : errors)
    for (std::size_t i = 2; i < of.size(); ++i) {
      const double order = integration == Integration::sdirk2 ? 2 : 1;
      EXPECT_NEAR(verification::order(of[i - 1].first, of[i].first), order, 0.15) << "T, order " << order;
      // The film takes the mean of its surroundings over each stage, of second order with shorter steps
      // alone.
      EXPECT_NEAR(verification::order(of[i - 1].second, of[i].second), order, i + 1 == of.size() ? 0.15 : 0.2)
          << "u, order " << order;
    }
}

}  // namespace
}  // namespace solidus
