#include "material/material.hpp"

#include <algorithm>

namespace solidus::material {

const PhaseChange* Material::solidification() const {
  const auto found = std::find_if(phase_changes.begin(), phase_changes.end(),
                                  [](const PhaseChange& change) { return change.solidification; });
  return found == phase_changes.end() ? nullptr : &*found;
}

double Material::solid_fraction(double temperature) const {
  const PhaseChange* change = solidification();
  return change == nullptr ? 1.0 : change->fraction.value(temperature);
}

}  // namespace solidus::material
