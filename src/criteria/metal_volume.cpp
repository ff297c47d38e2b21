/// Thermal and phase part of the volume, from the card's tables and fractions.
#include "criteria/metal_volume.hpp"

#include <algorithm>
#include <utility>

namespace solidus::criteria {

MetalVolume::MetalVolume(const material::Material& material)
    : material_(&material),
      mobile_to_(material.casting.coherency_fraction),
      held_from_(material.casting.coherency_fraction) {
  const material::PhaseFraction& fraction = material.solidification()->fraction;
  const std::vector<std::pair<double, double>>& points = fraction.points();
  // Where the fraction jumps over the coherency (a eutectic, a pure metal), mobile melt ends before the jump
  // and held metal begins after it; both are fractions on the table.
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto [temperature, before] = points[i + 1];  // temperature rises: the later point has less solid
    if (points[i].first != temperature) continue;
    const double after = points[i].second;
    if (before < mobile_to_ && mobile_to_ <= after) {
      mobile_to_ = before;
      held_from_ = after;
      break;
    }
  }
  solid_ = at(fraction.solidus(), 0);
}

bool MetalVolume::changes() const {
  if (std::ranges::any_of(material_->phase_changes, [](const auto& c) { return c.volume_change != 0; }))
    return true;
  return material_->expansion.min_value() != 0;
}

VolumeParts MetalVolume::at(double temperature, double plateau_share) const {
  VolumeParts parts;
  parts.thermal =
      3 * material_->expansion.value(temperature) * (temperature - material_->expansion_reference);
  for (const material::PhaseChange& change : material_->phase_changes)
    if (change.volume_change != 0)
      parts.phase += change.volume_change * change.fraction.value(temperature, plateau_share);
  return parts;
}

}  // namespace solidus::criteria
