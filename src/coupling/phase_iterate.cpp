/// Fractions follow the iterate at once at first, and later by a share that the caller lowers, so that an
/// alternation between two states dies out.
#include "coupling/phase_iterate.hpp"

#include <algorithm>

#include "coupling/largest_difference.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::coupling {

namespace {

bool changes_phase(const Phases& phases) {
  const std::size_t n_bodies = phases.mechanics->mesh().bodies.size();
  for (std::size_t b = 0; b < n_bodies; ++b) {
    const material::Material& material = phases.mechanics->bodies().material(static_cast<int>(b));
    const bool strains = std::ranges::any_of(material.phase_changes,
                                             [](const auto& change) { return change.volume_change != 0; });
    if (material.solidification() != nullptr || strains) return true;
  }
  return false;
}

/// The state whose nodal heats lie a share of the way from those of `a` to those of `b`, with the
/// temperatures that follow; where nodes hold no heat, the temperatures lie there. Collective.
heat::ThermalState between(const heat::ThermalPhase& phase, const heat::ThermalState& a,
                           const heat::ThermalState& b, double share) {
  const auto part = [share](double from, double to) { return from + share * (to - from); };
  heat::ThermalState state = b;
  if (a.enthalpy.empty()) {
    std::ranges::transform(a.temperature, b.temperature, state.temperature.begin(), part);
    return state;
  }
  std::ranges::transform(a.enthalpy, b.enthalpy, state.enthalpy.begin(), part);
  const heat::NodalEnthalpy& storage = phase.storage();
  for (Index i = 0; i < storage.n_nodes(); ++i) {
    const auto node = as_size(i);
    if (storage.capacity(i, b.temperature[node]) > 0)
      state.temperature[node] = storage.temperature(i, state.enthalpy[node]);
  }
  parallel::GhostExchange(phase.mesh()).update(state.temperature, 1);
  return state;
}

}  // namespace

PhaseIterate::PhaseIterate(const Phases& phases, const heat::ThermalState& old)
    : any_(changes_phase(phases)),
      phases_(&phases),
      old_(&old),
      plateau_share_(coupling::plateau_share(phases, old)) {
  if (any_) held_ = old;
}

void PhaseIterate::hold(mechanics::MechanicalPass& pass) const {
  pass.phase_temperature = held_.temperature;
  pass.plateau_share = plateau_share_;
}

void PhaseIterate::advance(const heat::ThermalState& now, double share) {
  if (!any_) return;
  held_ = share == 1 ? now : between(*phases_->heat, held_, now, share);
  plateau_share_ = coupling::plateau_share(*phases_, held_);
}

double PhaseIterate::distance(const heat::ThermalState& a, const heat::ThermalState& b) const {
  if (a.enthalpy.empty()) return largest_difference(b.temperature, a.temperature);
  const std::vector<double> change = heat::change_in_kelvin(*phases_->heat, a, b);
  return largest_difference(change, std::vector<double>(change.size(), 0.0));
}

double PhaseIterate::difference(const heat::ThermalState& now) const {
  if (!any_) return 0;
  constexpr double k_rounding = 1e-9;  // [K]
  const double left = distance(held_, now);
  return left > k_rounding ? left / distance(*old_, now) : 0.0;
}

}  // namespace solidus::coupling
