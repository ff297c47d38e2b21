/// The interface as a body that stores heat without friction (3.41b, 5.33) between two sides that conduct
/// differently (3.45).
///
///   Θ_1 = 400 K ──h_1──●──h_2── 300 K = Θ_2        C_co dΘ_c/dt = h_1 (Θ_1 − Θ_c) + h_2 (Θ_2 − Θ_c)
///                     Θ_c, C_co
///
/// Both bodies are held at their temperatures from t = 0 on; before they had 300 K, and so has the interface:
/// Θ_c = Θ_∞ + (300 − Θ_∞) e^{−t/τ},  τ = C_co/(h_1 + h_2),  Θ_∞ = (h_1 Θ_1 + h_2 Θ_2)/(h_1 + h_2).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "contact/laws/power_contact.hpp"
#include "contact_bodies.hpp"
#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;

constexpr double k_conductance = 1000, k_capacity = 2000, k_slave_resistance = 0.25;
constexpr double k_hot = 400, k_cold = 300;                     // [K]
constexpr double k_slave = k_conductance / k_slave_resistance;  // h_1, of the lower body
constexpr double k_master = k_conductance / (1 - k_slave_resistance);
constexpr double k_end = 1;

Coupled blocks() {
  Coupled c;
  c.mesh = test::distribute_blocks(
      test::raw_blocks({{0.01, 0.02}, {0.01, 0.02}, {2, 3}, {3, 2}, 0.0}, mesh::Shape::quad4));
  c.materials = {test::elastic(2e11, 0.3), test::elastic(2e11, 0.3)};
  c.start = {k_cold, k_cold};
  c.contact = test::interface();
  c.contact->heat.emplace();
  c.contact->heat->contact_law = contact::contact_law(contact::PowerContact{k_conductance});
  c.contact->heat->slave_resistance = k_slave_resistance;
  c.contact->interface_heat_capacity = k_capacity;
  for (const char* body : {"lower", "upper"}) {
    c.hold(body, 0);
    c.hold(body, 1);
  }
  c.form = StructuralForm::energy;
  return c;
}

struct Scheme {
  const char* name;
  Mapping mapping;
  bool double_pass = false, iterates = false;
  coupling::PhaseOrder order = coupling::PhaseOrder::mechanics_first;
};
const Scheme k_schemes[] = {
    {"isothermal", Mapping::isothermal},
    {"isentropic", Mapping::isentropic},
    {"heat first", Mapping::isentropic, false, false, coupling::PhaseOrder::heat_first},
    {"simultaneous", Mapping::simultaneous},
    {"double pass", Mapping::isentropic, true},
    {"iterative", Mapping::isothermal, false, true}};

Coupled with(Coupled c, const Scheme& scheme) {
  c.mapping = scheme.mapping;
  c.double_pass = scheme.double_pass;
  c.order = scheme.order;
  if (scheme.iterates) c.iteration.emplace();
  return c;
}

double exact(double time) {
  const double limit = (k_slave * k_hot + k_master * k_cold) / (k_slave + k_master);
  return limit + (k_cold - limit) * std::exp(-time * (k_slave + k_master) / k_capacity);
}

double largest_error(const Scheme& scheme, int n_steps) {
  Coupled c = with(blocks(), scheme);
  c.thermal.temperatures.push_back({"lower", "lower", Table(k_hot)});
  c.thermal.temperatures.push_back({"upper", "upper", Table(k_cold)});
  double worst = 0;
  verification::march(c, k_end, n_steps, [&](const coupling::State& state) {
    for (const contact::ContactPointState& point : state.contacts.at(0).points)
      worst = std::max(worst, std::abs(point.temperature - exact(state.time)));
  });
  return worst;
}

TEST(InterfaceHeat, IsStoredWithoutFrictionInEveryScheme) {
  for (const Scheme& scheme : k_schemes) {
    const double coarse = largest_error(scheme, 40), fine = largest_error(scheme, 80);
    RecordProperty(scheme.name, fmt::format("{:.3f} and {:.3f} K", coarse, fine));
    EXPECT_LT(fine, 1.2) << scheme.name;
    EXPECT_GT(coarse / fine, 1.7) << scheme.name << ": of first order at least";
  }
}

// Two free bodies and the interface between them: what one loses the others gain.
TEST(InterfaceHeat, IsInTheFirstLaw) {
  for (const Scheme& scheme : k_schemes) {
    Coupled c = with(blocks(), scheme);
    c.materials = {test::elastic(2e11, 0.3, 1.2e-5), test::elastic(2e11, 0.3, 1.2e-5)};
    c.start = {k_hot, k_cold};
    double stored = 0, made = 0;
    const auto run = verification::march(c, k_end, 10, [&](const coupling::State&, const auto& effort) {
      stored += std::abs(effort.energy.interface.stored);
      made += effort.energy.interface.dissipated;
    });
    EXPECT_GT(stored, 1e-3 * run.exchanged()) << scheme.name;
    EXPECT_EQ(made, 0) << scheme.name;
    EXPECT_LT(run.worst_defect(), 1e-9 * run.exchanged()) << scheme.name;
  }
}

// Heat alone: the bodies do not move, and the interface stores as well.
TEST(InterfaceHeat, IsStoredWhereOnlyHeatIsComputed) {
  const Coupled c = blocks();
  contact::ContactPair pair(c.mesh, c.kind, *c.contact, std::vector<double>{2e11, 2e11});
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"lower", "lower", Table(k_hot)});
  conditions.temperatures.push_back({"upper", "upper", Table(k_cold)});
  heat::HeatOptions options;
  options.tolerance = 1e-12;
  heat::ThermalPhase phase(c.mesh, c.kind, c.materials, conditions, options,
                           std::vector<linear::Contribution*>{pair.parts().heat.term()});
  coupling::Phases phases;
  phases.heat = &phase;
  phases.contacts = {&pair};
  coupling::IsothermalSplit scheme(phases);
  coupling::State state;
  state.heat = phase.states().initial(c.start);
  scheme.synchronise(state);
  double worst = 0;
  for (int n = 1; n <= 80; ++n) {
    coupling::State trial = state;
    trial.time = k_end * n / 80;
    const coupling::StepEffort effort = scheme.advance(state, trial, trial.time, k_end / 80);
    EXPECT_LT(std::abs(effort.energy.defect()), 1e-9 * effort.energy.heat_exchanged);
    state = std::move(trial);
    for (const contact::ContactPointState& point : state.contacts.at(0).points)
      worst = std::max(worst, std::abs(point.temperature - exact(state.time)));
  }
  EXPECT_LT(worst, 1.2);
}

}  // namespace
}  // namespace solidus
