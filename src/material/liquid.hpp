/// The model of the liquid of a material (laws/liquid_law.hpp): its shares at a solid fraction, and what
/// follows for the spring. The models that come with the program are called directly, the others through
/// LiquidLaw; types of automatic differentiation, which only tests have, know no others.
///
///   Ḡ = G/a with a dashpot, a G without: the modulus of the free energy, W = Ḡ dev ε^E : dev ε^E (2.49a)
#pragma once

#include <stdexcept>
#include <type_traits>

#include "material/laws/degenerated.hpp"
#include "material/laws/maxwell.hpp"
#include "material/laws/modified_shear.hpp"
#include "material/material.hpp"

namespace solidus::material {

namespace detail {
extern bool liquid_dashpot[LawList<LiquidLaw>::k_most];        ///< LiquidLaw::dashpot of each
extern bool liquid_holds_modulus[LawList<LiquidLaw>::k_most];  ///< LiquidLaw::holds_modulus of each
}  // namespace detail

inline bool has_dashpot(LiquidModel model) {
  return detail::liquid_dashpot[static_cast<std::size_t>(model)];
}
inline bool holds_modulus(LiquidModel model) {
  return detail::liquid_holds_modulus[static_cast<std::size_t>(model)];
}

template <class T>
[[gnu::always_inline]] inline LiquidShares<T> liquid_shares(const Material& material,
                                                            const T& solid_fraction) {
  const LiquidNumbers& numbers = material.liquid_numbers;
  switch (material.liquid_model) {
    case LiquidModel::maxwell:
      return Maxwell::shares(numbers, solid_fraction);
    case LiquidModel::modified_shear:
      return ModifiedShear::shares(numbers, solid_fraction);
    case LiquidModel::degenerated:
      return Degenerated::shares(numbers, solid_fraction);
  }
  if constexpr (std::is_base_of_v<LiquidOn<T>, LiquidLaw>)
    return liquid_law(material.liquid_model).shares(numbers, solid_fraction);
  else
    throw std::logic_error("a model that was added knows no such type of numbers");
}

/// Ḡ [Pa], zero where a dashpot leaves the spring no strain (f_S = 0).
/// @param shear  G [Pa]
template <class T>
T spring_modulus(const Material& material, const T& shear, const T& solid_fraction) {
  const T spring = liquid_shares(material, solid_fraction).spring;
  if (!has_dashpot(material.liquid_model)) return spring * shear;
  const auto some = spring > T(0.0);
  return select(some, T(shear / select(some, spring, T(1.0))), T(0.0));
}

/// Ḡ_Θ (Ĝ/Ḡ)²: the derivative of W at fixed elastic strain, per square of the strain that spring and dashpot
/// share. Nothing divides by the solid fraction.
/// @param shear, twice_shear, solid_fraction  G, 2Ĝ and f_S with their derivatives
template <class T>
[[gnu::always_inline]] inline Jet<T> spring_slope(const Material& material, const Jet<T>& shear,
                                                  const Jet<T>& twice_shear, const Jet<T>& solid_fraction) {
  using J = Jet<T>;
  const J a = liquid_shares<J>(material, solid_fraction).spring;
  const J shear_theta(shear.d, shear.dd, T(0.0)), a_theta(a.d, a.dd, T(0.0));
  if (!has_dashpot(material.liquid_model)) return a * shear_theta + a_theta * shear;
  const J share = twice_shear / (J(T(2.0)) * shear);  // Ĝ/G
  return (a * shear_theta - a_theta * shear) * share * share;
}

}  // namespace solidus::material
