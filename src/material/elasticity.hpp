/// The thermo-elastic part of the free energy at a temperature (monograph 2.49a, 2.49b, 2.76a) and the
/// numbers a law needs there.
///
/// e^θ(Θ) = 3[α(Θ)(Θ − Θ_ref) − α(Θ_0)(Θ_0 − Θ_ref)] + e^pc(Θ) − e^pc(Θ_0),  e^pc = Σ_k (ΔV/V)_k f_k(Θ).
#pragma once

#include "base/jet.hpp"
#include "base/tensor.hpp"
#include "material/material.hpp"

namespace solidus::material {

/// What the constitutive update needs at one point and temperature. Evaluated once per phase, kept per
/// quadrature point.
template <class T>
struct PointProperties {
  T bulk;            ///< k [Pa]
  T shear;           ///< G [Pa] (the full modulus; 2.50 enters through the compliance)
  T thermal_strain;  ///< e^θ, volumetric
  T solid_fraction;  ///< f_S
  T viscosity;  ///< η of s = η ε̇ [Pa s]; not a number where Material::chooses_viscosity(), until set
};

/// Temperature derivatives for entropy and structural heating (2.53, 2.54, 2.127b), per kelvin.
template <class T>
struct PointDerivatives {
  T bulk, shear, thermal_strain;  ///< dk/dΘ, dG/dΘ, de^θ/dΘ (straining of phase changes included)
  T solid_fraction;  ///< df_S/dΘ; a caller that freezes the solid fraction (4.81) sets it to zero
};

/// Second temperature derivatives for the capacity (2.127a). Tables are piecewise linear, so only products
/// remain.
template <class T>
struct PointCurvatures {
  T bulk, shear, thermal_strain;  ///< d²k/dΘ², d²G/dΘ², d²e^θ/dΘ² = 6 α_Θ
};

/// How far the phase changes of a material have come, as stress and strain see it.
template <class T>
struct PhaseState {
  T solid_fraction;  ///< f_S of 2.65
  T straining;       ///< e^pc − e^pc(Θ_0) of 2.75, 2.76a
};

/// Where nothing but the temperatures is known: an isothermal change is molten at its own.
template <class T>
PhaseState<T> phase_state_at(const Material& material, const T& temperature, const T& initial_temperature);

/// @param initial_temperature Θ_0 of 2.51 [K]
/// @param phase               that of t_n within a step, whatever temperature the pass of a scheme works at
///                            (4.76a, 4.81)
template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature, const T& initial_temperature,
                                 const PhaseState<T>& phase);
/// With the phases that the temperatures tell.
template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature,
                                 const T& initial_temperature);
template <class T>
PointDerivatives<T> derivatives_at(const Material& material, const T& temperature,
                                   const T& initial_temperature);
template <class T>
PointCurvatures<T> curvatures_at(const Material& material, const T& temperature);

/// The part of entropy and internal energy that couples deformation and temperature, from W + M of 2.49:
/// S = −(W_Θ + M_Θ), E = W + M + Θ S, per unit volume. With the sensible and the latent part it makes up S^E
/// and E.
template <class T>
struct StructuralState {
  T entropy;          ///< [J/(m³ K)]
  T internal_energy;  ///< [J/m³]
};

/// 2.49a, 2.49b, 2.53, 2.54 (errata: with the full e^θ) written through the stress deviator s = 2 (G/f_S) dev
/// ε^E, so that nothing divides by f_S:
///
///   W = ½ k tr² + f_S/(4G) s:s,   M = −k e^θ tr
///   W_Θ = ½ k_Θ tr² + (f_S G_Θ/G − f_S,Θ)/(4G) s:s,   M_Θ = −(k e^θ)_Θ tr        (derivatives at fixed ε^E)
///
/// @param p, d              at the temperature
/// @param temperature       Θ [K]
/// @param strain_trace      tr ε^E = tr ε (inelastic strains are deviatoric)
/// @param deviator_squared  s:s [Pa²]
template <class T>
StructuralState<T> structural_state(const PointProperties<T>& p, const PointDerivatives<T>& d,
                                    const T& temperature, const T& strain_trace, const T& deviator_squared) {
  const T s2_over_4g = T(0.25) * deviator_squared / p.shear;
  const T w_theta = T(0.5) * d.bulk * strain_trace * strain_trace +
                    (p.solid_fraction * d.shear / p.shear - d.solid_fraction) * s2_over_4g;
  const T m_theta = -(d.bulk * p.thermal_strain + p.bulk * d.thermal_strain) * strain_trace;
  const T w = T(0.5) * p.bulk * strain_trace * strain_trace + p.solid_fraction * s2_over_4g;
  const T m = -p.bulk * p.thermal_strain * strain_trace;
  StructuralState<T> r;
  r.entropy = -(w_theta + m_theta);
  r.internal_energy = w + m + temperature * r.entropy;
  return r;
}

/// Θ ∂S/∂Θ = −Θ (W_ΘΘ + M_ΘΘ) at fixed elastic strain [J/(m³ K)], the difference of the capacity to C_v
/// in 2.127a; it is ∂E/∂Θ too. Arguments as of structural_state.
///
/// In the mushy zone it holds −Θ f_S,Θ² s:s/(2 G f_S), which is unbounded for f_S → 0 (melting a spring of
/// stiffness G/f_S that is kept strained): a Newton iteration that crosses the zone freezes the solid
/// fraction, d.solid_fraction = 0.
template <class T>
T structural_capacity(const PointProperties<T>& p, const PointDerivatives<T>& d, const PointCurvatures<T>& c,
                      const T& temperature, const T& strain_trace, const T& deviator_squared) {
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
  return -temperature * (w + m);
}

}  // namespace solidus::material

#include "material/elasticity_impl.hpp"
