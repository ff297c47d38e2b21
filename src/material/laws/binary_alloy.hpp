/// The lever rule and Scheil's equation of a binary alloy whose liquidus and solidus are straight lines:
///
///   lever rule  f = (Θ_L − Θ)/((1 − k)(Θ_m − Θ))           the solid is of one concentration throughout
///   Scheil      f = 1 − ((Θ_m − Θ)/(Θ_m − Θ_L))^(1/(k − 1))  what is solid does not mix
///
/// Symbols: Θ_m melting point of the pure solvent, Θ_L liquidus [K], k partition coefficient of the solute.
/// The rest freezes at the eutectic; where the lever rule reaches one above it, that is the solidus.
/// Validity: 0 < k < 1, Θ_m > Θ_L > eutectic.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "material/laws/fraction_law.hpp"

namespace solidus::material {

struct BinaryAlloy {
  double melting_point = 0, liquidus = 0, eutectic = 0;  ///< [K]
  double partition = 0;                                  ///< k

  void check() const {
    if (!(melting_point > liquidus && liquidus > eutectic))
      throw std::invalid_argument(
          "the melting point of the solvent must lie above the liquidus, and that above the eutectic");
    if (!(partition > 0 && partition < 1))
      throw std::invalid_argument("the partition coefficient must lie between 0 and 1");
  }

 protected:
  template <class Law>
  static void declare(Section<Law>& s) {
    liquidus_key(s);
    s.quantity("melting_point", static_cast<double Law::*>(&Law::melting_point), "K")
        .positive()
        .doc("Of the pure solvent.");
    s.quantity("eutectic", static_cast<double Law::*>(&Law::eutectic), "K")
        .positive()
        .doc("Eutectic temperature, at which the rest of the liquid freezes.");
    s.key("partition", static_cast<double Law::*>(&Law::partition))
        .range(0, 1)
        .doc("Partition coefficient k of the solute.");
  }
};

struct LeverRule : BinaryAlloy {
  static constexpr std::string_view name = "lever_rule", doc = "the lever rule";
  static void keys(Section<LeverRule>& s) { declare(s); }

  double solidus() const { return (liquidus - (1 - partition) * melting_point) / partition; }
  FractionRange range() const {
    check();
    return {std::max(eutectic, solidus()), liquidus};
  }
  double fraction(double t) const {
    return t <= solidus() ? 1.0 : (liquidus - t) / ((1 - partition) * (melting_point - t));
  }
};

struct Scheil : BinaryAlloy {
  static constexpr std::string_view name = "scheil", doc = "Scheil's equation";
  static void keys(Section<Scheil>& s) { declare(s); }

  FractionRange range() const {
    check();
    return {eutectic, liquidus};
  }
  double fraction(double t) const {
    return 1 - std::pow((melting_point - t) / (melting_point - liquidus), 1 / (partition - 1));
  }
};

}  // namespace solidus::material
