/// Energy stored by hardening: the part K of the free energy and the entropy, internal energy and capacity
/// that follow from its dependence on temperature (monograph 2.49d, 2.52b, 2.55, 2.127a).
///
///   K(ξ, ζ, Θ) = K_iso(ξ, Θ) + 1/3 K(Θ) ζ:ζ
///   S = −K_Θ,  E = K − Θ K_Θ,  C = Θ ∂S/∂Θ = −Θ K_ΘΘ
///
/// Symbols: ξ equivalent plastic strain, ζ back strain, K_iso the potential of hardening.hpp [J/m³], K(Θ) the
/// kinematic modulus [Pa]. With sensible, structural and latent parts they make up S^E, E and C.
/// Validity: ξ >= 0. Tables are piecewise linear, so K_ΘΘ holds the products of their slopes only.
#pragma once

#include "material/hardening.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

template <class T>
struct HardeningState {
  T free_energy;      ///< K [J/m³]
  T entropy;          ///< −K_Θ [J/(m³ K)]
  T internal_energy;  ///< K − Θ K_Θ [J/m³]
  T capacity;         ///< −Θ K_ΘΘ [J/(m³ K)], the derivative of internal_energy with respect to Θ
};

/// K of 2.49d at any number type.
/// @param xi            ξ
/// @param zeta_squared  ζ:ζ
template <class T>
T hardening_potential(const Flow& flow, const FlowProperties<T>& p, const T& xi, const T& zeta_squared) {
  T k(0.0);
  if (flow.isotropic != IsotropicHardening::none)
    k += hardening_energy<T>(flow.isotropic, flow.curves, p, xi);
  if (flow.kinematic != KinematicHardening::none) k += T(1.0 / 3.0) * p.kinematic_modulus * zeta_squared;
  return k;
}

/// @param temperature Θ [K]
template <class T>
HardeningState<T> hardening_state(const Flow& flow, const T& xi, const T& zeta_squared,
                                  const T& temperature) {
  const T zero(0.0);
  if (flow.isotropic == IsotropicHardening::none && flow.kinematic == KinematicHardening::none)
    return {zero, zero, zero, zero};
  const auto p = flow_properties_at(flow, Jet<T>::variable(temperature));
  const Jet<T> k = hardening_potential<Jet<T>>(flow, p, xi, zeta_squared);
  return {k.v, -k.d, k.v - temperature * k.d, -temperature * k.dd};
}

}  // namespace solidus::material
