/// The free energy from melt to solid and everything that is a derivative of it (monograph 2.40–2.60,
/// 2.67–2.70, 2.125–2.129; errata).
///
///   Ψ(ε^E, ξ, ζ, Θ) = W + M + T + K + Ψ^pc                                              (2.48, 2.67)
///   W = ½ k tr² ε^E + Ḡ dev ε^E : dev ε^E                                               (2.49a)
///   M = −k e^θ tr ε^E + R(Θ)                                                            (2.49b)
///   T, Ψ^pc: thermal_potential.hpp (2.49c, 2.68);  K: hardening_heat.hpp                (2.49d)
///
///   σ = ∂Ψ/∂ε^E,  q = −∂Ψ/∂ξ,  q = −∂Ψ/∂ζ                                               (2.45a, 2.59)
///   S^E = −∂(Ψ − Ψ^pc)/∂Θ,  S^pc = −∂Ψ^pc/∂Θ                                            (2.52b, 2.70b)
///   E = Ψ − Ψ^pc + Θ S^E                                                                (2.40)
///   C = Θ ∂S^E/∂Θ = C_v − Θ (W_ΘΘ + M_ΘΘ + K_ΘΘ)                                        (2.127a)
///   H^ep = Θ (∂S^E/∂ε^E : ε̇^E + ∂S^E/∂ξ ξ̇ + ∂S^E/∂ζ : ζ̇)                                 (2.127b)
///
/// Every parameter follows the temperature. The spring Ḡ is that of the liquid model (liquid.hpp): maxwell
/// G/f_S (2.50), modified_shear f_S G(Θ_S) (2.77), degenerated G. 2.127b omits the back strain; the chain
/// rule of 2.125 has it. R = ½ k (e^θ)² where the specific heat is that at constant pressure
/// (volumetric_energy), else 0 as printed: then C_v is the capacity at ε^E = 0, and C = C_v holds only
/// without strain and hardening.
///
/// Symbols: k bulk modulus, Ḡ spring [Pa], e^θ thermal strain with the straining of phase changes (2.76a), ξ
/// equivalent plastic strain, ζ back strain, Θ temperature, Θ_0 initial temperature [K].
/// Validity: infinitesimal strain, Θ > 0; a Maxwell liquid (f_S = 0) has no elastic deviator.
#pragma once

#include "material/hardening_heat.hpp"
#include "material/liquid.hpp"
#include "material/thermal_potential.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::material {

/// The state variables besides temperature.
template <class T>
struct StateVariables {
  Sym<T> elastic_strain;  ///< ε^E = ε − ε^v − ε^vp
  T hardening{};          ///< ξ
  Sym<T> back_strain;     ///< ζ
};

/// Ψ by its parts [J/m³].
template <class T>
struct FreeEnergy {
  T elastic, coupling, thermal, hardening, latent;  ///< W, M, T, K, Ψ^pc
  T without_latent() const { return elastic + coupling + thermal + hardening; }
  T total() const { return without_latent() + latent; }
};

/// @param T double, Lane, Jet in temperature, or a type of automatic differentiation
template <class T>
FreeEnergy<T> free_energy(const Viscoplastic& law, const StateVariables<T>& state, const T& temperature,
                          const T& initial_temperature) {
  const Material& material = law.material();
  const auto p = law.properties_at(temperature, initial_temperature);
  const T tr = trace(state.elastic_strain);
  const Sym<T> deviator = dev(state.elastic_strain);
  FreeEnergy<T> r;
  r.elastic =
      T(0.5) * p.elastic.bulk * tr * tr +
      spring_modulus(material, p.elastic.shear, p.elastic.solid_fraction) * dot(deviator, deviator);  // 2.49a
  r.coupling = volumetric_energy(material, p.elastic.bulk, p.elastic.thermal_strain, tr) -
               T(0.5) * p.elastic.bulk * tr * tr;  // 2.49b
  r.thermal = sensible_heat(material, initial_temperature, temperature).potential(temperature);
  r.latent = latent_heat(material, initial_temperature, temperature).potential(temperature);
  r.hardening = material.flow ? hardening_potential(*material.flow, p.flow, state.hardening,
                                                    dot(state.back_strain, state.back_strain))
                              : T(0.0);
  return r;
}

/// Thermodynamic forces that drive the evolution of the internal variables (2.45a, 2.47, 2.59).
template <class T>
struct Forces {
  Sym<T> stress;       ///< σ [Pa]
  T hardening;         ///< q = −K_ξ [Pa]
  Sym<T> back_stress;  ///< q = −⅔ K ζ [Pa]
};

/// Forces and their derivatives with respect to temperature at fixed state variables.
template <class T>
struct ForcesInTemperature {
  Forces<T> value, slope;
};
template <class T>
ForcesInTemperature<T> forces(const Viscoplastic& law, const StateVariables<T>& state, const T& temperature,
                              const T& initial_temperature) {
  using J = Jet<T>;
  const Material& material = law.material();
  const auto p = law.properties_at(J::variable(temperature), J(initial_temperature));
  const J pressure = p.elastic.bulk * (J(trace(state.elastic_strain)) - p.elastic.thermal_strain);  // 2.57b
  const J stiff = J(2.0) * spring_modulus(material, p.elastic.shear, p.elastic.solid_fraction);
  const Sym<T> deviator = dev(state.elastic_strain);
  ForcesInTemperature<T> r;
  r.value.stress = stiff.v * deviator;
  r.slope.stress = stiff.d * deviator;
  for (int i = 0; i < 3; ++i) {
    r.value.stress[i] += pressure.v;
    r.slope.stress[i] += pressure.d;
  }
  r.value.hardening = r.slope.hardening = T(0.0);
  if (!material.flow) return r;
  const Flow& flow = *material.flow;
  const J k = hardening_stress<J>(flow.isotropic, flow.curves, p.flow, J(state.hardening)).stress;
  r.value.hardening = -k.v;
  r.slope.hardening = -k.d;
  if (flow.kinematic != KinematicHardening::none) {
    r.value.back_stress = T(T(-2.0 / 3.0) * p.flow.kinematic_modulus.v) * state.back_strain;
    r.slope.back_stress = T(T(-2.0 / 3.0) * p.flow.kinematic_modulus.d) * state.back_strain;
  }
  return r;
}

/// Entropy, energy and capacity of a state.
template <class T>
struct ThermodynamicState {
  T entropy;          ///< S^E, zero at ε^E = 0, ξ = 0, ζ = 0, Θ_0 [J/(m³ K)]
  T internal_energy;  ///< E, without latent heat [J/m³]
  T capacity;         ///< C of 2.127a [J/(m³ K)]
  T latent_entropy;   ///< S^pc [J/(m³ K)]
  T latent_capacity;  ///< dL/dΘ of 2.129 [J/(m³ K)]
};
template <class T>
ThermodynamicState<T> thermal_state(const Viscoplastic& law, const StateVariables<T>& state,
                                    const T& temperature, const T& initial_temperature) {
  using J = Jet<T>;
  StateVariables<J> held;
  for (int i = 0; i < 6; ++i) {
    held.elastic_strain[i] = state.elastic_strain[i];
    held.back_strain[i] = state.back_strain[i];
  }
  held.hardening = state.hardening;
  const FreeEnergy<J> psi = free_energy<J>(law, held, J::variable(temperature), initial_temperature);
  const J without = psi.without_latent();
  return {-without.d, without.v - temperature * without.d, -temperature * without.dd, -psi.latent.d,
          -temperature * psi.latent.dd};
}

/// The coefficients of H^ep = strain : ε̇^E + hardening ξ̇ + back_strain : ζ̇ (2.127b) [Pa].
template <class T>
struct StructuralHeating {
  Sym<T> strain;       ///< −Θ ∂σ/∂Θ
  T hardening;         ///< Θ ∂q/∂Θ
  Sym<T> back_strain;  ///< Θ ∂q/∂Θ
};
template <class T>
StructuralHeating<T> structural_heating(const Viscoplastic& law, const StateVariables<T>& state,
                                        const T& temperature, const T& initial_temperature) {
  const Forces<T> slope = forces(law, state, temperature, initial_temperature).slope;
  return {T(-temperature) * slope.stress, temperature * slope.hardening, temperature * slope.back_stress};
}

}  // namespace solidus::material
