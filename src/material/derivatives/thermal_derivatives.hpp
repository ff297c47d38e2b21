/// Derivatives of the constitutive update with respect to temperature and strain, the flow multiplier γ
/// eliminated (monograph 2.127, 4.97–4.99), for the thermal phase, the simultaneous scheme and the isentropic
/// mapping.
///
///   γ(Θ, ε) solves Φ(γ, Θ, ε) = x(γ, Θ):  γ_Θ = D⁻¹ (Φ_Θ − x_Θ),  γ_ε = D⁻¹ Φ_ε,  D = x_γ − Φ_γ
///   a = ê − γ n,  s = 2Ĝ a,  n = β̂/‖β̂‖:  a_Θ = −γ_Θ n − γ n_Θ,  n_Θ = (I − n⊗n) β̂_Θ/‖β̂‖
///   S = −½ k_Θ tr² + (k e^θ)_Θ tr − R_Θ − Q a:a − K_Θ(ξ) − ⅓ K_Θ ζ:ζ                            (2.52b)
///   D_mech = [2Ĝ v a:a + γ (x + w √⅔ σ_0 + ⅔ K b ζ:ζ)]/Δt                               (2.114–2.117)
/// or, with a Taylor–Quinney factor β, [2Ĝ v a:a + β ⟨P⟩]/Δt, P = γ (x + …) + Δ(K + ⅓ K ζ:ζ).
///
/// Q = W_Θ/(a:a) at fixed elastic strain: maxwell (f_S G_Θ − f_S,Θ G) (Ĝ/G)², otherwise Ḡ_Θ; nothing divides
/// by f_S. With a Maxwell element whose solid fraction and viscosity are frozen it is Ĝ_Θ. v is the viscous
/// share, x the overstress; the other symbols are those of viscoplastic.hpp and return_mapping.hpp.
///
/// S is S^E without its sensible part ∫C_v/Θ dΘ. Derivatives are those of the branch of the response: at the
/// yield surface of the side that it took, at a point of a table of the piece on its right.
#pragma once

#include "material/viscoplastic.hpp"

namespace solidus::material {

/// Properties that are frozen while the temperature varies: all of them in the mechanical phase of the
/// isentropic split (docs/decisions/0006), none in the simultaneous scheme.
struct Frozen {
  bool phase = false;        ///< f_S, the straining e^pc, and with f_S the strength factor (4.76, 4.81)
  bool flow_stress = false;  ///< σ_0 of the yield radius (4.85)
  bool viscosity = false;    ///< η_l, and the parameters of rate dependence
  bool recall = false;       ///< those of the recall of back strain
  static constexpr Frozen dissipation() { return {true, true, true, true}; }
};

/// The properties with their temperature derivatives, those of frozen ones zero.
/// @param temperature, initial_temperature Θ, Θ_0 [K]
template <class T>
Viscoplastic::Properties<Jet<T>> thermal_properties(const Viscoplastic& law, const T& temperature,
                                                    const T& initial_temperature, Frozen frozen);

/// A scalar's derivatives along the update.
template <class T>
struct Derivatives {
  T value{};
  T temperature{};  ///< d/dΘ at fixed strain
  Sym<T> strain;    ///< d/dε: the change is strain : dε
};

/// A function of the state and its partial derivatives: f(Θ, tr ε, a:a, ξ, ζ:ζ).
template <class T>
struct StatePartials {
  T value{};
  T temperature{}, strain_trace{}, elastic_squared{}, hardening{}, back_squared{};
};

template <class T>
struct ThermalDerivatives {
  Sym<T> stress;                  ///< dσ/dΘ at fixed strain [Pa/K]
  Derivatives<T> entropy;         ///< S [J/(m³ K)]
  Derivatives<T> dissipation;     ///< D_mech [W/m³]
  Derivatives<T> flow_increment;  ///< γ
};

/// @param p         thermal_properties, at the temperature of the update
/// @param start, strain, step  arguments of the update
/// @param response  what it returned
template <class T>
ThermalDerivatives<T> thermal_derivatives(const Viscoplastic& law, const Viscoplastic::Properties<Jet<T>>& p,
                                          const Viscoplastic::State<T>& start, const Sym<T>& strain,
                                          const TimeStep& step, const Viscoplastic::Response<T>& response);

}  // namespace solidus::material
