/// Pressure, dissolved gas and free gas of a node, and the pressure at which a pore would have a given
/// size.
#include "criteria/gas_law.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::criteria {

namespace {

/// Arm spacing of metal whose card has none, as for the flow through mush, and the least time of freezing.
constexpr double k_usual_spacing = 50e-6, k_least_time = 1e-3;  // [m], [s]
/// The least pressure in a pore whose metal has no surface tension.
constexpr double k_least_pressure = 1;  // [Pa]

}  // namespace

std::optional<GasLaw> GasLaw::of(const material::Material& material, const GasOptions& options) {
  const material::PhaseChange* freezing = material.solidification();
  if (!options.follow || !material.gas || freezing == nullptr) return {};
  GasLaw law;
  law.gas_ = *material.gas;
  law.casting_ = material.casting;
  law.density_ = material.density;
  law.solidus_ = freezing->fraction.solidus();
  law.content_ = options.content.value_or(material.gas->content);
  law.ambient_ = options.ambient_pressure;
  if (!(law.content_ > 0)) return {};
  return law;
}

double GasLaw::tension(const Place& place) const {
  const double spacing =
      casting_.secondary_arm_spacing(std::max(place.freezing_time, k_least_time)).value_or(k_usual_spacing);
  return 4 * gas_.surface_tension / spacing;
}

GasLaw::Pore GasLaw::pore(const Place& place, double pressure) const {
  // Pressure outside the pore: that of the atmosphere and of the melt, never below zero; surface
  // tension holds the pore shut on top of it.
  const bool held = ambient_ + pressure > 0;
  const double outside = held ? ambient_ + pressure : 0;
  const double p = std::max(outside + tension(place), k_least_pressure);
  const double temperature = std::max(place.temperature, solidus_);
  Pore result;
  // The gas that the metal cannot hold at this pressure, as a volume (Sieverts' law).
  result.gas = gas_.free_volume(content_, temperature, place.solid_fraction, p, density_);
  // x = a (c − s √p)/p, also where it just begins
  constexpr double k_begins = 1e-9;
  const double dissolved =
      gas_.solubility(temperature, place.solid_fraction) * std::sqrt(p / material::k_standard_pressure);
  // The slope by pressure: less is dissolved, and the gas itself expands.
  if (!held || dissolved > (1 + k_begins) * content_) return result;
  const double a = density_ * material::k_standard_pressure * (temperature / material::k_standard_state);
  result.gas_by_pressure = a * (dissolved / 2 - content_) / (p * p);
  return result;
}

double GasLaw::pores(const Place& place, double pressure) const {
  const double gas = pore(place, pressure).gas;
  return gas / (1 + gas);
}

double GasLaw::slope(const Place& place, double pressure) const {
  const Pore p = pore(place, pressure);
  return p.gas_by_pressure / ((1 + p.gas) * (1 + p.gas));
}

// x p = a (c − s √p) as an equation of second order for √p.
double GasLaw::pressure_at(const Place& place, double pores) const {
  const double x = pores / (1 - pores), temperature = std::max(place.temperature, solidus_);
  const double a = density_ * material::k_standard_pressure * (temperature / material::k_standard_state);
  const double s =
      gas_.solubility(temperature, place.solid_fraction) / std::sqrt(material::k_standard_pressure);
  const double root = 2 * a * content_ / (a * s + std::sqrt(a * a * s * s + 4 * x * a * content_));
  return root * root - tension(place) - ambient_;
}

}  // namespace solidus::criteria
