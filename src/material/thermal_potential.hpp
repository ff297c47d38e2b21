/// The parts of the free energy that depend on temperature alone: T(Θ) of sensible heat (monograph 2.49c) and
/// Ψ^pc(Θ) of latent heat (2.68), in closed form from the tables.
///
///   T(Θ)    = −∫_Θ0^Θ dΘ̄ ∫_Θ0^Θ̄ C_v/Θ̂ dΘ̂ = ∫_Θ0^Θ C_v dΘ̂ − Θ ∫_Θ0^Θ C_v/Θ̂ dΘ̂         (by parts)
///   Ψ^pc(Θ) the same with L_Θ = dL/dΘ in place of C_v,  L(Θ) = Σ_k ρ L_k (1 − f_k(Θ))
///
/// Symbols: C_v = ρ c volumetric heat capacity at ε^E = 0 [J/(m³ K)], L latent heat function [J/m³], f_k the
/// fraction of the phase that is stable when cold. With the solid fraction, as 2.64 prints it, cooling would
/// absorb heat; L takes the liquid fraction (errata). Validity: Θ, Θ_0 > 0.
#pragma once

#include "material/elasticity.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

/// Heat and entropy that are stored between two temperatures.
template <class T>
struct StoredHeat {
  T heat;      ///< ∫ C dΘ [J/m³]
  T entropy;   ///< ∫ C/Θ dΘ [J/(m³ K)]
  T capacity;  ///< C at the upper bound [J/(m³ K)], without the jumps of isothermal changes
  /// T(Θ) or Ψ^pc(Θ) [J/m³].
  T potential(const T& temperature) const { return heat - temperature * entropy; }
};

StoredHeat<double> sensible_between(const Material& material, double from, double to);
/// Molten at the temperature of an isothermal change, as PhaseFraction::value has it.
StoredHeat<double> latent_between(const Material& material, double from, double to);

namespace detail {

template <class Between>
StoredHeat<Lane> of_lanes(Lane from, Lane to, Between between) {
  StoredHeat<Lane> r;
  for (int i = 0; i < k_lanes; ++i) {
    const StoredHeat<double> one = between(from[i], to[i]);
    r.heat.set(i, one.heat);
    r.entropy.set(i, one.entropy);
    r.capacity.set(i, one.capacity);
  }
  return r;
}

/// From the value at core(Θ) on along the line C + slope (Θ − core(Θ)), for types that carry derivatives.
template <class T, class Core>
StoredHeat<T> continued(const StoredHeat<Core>& at, const Core& slope, const T& temperature) {
  using std::log;
  const T from(core(temperature)), beyond = temperature - from, m(slope), c(at.capacity);
  return {T(at.heat) + (c + T(0.5) * m * beyond) * beyond,
          T(at.entropy) + (c - m * from) * T(log(T(temperature / from))) + m * beyond, c + m * beyond};
}

}  // namespace detail

/// Sensible heat from Θ_0 to Θ at any number type; `from` is a constant.
template <class T>
StoredHeat<T> sensible_heat(const Material& material, const T& from, const T& to) {
  if constexpr (std::is_same_v<T, double>) {
    return sensible_between(material, from, to);
  } else if constexpr (std::is_same_v<T, Lane>) {
    return detail::of_lanes(from, to, [&](double a, double b) { return sensible_between(material, a, b); });
  } else {
    const auto at = core(to);
    using Core = std::remove_const_t<decltype(at)>;
    return detail::continued<T, Core>(sensible_heat<Core>(material, core(from), at),
                                      Core(material.density) * material.specific_heat.derivative(at), to);
  }
}

/// Latent heat from Θ_0 to Θ at any number type; `from` is a constant.
template <class T>
StoredHeat<T> latent_heat(const Material& material, const T& from, const T& to) {
  if constexpr (std::is_same_v<T, double>) {
    return latent_between(material, from, to);
  } else if constexpr (std::is_same_v<T, Lane>) {
    return detail::of_lanes(from, to, [&](double a, double b) { return latent_between(material, a, b); });
  } else {
    const auto at = core(to);
    using Core = std::remove_const_t<decltype(at)>;
    return detail::continued<T, Core>(latent_heat<Core>(material, core(from), at), Core(0.0), to);
  }
}

}  // namespace solidus::material
