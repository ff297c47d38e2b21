/// The number at one temperature in closed form, and its maximum over a range by sampling the smooth
/// pieces.
#include "material/derivatives/coupling_number.hpp"

#include <algorithm>
#include <vector>

#include "material/elasticity.hpp"

namespace solidus::material {

CouplingNumber coupling_number(const Material& material, double temperature) {
  const PhaseChange* freezing = material.solidification();
  const bool solid = freezing == nullptr || freezing->fraction.value(temperature) >= 1;
  const auto p = properties_at(material, temperature, temperature, PhaseState<double>{1.0, 0.0});
  const double bulk = p.bulk, shear = solid ? p.shear : 0, slope = expansion_slope(material, temperature);
  double capacity = material.density * material.specific_heat.value(temperature);
  if (material.specific_heat_at == SpecificHeatAt::constant_pressure)
    capacity -= bulk * slope * slope * temperature;
  const double stored = bulk * slope * bulk * slope * temperature / capacity;  // β²Θ/C
  return {stored / (bulk + 4 * shear / 3), stored / (bulk + shear / 3), stored / bulk};
}

double strongest_coupling(const Material& material, double from, double to) {
  // Between the points of all tables the number is smooth; it is sampled there.
  std::vector<double> ends{from, to};
  for (const Table* table :
       {&material.young_modulus, &material.poisson_ratio, &material.expansion, &material.specific_heat})
    for (const double x : table->x())
      if (x > from && x < to) ends.push_back(x);
  std::sort(ends.begin(), ends.end());

  constexpr int k_samples = 10;
  double at = from, strongest = -1;
  // Samples of the number from cold to hot; the first of equal ones stays.
  const auto look = [&](double temperature) {
    const double number = coupling_number(material, temperature).bound;
    if (number <= strongest) return;
    strongest = number;
    at = temperature;
  };
  // Within a piece the number is smooth, so that a few samples find its maximum closely enough.
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (int n = 0; n < k_samples; ++n) look(ends[i] + (ends[i + 1] - ends[i]) * n / k_samples);
  look(to);
  return at;
}

}  // namespace solidus::material
