/// The coefficient of friction μ(ζ_c, Θ_c) of surfaces that harden, soften or wear (monograph 3.62), with the
/// free energy that it stores (3.41c):
///
///   polynomial  μ = μ_0(Θ) + Σ_{p=1..m} μ_p(Θ) z^p     any number of terms, each a table of temperature
///   curves      μ = μ(z, Θ), tables of z for one temperature or several, linear in z and Θ between them
///   K_c         = ∫_0^ζ (μ − μ_0) dζ
///
/// z = ζ_c/unit is the internal variable in the unit of the data (1 kN/mm = 1e6 N/m); ζ_c and all
/// derivatives are in SI. At temperatures between the points of a table everything is linear in Θ: the second
/// derivatives vanish. Curves stay level beyond their last points.
///
/// Validity: ζ_c >= 0; μ_0 does not rise with temperature (3.60, checked). A polynomial may become zero or
/// negative for some ζ_c: FrictionLaw reports it. Source: monograph 3.41c, 3.60, 3.62, 7.1.
#pragma once

#include <vector>

#include "base/errors.hpp"
#include "base/table.hpp"

namespace solidus::contact {

/// μ over the internal variable at one temperature.
struct FrictionCurve {
  double temperature = 0;  ///< [K]; of a single curve without meaning
  Table coefficient;       ///< of z, from z = 0 on
};

struct FrictionCoefficientSpec {
  std::vector<Table> terms{};           ///< μ_0, μ_1, … over temperature [K]; or, where empty,
  std::vector<FrictionCurve> curves{};  ///< in any order
  double unit = 1;                      ///< of z, in SI
  SourceLocation where{};
};

class FrictionCoefficient {
 public:
  /// Throws InputError for data that make no law: neither or both of terms and curves, curves that do not
  /// start at 0 or share a temperature, μ_0 or a curve not positive, μ_0 that rises with temperature (3.60).
  explicit FrictionCoefficient(FrictionCoefficientSpec spec);

  struct Value {
    double value = 0, zeta = 0;  ///< μ and ∂μ/∂ζ [1/ζ]
  };
  struct Point {
    double value = 0, zeta = 0;             ///< μ, ∂μ/∂ζ
    double theta = 0, zeta_theta = 0;       ///< of μ − μ_0: ∂/∂Θ [1/K], ∂²/∂ζ∂Θ
    double initial = 0, initial_theta = 0;  ///< μ_0, dμ_0/dΘ
    double stored = 0, stored_theta = 0;    ///< K_c, ∂K_c/∂Θ
  };
  struct Bounds {
    double low, high;
  };
  Value value(double zeta, double theta) const;
  Point point(double zeta, double theta) const;
  /// Bounds of ∂μ/∂ζ over [from, to], 0 <= from <= to, at Θ. Of one curve they are sharp, of a polynomial
  /// they are those of its terms: not sharp, but they become so as the range shrinks.
  Bounds slopes(double from, double to, double theta) const;

  /// μ does not depend on ζ.
  bool constant() const { return spec_.terms.size() == 1; }
  /// μ − μ_0 depends on temperature.
  bool hardening_depends_on_temperature() const { return hardening_depends_on_temperature_; }
  double unit() const { return spec_.unit; }

 private:
  /// The curves around a temperature and the share of the second one.
  struct Between {
    const Table *first, *second;
    double share, per_kelvin;
  };
  Between between(double theta) const;
  void check_terms();
  void check_curves();
  template <class Coefficient>
  Value polynomial(std::size_t n, double zeta, Coefficient coefficient) const;

  FrictionCoefficientSpec spec_;
  double per_unit_ = 1;          ///< 1/unit
  std::vector<double> numbers_;  ///< the terms, where none depends on temperature
  bool hardening_depends_on_temperature_ = false;
};

template <class Coefficient>
FrictionCoefficient::Value FrictionCoefficient::polynomial(std::size_t n, double zeta,
                                                           Coefficient coefficient) const {
  const double z = zeta * per_unit_;
  double value = coefficient(n - 1), slope = 0;
  for (std::size_t p = n - 1; p-- > 0;) {
    slope = slope * z + value;
    value = value * z + coefficient(p);
  }
  return {value, slope * per_unit_};
}

inline FrictionCoefficient::Value FrictionCoefficient::value(double zeta, double theta) const {
  if (!numbers_.empty()) return polynomial(numbers_.size(), zeta, [&](std::size_t p) { return numbers_[p]; });
  if (!spec_.terms.empty())
    return polynomial(spec_.terms.size(), zeta, [&](std::size_t p) { return spec_.terms[p].value(theta); });
  const Between at = between(theta);
  const double z = zeta * per_unit_;
  const auto a = at.first->line(z);
  if (at.second == at.first) return {a.value, a.slope * per_unit_};
  const auto b = at.second->line(z);
  return {a.value + at.share * (b.value - a.value), (a.slope + at.share * (b.slope - a.slope)) * per_unit_};
}

}  // namespace solidus::contact
