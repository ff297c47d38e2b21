#include "coupling/phase_iterate.hpp"

#include <algorithm>

#include "coupling/largest_difference.hpp"

namespace solidus::coupling {

namespace {

bool changes_phase(const Phases& phases) {
  const std::size_t n_bodies = phases.mechanics->mesh().bodies.size();
  for (std::size_t b = 0; b < n_bodies; ++b) {
    const material::Material& material = phases.mechanics->material(static_cast<int>(b));
    const bool strains = std::ranges::any_of(material.phase_changes,
                                             [](const auto& change) { return change.volume_change != 0; });
    if (material.solidification() != nullptr || strains) return true;
  }
  return false;
}

}  // namespace

PhaseIterate::PhaseIterate(const Phases& phases, const heat::ThermalState& old)
    : any_(changes_phase(phases)), plateau_share_(coupling::plateau_share(phases, old)) {
  if (!any_) return;
  old_ = old.temperature;
  temperature_ = old.temperature;
}

void PhaseIterate::hold(mechanics::MechanicalPass& pass) const {
  pass.phase_temperature = temperature_;
  pass.plateau_share = plateau_share_;
}

void PhaseIterate::advance(std::span<const double> temperature, std::vector<double> plateau_share,
                           double share) {
  if (!any_) return;
  const auto go = [share](double from, double to) { return share == 1 ? to : from + share * (to - from); };
  std::ranges::transform(temperature_, temperature, temperature_.begin(), go);
  std::ranges::transform(plateau_share_, plateau_share, plateau_share_.begin(), go);
}

double PhaseIterate::difference(std::span<const double> temperature,
                                std::span<const double> plateau_share) const {
  if (!any_) return 0;
  constexpr double k_rounding = 1e-9;  // [K]
  const double change = largest_difference(temperature, old_),
               left = largest_difference(temperature, temperature_);
  const double of_temperature = left > k_rounding ? left / change : 0.0;
  const double of_share = plateau_share_.empty() ? 0.0 : largest_difference(plateau_share, plateau_share_);
  return std::max(of_temperature, of_share);
}

}  // namespace solidus::coupling
