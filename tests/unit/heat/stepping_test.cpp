/// SDIRK2 of the thermal phase, and the guard at 0 K.
#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.hpp"
#include "block.hpp"

namespace solidus {
namespace {

using heat::Integration;
using heat::ThermalStepping;

/// A bar of 0.1 m, insulated but for a film on the left whose ambient temperature moves as a sine; it melts
/// at 890 to 900 K if it gets so warm.
struct Bar {
  mesh::Mesh mesh = test::block_mesh(mesh::Shape::quad4, {0.1, 0.01}, {10, 1});
  std::vector<material::Material> materials{test::metal(10)};
  heat::Conditions conditions;
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
  Run run(Integration rule, ThermalStepping stepping, int n_steps) const {
    heat::HeatOptions options;
    options.integration = rule;
    options.tolerance = 1e-12;
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, materials, conditions, options);
    Run r{phase.initial_state_at_nodes(std::vector<double>(mesh.x.size(), start))};
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
  return std::sqrt(algebra::global_sum(sum));
}

// At a surface with a film the order of SDIRK2 is 1.75 at first, because its stages are of order one: hence
// the mean, and short steps.
TEST(ThermalStepping, IsOfTheOrderOfItsMethodWithBothRules) {
  const Bar bar(800, 500);
  for (const auto rule : {Integration::closed, Integration::open})
    for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2}) {
      const Bar::Run coarse = bar.run(rule, stepping, 64), middle = bar.run(rule, stepping, 128),
                     fine = bar.run(rule, stepping, 256);
      EXPECT_NEAR(std::log2(difference(coarse, middle) / difference(middle, fine)),
                  stepping == ThermalStepping::sdirk2 ? 2 : 1, 0.1);
    }
}

TEST(ThermalStepping, Sdirk2ClosesTheBalanceAcrossMeltingWithBothRules) {
  const Bar bar(880, 1200);
  for (const auto rule : {Integration::closed, Integration::open})
    for (const int n : {2, 20}) {
      const Bar::Run run = bar.run(rule, ThermalStepping::sdirk2, n);
      EXPECT_NEAR(run.stored, run.heat_in, 1e-10 * run.exchanged);
      EXPECT_GT(run.latent, 0.1 * run.stored);  // some of it melts
    }
}

TEST(ThermalPhase, RejectsAStepThatEndsBelowZeroWithPlaceAndTemperature) {
  for (const auto rule : {Integration::closed, Integration::open}) {
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
