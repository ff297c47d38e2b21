/// The three forms differ in which factor of the product is integrated; each is evaluated as its difference
/// to the enthalpy.
#include "heat/storage/sensible_form.hpp"

#include <limits>

#include "material/thermal_potential.hpp"

namespace solidus::heat {

PrintedExcess printed_excess(const material::Material& material, SensibleForm form, double from, double to) {
  if (form == SensibleForm::enthalpy || from == to) return {};
  if (form == SensibleForm::entropy) {
    if (!(from > 0 && to > 0)) return {std::numeric_limits<double>::quiet_NaN(), 0};
    const material::StoredHeat<double> between = material::sensible_between(material, from, to);
    return {to * between.entropy - between.heat, between.entropy};
  }
  const Table& c = material.specific_heat;
  const double rho = material.density;
  return {rho * (c.value(to) * (to - from) - c.integral(from, to)), rho * c.derivative(to) * (to - from)};
}

}  // namespace solidus::heat
