/// Two bars that are pressed together ever harder and let go again, heat between them by the conductance of
/// the pressure, against a one-dimensional program.
///
///   ├── lower, k_1, L_1, hot ──┤ h(p(t)) ├── upper, k_2, L_2, cold ──┤ ◄── p(t)
///
///   h = h_o + h_co (p/H_e)^0.95                                                                    (3.49)
///
/// Sideways both are held, along their axis they expand freely: the pressure at the interface is that of the
/// load, whatever the temperatures. Nothing is exchanged with the surroundings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/laws/constant_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact_bodies.hpp"
#include "coupling/isothermal_split.hpp"
#include "csv.hpp"

namespace solidus {
namespace {

constexpr double k_k1 = 200, k_k2 = 40;        // [W/(m K)]
constexpr double k_capacity = 7800.0 * 500.0;  // of test::elastic [J/(m³ K)]
constexpr double k_l1 = 0.1, k_l2 = 0.2;       // [m]
constexpr double k_hot = 900, k_cold = 300;    // [K]
constexpr double k_end = 120, k_sample = 4;    // [s]
constexpr double k_open = 100, k_closed = 1e5, k_hardness = 1e9, k_exponent = 0.95;

Table load() {
  return Table({0, 40, 60, 80, 120}, {0, 30e6, 30e6, 1e6, 10e6});
}

struct Trace {
  std::vector<double> lower, upper;  // of the two surfaces every `k_sample` seconds [K]
  double pressure_error = 0;         // largest, relative to the load
  double heat_error = 0;             // of both bars together, as a part of what passed
};

/// Finite volumes along the axis, the implicit midpoint rule.
class OneDimension {
 public:
  explicit OneDimension(int cells) : n_(static_cast<std::size_t>(cells)), t_(2 * n_, k_hot) {
    std::fill(t_.begin() + cells, t_.end(), k_cold);
  }
  void step(double middle, double dt) {
    const double h = conductance(middle);
    // Backward Euler to the middle of the step, by Thomas' algorithm, and as far again.
    std::vector<double> next(2 * n_, 0.0), diagonal(2 * n_), t(2 * n_);
    for (std::size_t i = 0; i + 1 < 2 * n_; ++i)
      next[i] = 1 / (half(i) + half(i + 1) + (i + 1 == n_ ? 1 / h : 0.0));
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      const double stored = k_capacity * width(i) / (0.5 * dt);
      diagonal[i] = stored + next[i] + (i > 0 ? next[i - 1] : 0.0);
      t[i] = stored * t_[i];
      if (i == 0) continue;
      const double f = next[i - 1] / diagonal[i - 1];
      diagonal[i] -= f * next[i - 1];
      t[i] += f * t[i - 1];
    }
    for (std::size_t i = 2 * n_; i-- > 0;)
      t[i] = (t[i] + (i + 1 < 2 * n_ ? next[i] * t[i + 1] : 0.0)) / diagonal[i];
    for (std::size_t i = 0; i < 2 * n_; ++i) t_[i] = 2 * t[i] - t_[i];
  }
  // Behind half a cell, with the flux at that time.
  double lower(double time) const { return t_[n_ - 1] - half(n_ - 1) * flux(time); }
  double upper(double time) const { return t_[n_] + half(n_) * flux(time); }

 private:
  double width(std::size_t i) const { return (i < n_ ? k_l1 : k_l2) / static_cast<double>(n_); }
  static double conductance(double time) {
    return k_open + k_closed * std::pow(load().value(time) / k_hardness, k_exponent);
  }
  double flux(double time) const {
    return (t_[n_ - 1] - t_[n_]) / (half(n_ - 1) + half(n_) + 1 / conductance(time));
  }
  // Resistance of half a cell [m² K/W].
  double half(std::size_t i) const { return 0.5 * width(i) / (i < n_ ? k_k1 : k_k2); }

  std::size_t n_;
  std::vector<double> t_;
};

Trace one_dimension(int cells, double dt) {
  OneDimension bars(cells);
  Trace trace;
  const int per_sample = static_cast<int>(std::lround(k_sample / dt));
  for (int i = 1; i * dt <= k_end + 1e-9; ++i) {
    bars.step((i - 0.5) * dt, dt);
    if (i % per_sample != 0) continue;
    trace.lower.push_back(bars.lower(i * dt));
    trace.upper.push_back(bars.upper(i * dt));
  }
  return trace;
}

// Mean over the interface's nodes of one side.
double surface(const mesh::Mesh& mesh, const char* name, const std::vector<double>& temperature) {
  double sum = 0, n = 0;
  for (const Index node : mesh.surfaces.at(name).nodes)
    if (node < mesh.n_owned_nodes) {
      sum += temperature[static_cast<std::size_t>(node)];
      n += 1;
    }
  return parallel::global_sum(sum) / parallel::global_sum(n);
}

contact::ContactParameters through(contact::Formulation formulation) {
  contact::ContactParameters s = test::interface();
  s.formulation = formulation;
  if (formulation == contact::Formulation::large_sliding) s.integration = contact::IntegrationRule::gauss;
  s.heat = contact::HeatTransferSpec{};
  s.heat->contact_law = contact::contact_law(contact::PowerContact{k_closed, k_exponent, k_hardness});
  s.heat->gap_law = contact::gap_law(contact::ConstantGap{k_open});
  return s;
}

/// Elements across and along each bar.
struct Divisions {
  std::vector<int> lower{1, 240}, upper{1, 360};
};

Trace simulated(contact::Formulation formulation, double dt,
                contact::NormalKind normal = contact::NormalKind::penalty, const Divisions& divisions = {}) {
  const mesh::Mesh mesh = test::distribute_blocks(test::raw_blocks(
      {{0.01, k_l1}, {0.01, k_l2}, divisions.lower, divisions.upper, 0.0}, mesh::Shape::quad4));
  const std::vector<material::Material> materials = {test::elastic(70e9, 0.33, 1e-5, k_k1),
                                                     test::elastic(210e9, 0.3, 1e-5, k_k2)};
  contact::ContactParameters interface = through(formulation);
  interface.normal = normal;
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, interface, std::vector<double>{70e9, 210e9});
  mechanics::MechanicalConditions conditions = test::symmetric_supports(2);
  for (const char* side : {"lower_x_max", "upper_x_max"}) conditions.displacements.push_back({side, 0, 0.0});
  conditions.pressures.push_back({"upper_y_max", load()});
  const std::vector<double> cold(mesh.x.size(), k_cold);
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.symmetric = pair.parts().forces.symmetric();
  mechanics::MechanicalPhase mechanics(mesh, AnalysisKind::plane_strain, materials, cold, conditions, options,
                                       {&pair.parts().forces.term()});
  heat::HeatOptions heat_options;
  heat_options.tolerance = 1e-12;
  heat::ThermalPhase heat(mesh, AnalysisKind::plane_strain, materials, {}, heat_options,
                          {pair.parts().heat.term()});
  coupling::Phases phases;
  phases.heat = &heat;
  phases.mechanics = &mechanics;
  phases.contacts = {&pair};
  coupling::IsothermalSplit scheme(phases);
  coupling::State state;
  state.heat = heat.states().initial(std::vector<double>{k_hot, k_cold});
  state.mechanics = mechanics.initial_state();
  scheme.synchronise(state);

  Trace trace;
  double stored = 0, passed = 0;
  const int per_sample = static_cast<int>(std::lround(k_sample / dt));
  for (int i = 1; i * dt <= k_end + 1e-9; ++i) {
    coupling::State next = state;
    next.time = i * dt;
    const coupling::StepEffort effort = scheme.advance(state, next, i * dt, dt);
    state = next;
    const double p = load().value(i * dt);
    for (const contact::ContactPointState& point : pair.state().points)
      trace.pressure_error = std::max(trace.pressure_error, std::abs(point.pressure / p - 1));
    stored += effort.energy.stored_heat;
    passed += effort.contacts[0].heat * dt;
    if (i % per_sample != 0) continue;
    trace.lower.push_back(surface(mesh, "lower_top", state.heat.temperature));
    trace.upper.push_back(surface(mesh, "upper_bottom", state.heat.temperature));
  }
  trace.heat_error = std::abs(stored) / passed;
  return trace;
}

double largest(const Trace& a, const Trace& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.lower.size(); ++i)
    worst = std::max({worst, std::abs(a.lower[i] - b.lower[i]), std::abs(a.upper[i] - b.upper[i])});
  return worst;
}

TEST(PressedBars, ConductInTimeByThePressureAsAOneDimensionalProgramDoes) {
  const Trace exact = one_dimension(1600, 0.02);
  // The program's own error, from half the cells and twice the step.
  EXPECT_LT(largest(exact, one_dimension(800, 0.04)), 0.01);
  for (const auto formulation : {contact::Formulation::small_sliding, contact::Formulation::large_sliding}) {
    const bool small = formulation == contact::Formulation::small_sliding;
    const char* name = small ? "small_sliding" : "large_sliding";
    SCOPED_TRACE(name);
    std::vector<double> errors;
    for (const double dt : {2.0, 1.0, 0.5}) {
      const Trace found = simulated(formulation, dt);
      ASSERT_EQ(found.lower.size(), exact.lower.size());
      errors.push_back(largest(found, exact));
      // Rounding of coordinates, 1e-16 m, in a penetration of 0.6 nm under 1 MPa.
      EXPECT_LT(found.pressure_error, 5e-7) << "the load";
      EXPECT_LT(found.heat_error, 1e-10) << "what leaves one bar enters the other";
      if (dt > 0.5 || !small) continue;
      auto file = verification::csv("contact_pressed_bars",
                                    "time[s],lower[K],upper[K],lower_exact[K],upper_exact[K]");
      for (std::size_t i = 0; i < exact.lower.size(); ++i)
        file << k_sample * static_cast<double>(i + 1) << ',' << found.lower[i] << ',' << found.upper[i] << ','
             << exact.lower[i] << ',' << exact.upper[i] << '\n';
    }
    RecordProperty(name, fmt::format("{:.3f} {:.3f} {:.3f} K", errors[0], errors[1], errors[2]));
    // Backward Euler takes h at the end of the step: first order.
    EXPECT_LT(errors[2], 1e-2 * (k_hot - k_cold));
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
      EXPECT_GT(errors[i] / errors[i + 1], 1.8);
      EXPECT_LT(errors[i] / errors[i + 1], 2.2);
    }
  }
}

// A multiplier carries the pressure; gap and penetration are of the size of the tolerance then, and say
// nothing of whether the surfaces touch.
TEST(PressedBars, ConductAlikeWithTheAugmentedLagrangian) {
  const Divisions coarse{{3, 60}, {2, 90}};
  const auto of = [&](contact::NormalKind normal) {
    return simulated(contact::Formulation::small_sliding, 2, normal, coarse);
  };
  const Trace penalty = of(contact::NormalKind::penalty),
              augmented = of(contact::NormalKind::augmented_lagrangian);
  EXPECT_LT(largest(penalty, augmented), 0.5);
}

}  // namespace
}  // namespace solidus
