/// A model of what is not yet solid as a plug-in (monograph 2.3.1): how a spring and a dashpot share the
/// strain of the deviator, and how much of flow and strength there is, as functions of the solid fraction
/// f_S:
///
///   with a dashpot     1/(2Ĝ) = a/(2G) + Δt λ/η      the spring G/a in series with the dashpot η/λ
///   without            2Ĝ = 2 a G                     the spring a G
///   γ̇ = m γ̇(Φ),  Φ = ‖s − w q‖ − w √⅔ (σ_0 + K_ξ)
///
/// A model is a struct like Degenerated (laws/degenerated.hpp), with all shares one where f_S = 1 but λ = 0:
///
///   struct Tough {
///     static constexpr std::string_view name = "tough", doc = "…";
///     static constexpr LawParameter parameters[] = {…};      // numbers, at most k_liquid_parameters
///     static constexpr bool dashpot = false;
///     template <class T> static LiquidShares<T> shares(const LiquidNumbers& numbers, const T&
///     solid_fraction);
///   };
///   const AddLiquid<Tough> k_tough;   // at namespace scope: the key liquid_model knows "tough"
///
/// Return mapping, entropy, energy, heat, the isentropic mapping and their derivatives follow. What a model
/// may declare besides: `holds_modulus` (G is that of the solidus where it is hotter, 2.77) and `needs_rate`
/// (a liquid is held by the rate dependence of [plasticity] alone).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "material/flow.hpp"
#include "material/laws/law_list.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

template <class T>
struct LiquidShares {
  T spring;    ///< a, of the modulus or with a dashpot of the compliance
  T fluid;     ///< λ; zero without a dashpot
  T flow;      ///< m
  T strength;  ///< w
};

/// The function of a model on one number type.
template <class T>
class LiquidOn {
 public:
  virtual LiquidShares<T> shares(const LiquidNumbers& numbers, const T& solid_fraction) const = 0;

 protected:
  ~LiquidOn() = default;
};

class LiquidLaw : public LiquidOn<double>,
                  public LiquidOn<Lane>,
                  public LiquidOn<Jet<double>>,
                  public LiquidOn<Jet<Lane>>,
                  public LiquidOn<Jet<Jet<double>>> {
 public:
  using LiquidOn<double>::shares, LiquidOn<Lane>::shares, LiquidOn<Jet<double>>::shares,
      LiquidOn<Jet<Lane>>::shares, LiquidOn<Jet<Jet<double>>>::shares;

  virtual std::string_view name() const = 0;  ///< value of the key liquid_model
  virtual std::string_view doc() const = 0;   ///< for the reference page
  virtual std::span<const LawParameter> parameters() const = 0;
  virtual bool dashpot() const = 0;
  virtual bool holds_modulus() const = 0;
  virtual bool needs_rate() const = 0;

 protected:
  ~LiquidLaw() = default;
};

namespace detail {
extern LawList<LiquidLaw> liquid_list;
}  // namespace detail

/// All models, each at the place that its LiquidModel says (LawList::all).
std::span<const LiquidLaw* const> liquid_laws();
/// @param law  lives as long as the program. Throws as LawList::add does.
LiquidModel add_liquid_law(const LiquidLaw& law);
inline const LiquidLaw& liquid_law(LiquidModel model) {
  return *detail::liquid_list.laws[static_cast<std::size_t>(model)];
}

/// A model's struct as a LiquidLaw.
template <class Law>
class LiquidLawOf final : public LiquidLaw {
 public:
  std::string_view name() const override { return Law::name; }
  std::string_view doc() const override { return Law::doc; }
  std::span<const LawParameter> parameters() const override { return detail::parameters_of<Law>(); }
  bool dashpot() const override { return Law::dashpot; }
  bool holds_modulus() const override {
    if constexpr (requires { Law::holds_modulus; })
      return Law::holds_modulus;
    else
      return false;
  }
  bool needs_rate() const override {
    if constexpr (requires { Law::needs_rate; })
      return Law::needs_rate;
    else
      return false;
  }

#define SOLIDUS_LIQUID_ON(T)                                                                     \
  LiquidShares<T> shares(const LiquidNumbers& numbers, const T& solid_fraction) const override { \
    return Law::shares(numbers, solid_fraction);                                                 \
  }
  SOLIDUS_LIQUID_ON(double)
  SOLIDUS_LIQUID_ON(Lane)
  SOLIDUS_LIQUID_ON(Jet<double>)
  SOLIDUS_LIQUID_ON(Jet<Lane>)
  SOLIDUS_LIQUID_ON(Jet<Jet<double>>)
#undef SOLIDUS_LIQUID_ON
};

/// Adds a model while the program starts, as an object at namespace scope.
template <class Law>
struct AddLiquid {
  AddLiquid() : model(add_liquid_law(k_object)) {}
  LiquidModel model;

 private:
  static inline const LiquidLawOf<Law> k_object{};
};

}  // namespace solidus::material
