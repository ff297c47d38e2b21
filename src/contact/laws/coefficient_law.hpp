/// The coefficient of friction as a plug-in: a struct like ExponentialCoefficient
/// (laws/exponential_coefficient.hpp).
///
///   struct Worn {
///     static constexpr std::string_view name = "worn", doc = "…";
///     double initial = 0, …;
///     static void keys(Section<Worn>& s) { s.key("initial_coefficient", &Worn::initial)…; }
///     template <class T> T coefficient(const T& z) const;                        // μ, or of (z,
///     temperature) template <class T> T integral(const T& z) const;                           // ∫_0^z μ dz,
///     likewise
///   };
///   const AddCoefficientLaw<Worn> k_worn;   // at namespace scope: the key law of friction knows "worn"
///
/// z is the internal variable in the unit of the data. From the integral come the energy K_c that friction
/// stores (3.41c) and, where μ depends on temperature, its entropy; all derivatives are by AD. In a step μ −
/// μ_0 follows its tangent in temperature, as tables follow their lines. What a law may declare besides:
///
///   std::optional<Objection> objection() const;             // what is wrong with its numbers together
///   CoefficientBounds slopes(double from, double to, double temperature) const;  // of ∂μ/∂z over [from,
///   to];
///                                                           // absent: ∂μ/∂z is monotone in z, between its
///                                                           ends
///
/// Validity: finite for z >= 0 and Θ >= 0 (zero where a point has met nothing yet); μ(0, Θ) > 0 does not rise
/// with temperature (3.60).
#pragma once

#include <algorithm>

#include "contact/interface/friction_coefficient.hpp"
#include "input/kinds.hpp"
#include "numbers/jet.hpp"

namespace solidus::contact {

template <class Law>
class CoefficientLawOf final : public CoefficientLaw {
 public:
  Law data;

  CoefficientValue value(const InternalValue& at, double theta) const override {
    const Jet<double> mu = coefficient(Jet<double>::variable(at.z), Jet<double>(theta));
    return {mu.v, mu.d * at.per_unit};
  }
  CoefficientPoint point(const InternalValue& at, double theta) const override {
    using J = Jet<double>;
    const Jet<J> mu = coefficient(Jet<J>(J::variable(at.z)), Jet<J>(J(theta), J(1.0), J(0.0)));
    const J initial = coefficient(J(0.0), J::variable(theta));
    const J integral = integral_to(J(at.z), J::variable(theta));
    return {.value = mu.v.v,
            .zeta = mu.v.d * at.per_unit,
            .theta = mu.d.v - initial.d,
            .zeta_theta = mu.d.d * at.per_unit,
            .initial = initial.v,
            .initial_theta = initial.d,
            .stored = (integral.v - initial.v * at.z) * at.unit,
            .stored_theta = (integral.d - initial.d * at.z) * at.unit};
  }
  CoefficientBounds slopes(double from, double to, double theta) const override {
    if constexpr (requires { data.slopes(from, to, theta); }) {
      return data.slopes(from, to, theta);
    } else {
      const double a = value({from, from}, theta).zeta, b = value({to, to}, theta).zeta;
      return {std::min(a, b), std::max(a, b)};
    }
  }
  bool constant() const override { return false; }
  bool hardening_depends_on_temperature() const override { return k_of_temperature; }
  std::optional<Objection> objection() const override {
    if constexpr (requires { data.objection(); })
      if (const std::optional<Objection> wrong = data.objection()) return wrong;
    return std::nullopt;
  }

 private:
  static constexpr bool k_of_temperature = requires(const Law law) { law.coefficient(1.0, 1.0); };
  template <class T>
  T coefficient(const T& z, const T& theta) const {
    if constexpr (k_of_temperature)
      return data.coefficient(z, theta);
    else
      return data.coefficient(z);
  }
  template <class T>
  T integral_to(const T& z, const T& theta) const {
    if constexpr (k_of_temperature)
      return data.integral(z, theta);
    else
      return data.integral(z);
  }
};

/// A law with its numbers, for FrictionCoefficientSpec.
template <class Law>
std::shared_ptr<const CoefficientLaw> coefficient_law(Law data) {
  auto law = std::make_shared<CoefficientLawOf<Law>>();
  law->data = std::move(data);
  return law;
}

/// All laws of the coefficient, built in and added; the key law of [contact.friction]. The first is the one
/// from data, which reads as a null pointer: the polynomial or the curves that the section has.
Kinds<CoefficientLaw>& coefficient_laws();

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddCoefficientLaw {
  AddCoefficientLaw() { coefficient_laws().add(kind_of<CoefficientLaw, CoefficientLawOf<Law>>()); }
};

}  // namespace solidus::contact
