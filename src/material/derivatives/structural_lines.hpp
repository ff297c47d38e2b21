/// Moduli, thermal strain and hardening near Θ_n, where every table is replaced by its line there: the
/// structural entropy and energy of a step are computed from them.
///
/// S = −(W_Θ + M_Θ + K_Θ) holds slopes of tables (2.52b) and would jump where a table bends, E = W + M + K +
/// Θ S with it. A thermal phase that crosses the bend then has a balance without a solution. The jump is one
/// of the table, not of the material: in a step the tables go on straight, as in the isentropic mapping
/// (docs/decisions/0006), and the next step begins with the lines of its own Θ_n.
#pragma once

#include "material/viscoplastic.hpp"

namespace solidus::material {

/// Properties at Θ along the lines at Θ_n, with their temperature derivatives; solid (4.81).
/// @param line_temperature  Θ_n [K]
/// @param strain_offset     e^θ less 3 α (Θ − Θ_ref)
template <class T>
Viscoplastic::Properties<Jet<T>> along_lines(const Material& m, const T& line_temperature,
                                             const T& temperature, const T& strain_offset) {
  using J = Jet<T>;
  const T zero(0.0), change = temperature - line_temperature;
  const T reference(m.expansion_reference);
  const auto now = properties_at(m, line_temperature, line_temperature);
  const auto slope = derivatives_at(m, line_temperature, line_temperature);
  const auto expansion = detail::line(m.expansion, line_temperature);
  // Lines of the moduli themselves: that of Poisson's ratio may run into 1/2.
  Viscoplastic::Properties<J> p;
  p.elastic.bulk = {T(now.bulk + slope.bulk * change), slope.bulk, zero};
  p.elastic.shear = {T(now.shear + slope.shear * change), slope.shear, zero};
  p.elastic.thermal_strain = J(T(3.0)) *
                                 J{T(expansion.value + expansion.slope * change), expansion.slope, zero} *
                                 J{T(temperature - reference), T(1.0), zero} +
                             J(strain_offset);
  p.elastic.solid_fraction = p.elastic.viscosity = J(T(1.0));
  if (!m.flow) return p;
  p.flow = flow_properties_at(*m.flow, J::variable(line_temperature));
  for (J FlowProperties<J>::*number :
       {&FlowProperties<J>::hardening_origin, &FlowProperties<J>::kinematic_modulus})
    (p.flow.*number).v += (p.flow.*number).d * change;
  for (J& parameter : p.flow.hardening) parameter.v += parameter.d * change;
  p.flow.temperature = J(line_temperature);
  p.flow.beyond = J{change, T(1.0), zero};
  return p;
}

}  // namespace solidus::material
