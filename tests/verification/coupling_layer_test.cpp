/// The quasi-static coupled layer against its series (analytic/coupled_layer.hpp): temperature, displacement
/// and wall pressure by every scheme that is stable there, and their orders in the time step.
#include <gtest/gtest.h>

#include <map>

#include "analytic/coupled_layer.hpp"
#include "linear_strip.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using verification::Coupled;
using verification::LinearSolid;
using verification::StripFields;
using verification::StripScheme;

constexpr auto k_two_stages = coupling::SimultaneousOptions::Integration::sdirk2;
const StripScheme k_isentropic{"isentropic", Mapping::isentropic};
const StripScheme k_isothermal{"isothermal", Mapping::isothermal};
const StripScheme k_simultaneous{"simultaneous", Mapping::simultaneous};
const StripScheme k_sdirk2{"sdirk2", Mapping::simultaneous, false, false, k_two_stages};
const StripScheme k_double_pass{"double_pass", Mapping::isentropic, true};
const StripScheme k_iterated{"block_iterative", Mapping::isentropic, false, true};

constexpr int k_quads = 40;
constexpr double k_end = 0.2;  // of the time l²/a of diffusion

Coupled layer(const LinearSolid& solid, const StripScheme& scheme) {
  Coupled c = verification::linear_strip(solid, scheme, 1, k_quads);
  c.hold("left", 0);
  c.thermal.temperatures.push_back({"hot", "right", LinearSolid::k_start + LinearSolid::k_rise});
  return c;
}

/// The largest differences of a time, displacement relative to its largest.
struct Errors {
  double temperature = 0, displacement = 0, pressure = 0;
};
Errors errors(const StripFields& f, const analytic::CoupledLayer& exact, double time) {
  Errors e;
  double largest = 0;
  for (std::size_t i = 0; i <= k_quads; ++i) {
    const double x = static_cast<double>(i) / k_quads, u = exact.displacement(x, time);
    e.temperature = std::max(e.temperature, std::abs(f.temperature[i] - exact.temperature(x, time)));
    e.displacement = std::max(e.displacement, std::abs(f.displacement[i] - u));
    largest = std::max(largest, std::abs(u));
  }
  e.displacement /= largest;
  for (const double stress : f.stress)
    e.pressure = std::max(e.pressure, std::abs(-stress - exact.mean_temperature(time)));
  return e;
}

TEST(CoupledLayer, FollowsItsSeriesWithinOnePercentByEveryScheme) {
  auto out = verification::table("coupling_layer", "delta,scheme,T[rise],u[largest],pressure[beta rise]");
  constexpr int n_steps = 400;  // a split's displacement lags by a step
  constexpr double dt = k_end / n_steps;
  for (const double delta : {0.05, 0.36, 1.0})
    for (const StripScheme& scheme :
         {k_isentropic, k_simultaneous, k_iterated, k_double_pass, k_isothermal}) {
      if (scheme.mapping == Mapping::isothermal && delta >= 1) continue;  // where it is not stable
      SCOPED_TRACE(scheme.name + " " + std::to_string(delta));
      const LinearSolid solid{delta};
      const analytic::CoupledLayer exact(delta, 1, 1);
      Errors worst;
      verification::march_strip(layer(solid, scheme), solid, dt, n_steps, [&](int n, const StripFields& f) {
        if (n != n_steps / 4 && n != n_steps / 2 && n != n_steps) return;
        const Errors e = errors(f, exact, n * dt);
        worst.temperature = std::max(worst.temperature, e.temperature);
        worst.displacement = std::max(worst.displacement, e.displacement);
        worst.pressure = std::max(worst.pressure, e.pressure);
      });
      EXPECT_LT(worst.temperature, 0.01);
      EXPECT_LT(worst.displacement, 0.01);
      EXPECT_LT(worst.pressure, 0.01);
      out << delta << "," << scheme.name << "," << worst.temperature << "," << worst.displacement << ","
          << worst.pressure << "\n";
    }
}

TEST(CoupledLayer, IsWarmedFarFromItsHotFaceByCompressionTheMoreTheStrongerTheCoupling) {
  auto out = verification::table("coupling_layer_profile",
                                 "x[l],exact_δ_0.05,isentropic_δ_0.05,exact_δ_0.36,isentropic_δ_0.36,"
                                 "exact_δ_1,isentropic_δ_1");
  std::vector<std::vector<double>> columns;
  constexpr int n_steps = 100;
  for (const double delta : {0.05, 0.36, 1.0}) {
    const LinearSolid solid{delta};
    const analytic::CoupledLayer exact(delta, 1, 1);
    std::vector<double> series;
    for (std::size_t i = 0; i <= k_quads; ++i)
      series.push_back(exact.temperature(static_cast<double>(i) / k_quads, k_end));
    columns.push_back(series);
    verification::march_strip(layer(solid, k_isentropic), solid, k_end / n_steps, n_steps,
                              [&](int n, const StripFields& f) {
                                if (n == n_steps) columns.push_back(f.temperature);
                              });
  }
  for (std::size_t i = 0; i <= k_quads; ++i) {
    out << static_cast<double>(i) / k_quads;
    for (const auto& column : columns) out << "," << column[i];
    out << "\n";
  }
  for (std::size_t c = 2; c < columns.size(); ++c) EXPECT_GT(columns[c][0], columns[c - 2][0] + 0.02);
}

// Differences of successive refinements: the mesh's error is not in them. After the jump of the face's
// temperature the double pass shows one and a half of its two orders; with smooth conditions it has both
// (coupling_double_pass_test.cpp).
TEST(CoupledLayer, IsApproachedWithTheOrderOfTheScheme) {
  auto out = verification::table("coupling_layer_order",
                                 "step[l²/a],isentropic,isothermal,simultaneous,double_pass,sdirk2");
  const std::vector<int> n_steps{25, 50, 100, 200};
  const LinearSolid solid{0.36};
  std::vector<std::vector<double>> all;
  for (const StripScheme& scheme : {k_isentropic, k_isothermal, k_simultaneous, k_double_pass, k_sdirk2}) {
    std::vector<std::vector<double>> ends;
    for (const int steps : n_steps)
      verification::march_strip(layer(solid, scheme), solid, k_end / steps, steps,
                                [&](int n, const StripFields& f) {
                                  if (n == steps) ends.push_back(f.temperature);
                                });
    std::vector<double>& difference = all.emplace_back();
    for (std::size_t i = 1; i < ends.size(); ++i) {
      double d = 0;
      for (std::size_t j = 0; j < ends[i].size(); ++j) d = std::max(d, std::abs(ends[i][j] - ends[i - 1][j]));
      difference.push_back(d);
    }
    const double expected = scheme.double_pass ? 1.5 : scheme.integration == k_two_stages ? 2 : 1;
    EXPECT_NEAR(verification::order(difference[1], difference[2]), expected, 0.1) << scheme.name;
  }
  for (std::size_t i = 0; i + 1 < n_steps.size(); ++i) {
    out << k_end / n_steps[i];
    for (const auto& difference : all) out << "," << difference[i];
    out << "\n";
  }
}

}  // namespace
}  // namespace solidus
