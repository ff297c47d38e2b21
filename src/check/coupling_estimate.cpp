/// The coupling number of each body at the temperatures that it passes, against the bound of the scheme.
#include "check/coupling_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mechanics/elements/structural_points.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/dynamics_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/scheme_input.hpp"
#include "system/log.hpp"

namespace solidus::check {

namespace {

setup::InitialTemperatureRange temperatures(const cases::CaseSpec& spec,
                                            const std::vector<setup::InitialTemperatureRange>& start) {
  setup::InitialTemperatureRange r = start.front();
  // The range that initial and boundary temperatures span.
  const auto add = [&r](double low, double high) { r = {std::min(r.low, low), std::max(r.high, high)}; };
  for (const setup::InitialTemperatureRange& body : start) add(body.low, body.high);
  const auto add_table = [&](const Function& f) {
    if (f.place == nullptr) add(f.table.min_value(), f.table.max_value());
  };
  using Kind = cases::ThermalConditionSpec::Kind;
  for (const auto& c : spec.thermal_conditions) {
    if (c.kind == Kind::temperature) add_table(c.temperature);
    if (c.kind == Kind::film || c.kind == Kind::radiation) add_table(c.ambient);
  }
  return r;
}

/// Supports hold every node in the axial direction.
bool axially_held(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  std::vector<char> held(mesh.x.size(), 0);
  for (const auto& c : spec.mechanical_conditions) {
    const bool axial = c.kind == cases::MechanicalConditionSpec::Kind::displacement && (c.uy || c.uz);
    const auto nodes = mesh.node_sets.find(c.group);
    if (!axial || nodes == mesh.node_sets.end()) continue;
    for (const Index node : nodes->second) held[as_size(node)] = 1;
  }
  const auto owned = held.begin() + mesh.n_owned_nodes;
  return !parallel::any_process(std::find(held.begin(), owned, 0) != owned);
}

}  // namespace

std::vector<CouplingEstimate> coupling_estimates(const cases::CaseSpec& spec,
                                                 const std::vector<material::Material>& materials,
                                                 const mesh::Mesh& mesh,
                                                 const std::vector<setup::InitialTemperatureRange>& start) {
  // The range of temperatures of the whole case, since a body may come to any of them. Plane strain
  // couples more strongly than free expansion does, as the plane hinders it.
  const auto [low, high] = temperatures(spec, start);
  const bool plane = spec.analysis.kind == AnalysisKind::plane_strain ||
                     (spec.analysis.kind == AnalysisKind::axisymmetric && axially_held(spec, mesh));
  std::vector<CouplingEstimate> estimates;
  // The coupling number of each body that deforms, at its start and at its worst within the range of
  // temperatures.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (cases::only_conducts(spec.bodies[b])) continue;
    // Bodies that only conduct have no strains that could couple.
    CouplingEstimate e;
    e.body = spec.bodies[b].name;
    e.where = spec.bodies[b].where;
    e.plane = plane;
    e.initial = start[b].high;
    // The worst is looked for among all temperatures of the range, since the number grows with
    // temperature and the properties are tables.
    e.worst = material::strongest_coupling(materials[b], low, high);
    e.at_initial = material::coupling_number(materials[b], e.initial);
    e.at_worst = material::coupling_number(materials[b], e.worst);
    estimates.push_back(std::move(e));
  }
  return estimates;
}

/// The steps by which conduction is ahead of deformation of δ_K = m where free expansion, δ_K = p, is
/// expected: (m − p)/(1 + p).
double late(const CouplingEstimate& e) {
  const double expected = std::min(e.at_worst.bound, mechanics::k_most_expansion);
  return std::abs(e.decisive() - expected) / (1 + expected);
}

double heat_lag(const cases::CaseSpec& spec, const std::vector<CouplingEstimate>& estimates,
                bool keeps_strain) {
  const coupling::SchemeTraits traits = spec.coupling.scheme->traits();
  if (!spec.exchanges_heat() || spec.dynamics || estimates.empty() || traits.iterates) return 0;
  if (traits.mapping == mechanics::Mapping::simultaneous || setup::lags_a_step(spec, keeps_strain)) return 0;
  double strongest = 0;
  for (const CouplingEstimate& e : estimates)
    strongest = std::max(strongest, traits.second_order ? e.decisive() : late(e));
  const bool end_of_step =
      !traits.second_order && setup::heat_options(spec).stepping == heat::ThermalStepping::backward_euler;
  return end_of_step ? strongest : 0.5 * strongest;
}

std::string text(const CouplingEstimate& e) {
  std::string most;
  if (e.at_worst.uniaxial > e.at_initial.uniaxial)
    most = fmt::format(", at most {:.4f} at {:.6g} degC", e.at_worst.uniaxial, e.worst - k_zero_celsius);
  return fmt::format("{}: delta = {:.4f} at {:.6g} degC{}; isothermal split quasi-statically {}: {} = {:.4f}",
                     e.body, e.at_initial.uniaxial, e.initial - k_zero_celsius, most,
                     e.decisive() < 1 ? "stable" : (e.plane ? "unstable" : "unstable in the worst case"),
                     e.plane ? "2 (1 - nu) delta" : "3 (1 - nu)/(1 + nu) delta", e.decisive());
}

void announce_isothermal(const cases::CaseSpec& spec, const std::vector<CouplingEstimate>& estimates) {
  // Only isothermal passes can be unstable; all other schemes are so by construction of the split
  // for no coupling.
  const bool isothermal = spec.coupling.scheme->traits().mapping == mechanics::Mapping::isothermal;
  if (!isothermal || estimates.empty()) return;
  // The body with the strongest coupling decides for all, for they are solved in one step.
  const CouplingEstimate& worst = *std::max_element(
      estimates.begin(), estimates.end(),
      [](const CouplingEstimate& a, const CouplingEstimate& b) { return a.decisive() < b.decisive(); });
  // By the criterion for stability of the isothermal split: with inertia by other methods than backward Euler
  // no bound is known, weak coupling is stable, strong coupling needs short steps or is unstable.
  const std::string advice =
      fmt::format("scheme = \"{}\" in [coupling] has no such limit", coupling::k_stable_scheme);
  if (spec.dynamics && spec.dynamics->method != cases::DynamicsSpec::Method::backward_euler) {
    logging::warn(
        "isothermal passes with inertia by {}: no strength of coupling is known to be stable, and high "
        "frequencies grow in a weak one too ({}); {}",
        setup::method_name(*spec.dynamics), text(worst), advice);
  } else if (worst.decisive() < 1) {
    logging::info("isothermal passes: the coupling is weak enough for every step; {}", text(worst));
  } else if (spec.dynamics) {
    logging::warn(
        "isothermal passes with inertia: stable only for steps dt with delta_K < 1 + 4/(omega dt)^2, omega "
        "the "
        "frequency of a mode, in the quasi-static limit delta_K < 1; {}; {}",
        text(worst), advice);
  } else {
    logging::warn(
        "isothermal passes: {}; temperatures and displacements will oscillate and grow in every "
        "step that conduction does not damp; {}",
        text(worst), advice);
  }
}

}  // namespace solidus::check
