/// The coefficient of friction μ(ζ_c, Θ_c) of surfaces that harden, soften or wear (monograph 3.62), with the
/// free energy that it stores (3.41c): a law of laws/coefficient_law.hpp in SI.
///
///   K_c = ∫_0^ζ (μ − μ_0) dζ
///
/// z = ζ_c/unit is the internal variable in the unit of the data (1 kN/mm = 1e6 N/m); ζ_c and all
/// derivatives are in SI. In a step everything is linear in Θ, along the lines of tables and the tangents of
/// formulas: the second derivatives vanish.
///
/// Validity: ζ_c >= 0; μ_0 does not rise with temperature (3.60, checked). A law may become zero or
/// negative for some ζ_c: FrictionLaw reports it. Source: monograph 3.41c, 3.60, 3.62, 7.1.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "numbers/table.hpp"
#include "system/errors.hpp"
#include "system/objection.hpp"

namespace solidus::contact {

/// The internal variable of friction in SI, and in the unit of the data.
struct InternalValue {
  double zeta = 0;                ///< ζ_c [N/m] or [m]
  double z = 0;                   ///< ζ_c/unit
  double unit = 1, per_unit = 1;  ///< [ζ_c per z] and its inverse
};

struct CoefficientValue {
  double value = 0, zeta = 0;  ///< μ and ∂μ/∂ζ [1/ζ]
};
struct CoefficientPoint {
  double value = 0, zeta = 0;             ///< μ, ∂μ/∂ζ
  double theta = 0, zeta_theta = 0;       ///< of μ − μ_0: ∂/∂Θ [1/K], ∂²/∂ζ∂Θ
  double initial = 0, initial_theta = 0;  ///< μ_0, dμ_0/dΘ
  double stored = 0, stored_theta = 0;    ///< K_c, ∂K_c/∂Θ
};
struct CoefficientBounds {
  double low, high;
};

class CoefficientLaw {
 public:
  virtual ~CoefficientLaw() = default;
  virtual CoefficientValue value(const InternalValue& at, double theta) const = 0;
  virtual CoefficientPoint point(const InternalValue& at, double theta) const = 0;
  /// Bounds of ∂μ/∂z over [from, to] in the unit of the data, sharp as the range shrinks.
  virtual CoefficientBounds slopes(double from, double to, double theta) const = 0;
  virtual bool constant() const = 0;                          ///< μ does not depend on ζ
  virtual bool hardening_depends_on_temperature() const = 0;  ///< μ − μ_0 does
  virtual std::optional<Objection> objection() const = 0;
};

/// μ over the internal variable at one temperature.
struct FrictionCurve {
  double temperature = 0;  ///< [K]; of a single curve without meaning
  Table coefficient;       ///< of z, from z = 0 on
};

/// Exactly one of terms, curves and law.
struct FrictionCoefficientSpec {
  std::vector<Table> terms{};           ///< of a polynomial: μ_0, μ_1, … over temperature [K]
  std::vector<FrictionCurve> curves{};  ///< in any order
  std::shared_ptr<const CoefficientLaw> law{};
  double unit = 1;  ///< of z, in SI
  SourceLocation where{};
};

class FrictionCoefficient {
 public:
  /// Throws InputError for data that make no law: not one of terms, curves and law, curves that do not
  /// start at 0 or share a temperature, μ_0 or a curve not positive, μ_0 that rises with temperature (3.60).
  explicit FrictionCoefficient(const FrictionCoefficientSpec& spec);

  using Value = CoefficientValue;
  using Point = CoefficientPoint;
  using Bounds = CoefficientBounds;
  Value value(double zeta, double theta) const { return law_->value(at(zeta), theta); }
  Point point(double zeta, double theta) const { return law_->point(at(zeta), theta); }
  /// Bounds of ∂μ/∂ζ over [from, to], 0 <= from <= to, at Θ; they become sharp as the range shrinks.
  Bounds slopes(double from, double to, double theta) const {
    const Bounds r = law_->slopes(from * per_unit_, to * per_unit_, theta);
    return {r.low * per_unit_, r.high * per_unit_};
  }

  /// μ does not depend on ζ.
  bool constant() const { return law_->constant(); }
  /// μ − μ_0 depends on temperature.
  bool hardening_depends_on_temperature() const { return law_->hardening_depends_on_temperature(); }
  double unit() const { return unit_; }

 private:
  InternalValue at(double zeta) const { return {zeta, zeta * per_unit_, unit_, per_unit_}; }

  std::shared_ptr<const CoefficientLaw> law_;
  double unit_ = 1, per_unit_ = 1;
};

/// The objections of FrictionCoefficient: μ_0 rises with temperature, and a coefficient is not positive.
Objection hardens_with_temperature(double from, double at, double to, double then);
std::optional<Objection> not_positive(double coefficient);

}  // namespace solidus::contact
