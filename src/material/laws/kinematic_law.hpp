/// A law of kinematic hardening as a plug-in. The back stress follows the back strain
/// (monograph 2.49d, 2.59), and laws differ in how the back strain is recalled:
///
///   q = −⅔ K ζ,   ζ̇ = −γ̇ w (n + √⅔ r ζ),   r = r(ξ, Θ) >= 0
///
/// K is the key kinematic_modulus of all laws, r what a law is: zero for Prager (laws/prager.hpp), a
/// parameter for Armstrong and Frederick. A law is a struct like ArmstrongFrederick
/// (laws/armstrong_frederick.hpp):
///
///   struct Marquis {
///     static constexpr std::string_view name = "marquis", equation = "…";
///     static constexpr LawParameter parameters[] = {…};      // at most k_kinematic_parameters, besides K
///     template <class T> static Recall<T> recall(const FlowProperties<T>& p, const T& xi);
///   };
///   const AddKinematic<Marquis> k_marquis;   // at namespace scope: kinematic_hardening knows "marquis"
///
/// p.recall[i] is parameter i at the temperature. The stored energy ⅓ K ζ:ζ and its entropy belong to all
/// laws; what is recalled is dissipated, ⅔ K √⅔ w r γ̇ ζ:ζ. Symbols: those of viscoplastic.hpp.
#pragma once

#include <span>
#include <string_view>

#include "material/flow_properties.hpp"
#include "material/laws/law_list.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

/// r and r_ξ.
template <class T>
struct Recall {
  T value, slope;
};

/// The function of a law on one number type.
template <class T>
class KinematicOn {
 public:
  virtual Recall<T> recall(const FlowProperties<T>& p, const T& xi) const = 0;

 protected:
  ~KinematicOn() = default;
};

class KinematicLaw : public KinematicOn<double>,
                     public KinematicOn<Lane>,
                     public KinematicOn<Jet<double>>,
                     public KinematicOn<Jet<Lane>>,
                     public KinematicOn<Jet<Jet<double>>> {
 public:
  using KinematicOn<double>::recall, KinematicOn<Lane>::recall, KinematicOn<Jet<double>>::recall,
      KinematicOn<Jet<Lane>>::recall, KinematicOn<Jet<Jet<double>>>::recall;

  virtual std::string_view name() const = 0;      ///< value of the key kinematic_hardening
  virtual std::string_view equation() const = 0;  ///< of q, for the reference page
  virtual std::span<const LawParameter> parameters() const = 0;
  virtual bool recalls() const = 0;  ///< r is not zero: the tangent is not symmetric

 protected:
  ~KinematicLaw() = default;
};

namespace detail {
extern LawList<KinematicLaw> kinematic_list;
}  // namespace detail

/// All laws, each at the place that its KinematicHardening says (LawList::all).
std::span<const KinematicLaw* const> kinematic_laws();
/// @param law  lives as long as the program. Throws as LawList::add does.
KinematicHardening add_kinematic_law(const KinematicLaw& law);
inline const KinematicLaw& kinematic_law(KinematicHardening kind) {
  return *detail::kinematic_list.laws[static_cast<std::size_t>(kind)];
}

/// A law's struct as a KinematicLaw.
template <class Law>
class KinematicLawOf final : public KinematicLaw {
 public:
  std::string_view name() const override { return Law::name; }
  std::string_view equation() const override { return Law::equation; }
  std::span<const LawParameter> parameters() const override { return detail::parameters_of<Law>(); }
  bool recalls() const override {
    return requires(const FlowProperties<double>& p, double xi) {
      Law::recall(p, xi);
    };
  }

#define SOLIDUS_KINEMATIC_ON(T)                                              \
  Recall<T> recall(const FlowProperties<T>& p, const T& xi) const override { \
    return recall_of(p, xi);                                                 \
  }
  SOLIDUS_KINEMATIC_ON(double)
  SOLIDUS_KINEMATIC_ON(Lane)
  SOLIDUS_KINEMATIC_ON(Jet<double>)
  SOLIDUS_KINEMATIC_ON(Jet<Lane>)
  SOLIDUS_KINEMATIC_ON(Jet<Jet<double>>)
#undef SOLIDUS_KINEMATIC_ON

 private:
  template <class T>
  static Recall<T> recall_of(const FlowProperties<T>& p, const T& xi) {
    if constexpr (requires { Law::recall(p, xi); })
      return Law::recall(p, xi);
    else
      return {T(0.0), T(0.0)};
  }
};

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddKinematic {
  AddKinematic() : kind(add_kinematic_law(k_object)) {}
  KinematicHardening kind;

 private:
  static inline const KinematicLawOf<Law> k_object{};
};

}  // namespace solidus::material
