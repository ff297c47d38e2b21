/// The structural entropy S = −(W_Θ + M_Θ + K_Θ) and energy E = W + M + K + Θ S as functions of their
/// variables, with their partial derivatives: the tangent of the heat balance (monograph 2.52b, 2.55).
///
///   S = −½ k_Θ tr² + (k e^θ)_Θ tr − R_Θ − G_Θ a:a − K_Θ(ξ, Θ) − ⅓ K_Θ ζ:ζ
///   E = ½ k tr² − k e^θ tr + R + G a:a + K(ξ, Θ) + ⅓ K ζ:ζ + Θ S,   E_Θ = Θ S_Θ
///
/// Symbols: R = ½ k (e^θ)² with the specific heat at constant pressure, else 0 (volumetric_energy); tr = tr
/// ε, a = dev ε^E of a solid (elsewhere its energy is left out), k, G moduli [Pa], e^θ thermal strain, ξ
/// equivalent plastic strain, ζ back strain, K(ξ, Θ) the potential of hardening, alone the kinematic modulus.
/// Solid fraction and straining of phase changes are held (4.81), so f_S = 1 wherever a counts.
#pragma once

#include "material/derivatives/thermal_derivatives.hpp"
#include "material/hardening.hpp"

namespace solidus::material {

template <class T>
struct StructuralPartials {
  StatePartials<T> entropy, internal_energy;
};

/// @param elastic     elastic_along, or those of thermal_properties with the phase frozen
/// @param parameters  of the flow rule: hardening_along, or those of thermal_properties; null where nothing
///                    has hardened
/// @param solid       where a:a counts
template <class T, class Mask>
StructuralPartials<T> structural_partials(const Material& material, const PointProperties<Jet<T>>& elastic,
                                          const FlowProperties<Jet<T>>* parameters, const T& temperature,
                                          const T& trace, const T& elastic_squared, const Mask& solid,
                                          const T& hardening, const T& back_squared) {
  using J = Jet<T>;
  const T zero(0.0);
  const J &k = elastic.bulk, &g = elastic.shear;
  const J pull = k * elastic.thermal_strain;
  const J volumetric = volumetric_energy(material, k, elastic.thermal_strain, trace);
  const T squared = select(solid, elastic_squared, zero);

  StructuralPartials<T> r;
  StatePartials<T>&s = r.entropy, &e = r.internal_energy;
  s.value = zero - volumetric.d - g.d * squared;
  s.temperature = zero - volumetric.dd - g.dd * squared;
  s.strain_trace = pull.d - k.d * trace;
  s.elastic_squared = select(solid, T(zero - g.d), zero);
  s.hardening = s.back_squared = zero;
  e.value = volumetric.v + g.v * squared;
  e.strain_trace = k.v * trace - pull.v;
  e.elastic_squared = select(solid, g.v, zero);
  e.hardening = e.back_squared = zero;
  if (parameters != nullptr) {  // K, K_ξ and ζ vanish with ξ
    const Flow& flow = *material.flow;
    if (flow.isotropic != IsotropicHardening::none) {
      const J stored = hardening_energy<J>(flow.isotropic, flow.curves, *parameters, J(hardening));
      const J stress = hardening_stress<J>(flow.isotropic, flow.curves, *parameters, J(hardening)).stress;
      s.value -= stored.d;
      s.temperature -= stored.dd;
      s.hardening = zero - stress.d;
      e.value += stored.v;
      e.hardening = stress.v;
    }
    if (flow.kinematic != KinematicHardening::none) {
      const J third = J(T(1.0 / 3.0)) * parameters->kinematic_modulus;
      s.value -= third.d * back_squared;
      s.temperature -= third.dd * back_squared;
      s.back_squared = zero - third.d;
      e.value += third.v * back_squared;
      e.back_squared = third.v;
    }
  }
  e.value += temperature * s.value;
  e.temperature = temperature * s.temperature;
  e.strain_trace += temperature * s.strain_trace;
  e.elastic_squared += temperature * s.elastic_squared;
  e.hardening += temperature * s.hardening;
  e.back_squared += temperature * s.back_squared;
  return r;
}

}  // namespace solidus::material
