/// Structural entropy, energy and capacity written out by hand: what the derivatives of the free energy and
/// the update are compared with.
#pragma once

#include "material/elasticity.hpp"

namespace solidus::material {

/// The part of entropy and internal energy that couples deformation and temperature, from W + M + R of 2.49:
/// S = −(W_Θ + M_Θ + R_Θ), E = W + M + R + Θ S, per unit volume. With the sensible and the latent part it
/// makes up S^E and E.
template <class T>
struct StructuralState {
  T entropy;          ///< [J/(m³ K)]
  T internal_energy;  ///< [J/m³]
};

/// 2.49a, 2.49b, 2.53, 2.54 (errata: with the full e^θ) written through the stress deviator s = 2 (G/f_S) dev
/// ε^E, so that nothing divides by f_S:
///
///   W = ½ k tr² + f_S/(4G) s:s,   M = −k e^θ tr,   R = ½ k (e^θ)² with the specific heat at constant
///   pressure W_Θ = ½ k_Θ tr² + (f_S G_Θ/G − f_S,Θ)/(4G) s:s,   M_Θ = −(k e^θ)_Θ tr        (derivatives at
///   fixed ε^E)
///
/// @param p, d              at the temperature
/// @param temperature       Θ [K]
/// @param strain_trace      tr ε^E = tr ε (inelastic strains are deviatoric)
/// @param deviator_squared  s:s [Pa²]
template <class T>
StructuralState<T> structural_state(const Material& material, const PointProperties<T>& p,
                                    const PointDerivatives<T>& d, const T& temperature, const T& strain_trace,
                                    const T& deviator_squared) {
  const T s2_over_4g = T(0.25) * deviator_squared / p.shear;
  const T w_theta = T(0.5) * d.bulk * strain_trace * strain_trace +
                    (p.solid_fraction * d.shear / p.shear - d.solid_fraction) * s2_over_4g;
  const T m_theta = -(d.bulk * p.thermal_strain + p.bulk * d.thermal_strain) * strain_trace;
  const T w = T(0.5) * p.bulk * strain_trace * strain_trace + p.solid_fraction * s2_over_4g;
  const T m = -p.bulk * p.thermal_strain * strain_trace;
  const bool squared = material.specific_heat_at == SpecificHeatAt::constant_pressure;
  const T &e = p.thermal_strain, &e_theta = d.thermal_strain, zero(0.0);
  const T r = squared ? T(T(0.5) * p.bulk * e * e) : zero;
  const T r_theta = squared ? T(T(0.5) * d.bulk * e * e + p.bulk * e * e_theta) : zero;
  StructuralState<T> state;
  state.entropy = -(w_theta + m_theta + r_theta);
  state.internal_energy = w + m + r + temperature * state.entropy;
  return state;
}

/// Θ ∂S/∂Θ = −Θ (W_ΘΘ + M_ΘΘ + R_ΘΘ) at fixed elastic strain [J/(m³ K)], the difference of the capacity to
/// C_v in 2.127a; it is ∂E/∂Θ too. Arguments as of structural_state.
///
/// In the mushy zone it holds −Θ f_S,Θ² s:s/(2 G f_S), which is unbounded for f_S → 0 (melting a spring of
/// stiffness G/f_S that is kept strained): a Newton iteration that crosses the zone freezes the solid
/// fraction, d.solid_fraction = 0.
template <class T>
T structural_capacity(const Material& material, const PointProperties<T>& p, const PointDerivatives<T>& d,
                      const PointCurvatures<T>& c, const T& temperature, const T& strain_trace,
                      const T& deviator_squared) {
  const T tiny(1e-300);  // where f_S = 0 the elastic deviator is zero, and so is its energy
  const T mushy =
      select(p.solid_fraction > tiny,
             d.solid_fraction * d.solid_fraction / select(p.solid_fraction > tiny, p.solid_fraction, T(1.0)),
             T(0.0));
  const T w = T(0.5) * c.bulk * strain_trace * strain_trace +
              (p.solid_fraction * c.shear - T(2.0) * d.shear * d.solid_fraction + T(2.0) * p.shear * mushy) *
                  T(0.25) * deviator_squared / (p.shear * p.shear);
  const T m = -(c.bulk * p.thermal_strain + T(2.0) * d.bulk * d.thermal_strain + p.bulk * c.thermal_strain) *
              strain_trace;
  const T& e = p.thermal_strain;
  const T r = material.specific_heat_at == SpecificHeatAt::constant_pressure
                  ? T(T(0.5) * c.bulk * e * e + T(2.0) * d.bulk * e * d.thermal_strain +
                      p.bulk * (d.thermal_strain * d.thermal_strain + e * c.thermal_strain))
                  : T(0.0);
  return -temperature * (w + m + r);
}

}  // namespace solidus::material
