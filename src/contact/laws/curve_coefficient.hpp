/// The coefficient of friction as measured curves μ(z, Θ): tables of the internal variable z at one
/// temperature or several, linear in z and Θ between them, level beyond; K_c = ∫_0^ζ (μ − μ_0) dζ in closed
/// form.
///
/// Validity: z >= 0.
#pragma once

#include <vector>

#include "contact/interface/friction_coefficient.hpp"

namespace solidus::contact {

class CurveCoefficient final : public CoefficientLaw {
 public:
  /// @param curves  in any order
  explicit CurveCoefficient(std::vector<FrictionCurve> curves);
  CoefficientValue value(const InternalValue& at, double theta) const override;
  CoefficientPoint point(const InternalValue& at, double theta) const override;
  /// The bounds of one curve are sharp.
  CoefficientBounds slopes(double from, double to, double theta) const override;
  bool constant() const override { return false; }
  bool hardening_depends_on_temperature() const override { return curves_.size() > 1; }
  std::optional<Objection> objection() const override;

 private:
  /// The curves around a temperature and the share of the second one.
  struct Between {
    const Table *first, *second;
    double share, per_kelvin;
  };
  Between between(double theta) const;

  std::vector<FrictionCurve> curves_;
};

}  // namespace solidus::contact
