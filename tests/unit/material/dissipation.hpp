/// Thermal dissipation and entropy production of a plastic flow (monograph 2.119–2.121).
///
///   Ṡ^I = γ̇ ∂Φ/∂Θ = −γ̇ w √⅔ dσ_0/dΘ,   D_ther = Θ Ṡ^I                                   (2.119b, 2.120)
///   production = (D_mech + D_ther)/Θ >= 0
///
/// The viscous potential does not depend on temperature (2.119a). Hardening and back stress enter Φ through
/// their forces, which the principle of maximum dissipation varies on their own, so that σ_0 alone is left.
/// The strength factor w (f_S in the degenerated liquid, else 1) is held, as in 4.76: its change belongs to
/// the phase change. D_ther >= 0 asks for thermal softening, dσ_0/dΘ <= 0 (2.121), which the input checks.
///
/// Symbols: γ flow multiplier, σ_0 flow stress [Pa], Θ temperature [K].
#pragma once

#include "material/return_mapping.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::material {

/// D_ther [W/m³].
/// @param temperature      Θ [K]
/// @param flow_increment   γ over the step
/// @param strength         w
/// @param dt               the step that γ belongs to [s]
template <class T>
T thermal_dissipation(const Flow& flow, const T& temperature, const T& flow_increment, const T& strength,
                      double dt) {
  const T softening = T(0.0) - detail::line(flow.flow_stress, temperature).slope;
  return T(return_mapping::k_root_two_thirds / dt) * flow_increment * strength * softening * temperature;
}

/// Internal entropy production at the end of an update [W/(m³ K)].
/// @param p  the properties that the update had, at `temperature`
template <class T>
T entropy_production(const Viscoplastic& law, const Viscoplastic::Properties<T>& p,
                     const Viscoplastic::Response<T>& response, const T& temperature, double dt) {
  T heat = response.dissipation;
  if (law.material().flow)
    heat += thermal_dissipation(*law.material().flow, temperature, response.flow_increment,
                                law.shear(p.elastic, dt).strength, dt);
  return heat / temperature;
}

}  // namespace solidus::material
