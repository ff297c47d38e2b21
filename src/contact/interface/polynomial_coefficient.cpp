/// A polynomial in the internal variable with coefficients that are linear in temperature; value, slopes
/// and integrals by Horner's rule in one pass.
#include "contact/laws/polynomial_coefficient.hpp"

#include <algorithm>

namespace solidus::contact {

PolynomialCoefficient::PolynomialCoefficient(std::vector<Table> terms) : terms_(std::move(terms)) {
  const auto depends = [](const Table& t) { return !t.constant(); };
  hardening_depends_on_temperature_ = std::any_of(terms_.begin() + 1, terms_.end(), depends);
  if (hardening_depends_on_temperature_ || depends(terms_.front())) return;
  for (const Table& term : terms_) numbers_.push_back(term.y()[0]);
}

std::optional<Objection> PolynomialCoefficient::objection() const {
  const Table& initial = terms_.front();
  for (std::size_t i = 0; i < initial.y().size(); ++i) {
    if (const auto wrong = not_positive(initial.y()[i])) return wrong;
    if (i > 0 && initial.y()[i] > initial.y()[i - 1])
      return hardens_with_temperature(initial.y()[i - 1], initial.x()[i - 1], initial.y()[i], initial.x()[i]);
  }
  return std::nullopt;
}

template <class Coefficient>
CoefficientValue PolynomialCoefficient::polynomial(std::size_t n, const InternalValue& at,
                                                   Coefficient coefficient) {
  double value = coefficient(n - 1), slope = 0;
  for (std::size_t p = n - 1; p-- > 0;) {
    slope = slope * at.z + value;
    value = value * at.z + coefficient(p);
  }
  return {value, slope * at.per_unit};
}

CoefficientValue PolynomialCoefficient::value(const InternalValue& at, double theta) const {
  if (!numbers_.empty()) return polynomial(numbers_.size(), at, [&](std::size_t p) { return numbers_[p]; });
  return polynomial(terms_.size(), at, [&](std::size_t p) { return terms_[p].value(theta); });
}

CoefficientPoint PolynomialCoefficient::point(const InternalValue& at, double theta) const {
  const double z = at.z;
  // The coefficient without use, which is linear in temperature.
  CoefficientPoint r;
  const auto initial = terms_.front().line(theta);
  r.initial = initial.value;
  r.initial_theta = initial.slope;
  // Horner's rule for Σ c_p z^(p−1), its derivative and Σ c_p z^(p−1)/(p + 1), p >= 1.
  double value = 0, slope = 0, theta_value = 0, theta_slope = 0, stored = 0, stored_theta = 0;
  for (std::size_t p = terms_.size() - 1; p > 0; --p) {
    const auto c = terms_[p].line(theta);
    const double share = 1.0 / static_cast<double>(p + 1);
    slope = slope * z + value;
    value = value * z + c.value;
    theta_slope = theta_slope * z + theta_value;
    theta_value = theta_value * z + c.slope;
    stored = stored * z + c.value * share;
    stored_theta = stored_theta * z + c.slope * share;
  }
  // Values by ζ: the polynomial is in z = ζ/unit, hence the factor at.per_unit of each derivative
  // and ζ of each integral.
  r.value = r.initial + value * z;
  r.zeta = (slope * z + value) * at.per_unit;
  r.theta = theta_value * z;
  r.zeta_theta = (theta_slope * z + theta_value) * at.per_unit;
  r.stored = stored * z * at.zeta;
  r.stored_theta = stored_theta * z * at.zeta;
  return r;
}

CoefficientBounds PolynomialCoefficient::slopes(double from, double to, double theta) const {
  CoefficientBounds r{0, 0};
  double at_a = 1, at_b = 1;  // z^(p−1)
  for (std::size_t p = 1; p < terms_.size(); ++p, at_a *= from, at_b *= to) {
    const double c = static_cast<double>(p) * terms_[p].value(theta);
    r.low += std::min(c * at_a, c * at_b);
    r.high += std::max(c * at_a, c * at_b);
  }
  return r;
}

}  // namespace solidus::contact
