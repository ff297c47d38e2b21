/// Moduli, thermal strain and hardening near Θ_n, where every table is replaced by its line there: the
/// structural entropy and energy of a step are computed from them.
///
/// S = −(W_Θ + M_Θ + K_Θ) holds slopes of tables (2.52b) and would jump where a table bends, E = W + M + K +
/// Θ S with it. A thermal phase that crosses the bend then has a balance without a solution. The jump is one
/// of the table, not of the material: in a step the tables go on straight, as in the isentropic mapping
/// (docs/decisions/0006), and the next step begins with the lines of its own Θ_n.
#pragma once

#include <optional>

#include "material/viscoplastic.hpp"

namespace solidus::material {

/// Elastic properties at Θ_n and their slopes there.
template <class T>
struct ElasticLines {
  T temperature;                           ///< Θ_n [K]
  T bulk, bulk_slope, shear, shear_slope;  ///< [Pa], [Pa/K]
  T expansion, expansion_slope;            ///< α [1/K], [1/K²]
};

template <class T>
ElasticLines<T> elastic_lines(const Material& m, const T& line_temperature) {
  const auto now = properties_at(m, line_temperature, line_temperature);
  const auto slope = derivatives_at(m, line_temperature, line_temperature);
  const auto expansion = detail::line(m.expansion, line_temperature);
  return {line_temperature, now.bulk, slope.bulk, now.shear, slope.shear, expansion.value, expansion.slope};
}

/// Elastic properties of a solid (4.81) at Θ along lines, with their temperature derivatives. Lines of the
/// moduli themselves: that of Poisson's ratio may run into 1/2.
/// @param strain_offset  e^θ less 3 α (Θ − Θ_ref)
template <class T>
PointProperties<Jet<T>> elastic_along(const Material& m, const ElasticLines<T>& lines, const T& temperature,
                                      const T& strain_offset) {
  using J = Jet<T>;
  const T zero(0.0), change = temperature - lines.temperature;
  const auto along = [&](const T& value, const T& slope) {
    return J{T(value + slope * change), slope, zero};
  };
  PointProperties<J> p;
  p.bulk = along(lines.bulk, lines.bulk_slope);
  p.shear = along(lines.shear, lines.shear_slope);
  p.thermal_strain = J(T(3.0)) * along(lines.expansion, lines.expansion_slope) *
                         J{T(temperature - T(m.expansion_reference)), T(1.0), zero} +
                     J(strain_offset);
  p.solid_fraction = p.viscosity = J(T(1.0));
  return p;
}

/// The parameters by which hardening stores its energy where something has hardened, ξ > 0, at Θ along their
/// lines at Θ_n, with their temperature derivatives; all others of the flow rule are zero. Nothing where K,
/// K_ξ and ζ vanish with ξ.
template <class T>
std::optional<FlowProperties<Jet<T>>> hardening_along(const Material& m, const T& hardening,
                                                      const T& line_temperature, const T& temperature) {
  using J = Jet<T>;
  const T zero(0.0), change = temperature - line_temperature;
  if (!m.flow || !any(hardening > zero)) return {};
  const Flow& flow = *m.flow;
  const auto along = [&](const Table& table) {
    const auto line = detail::line(table, line_temperature);
    return J{T(line.value + line.slope * change), line.slope, zero};
  };
  FlowProperties<J> p;
  p.hardening_origin = along(flow.flow_stress);
  for (std::size_t i = 0; i < k_hardening_parameters; ++i) p.hardening[i] = along(flow.hardening[i]);
  if (flow.kinematic != KinematicHardening::none) p.kinematic_modulus = along(flow.kinematic_modulus);
  p.temperature = J(line_temperature);
  p.beyond = J{change, T(1.0), zero};
  return p;
}

}  // namespace solidus::material
