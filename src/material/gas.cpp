/// Sieverts' law and its inverse, in closed form for atoms in solution and a pore of ideal gas.
#include "material/gas.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::material {

namespace {

constexpr double k_per_hundred_grams = 1e-5;  // [m³/kg] in a cm³ per 100 g

double solubility_of(const std::array<double, 2>& law, double temperature) {
  return k_per_hundred_grams * std::pow(10.0, law[0] - law[1] / temperature);
}

}  // namespace

double Gas::solubility(double temperature, double solid_fraction) const {
  return std::lerp(solubility_of(melt, temperature), solubility_of(solid, temperature), solid_fraction);
}

double Gas::pressure(double amount, double temperature, double solid_fraction) const {
  const double root = amount / solubility(temperature, solid_fraction);
  return k_standard_pressure * root * root;
}

double Gas::free_volume(double amount, double temperature, double solid_fraction, double at_pressure,
                        double density) const {
  const double dissolved =
      solubility(temperature, solid_fraction) * std::sqrt(at_pressure / k_standard_pressure);
  const double free = std::max(0.0, amount - dissolved);
  return density * free * (k_standard_pressure / at_pressure) * (temperature / k_standard_state);
}

}  // namespace solidus::material
