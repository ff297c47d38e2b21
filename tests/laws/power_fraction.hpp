/// A phase fraction by a power of the undercooling, a law that the sources do not have:
///
///   f = ((Θ_L − Θ)/(Θ_L − Θ_S))^m
///
/// Symbols: Θ_L liquidus, Θ_S solidus [K], m a number. Validity: m > 0.
#pragma once

#include <cmath>
#include <stdexcept>

#include "material/laws/fraction_law.hpp"

namespace solidus::test {

struct PowerFraction {
  static constexpr std::string_view name = "power", doc = "((liquidus - T)/(liquidus - solidus))^exponent";
  double solidus = 0, liquidus = 0, exponent = 1;

  static void keys(Section<PowerFraction>& s) {
    material::solidus_key(s);
    material::liquidus_key(s);
    s.key("fraction_exponent", &PowerFraction::exponent).positive().doc("m.");
  }
  material::FractionRange range() const {
    if (!(liquidus > solidus)) throw std::invalid_argument("the liquidus must lie above the solidus");
    return {solidus, liquidus};
  }
  double fraction(double t) const { return std::pow((liquidus - t) / (liquidus - solidus), exponent); }
};

inline const material::AddFractionLaw<PowerFraction> k_power_fraction;

}  // namespace solidus::test
