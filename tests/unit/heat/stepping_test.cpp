/// SDIRK2 of the thermal phase, and the guard at 0 K.
#include <gtest/gtest.h>

#include <numbers>

#include "block.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using heat::HeatIntegration;
using heat::ThermalStepping;

/// A bar of 0.1 m, insulated but for a film on the left whose ambient temperature moves as a sine; it melts
/// at 890 to 900 K if it gets so warm.
struct Bar {
  mesh::Mesh mesh = test::block_mesh(mesh::Shape::quad4, {0.1, 0.01}, {10, 1});
  std::vector<material::Material> materials{test::metal(10)};
  heat::ThermalConditions conditions;
  double start;

  Bar(double from, double to) : start(from) {
    std::vector<double> x, y;
    for (int i = 0; i <= 400; ++i) {
      const double s = std::sin(0.5 * std::numbers::pi * i / 400);
      x.push_back(100.0 * i / 400);
      y.push_back(from + (to - from) * s * s);
    }
    conditions.films.push_back({"film", "x_min", {Table(5000.0)}, Table(x, y)});
  }
  struct Run {
    heat::ThermalState end;
    double stored = 0, latent = 0, heat_in = 0, exchanged = 0;
  };
  Run run(HeatIntegration rule, ThermalStepping stepping, int n_steps) const {
    heat::HeatOptions options;
    options.integration = rule;
    options.tolerance = 1e-12;
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, materials, conditions, options);
    Run r{phase.states().initial_at_nodes(std::vector<double>(mesh.x.size(), start))};
    const double dt = 100.0 / n_steps;
    for (int n = 1; n <= n_steps; ++n) {
      const heat::HeatBalance b =
          phase.solve(r.end, r.end, {.time = n * dt, .dt = dt, .stepping = stepping}).balance;
      r.stored += b.stored;
      r.latent += b.latent;
      r.heat_in += b.heat_in();
      r.exchanged += b.exchanged;
    }
    return r;
  }
};

/// Root of the mean square over the nodes.
double difference(const Bar::Run& a, const Bar::Run& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.end.temperature.size(); ++i)
    sum += std::pow(a.end.temperature[i] - b.end.temperature[i], 2);
  return std::sqrt(parallel::global_sum(sum));
}

// At a surface with a film the order of SDIRK2 is 1.75 at first, because its stages are of order one: hence
// the mean, and short steps.
TEST(ThermalStepping, IsOfTheOrderOfItsMethodWithBothRules) {
  const Bar bar(800, 500);
  for (const auto rule : {HeatIntegration::closed, HeatIntegration::open})
    for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2}) {
      const Bar::Run coarse = bar.run(rule, stepping, 64), middle = bar.run(rule, stepping, 128),
                     fine = bar.run(rule, stepping, 256);
      EXPECT_NEAR(std::log2(difference(coarse, middle) / difference(middle, fine)),
                  stepping == ThermalStepping::sdirk2 ? 2 : 1, 0.1);
    }
}

TEST(ThermalStepping, Sdirk2ClosesTheBalanceAcrossMeltingWithBothRules) {
  const Bar bar(880, 1200);
  for (const auto rule : {HeatIntegration::closed, HeatIntegration::open})
    for (const int n : {2, 20}) {
      const Bar::Run run = bar.run(rule, ThermalStepping::sdirk2, n);
      EXPECT_NEAR(run.stored, run.heat_in, 1e-10 * run.exchanged);
      EXPECT_GT(run.latent, 0.1 * run.stored);  // some of it melts
    }
}

// Its second stage starts from an extrapolation, which in a step much longer than the film takes to cool a
// cell lies beyond the ambient temperature.
TEST(ThermalStepping, Sdirk2StaysWithinTheSurroundingsWhateverTheStepAndClosesTheBalance) {
  Bar bar(1000, 1000);
  for (const double ambient : {300.0, 1700.0}) {
    bar.conditions.films = {{"film", "x_min", {Table(1e5)}, Table(ambient)}};
    for (const int n : {1, 3, 10, 100}) {
      heat::ThermalPhase phase(bar.mesh, AnalysisKind::plane_strain, bar.materials, bar.conditions);
      heat::ThermalState state =
          phase.states().initial_at_nodes(std::vector<double>(bar.mesh.x.size(), 1000));
      for (int i = 1; i <= n; ++i) {
        const double dt = 100.0 / n;
        const heat::HeatBalance b =
            phase.solve(state, state, {.time = i * dt, .dt = dt, .stepping = ThermalStepping::sdirk2})
                .balance;
        EXPECT_NEAR(b.stored, b.heat_in(), 1e-11 * b.exchanged);
        EXPECT_NEAR(b.latent + b.sensible, b.stored, 1e-12 * b.exchanged);
        for (const double t : state.temperature) {
          EXPECT_GE(t, std::min(ambient, 1000.0) - 1e-3);
          EXPECT_LE(t, std::max(ambient, 1000.0) + 1e-3);
        }
      }
    }
  }
}

// A flux cools without a bound: no reason to do without the second order.
TEST(ThermalStepping, Sdirk2StaysOfSecondOrderWhereAFluxCoolsBelowAllTemperatures) {
  Bar bar(800, 800);
  bar.conditions.films.clear();
  bar.conditions.fluxes.push_back({"drain", "x_min", Table({0, 100}, {0, -3e5})});
  const auto end = [&](int n) { return bar.run(HeatIntegration::closed, ThermalStepping::sdirk2, n); };
  const Bar::Run coarse = end(32), middle = end(64), fine = end(128);
  EXPECT_LT(*std::min_element(fine.end.temperature.begin(), fine.end.temperature.end()), 750);
  EXPECT_NEAR(std::log2(difference(coarse, middle) / difference(middle, fine)), 2, 0.2);
}

// The middle of a casting freezes in less than a step, while much heat flows out of it: the extrapolation
// between the stages of SDIRK2 takes it far below what lies around it, by up to 37 K here. One percent of the
// range of temperatures is what extrapolation_guard.hpp lets pass.
TEST(ThermalStepping, Sdirk2LetsTheLastMetalToFreezeCoolMonotonicallyAndNotBelowWhatLiesAroundIt) {
  using material::PhaseFraction;
  constexpr double k_pouring = 910, k_ambient = 400, k_sink = 1e-2 * (k_pouring - k_ambient);
  for (const PhaseFraction& change :
       {PhaseFraction::linear(900, 900), PhaseFraction::linear(899, 900), PhaseFraction::linear(860, 900),
        PhaseFraction::scheil(933, 900, 850, 0.13)})
    for (const auto& [shape, kind] : {std::pair{mesh::Shape::quad4, AnalysisKind::plane_strain},
                                      std::pair{mesh::Shape::tri3, AnalysisKind::axisymmetric},
                                      std::pair{mesh::Shape::tri6, AnalysisKind::plane_strain},
                                      std::pair{mesh::Shape::tet4, AnalysisKind::solid}})
      for (const double dt : {0.6, 1.2}) {
        SCOPED_TRACE(std::string(mesh::name(shape)) + ", steps of " + std::to_string(dt) + " s");
        std::vector<material::Material> materials{test::metal(0)};
        materials[0].phase_changes[0].fraction = change;
        const bool solid = test::is_3d(shape);
        const mesh::Mesh mesh =
            test::block_mesh(shape, solid ? std::vector{0.015, 0.004, 0.004} : std::vector{0.015, 0.004},
                             solid ? std::vector{15, 4, 4} : std::vector{15, 4});
        heat::ThermalConditions conditions;
        conditions.films.push_back({"film", "x_max", {Table(3000.0)}, Table(k_ambient)});
        heat::ThermalPhase phase(mesh, kind, materials, conditions);
        heat::ThermalState now =
            phase.states().initial_at_nodes(std::vector<double>(mesh.x.size(), k_pouring));
        for (int n = 1; n <= 40; ++n) {
          const heat::ThermalState before = now;
          const heat::HeatBalance b =
              phase.solve(now, now, {.time = n * dt, .dt = dt, .stepping = ThermalStepping::sdirk2}).balance;
          EXPECT_NEAR(b.stored, b.heat_in(), 1e-11 * b.exchanged);
          for (std::size_t i = 0; i < mesh.x.size(); ++i) {
            double hottest_outside = 0;
            for (std::size_t j = 0; j < mesh.x.size(); ++j)
              if (mesh.x[j][0] > mesh.x[i][0])
                hottest_outside = std::max(hottest_outside, now.temperature[j]);
            EXPECT_GT(now.temperature[i], hottest_outside - k_sink) << "node " << i << ", step " << n;
            if (mesh.x[i][0] < 1e-9) {
              EXPECT_LT(now.temperature[i], before.temperature[i] + 1e-3) << "node " << i << ", step " << n;
            }
          }
        }
        EXPECT_LT(*std::max_element(now.temperature.begin(), now.temperature.end()), 900);
      }
}

// The error of one step, as the flows of heat tell it, against the same step in thirty-two.
TEST(ThermalStepping, TheErrorOfAStepIsTheEstimated) {
  Bar bar(800, 500);
  bar.conditions.films = {{"film", "x_min", {Table(1000.0)}, Table(500.0)}};
  for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2}) {
    heat::HeatOptions options;
    options.tolerance = 1e-12;
    heat::ThermalPhase phase(bar.mesh, AnalysisKind::plane_strain, bar.materials, bar.conditions, options);
    heat::ThermalState old = phase.states().initial_at_nodes(std::vector<double>(bar.mesh.x.size(), 800));
    constexpr double k_dt = 2;
    std::vector<double> flow;
    for (int i = 1; i <= 10; ++i) {
      flow = heat::flow_at_end(
          phase, phase.solve(old, old, {.time = i * k_dt, .dt = k_dt, .stepping = stepping}).flows);
    }
    heat::ThermalState now = old, fine = old;
    const heat::ThermalReport report =
        phase.solve(old, now, {.time = 11 * k_dt, .dt = k_dt, .stepping = stepping});
    const std::vector<double> estimate = heat::time_error(phase, now, report.flows, flow);
    for (int i = 1; i <= 32; ++i)
      phase.solve(fine, fine,
                  {.time = 10 * k_dt + i * k_dt / 32, .dt = k_dt / 32, .stepping = ThermalStepping::sdirk2});
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < estimate.size(); ++i) {
      difference += std::pow(estimate[i] - (now.temperature[i] - fine.temperature[i]), 2);
      size += std::pow(fine.temperature[i] - now.temperature[i], 2);
    }
    printf("estimate %d: off by %.3f of the error\n", static_cast<int>(stepping),
           std::sqrt(difference / size));
    EXPECT_LT(std::sqrt(difference / size), 0.5);
  }
}

TEST(ThermalPhase, RejectsAStepThatEndsBelowZeroWithPlaceAndTemperature) {
  for (const auto rule : {HeatIntegration::closed, HeatIntegration::open}) {
    Bar bar(300, 300);
    bar.conditions.films.clear();
    bar.conditions.fluxes.push_back({"drain", "x_min", Table(-1e6)});
    try {
      bar.run(rule, ThermalStepping::backward_euler, 1);
      FAIL() << "should have been rejected";
    } catch (const StepRejected& rejected) {
      EXPECT_NE(rejected.reason().find("the temperature falls to -"), std::string::npos) << rejected.reason();
      EXPECT_NE(rejected.where().find("node"), std::string::npos);
      EXPECT_NE(rejected.where().find("at (0, "), std::string::npos) << rejected.where();
    }
  }
}

}  // namespace
}  // namespace solidus
