/// Heat through an interface in time, against closed forms and a one-dimensional program.
///
/// Two half spaces at Θ_1 and Θ_2 that meet through a conductance h at t = 0, with the effusivities
/// e = √(k ρ c):
///
///   q(t) = h (Θ_1 − Θ_2) exp(η²) erfc η,   η = h (1/e_1 + 1/e_2) √t
///   Θ_s,1 = Θ_1 − (Θ_1 − Θ_2) e_2/(e_1 + e_2) (1 − exp(η²) erfc η)
///
/// (Carslaw and Jaeger 1959, 2.7 with a film, applied to both sides).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/spots_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "contact_bodies.hpp"
#include "coupling/isothermal_split.hpp"
#include "csv.hpp"

namespace solidus {
namespace {

using HeatLaw = contact::HeatTransferSpec;

constexpr double k_k1 = 200, k_k2 = 40;        // [W/(m K)]
constexpr double k_capacity = 7800.0 * 500.0;  // [J/(m³ K)] of both
constexpr double k_l1 = 0.1, k_l2 = 0.2;       // [m]
constexpr double k_width = 0.01;               // [m]

mesh::Mesh bars(int n1, int n2, double gap) {
  return test::distribute_blocks(
      test::raw_blocks({{k_width, k_l1}, {k_width, k_l2}, {1, n1}, {1, n2}, gap}, mesh::Shape::quad4));
}

std::vector<material::Material> materials(double expansion) {
  return {test::elastic(70e9, 0.33, expansion, k_k1), test::elastic(210e9, 0.3, expansion, k_k2)};
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

contact::ContactParameters through(const HeatLaw& law) {
  contact::ContactParameters s = test::interface();
  s.heat = law;
  return s;
}

TEST(TwoHalfSpaces, ThatMeetThroughSpotsAndGasEqualiseAsTheClosedFormSays) {
  HeatLaw law;
  law.contact_law =
      contact::contact_law(contact::SpotsContact{{.roughness = 4e-6,
                                                  .slope = 0.1,
                                                  .conductivity = Table(2 * k_k1 * k_k2 / (k_k1 + k_k2)),
                                                  .hardness_coefficient = 6.27e9,
                                                  .hardness_exponent = -0.229},
                                                 2e9});
  law.gap_law = contact::gap_law(contact::GasGap{.conductivity = 0.03, .temperature_jump = 1.3e-9});
  const mesh::Mesh mesh = bars(200, 200, 0);
  contact::ContactParameters spec = through(law);
  spec.penalty = 1e12;
  spec.penalty_is_factor = false;
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, spec);
  coupling::Phases phases;
  phases.contacts = {&pair};
  heat::HeatOptions options;
  options.tolerance = 1e-11;
  options.symmetric = false;
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, materials(0), {}, options,
                           {pair.parts().heat.term()});
  phases.heat = &phase;

  // Without pressure: the two sides keep their conductance but for what the gas feels of their temperature.
  const double hot = 900, cold = 300, end = 8, dt = 0.02;
  heat::ThermalState state = phase.states().initial(std::vector<double>{hot, cold});
  const double h = contact::HeatTransferLaw(law).at(0, 0, 0.5 * (hot + cold)).value;
  const double e1 = std::sqrt(k_k1 * k_capacity), e2 = std::sqrt(k_k2 * k_capacity);
  double worst = 0;
  auto file =
      verification::csv("contact_half_spaces", "time[s],slave[K],master[K],slave_exact[K],master_exact[K]");
  for (int i = 1; i * dt <= end + 1e-9; ++i) {
    phase.solve(state, state, {.time = i * dt, .dt = dt, .stepping = heat::ThermalStepping::sdirk2});
    const double eta = h * (1 / e1 + 1 / e2) * std::sqrt(i * dt);
    const double risen = (hot - cold) * (1 - std::exp(eta * eta) * std::erfc(eta));
    const double exact1 = hot - risen * e2 / (e1 + e2), exact2 = cold + risen * e1 / (e1 + e2);
    const double found1 = surface(mesh, "lower_top", state.temperature);
    const double found2 = surface(mesh, "upper_bottom", state.temperature);
    file << i * dt << ',' << found1 << ',' << found2 << ',' << exact1 << ',' << exact2 << '\n';
    if (i * dt > 0.5) worst = std::max({worst, std::abs(found1 - exact1), std::abs(found2 - exact2)});
  }
  RecordProperty("worst", fmt::format("{:.3f} K of {:.0f} K", worst, hot - cold));
  // Elements of 0.5 and 1 mm, the square of whose length over the diffusion length is 1e-3; the mean
  // temperature of the gas moves with the effusivities, by 100 K, of its conductance 0.5 %.
  EXPECT_LT(worst, 2e-3 * (hot - cold));
}

// Table 7.9 in SI.
const Table k_table_7_9({0, 1e-5, 2e-5, 6e-5, 1e-4}, {2300, 2200, 1400, 350, 300});

HeatLaw table_7_9() {
  HeatLaw law;
  law.contact_law = contact::contact_law(contact::PowerContact{2300});
  law.gap_law = contact::gap_law(contact::TableGap{{}, k_table_7_9});
  return law;
}

/// The same bars by finite volumes in one dimension: heat implicit, the gap from the mean temperatures of the
/// bars that expand freely along their axis and are held sideways.
class Reference {
 public:
  Reference(int cells, double gap, double expansion, double hot)
      : n_(cells),
        gap_(gap),
        expansion_(expansion),
        hot_(hot),
        t_(2 * static_cast<std::size_t>(cells), 300) {}

  double opening() const {
    return gap_ -
           expansion_ * ((1 + 0.33) / (1 - 0.33) * k_l1 * mean(0) + (1 + 0.3) / (1 - 0.3) * k_l2 * mean(n_));
  }
  double conductance() const { return k_table_7_9.value(std::max(opening(), 0.0)); }
  void step(double dt) {
    // Tridiagonal, Thomas' algorithm; conductances between neighbours, the hot end in front.
    const std::size_t n = t_.size();
    std::vector<double> to_next(n, 0.0), diagonal(n), right(n);
    const double front = 2 * k_k1 / d(0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double r = 0.5 * d(i) / k(i) + 0.5 * d(i + 1) / k(i + 1);
      to_next[i] = 1 / (r + (i + 1 == n / 2 ? 1 / conductance() : 0.0));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double stored = k_capacity * d(i) / dt;
      diagonal[i] = stored + to_next[i] + (i > 0 ? to_next[i - 1] : front);
      right[i] = stored * t_[i] + (i > 0 ? 0 : front * hot_);
    }
    for (std::size_t i = 1; i < n; ++i) {
      const double f = to_next[i - 1] / diagonal[i - 1];
      diagonal[i] -= f * to_next[i - 1];
      right[i] += f * right[i - 1];
    }
    for (std::size_t i = n; i-- > 0;)
      t_[i] = (right[i] + (i + 1 < n ? to_next[i] * t_[i + 1] : 0.0)) / diagonal[i];
  }
  double flux() const { return conductance_between() * (t_[t_.size() / 2 - 1] - t_[t_.size() / 2]); }
  double lower_surface() const { return t_[t_.size() / 2 - 1] - flux() * 0.5 * d(0) / k_k1; }
  double upper_surface() const { return t_[t_.size() / 2] + flux() * 0.5 * d(t_.size() - 1) / k_k2; }

 private:
  double d(std::size_t i) const { return (i < t_.size() / 2 ? k_l1 : k_l2) / n_; }
  double k(std::size_t i) const { return i < t_.size() / 2 ? k_k1 : k_k2; }
  double conductance_between() const {
    return 1 / (0.5 * d(0) / k_k1 + 1 / conductance() + 0.5 * d(t_.size() - 1) / k_k2);
  }
  double mean(int first) const {
    double sum = 0;
    for (int i = first; i < first + n_; ++i) sum += t_[static_cast<std::size_t>(i)] - 300;
    return sum / n_;
  }

  int n_;
  double gap_, expansion_, hot_;
  std::vector<double> t_;
};

struct Trace {
  std::vector<double> lower, upper, opening;  // every `k_sample` seconds
  double closes = 0;                          // [s]
};

constexpr double k_end = 120, k_sample = 4;  // [s]
constexpr double k_gap = 5e-4, k_expansion = 1e-5, k_hot_end = 800;

Trace reference() {
  Reference bars(300, k_gap, k_expansion, k_hot_end);
  Trace trace;
  const double dt = 0.01;
  const int per_sample = static_cast<int>(std::lround(k_sample / dt));
  for (int i = 1; i * dt <= k_end + 1e-9; ++i) {
    bars.step(dt);
    if (trace.closes == 0 && bars.opening() <= 0) trace.closes = i * dt;
    if (i % per_sample != 0) continue;
    trace.lower.push_back(bars.lower_surface());
    trace.upper.push_back(bars.upper_surface());
    trace.opening.push_back(std::max(bars.opening(), 0.0));
  }
  return trace;
}

Trace simulated(double dt) {
  const mesh::Mesh mesh = bars(40, 60, k_gap);
  const std::vector<material::Material> of_bars = materials(k_expansion);
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, through(table_7_9()),
                            std::vector<double>{70e9, 210e9});
  mechanics::MechanicalConditions supports = test::symmetric_supports(2);
  for (const char* side : {"lower_x_max", "upper_x_max"}) supports.displacements.push_back({side, 0, 0.0});
  supports.displacements.push_back({"upper_y_max", 1, 0.0});
  const std::vector<double> cold(mesh.x.size(), 300.0);
  mechanics::MechanicalPhase mechanics(mesh, AnalysisKind::plane_strain, of_bars, cold, supports,
                                       test::strict_mechanics(), {&pair.parts().forces.term()});
  heat::ThermalConditions ends;
  ends.temperatures.push_back({"hot", "lower_y_min", k_hot_end});
  heat::ThermalPhase heat(mesh, AnalysisKind::plane_strain, of_bars, ends, {}, {pair.parts().heat.term()});
  coupling::Phases phases;
  phases.heat = &heat;
  phases.mechanics = &mechanics;
  phases.contacts = {&pair};
  coupling::IsothermalSplit scheme(phases);
  coupling::State state;
  state.heat = heat.states().initial(std::vector<double>{300, 300});
  state.mechanics = mechanics.initial_state();
  scheme.synchronise(state);

  Trace trace;
  const int per_sample = static_cast<int>(std::lround(k_sample / dt));
  for (int i = 1; i * dt <= k_end + 1e-9; ++i) {
    coupling::State next = state;
    next.time = i * dt;
    const coupling::StepEffort effort = scheme.advance(state, next, i * dt, dt);
    state = next;
    if (trace.closes == 0 && effort.contacts[0].closed_points > 0) trace.closes = i * dt;
    if (i % per_sample != 0) continue;
    trace.lower.push_back(surface(mesh, "lower_top", state.heat.temperature));
    trace.upper.push_back(surface(mesh, "upper_bottom", state.heat.temperature));
    const auto opening = contact::nodal_fields(pair.view(), state.heat.temperature).opening;
    trace.opening.push_back(std::max(parallel::global_max(opening.empty() ? -1.0 : opening.front()), 0.0));
  }
  return trace;
}

double largest(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

TEST(TwoBarsInTime, ThatCloseTheirGapFollowTheTableAsAOneDimensionalProgramDoes) {
  const Trace exact = reference(), coarse = simulated(1), fine = simulated(0.25);
  auto file =
      verification::csv("contact_closing_gap", "time[s],lower[K],upper[K],lower_exact[K],upper_exact[K]");
  auto gap = verification::csv("contact_closing_gap_opening", "time[s],opening[mm],exact[mm]");
  for (std::size_t i = 0; i < exact.lower.size(); ++i) {
    const double time = k_sample * static_cast<double>(i + 1);
    file << time << ',' << fine.lower[i] << ',' << fine.upper[i] << ',' << exact.lower[i] << ','
         << exact.upper[i] << '\n';
    gap << time << ',' << 1e3 * fine.opening[i] << ',' << 1e3 * exact.opening[i] << '\n';
  }
  EXPECT_GT(exact.closes, 0);
  EXPECT_NEAR(fine.closes, exact.closes, 0.6);
  const double error1 = std::max(largest(coarse.lower, exact.lower), largest(coarse.upper, exact.upper));
  const double error2 = std::max(largest(fine.lower, exact.lower), largest(fine.upper, exact.upper));
  RecordProperty("closes", fmt::format("{:.2f} s (1-D {:.2f} s)", fine.closes, exact.closes));
  RecordProperty("errors", fmt::format("{:.3f} K, {:.3f} K", error1, error2));
  // Backward Euler and the gap of the temperature before: first order in the step.
  EXPECT_LT(error2, 0.005 * (k_hot_end - 300));
  EXPECT_GT(error1 / error2, 2.5);
  EXPECT_LT(error1 / error2, 5.0);
}

}  // namespace
}  // namespace solidus
