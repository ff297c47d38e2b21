/// The coefficient is one of the laws of the list, with its value, slopes and stored energy at a point;
/// checks that every law has to pass come first.
#include "contact/interface/friction_coefficient.hpp"

#include <fmt/format.h>

#include "contact/laws/curve_coefficient.hpp"
#include "contact/laws/exponential_coefficient.hpp"
#include "contact/laws/polynomial_coefficient.hpp"

namespace solidus::contact {
namespace {

std::shared_ptr<const CoefficientLaw> law_of(const FrictionCoefficientSpec& spec) {
  const int given = (spec.terms.empty() ? 0 : 1) + (spec.curves.empty() ? 0 : 1) + (spec.law ? 1 : 0);
  if (given != 1)
    throw InputError(spec.where, given == 0 ? "no coefficient of friction" : "two coefficients of friction",
                     "either coefficient (a number, or terms of a polynomial) or curves over the internal "
                     "variable");
  if (spec.law) return spec.law;
  if (!spec.terms.empty()) return std::make_shared<PolynomialCoefficient>(spec.terms);
  return std::make_shared<CurveCoefficient>(spec.curves);
}

/// Checks a formula at some temperatures; data are checked at all their points.
std::optional<Objection> against_start(const CoefficientLaw& law) {
  double before = 0, at = 0;
  for (const double theta : {300.0, 600.0, 900.0, 1200.0, 1500.0, 1800.0}) {
    const double initial = law.value({}, theta).value;
    if (const auto wrong = not_positive(initial)) return wrong;
    if (at > 0 && initial > before) return hardens_with_temperature(before, at, initial, theta);
    before = initial, at = theta;
  }
  return std::nullopt;
}

}  // namespace

Objection hardens_with_temperature(double from, double at, double to, double then) {
  return {
      fmt::format("the initial coefficient of friction rises with temperature, from {:.6g} at {:.6g} K to "
                  "{:.6g} at {:.6g} K: slip there would take entropy away (3.59, 3.60)",
                  from, at, to, then),
      "a coefficient at zero internal variable that falls or stays level with temperature"};
}

std::optional<Objection> not_positive(double coefficient) {
  if (coefficient > 0) return std::nullopt;
  return Objection{fmt::format("a coefficient of friction is {:.6g}", coefficient),
                   "coefficients above zero; for contact without friction leave [contact.friction] out"};
}

FrictionCoefficient::FrictionCoefficient(const FrictionCoefficientSpec& spec)
    : law_(law_of(spec)), unit_(spec.unit), per_unit_(1 / spec.unit) {
  if (!(unit_ > 0))
    throw InputError(spec.where, "the unit of the internal variable is not positive", "a unit above zero");
  std::optional<Objection> wrong = law_->objection();
  if (!wrong && spec.law) wrong = against_start(*law_);
  if (wrong) throw InputError(spec.where, wrong->found, wrong->allowed);
}

Kinds<CoefficientLaw>& coefficient_laws() {
  static Kinds<CoefficientLaw> laws = [] {
    Kinds<CoefficientLaw> all("law of the coefficient of friction");
    all.add({"data", "the polynomial `coefficient`, or the tables of [[contact.friction.curve]]",
             std::make_shared<SectionInfo>(),
             [](const Value&) { return std::shared_ptr<const CoefficientLaw>(); }});
    all.add(kind_of<CoefficientLaw, CoefficientLawOf<ExponentialCoefficient>>());
    return all;
  }();
  return laws;
}

}  // namespace solidus::contact
