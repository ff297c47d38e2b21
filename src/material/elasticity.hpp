/// The thermo-elastic part of the free energy at a temperature (monograph 2.49a, 2.49b, 2.76a) and the
/// numbers a law needs there.
///
/// e^θ(Θ) = 3[α(Θ)(Θ − Θ_ref) − α(Θ_0)(Θ_0 − Θ_ref)] + e^pc(Θ) − e^pc(Θ_0),  e^pc = Σ_k (ΔV/V)_k f_k(Θ).
#pragma once

#include "material/material.hpp"
#include "numbers/jet.hpp"
#include "numbers/tensor.hpp"

namespace solidus::material {

/// Properties that the constitutive update needs at one point and temperature. They are evaluated once per
/// phase and stored per quadrature point.
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

/// Solid fraction and straining of the phase changes of a material at a point.
template <class T>
struct PhaseState {
  T solid_fraction;  ///< f_S of 2.65
  T straining;       ///< e^pc − e^pc(Θ_0) of 2.75, 2.76a
};

/// Phase state if nothing but the temperatures is known: at the temperature of an isothermal change the
/// material is molten.
template <class T>
PhaseState<T> phase_state_at(const Material& material, const T& temperature, const T& initial_temperature);

/// @param initial_temperature Θ_0 of 2.51 [K]
/// @param phase               that of t_n within a step, whatever temperature the pass of a scheme works at
///                            (4.76a, 4.81)
template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature, const T& initial_temperature,
                                 const PhaseState<T>& phase);
/// Evaluates the properties with the phase state that follows from the temperatures.
template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature,
                                 const T& initial_temperature);
template <class T>
PointDerivatives<T> derivatives_at(const Material& material, const T& temperature,
                                   const T& initial_temperature);
/// 3 [α + α_Θ (Θ − Θ_ref)]: de^θ/dΘ without phase changes [1/K].
template <class T>
T expansion_slope(const Material& material, const T& temperature);
template <class T>
PointCurvatures<T> curvatures_at(const Material& material, const T& temperature);

/// The part of W + M + R that holds the volume: the square ½ k (tr ε − e^θ)² of a material whose specific
/// heat is that at constant pressure, R(Θ) = ½ k (e^θ)², so that what is free of stress stores nothing but
/// sensible heat; ½ k tr² − k e^θ tr where it is that at constant strain, R = 0 (2.49a, 2.49b). R depends on
/// the temperature alone: stresses are the same in both.
/// @param bulk, thermal_strain  k and e^θ, T a number or a Jet in temperature
/// @param trace                 tr ε
template <class T, class Trace>
[[gnu::always_inline]] inline T volumetric_energy(const Material& material, const T& bulk,
                                                  const T& thermal_strain, const Trace& trace) {
  const T tr(trace), half(0.5);
  if (material.specific_heat_at == SpecificHeatAt::constant_strain)
    return bulk * tr * (half * tr - thermal_strain);
  const T elastic = tr - thermal_strain;
  return half * bulk * elastic * elastic;
}

}  // namespace solidus::material

#include "material/elasticity_impl.hpp"
