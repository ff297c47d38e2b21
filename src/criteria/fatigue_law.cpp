#include "criteria/fatigue_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace solidus::criteria {

namespace {

constexpr double k_fewest = 1e-3;  ///< of cycles: what breaks at once

/// Half the range of strain that is borne for N cycles.
double amplitude(const FatigueLaw& law, double cycles) {
  const double reversals = 2 * cycles;
  return (law.strength - law.mean_stress) / law.modulus * std::pow(reversals, law.strength_exponent) +
         law.ductility * std::pow(reversals, law.ductility_exponent);
}

/// Straight lines in both logarithms, the outermost ones going on.
double of_table(const FatigueLaw& law, double strain_range) {
  std::size_t k = 1;
  while (k + 1 < law.strain.size() && law.strain[k] < strain_range) ++k;
  const double x0 = std::log(law.strain[k - 1]), x1 = std::log(law.strain[k]);
  const double y0 = std::log(law.cycles[k - 1]), y1 = std::log(law.cycles[k]);
  return std::exp(y0 + (y1 - y0) * (std::log(strain_range) - x0) / (x1 - x0));
}

}  // namespace

double FatigueLaw::life(double strain_range) const {
  if (!(strain_range > 0)) return k_most_cycles;
  if (!strain.empty()) return std::clamp(of_table(*this, strain_range), k_fewest, k_most_cycles);
  // The amplitude falls with the number of cycles: bisection in its logarithm.
  if (amplitude(*this, k_most_cycles) >= 0.5 * strain_range) return k_most_cycles;
  if (amplitude(*this, k_fewest) <= 0.5 * strain_range) return k_fewest;
  double low = std::log(k_fewest), high = std::log(k_most_cycles);
  constexpr int k_halvings = 60;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (amplitude(*this, std::exp(middle)) > 0.5 * strain_range ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace solidus::criteria
