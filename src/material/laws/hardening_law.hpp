/// A law of isotropic hardening as a plug-in. A law is a struct like Voce (laws/voce.hpp): its parameters,
/// and K_ξ and K as templates on the number type; HardeningLawOf makes of it what the return mapping, the
/// entropy, the isentropic mapping, the keys and the reference page ask for.
///
///   struct Ludwik {
///     static constexpr std::string_view name = "ludwik", equation = "…";
///     static constexpr LawParameter parameters[] = {…};   // at most k_hardening_parameters
///     template <class T> static HardeningStress<T> stress(const FlowProperties<T>& p, const T& xi);   // K_ξ
///     and K_ξξ template <class T> static T energy(const FlowProperties<T>& p, const T& xi); // K, zero at ξ
///     = 0
///   };
///   const AddHardening<Ludwik> k_ludwik;   // at namespace scope: the key isotropic_hardening knows "ludwik"
///
/// p.hardening[i] is parameter i at the temperature, p.hardening_origin is σ_0. A law has to harden, K_ξξ >=
/// 0 for ξ >= 0, with K_ξ(0) = 0. What it may declare besides: `kinks` (its slope jumps in ξ), `saturation`
/// (the plastic strain at which a plot may end) and `objection` (what is wrong with its tables together).
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "material/flow_properties.hpp"
#include "material/laws/law_list.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

template <class T>
struct HardeningStress {
  T stress, slope;   ///< K_ξ and K_ξξ [Pa]
  T cancelled{0.0};  ///< a term far above K_ξ that cancels in it, for what rounding leaves [Pa]
};

/// The terms that hardening adds to the entropy, from K(ξ, Θ) at fixed ξ, every table a line over
/// temperature.
template <class T>
struct HardeningSlopes {
  T entropy, entropy_theta;       ///< −K_Θ, −K_ΘΘ
  T stress, stress_theta, slope;  ///< K_ξ, K_ξΘ, K_ξξ
};

using HardeningTables = std::array<Table, k_hardening_parameters>;

/// The reason why the tables of a law do not fit together.
struct LawObjection {
  std::size_t parameter;       ///< the one to blame
  std::string found, allowed;  ///< for InputError
};

/// The functions of a law on one number type.
template <class T>
class HardeningOn {
 public:
  virtual HardeningStress<T> stress(const FlowCurves& curves, const FlowProperties<T>& p,
                                    const T& xi) const = 0;
  virtual T energy(const FlowCurves& curves, const FlowProperties<T>& p, const T& xi) const = 0;

 protected:
  ~HardeningOn() = default;
};

/// The same along lines over temperature.
template <class T>
class HardeningAlong {
 public:
  /// @param values, slopes    the numbers at line_temperature Θ_n and their derivatives
  /// @param temperature, xi   Θ [K], ξ; by value: a caller would otherwise keep them in memory
  virtual HardeningSlopes<T> slopes(const FlowCurves& curves, const FlowProperties<T>& values,
                                    const FlowProperties<T>& slopes, T line_temperature, T temperature,
                                    T xi) const = 0;

 protected:
  ~HardeningAlong() = default;
};

class HardeningLaw : public HardeningOn<double>,
                     public HardeningOn<Lane>,
                     public HardeningOn<Jet<double>>,
                     public HardeningOn<Jet<Lane>>,
                     public HardeningOn<Jet<Jet<double>>>,
                     public HardeningAlong<double>,
                     public HardeningAlong<Lane>,
                     public HardeningAlong<Jet<double>> {
 public:
  using HardeningOn<double>::stress, HardeningOn<Lane>::stress, HardeningOn<Jet<double>>::stress,
      HardeningOn<Jet<Lane>>::stress, HardeningOn<Jet<Jet<double>>>::stress;
  using HardeningOn<double>::energy, HardeningOn<Lane>::energy, HardeningOn<Jet<double>>::energy,
      HardeningOn<Jet<Lane>>::energy, HardeningOn<Jet<Jet<double>>>::energy;
  using HardeningAlong<double>::slopes, HardeningAlong<Lane>::slopes, HardeningAlong<Jet<double>>::slopes;

  virtual std::string_view name() const = 0;      ///< value of the key isotropic_hardening
  virtual std::string_view equation() const = 0;  ///< of σ_y, for the reference page
  virtual std::span<const LawParameter> parameters() const = 0;
  virtual bool kinks() const = 0;  ///< K_ξξ jumps at some ξ
  /// The equivalent plastic strain beyond which a curve has nothing new to show, infinite if there is none.
  virtual double saturation(const HardeningTables& tables) const = 0;
  virtual std::optional<LawObjection> objection(const Table& flow_stress,
                                                const HardeningTables& tables) const = 0;

 protected:
  ~HardeningLaw() = default;
};

/// All laws, built in and added, each at the place that its IsotropicHardening says (LawList::all).
std::span<const HardeningLaw* const> hardening_laws();

/// @param law  lives as long as the program. Throws as LawList::add does.
IsotropicHardening add_hardening_law(const HardeningLaw& law);

namespace detail {

extern LawList<HardeningLaw> hardening_list;
extern bool hardening_kinks[LawList<HardeningLaw>::k_most];  ///< HardeningLaw::kinks of each

template <class Law, class T>
[[gnu::always_inline]] inline HardeningStress<T> stress_of(const FlowCurves& curves,
                                                           const FlowProperties<T>& p, const T& xi) {
  if constexpr (requires { Law::template stress<T>(curves, p, xi); })
    return Law::template stress<T>(curves, p, xi);  // measured curves
  else
    return Law::template stress<T>(p, xi);
}
template <class Law, class T>
[[gnu::always_inline]] inline T energy_of(const FlowCurves& curves, const FlowProperties<T>& p, const T& xi) {
  if constexpr (requires { Law::template energy<T>(curves, p, xi); })
    return Law::template energy<T>(curves, p, xi);
  else
    return Law::template energy<T>(p, xi);
}

}  // namespace detail

inline const HardeningLaw& hardening_law(IsotropicHardening kind) {
  return *detail::hardening_list.laws[static_cast<std::size_t>(kind)];
}

/// Sets the parameters of the law that `flow` names from numbers by key; those of other laws are passed over.
/// Throws std::invalid_argument where one is missing that the law needs.
void set_hardening(Flow& flow, const std::map<std::string_view, Table>& numbers);

/// A law's struct as a HardeningLaw.
template <class Law>
class HardeningLawOf final : public HardeningLaw {
 public:
  std::string_view name() const override { return Law::name; }
  std::string_view equation() const override { return Law::equation; }
  std::span<const LawParameter> parameters() const override { return detail::parameters_of<Law>(); }
  bool kinks() const override {
    if constexpr (requires { Law::kinks; })
      return Law::kinks;
    else
      return false;
  }
  double saturation(const HardeningTables& tables) const override {
    if constexpr (requires { Law::saturation(tables); })
      return Law::saturation(tables);
    else
      return std::numeric_limits<double>::infinity();
  }
  std::optional<LawObjection> objection(const Table& flow_stress,
                                        const HardeningTables& tables) const override {
    if constexpr (requires { Law::objection(flow_stress, tables); })
      return Law::objection(flow_stress, tables);
    else
      return std::nullopt;
  }

#define SOLIDUS_HARDENING_ON(T)                                                                            \
  HardeningStress<T> stress(const FlowCurves& c, const FlowProperties<T>& p, const T& xi) const override { \
    return detail::stress_of<Law, T>(c, p, xi);                                                            \
  }                                                                                                        \
  T energy(const FlowCurves& c, const FlowProperties<T>& p, const T& xi) const override {                  \
    return detail::energy_of<Law, T>(c, p, xi);                                                            \
  }
  SOLIDUS_HARDENING_ON(double)
  SOLIDUS_HARDENING_ON(Lane)
  SOLIDUS_HARDENING_ON(Jet<double>)
  SOLIDUS_HARDENING_ON(Jet<Lane>)
  SOLIDUS_HARDENING_ON(Jet<Jet<double>>)
#undef SOLIDUS_HARDENING_ON

  HardeningSlopes<double> slopes(const FlowCurves& c, const FlowProperties<double>& v,
                                 const FlowProperties<double>& d, double from, double theta,
                                 double xi) const override {
    return slopes_of<double>(c, v, d, from, theta, xi);
  }
  HardeningSlopes<Lane> slopes(const FlowCurves& c, const FlowProperties<Lane>& v,
                               const FlowProperties<Lane>& d, Lane from, Lane theta, Lane xi) const override {
    return slopes_of<Lane>(c, v, d, from, theta, xi);
  }
  HardeningSlopes<Jet<double>> slopes(const FlowCurves& c, const FlowProperties<Jet<double>>& v,
                                      const FlowProperties<Jet<double>>& d, Jet<double> from,
                                      Jet<double> theta, Jet<double> xi) const override {
    return slopes_of<Jet<double>>(c, v, d, from, theta, xi);
  }

  /// Also for types of automatic differentiation. All that it calls is part of it, so that of the numbers
  /// those alone are computed that the law reads.
  template <class T>
  [[gnu::flatten]] static HardeningSlopes<T> slopes_of(const FlowCurves& curves,
                                                       const FlowProperties<T>& values,
                                                       const FlowProperties<T>& slopes,
                                                       const T& line_temperature, const T& temperature,
                                                       const T& xi) {
    using J = Jet<T>;
    const FlowProperties<J> at = flow_jets<T>(values, slopes, line_temperature, temperature);
    const J stored = detail::energy_of<Law, J>(curves, at, J(xi));
    const auto k = detail::stress_of<Law, J>(curves, at, J(xi));
    return {T(-stored.d), T(-stored.dd), k.stress.v, k.stress.d, k.slope.v};
  }
};

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddHardening {
  AddHardening() : kind(add_hardening_law(k_object)) {}
  IsotropicHardening kind;

 private:
  static inline const HardeningLawOf<Law> k_object{};
};

}  // namespace solidus::material
