/// Spots, gas gap and separation are correlations in closed form; beyond the range of its fit the
/// separation goes on smoothly, so that an iterate may pass there.
#include "contact/interface/asperities.hpp"

#include <cmath>

namespace solidus::contact {

Asperities::Pressed Asperities::spots(double pressure, double temperature) const {
  if (!(pressure > 0)) return {};
  // Contacts of plastic asperities (the exponents are those of the correlation), with a hardness that depends
  // on the size of their indentations.
  constexpr double k_exponent = 0.95, k_size = 0.071;
  constexpr double k_per_micrometre = 1e6;
  const double power = 1 / (1 + k_size * hardness_exponent);
  const double size = 1.62 * k_per_micrometre * roughness / slope;  // of indentations [µm]
  const double relative =
      std::pow(pressure / hardness_coefficient * std::pow(size, -hardness_exponent), power);
  const double per_conductivity = 1.25 * slope / roughness * std::pow(relative, k_exponent);
  const auto [k, k_slope] = conductivity->line(temperature);
  const double per_pressure = k_exponent * power / pressure;
  return {per_conductivity * k, per_pressure * per_conductivity * k, per_conductivity * k_slope,
          per_pressure * per_conductivity * k_slope};
}

Asperities::PlaneDistance Asperities::separation(double x) const {
  constexpr double k_low = 1e-5, k_high = 2e-2;  // where the fit holds
  const double scale = 1.36 * roughness;
  const auto fit = [scale](double p) { return scale * std::sqrt(-std::log(5.59 * p)); };
  const auto fit_slope = [scale, &fit](double p) { return -0.5 * scale * scale / (p * fit(p)); };
  if (x < k_low) return {fit(k_low) + fit_slope(k_low) * (x - k_low), fit_slope(k_low)};
  if (x <= k_high) return {fit(x), fit_slope(x)};
  const double rate = -fit_slope(k_high) / fit(k_high);
  const double closer = 1 / (1 + rate * (x - k_high));
  return {fit(k_high) * closer, -rate * fit(k_high) * closer * closer};
}

}  // namespace solidus::contact
