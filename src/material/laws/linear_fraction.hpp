/// A phase fraction that falls linearly from the solidus to the liquidus; equal temperatures: isothermal.
#pragma once

#include "material/laws/fraction_law.hpp"

namespace solidus::material {

struct LinearFraction {
  static constexpr std::string_view name = "linear",
                                    doc = "linear between solidus and liquidus (equal: isothermal)";
  double solidus = 0, liquidus = 0;  ///< [K]

  static void keys(Section<LinearFraction>& s) {
    solidus_key(s);
    liquidus_key(s);
  }
  PhaseFraction curve() const { return PhaseFraction::linear(solidus, liquidus); }
};

}  // namespace solidus::material
