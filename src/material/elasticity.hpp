/// The thermo-elastic part of the free energy at a temperature (monograph 2.49a, 2.49b, 2.76a) and the numbers a law needs there.
///
/// e^θ(Θ) = 3[α(Θ)(Θ − Θ_ref) − α(Θ_0)(Θ_0 − Θ_ref)] + e^pc(Θ) − e^pc(Θ_0),  e^pc = Σ_k (ΔV/V)_k f_k(Θ).
#pragma once

#include "base/tensor.hpp"
#include "material/material.hpp"

namespace solidus::material {

/// What the constitutive update needs at one point and temperature. Evaluated once per phase, kept per quadrature point.
template <class T>
struct PointProperties {
  T bulk;             ///< k [Pa]
  T shear;            ///< G [Pa] (the full modulus; 2.50 enters through the compliance)
  T thermal_strain;   ///< e^θ, volumetric
  T solid_fraction;   ///< f_S
  T viscosity;        ///< η of s = η ε̇ [Pa s]
};

/// Temperature derivatives for entropy and structural heating (2.53, 2.54, 2.127b).
template <class T>
struct PointDerivatives {
  T bulk, shear, thermal_strain;  ///< dk/dΘ, dG/dΘ, de^θ/dΘ (straining of phase changes included)
};

/// @param initial_temperature Θ_0 of 2.51 [K]
template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature, const T& initial_temperature);
template <class T>
PointDerivatives<T> derivatives_at(const Material& material, const T& temperature, const T& initial_temperature);

extern template PointProperties<double> properties_at(const Material&, const double&, const double&);
extern template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&);
extern template PointDerivatives<double> derivatives_at(const Material&, const double&, const double&);
extern template PointDerivatives<Lane> derivatives_at(const Material&, const Lane&, const Lane&);

/// The part of entropy, internal energy and stress that couples deformation and temperature, from W + M of 2.49:
/// S = −(W_Θ + M_Θ), E = W + M + Θ S [per m³], with the elastic strain ε^E = ε − ε^v (− ε^vp) and the deviatoric modulus Ĝ of
/// the caller's choice (G/f_S of 2.50 enters W only where f_S > 0; the law reports the deviatoric energy itself).
template <class T>
struct StructuralState {
  T entropy;          ///< [J/(m³ K)]
  T internal_energy;  ///< [J/m³]
};

}  // namespace solidus::material
