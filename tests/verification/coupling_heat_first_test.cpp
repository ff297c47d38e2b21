/// The sequential splits with heat first (coupling/sequential_split.hpp): what a step ends with belongs to
/// its own temperatures, both phases dissipate, the first law closes, and the limit is that of the other
/// order.
#include <gtest/gtest.h>

#include <numeric>

#include "casting_bodies.hpp"
#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using coupling::PhaseOrder;
using heat::ThermalStepping;
using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::CoupledRun;

constexpr double k_end = 80;  // [s]

/// A free block of 100 x 50 mm, symmetric on two sides, that cools through the two others.
Coupled block(PhaseOrder order) {
  Coupled c;
  c.mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {10, 5, 1}, .size = {0.1, 0.05, 1}});
  c.materials = {verification::steel(1, false)};
  c.start = {800};
  c.hold("left", 0);
  c.hold("bottom", 1);
  for (const char* side : {"right", "top"}) c.thermal.films.push_back({side, side, {2000.0}, 300.0});
  c.mapping = Mapping::isentropic;
  c.form = StructuralForm::energy;
  c.order = order;
  return c;
}

double edge(const Coupled& c, int n_steps) {
  const CoupledRun run = verification::march(c, k_end, n_steps);
  double u = 0;
  for (std::size_t i = 0; i < c.mesh.x.size(); ++i)
    if (c.mesh.x[i][0] > 0.0999 && c.mesh.x[i][1] > 0.0499) u = run.end.mechanics.displacement[2 * i];
  return -parallel::global_max(-u);
}

TEST(HeatFirst, ShrinksWithTheTemperaturesThatItEndsWith) {
  auto out = verification::table("coupling_heat_first_lag",
                                 "step[s],together[mm],heat_first[mm],mechanics_first[mm]");
  for (const int n : {4, 8, 16}) {
    Coupled together = block(PhaseOrder::heat_first);
    together.mapping = Mapping::simultaneous;
    const double reference = edge(together, n), here = edge(block(PhaseOrder::heat_first), n),
                 there = edge(block(PhaseOrder::mechanics_first), n);
    out << k_end / n << ',' << 1e3 * reference << ',' << 1e3 * here << ',' << 1e3 * there << '\n';
    EXPECT_LT(std::abs(here - reference), 0.05 * std::abs(there - reference)) << n;
    EXPECT_NEAR(here, reference, 2e-3 * std::abs(reference)) << n;
  }
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(HeatFirst, IsOfFirstOrderAndTendsToWhatTheDoublePassTendsTo) {
  const auto wall = [](PhaseOrder order, bool double_pass) {
    Coupled c = verification::cylinder({false, 3, Mapping::isentropic, StructuralForm::energy});
    c.mechanical.pressures = {{"left", verification::smooth(0, 2e8, k_end)}};
    c.thermal.films.clear();
    c.thermal.films.push_back({"inner", "left", {1160.0}, verification::smooth(593, 293, k_end)});
    c.order = order;
    c.double_pass = double_pass;
    return c;
  };
  const CoupledRun fine = verification::march(wall(PhaseOrder::mechanics_first, true), k_end, 128);
  auto out = verification::table("coupling_heat_first_order", "order,step[s],T[K],u[m]");
  std::vector<double> last;
  for (const PhaseOrder order : {PhaseOrder::heat_first, PhaseOrder::mechanics_first}) {
    std::vector<double> temperature, displacement;
    for (const int n : {32, 64, 128}) {
      const CoupledRun run = verification::march(wall(order, false), k_end, n);
      temperature.push_back(mean_difference(run.end.heat.temperature, fine.end.heat.temperature));
      displacement.push_back(
          mean_difference(run.end.mechanics.displacement, fine.end.mechanics.displacement));
      out << (order == PhaseOrder::heat_first ? "heat first" : "mechanics first") << ',' << k_end / n << ','
          << temperature.back() << ',' << displacement.back() << '\n';
    }
    EXPECT_NEAR(verification::order(temperature[1], temperature[2]), 1, 0.1);
    EXPECT_NEAR(verification::order(displacement[1], displacement[2]), 1, 0.1);
    last.push_back(displacement.back());
  }
  EXPECT_LT(last[0], last[1]);
}

// Section 7.1, weakly to strongly coupled: the functional is checked in every step (Assembly::advance).
TEST(HeatFirst, TheFunctionalFallsInEveryStepAndTheFirstLawCloses) {
  for (const bool plastic : {false, true})
    for (const int factor : {1, 3, 6})
      for (const double dt : {1.0, 10.0, 100.0, 1000.0})
        for (const StructuralForm form : {StructuralForm::energy, StructuralForm::entropy}) {
          SCOPED_TRACE(testing::Message()
                       << (plastic ? "plastic " : "elastic ") << factor << ", " << dt << " s");
          Coupled c = verification::cylinder({plastic, factor, Mapping::isentropic, form});
          c.order = PhaseOrder::heat_first;
          const CoupledRun run = verification::march(c, 10 * dt, 10);
          if (form == StructuralForm::energy) {
            EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
          }
        }
}

TEST(HeatFirst, StaysWithTheSimultaneousSolutionAtSixTimesExpansion) {
  for (const bool plastic : {false, true}) {
    Coupled c = verification::cylinder({plastic, 6, Mapping::isentropic, StructuralForm::energy});
    c.order = PhaseOrder::heat_first;
    const CoupledRun run = verification::march(c, 1000, 100);
    const verification::Surfaces here = verification::surfaces(c.mesh, run.end);
    const verification::Surfaces there =
        verification::reference({plastic, 6, Mapping::isentropic}, "simultaneous_energy", 1000);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(here.temperature[i], there.temperature[i], 6) << plastic;
  }
}

// With freezing, contact that opens, conduction through the gap and melt that flows; the functional where the
// conditions are admissible.
TEST(HeatFirst, ClosesTheFirstLawOfACastingThatFreezesAndLeavesItsMould) {
  for (const double pressure : {0.0, 2e5})
    for (const Mapping mapping : {Mapping::isentropic, Mapping::isothermal})
      for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
        for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2}) {
          Coupled c = verification::casting(pressure);
          c.form = StructuralForm::energy;
          c.mapping = mapping;
          c.integration = rule;
          c.stepping = stepping;
          c.order = PhaseOrder::heat_first;
          const CoupledRun run = verification::march(c, 8, 32);
          EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged())
              << pressure << ' ' << static_cast<int>(mapping) << ' ' << static_cast<int>(rule);
        }
}

// Gaps that change within a step are known when its heat has passed. Where heat and equilibrium are solved
// again with the mean of the gaps, both phases dissipate and conserve as before, and the heat is that of
// shorter steps.
TEST(HeatFirst, ConductsThroughTheMeanOfGapsThatChangeWithinTheStep) {
  const auto cast = [](double gap_tolerance, ThermalStepping stepping) {
    Coupled c = verification::casting(0);
    c.form = StructuralForm::energy;
    c.mapping = Mapping::isentropic;
    c.stepping = stepping;
    c.order = PhaseOrder::heat_first;
    c.gap_tolerance = gap_tolerance;
    return c;
  };
  auto out = verification::table("coupling_heat_first_gaps", "steps,whole[K],repeated[K],turns");
  const CoupledRun fine = verification::march(cast(1, ThermalStepping::sdirk2), 8, 1024);
  for (const int n : {4, 8, 16, 32}) {
    std::vector<double> off;
    double turns = 0;
    for (const double tolerance : {1.0, 0.01}) {
      const CoupledRun run = verification::march(cast(tolerance, ThermalStepping::sdirk2), 8, n);
      EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged()) << n << ", " << tolerance;
      off.push_back(mean_difference(run.end.heat.temperature, fine.end.heat.temperature));
      turns = std::accumulate(run.iterations.begin(), run.iterations.end(), 0.0) / n;
    }
    out << n << ',' << off[0] << ',' << off[1] << ',' << turns << '\n';
    EXPECT_GT(turns, 1) << n;
    EXPECT_LT(off[1], 0.3 * off[0]) << n;
  }
}

// Gaps that widen steadily are known from the step before: hardly a step is solved twice, and its heat is as
// near to that of shorter steps as where all that is misplaced is mended.
TEST(HeatFirst, ExpectsGapsThatWidenSteadily) {
  const auto cast = [](double gap_tolerance) {
    Coupled c = verification::casting(0);
    c.form = StructuralForm::energy;
    c.mapping = Mapping::isentropic;
    c.stepping = ThermalStepping::sdirk2;
    c.order = PhaseOrder::heat_first;
    c.gap_tolerance = gap_tolerance;
    return c;
  };
  const CoupledRun fine = verification::march(cast(1), 8, 1024);
  const CoupledRun once = verification::march(cast(1), 8, 64), run = verification::march(cast(0.02), 8, 64);
  const double turns = std::accumulate(run.iterations.begin(), run.iterations.end(), 0.0);
  const double whole = mean_difference(once.end.heat.temperature, fine.end.heat.temperature),
               here = mean_difference(run.end.heat.temperature, fine.end.heat.temperature);
  auto out = verification::table("coupling_heat_first_expected", "whole[K],expected[K],turns");
  out << whole << ',' << here << ',' << turns / 64 << '\n';
  EXPECT_LT(turns, 1.15 * 64);
  EXPECT_LT(here, 0.5 * whole);
  EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
}

}  // namespace
}  // namespace solidus
