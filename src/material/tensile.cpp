#include "material/tensile.hpp"

#include <cmath>

#include "material/elasticity_impl.hpp"
#include "material/hardening.hpp"

namespace solidus::material {
namespace {

double back_stress(const Flow& flow, double strain, double temperature) {
  const double modulus = flow.kinematic_modulus.value(temperature), recall = flow.recall.value(temperature);
  switch (flow.kinematic) {
    case KinematicHardening::none:
      break;
    case KinematicHardening::linear:
      return modulus * strain;
    case KinematicHardening::armstrong_frederick:
      return -modulus / recall * std::expm1(-recall * strain);
  }
  return 0;
}

}  // namespace

double tensile_stress(const Flow& flow, double strain, double temperature) {
  const auto properties = flow_properties_at(flow, temperature);
  return properties.flow_stress + hardening_stress(flow.isotropic, flow.curves, properties, strain).stress +
         back_stress(flow, strain, temperature);
}

double tensile_overstress(const Flow& flow, double rate, double temperature) {
  if (flow.rate_independent()) return 0;
  const double n = flow.exponent.value(temperature), drag = flow.drag_stress.value(temperature);
  // Scaled by D, so that no power leaves the range of numbers.
  const double scaled = flow.viscosity.value(temperature) * rate / drag * std::pow(1.5, 0.5 * (n + 1));
  return drag * std::pow(scaled, 1 / n);
}

}  // namespace solidus::material
