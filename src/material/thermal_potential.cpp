/// Integrals over the pieces of the tables, so that energy and entropy stay consistent to rounding.
#include "material/thermal_potential.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::material {

StoredHeat<double> sensible_between(const Material& material, double from, double to) {
  const Table& c = material.specific_heat;
  const double rho = material.density;
  return {rho * c.integral(from, to), rho * c.integral_over_x(from, to), rho * c.value(to)};
}

StoredHeat<double> latent_between(const Material& material, double from, double to) {
  // Latent heat that is released between two temperatures, with its entropy and slope. Backward it is the
  // same with the other sign, but its slope belongs to the end of the way.
  if (from > to) {
    const StoredHeat<double> back = latent_between(material, to, from);
    double capacity = 0;
    for (const PhaseChange& change : material.phase_changes)
      capacity -= material.density * change.latent_heat * change.fraction.derivative(to);
    return {-back.heat, -back.entropy, capacity};
  }
  // Each piece of a fraction curve releases its share evenly: over a range ∫ dh/Θ is a logarithm, at one
  // temperature heat over temperature.
  StoredHeat<double> r{0, 0, 0};
  for (const PhaseChange& change : material.phase_changes) {
    const double heat = material.density * change.latent_heat;
    r.capacity -= heat * change.fraction.derivative(to);
    const auto& points = change.fraction.points();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto [cold, f_cold] = points[i];
      const auto [hot, f_hot] = points[i + 1];
      const double fallen = heat * (f_cold - f_hot);
      // An isothermal piece counts where the way passes its temperature.
      if (cold == hot) {  // isothermal
        const double share = (from < cold ? 1 : 0) - (to < cold ? 1 : 0);
        r.heat += share * fallen;
        r.entropy += share * fallen / cold;
        continue;
      }
      const double a = std::clamp(from, cold, hot), b = std::clamp(to, cold, hot);
      const double slope = fallen / (hot - cold);
      r.heat += slope * (b - a);
      r.entropy += slope * std::log1p((b - a) / a);
    }
  }
  return r;
}

}  // namespace solidus::material
