/// The coefficient of friction as a polynomial of the internal variable (monograph 3.62):
///
///   μ = μ_0(Θ) + Σ_{p=1..m} μ_p(Θ) z^p,   K_c = Σ_{p=1..m} μ_p(Θ) z^p ζ/(p + 1)
///
/// Symbols: z internal variable ζ_c in the unit of the data, μ_p tables of temperature, linear between their
/// points. Validity: z >= 0; it may become zero or negative for some z, which FrictionLaw reports.
#pragma once

#include <utility>
#include <vector>

#include "contact/interface/friction_coefficient.hpp"

namespace solidus::contact {

class PolynomialCoefficient final : public CoefficientLaw {
 public:
  /// @param terms  μ_0, μ_1, … over temperature [K]
  explicit PolynomialCoefficient(std::vector<Table> terms);
  CoefficientValue value(const InternalValue& at, double theta) const override;
  CoefficientPoint point(const InternalValue& at, double theta) const override;
  /// Those of the terms: not sharp, but they become so as the range shrinks.
  CoefficientBounds slopes(double from, double to, double theta) const override;
  bool constant() const override { return terms_.size() == 1; }
  bool hardening_depends_on_temperature() const override { return hardening_depends_on_temperature_; }
  std::optional<Objection> objection() const override;

 private:
  template <class Coefficient>
  static CoefficientValue polynomial(std::size_t n, const InternalValue& at, Coefficient coefficient);

  std::vector<Table> terms_;
  std::vector<double> numbers_;  ///< the terms, where none depends on temperature
  bool hardening_depends_on_temperature_ = false;
};

}  // namespace solidus::contact
