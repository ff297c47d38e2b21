/// A law of rate dependence as a plug-in: the overstress Φ beyond the yield surface that a rate of flow
/// needs,
///
///   Φ = x(γ̇/m, Θ),  x(0) = 0, x rises                                                      (2.109a)
///
/// with m the share of the flow of the liquid model (f_S of a Maxwell element). A law is a struct:
///
///   struct Sinh {
///     static constexpr std::string_view name = "sinh", equation = "…";
///     static constexpr LawParameter parameters[] = {…};     // at most k_rate_parameters
///     template <class T> static Overstress<T> overstress(const FlowProperties<T>& p, const T& rate);
///   };
///   const AddRate<Sinh> k_sinh;   // at namespace scope: the key rate_dependence knows "sinh"
///
/// p.rate[i] is parameter i at the temperature; within a step of the isentropic mapping it is held, since the
/// viscous potential does not depend on temperature (2.119a). x' may be infinite at a rate of zero, where the
/// law is not asked. The return mapping solves Φ(γ) = x(γ/(m Δt)) for any such law (return_mapping.hpp);
/// Perzyna (laws/perzyna.hpp) has solvers of its own. What a law may declare besides: `complete` (what is
/// wrong with its tables together, or what stands for one that is left out) and `reads` (whether it reads a
/// parameter).
///
/// Symbols: Φ, x [Pa], γ̇ = ‖ε̇^vp‖ [1/s].
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "material/flow_properties.hpp"
#include "material/laws/law_list.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

struct Material;

/// x [Pa] and its derivative with respect to the rate [Pa s].
template <class T>
struct Overstress {
  T stress, slope;
};

using RateTables = std::array<Table, k_rate_parameters>;
using GivenRates = std::array<bool, k_rate_parameters>;  ///< which of them the material file gives

/// The objection of `complete`, if any.
struct RateCompletion {
  std::optional<std::size_t> left_out;  ///< a parameter that was filled in, with `text` as its source
  std::optional<std::size_t> blamed;    ///< a parameter that is wrong, or missing
  std::string text, allowed;            ///< for InputError
};

/// The function of a law on one number type.
template <class T>
class RateOn {
 public:
  virtual Overstress<T> overstress(const FlowProperties<T>& p, const T& rate) const = 0;

 protected:
  ~RateOn() = default;
};

class RateLaw : public RateOn<double>,
                public RateOn<Lane>,
                public RateOn<Jet<double>>,
                public RateOn<Jet<Lane>>,
                public RateOn<Jet<Jet<double>>> {
 public:
  using RateOn<double>::overstress, RateOn<Lane>::overstress, RateOn<Jet<double>>::overstress,
      RateOn<Jet<Lane>>::overstress, RateOn<Jet<Jet<double>>>::overstress;

  virtual std::string_view name() const = 0;      ///< value of the key rate_dependence
  virtual std::string_view equation() const = 0;  ///< of the flow, for the reference page
  virtual std::span<const LawParameter> parameters() const = 0;
  virtual bool reads(std::size_t parameter, const RateTables& tables) const = 0;
  virtual RateCompletion complete(RateTables& tables, const GivenRates& given,
                                  const Material& material) const = 0;

 protected:
  ~RateLaw() = default;
};

namespace detail {
extern LawList<RateLaw> rate_list;
}  // namespace detail

/// All laws, each at the place that its RateDependence says (LawList::all).
std::span<const RateLaw* const> rate_laws();
/// @param law  lives as long as the program. Throws as LawList::add does.
RateDependence add_rate_law(const RateLaw& law);
inline const RateLaw& rate_law(RateDependence kind) {
  return *detail::rate_list.laws[static_cast<std::size_t>(kind)];
}

/// A law's struct as a RateLaw.
template <class Law>
class RateLawOf final : public RateLaw {
 public:
  std::string_view name() const override { return Law::name; }
  std::string_view equation() const override { return Law::equation; }
  std::span<const LawParameter> parameters() const override { return detail::parameters_of<Law>(); }
  bool reads(std::size_t parameter, const RateTables& tables) const override {
    if constexpr (requires { Law::reads(parameter, tables); })
      return Law::reads(parameter, tables);
    else
      return true;
  }
  RateCompletion complete(RateTables& tables, const GivenRates& given,
                          const Material& material) const override {
    if constexpr (requires { Law::complete(tables, given, material); })
      return Law::complete(tables, given, material);
    else
      return {};
  }

#define SOLIDUS_RATE_ON(T)                                                             \
  Overstress<T> overstress(const FlowProperties<T>& p, const T& rate) const override { \
    return Law::overstress(p, rate);                                                   \
  }
  SOLIDUS_RATE_ON(double)
  SOLIDUS_RATE_ON(Lane)
  SOLIDUS_RATE_ON(Jet<double>)
  SOLIDUS_RATE_ON(Jet<Lane>)
  SOLIDUS_RATE_ON(Jet<Jet<double>>)
#undef SOLIDUS_RATE_ON
};

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddRate {
  AddRate() : kind(add_rate_law(k_object)) {}
  RateDependence kind;

 private:
  static inline const RateLawOf<Law> k_object{};
};

}  // namespace solidus::material
