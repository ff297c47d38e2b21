/// Heat in time: the order of SDIRK2 where it freezes and where it does not, and adaptive steps against runs
/// with a tenth of theirs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analytic/stefan.hpp"
#include "coupling/isothermal_split.hpp"
#include "coupling/simulation.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

using coupling::ErrorControl;
using coupling::State;
using coupling::StepRecord;
using heat::ThermalStepping;

/// A strip along x that conducts heat, and what surrounds it.
struct Problem {
  mesh::Mesh mesh;
  material::Material material;
  heat::ThermalConditions conditions;
  double start, end;  ///< [K], [s]
};

material::Material metal(double conductivity, double capacity, double latent, double solidus,
                         double liquidus) {
  material::Material m;
  m.name = "metal";
  m.density = 1000;
  m.conductivity = Table(conductivity);
  m.specific_heat = Table(capacity / m.density);
  if (latent > 0)
    m.phase_changes = {{"solidification", material::PhaseFraction::linear(solidus, liquidus),
                        latent / m.density, 0.0, true}};
  return m;
}

/// That of stefan_test.cpp: a half-space whose wall is cold from the start on.
Problem stefan(double range, double superheat) {
  Problem p{verification::strip(mesh::Shape::quad4, 0.2, 200),
            metal(100, 2.5e6, 1e9, 930 - range, 930),
            {},
            930 + superheat,
            10};
  p.conditions.temperatures.push_back({"wall", "x_min", Table(400.0)});
  return p;
}

/// A plate of 30 mm that loses its heat by a film: it freezes evenly, and what is late stays late.
Problem plate(double range) {
  Problem p{verification::strip(mesh::Shape::quad4, 0.03, 100),
            metal(100, 2.5e6, 1e9, 930 - range, 930),
            {},
            960,
            60};
  p.conditions.films.push_back({"film", "x_min", {Table(3000.0)}, Table(300.0)});
  return p;
}

/// NAFEMS T3: a bar of 0.1 m at 0 °C, one end of it at 100 °C × sin(πt/40 s), the other at 0 °C.
Problem nafems_t3() {
  Problem p{
      verification::strip(mesh::Shape::quad4, 0.1, 50), metal(35, 440.5 * 7200, 0, 0, 0), {}, 273.15, 32};
  std::vector<double> t, y;
  for (int i = 0; i <= 3200; ++i) {
    t.push_back(0.01 * i);
    y.push_back(273.15 + 100 * std::sin(std::numbers::pi * t.back() / 40));
  }
  p.conditions.temperatures.push_back({"cold", "x_min", Table(273.15)});
  p.conditions.temperatures.push_back({"hot", "x_max", Table(t, y)});
  return p;
}

struct Diary : coupling::Observer {
  std::vector<State> states;
  std::vector<StepRecord> steps;
  std::vector<std::pair<coupling::RestartData, State>> checkpoints;
  void begin(const State& state) override { states.push_back(state); }
  void step(const StepRecord& record, const State& state) override {
    steps.push_back(record);
    states.push_back(state);
  }
  void checkpoint(const coupling::RestartData& continuation, const State& state) override {
    checkpoints.emplace_back(continuation, state);
  }
  void stopped(const coupling::Stop&, const State&) override {}
  void end(const State&) override {}
};

/// A problem with its phase.
struct March {
  const Problem& p;
  heat::ThermalPhase heat;
  coupling::BodyNorm norm;

  March(const Problem& problem, ThermalStepping stepping)
      : p(problem),
        heat(p.mesh, AnalysisKind::plane_strain, {p.material}, p.conditions, {.stepping = stepping}),
        norm(p.mesh, AnalysisKind::plane_strain) {}
  coupling::Phases phases() {
    coupling::Phases phases;
    phases.heat = &heat;
    return phases;
  }
  State start() const {
    State state;
    state.heat = heat.states().initial(std::vector<double>{p.start});
    return state;
  }
  double distance(const heat::ThermalState& a, const heat::ThermalState& b) const {
    std::vector<double> difference(a.temperature.size());
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a.temperature[i] - b.temperature[i];
    return norm(difference);
  }
  /// All states of `n` equal steps, or those of every `stride`-th. Adds defect and heat exchanged to `audit`.
  std::vector<heat::ThermalState> equal_steps(int n, int stride = 1, std::pair<double, double>* audit = {}) {
    std::vector<heat::ThermalState> states = {start().heat};
    heat::ThermalState now = states.front();
    for (int i = 1; i <= n; ++i) {
      const heat::HeatBalance balance =
          heat.solve(now, now, {.time = p.end * i / n, .dt = p.end / n, .stepping = heat::stepping(heat)})
              .balance;
      if (audit != nullptr) {
        audit->first += std::abs(balance.defect());
        audit->second += balance.exchanged;
      }
      if (i % stride == 0) states.push_back(now);
    }
    return states;
  }
  Diary adaptive(const coupling::TimeOptions& options,
                 const std::pair<coupling::RestartData, State>* from = nullptr) {
    const coupling::Phases all = phases();
    coupling::Simulation simulation(std::make_unique<coupling::IsothermalSplit>(all), options,
                                    coupling::ErrorEstimate(norm, &all));
    Diary diary;
    simulation.add(diary);
    const auto fraction = [&](const State& s) { return heat.states().mean_solid_fraction(s.heat); };
    EXPECT_EQ(from != nullptr ? simulation.run(from->second, fraction, from->first)
                              : simulation.run(start(), fraction),
              coupling::Outcome::finished);
    return diary;
  }
  /// A run of equal steps, as a diary.
  Diary equal(int n) {
    Diary diary;
    diary.states.push_back(start());
    for (const heat::ThermalState& state : equal_steps(n)) {
      State next;
      next.time = p.end * static_cast<double>(diary.states.size() - 1) / n;
      next.heat = state;
      diary.states.push_back(next);
    }
    diary.states.erase(diary.states.begin());
    return diary;
  }
  /// The largest distance of a run's states from one with a tenth of its steps.
  double error(const Diary& diary) {
    heat::ThermalState exact = diary.states.front().heat;
    double worst = 0;
    for (std::size_t n = 1; n < diary.states.size(); ++n) {
      const double from = diary.states[n - 1].time, dt = (diary.states[n].time - from) / 10;
      for (int i = 1; i <= 10; ++i)
        heat.solve(exact, exact, {.time = from + i * dt, .dt = dt, .stepping = ThermalStepping::sdirk2});
      worst = std::max(worst, distance(exact, diary.states[n].heat));
    }
    return worst;
  }
};

/// The defaults of a case file, with a first step of a fiftieth of the run.
coupling::TimeOptions by_default(const Problem& p) {
  coupling::TimeOptions options;
  options.end = p.end;
  options.step.step = p.end / 50;
  options.step.adaptive = true;
  options.step.easy_iterations = 8;
  options.step.limits = {ErrorControl::predictor, 1.0, 1e9, 0.1};
  return options;
}

std::map<std::string, Problem> problems() {
  std::map<std::string, Problem> all;
  all.emplace("stefan_isothermal", stefan(0, 0));
  all.emplace("stefan_isothermal_superheat", stefan(0, 60));
  all.emplace("stefan_range_40", stefan(40, 60));
  all.emplace("plate_isothermal", plate(0));
  all.emplace("plate_range_40", plate(40));
  all.emplace("nafems_t3", nafems_t3());
  return all;
}

TEST(HeatInTime, NafemsT3IsMetWithStepsOfASecond) {
  const Problem p = nafems_t3();
  std::map<ThermalStepping, double> found;
  for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2}) {
    March run(p, stepping);
    const std::vector<heat::ThermalState> states = run.equal_steps(32);
    for (std::size_t i = 0; i < p.mesh.x.size(); ++i)
      if (std::abs(p.mesh.x[i][0] - 0.08) < 1e-9) found[stepping] = states.back().temperature[i] - 273.15;
  }
  printf("NAFEMS T3: backward Euler %.3f, SDIRK2 %.3f\n", found[ThermalStepping::backward_euler],
         found[ThermalStepping::sdirk2]);
  EXPECT_NEAR(found[ThermalStepping::sdirk2], 36.60, 0.1);
  EXPECT_LT(found[ThermalStepping::backward_euler], 36.3);
}

// The errors of single times scatter with the nodes that the front passes: hence a mean over 21 of them.
TEST(HeatInTime, SecondOrderIsBetterAtEqualCostAlsoWhereItFreezesAndClosesTheBalance) {
  std::ofstream table =
      verification::csv("heat_in_time", "problem,stepping,steps,solves,end_error[K],mean_error[K]");
  for (const auto& [name, p] : problems()) {
    constexpr int k_fine = 6400, k_output = 25;
    const std::vector<heat::ThermalState> exact =
        March(p, ThermalStepping::sdirk2).equal_steps(k_fine, k_fine / k_output);
    std::map<ThermalStepping, std::map<int, double>> errors;  // by the number of solves
    for (const auto stepping : {ThermalStepping::backward_euler, ThermalStepping::sdirk2})
      for (const int n : {50, 100, 200, 400}) {
        March run(p, stepping);
        std::pair<double, double> audit;
        const std::vector<heat::ThermalState> states = run.equal_steps(n, n / k_output, &audit);
        EXPECT_LE(audit.first, 1e-11 * audit.second) << name;
        double square = 0;
        for (std::size_t k = 5; k < states.size(); ++k)
          square += std::pow(run.distance(exact[k], states[k]), 2) / (k_output - 4);
        const int solves = stepping == ThermalStepping::sdirk2 ? 2 * n : n;
        errors[stepping][solves] = std::sqrt(square);
        table << name << ',' << (stepping == ThermalStepping::sdirk2 ? "sdirk2" : "backward_euler") << ','
              << n << ',' << solves << ',' << run.distance(exact.back(), states.back()) << ','
              << std::sqrt(square) << '\n';
      }
    // A single front that frozen metal follows at once steps from node to node, whatever the integration.
    const double share = name == "stefan_isothermal" ? 1.0 : 0.7;
    for (const int solves : {100, 200, 400})
      EXPECT_LT(errors[ThermalStepping::sdirk2][solves],
                share * errors[ThermalStepping::backward_euler][solves])
          << name << ' ' << solves;
    const double order =
        std::log2(errors[ThermalStepping::sdirk2][100] / errors[ThermalStepping::sdirk2][800]) / 3;
    printf("%s: order of SDIRK2 %.2f\n", name.c_str(), order);
    EXPECT_GT(order, name == "nafems_t3" ? 1.9 : name.ends_with("range_40") ? 1.3 : 0.7) << name;
  }
}

TEST(HeatInTime, AdaptiveStepsKeepTheirWord) {
  std::ofstream table =
      verification::csv("heat_adaptive", "problem,stepping,steps,rejected,error[K],equal_steps_error[K]");
  for (const auto& [name, p] : problems())
    for (const auto stepping : {ThermalStepping::sdirk2, ThermalStepping::backward_euler}) {
      March run(p, stepping);
      const Diary diary = run.adaptive(by_default(p));
      const double error = run.error(diary);
      int rejected = 0;
      for (const StepRecord& step : diary.steps) rejected += step.rejected;
      const bool second = stepping == ThermalStepping::sdirk2;
      const int n = static_cast<int>(diary.steps.size());
      const double of_equal = run.error(run.equal(2 * n));
      table << name << ',' << (second ? "sdirk2" : "backward_euler") << ',' << n << ',' << rejected << ','
            << error << ',' << of_equal << '\n';
      printf("%s %s: %d steps, %d rejected, %.3f K; twice as many equal ones %.3f K\n", name.c_str(),
             second ? "sdirk2" : "backward_euler", n, rejected, error, of_equal);
      // The others go on at one pace until they end: equal steps suit them.
      if (second && name.starts_with("stefan")) {
        EXPECT_LT(error, 0.5 * of_equal) << name;
      }
      EXPECT_LE(error, second ? 2 : 3.5) << name;
    }
}

TEST(HeatInTime, AnAdaptiveRunGoesOnFromACheckpointWithTheSameBits) {
  for (const auto stepping : {ThermalStepping::sdirk2, ThermalStepping::backward_euler}) {
    const Problem p = plate(40);
    coupling::TimeOptions options = by_default(p);
    options.checkpoint_every = 1;
    March run(p, stepping);
    const Diary whole = run.adaptive(options);
    ASSERT_GT(whole.checkpoints.size(), 12U);
    for (const std::size_t k : {0U, 3U, 11U}) {
      March again(p, stepping);
      const Diary rest = again.adaptive(options, &whole.checkpoints[k]);
      ASSERT_EQ(rest.steps.size() + k + 1, whole.steps.size());
      EXPECT_EQ(rest.states.back().heat.temperature, whole.states.back().heat.temperature);
      EXPECT_EQ(rest.states.back().heat.enthalpy, whole.states.back().heat.enthalpy);
      for (std::size_t n = 0; n < rest.steps.size(); ++n)
        EXPECT_EQ(rest.steps[n].temperature_error, whole.steps[n + k + 1].temperature_error);
    }
  }
}

}  // namespace
}  // namespace solidus
