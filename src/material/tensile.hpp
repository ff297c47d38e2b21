/// Stress-strain curve of a tensile test of the solid, from the flow data alone: for inspecting a material
/// card.
///
/// Uniaxial, monotonic, at one temperature, without the elastic part:
///   σ(ξ) = σ_0 + K_ξ(ξ) + X(ξ)          slow test; X the back stress, K ξ or K/recall (1 − exp(−recall ξ))
///   o    = [η ε̇ (3/2)^((n+1)/2) D^(n−1)]^(1/n)    overstress at the strain rate ε̇, from 2.109b with
///                                                  Φ = √(2/3) o and γ̇ = √(3/2) ε̇
#pragma once

#include "material/flow.hpp"

namespace solidus::material {

/// σ(ξ) of a slow test [Pa].
/// @param strain      ξ >= 0, equivalent plastic strain
/// @param temperature [K]
double tensile_stress(const Flow& flow, double strain, double temperature);

/// o [Pa]; zero when rate independent.
/// @param rate of the plastic strain [1/s], positive
double tensile_overstress(const Flow& flow, double rate, double temperature);

}  // namespace solidus::material
