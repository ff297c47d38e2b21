/// Gas pores around a node: what melt and solid cannot keep in solution as metal freezes
/// (docs/theory/gas.md).
///
/// No gas leaves the metal around a node, and melt, solid and pores are in equilibrium until the last melt
/// is frozen. At the pressure p of a pore
///
///   p = max(p_a + P, 0) + 2 σ/r,   r = λ₂/2
///   x = (ρ/ρ₁) max(0, c − S(Θ, f) √(p/p₁)),   g = x/(1 + x)
///
/// with p_a [Pa] of the surroundings, P [Pa] of the melt from there on (mush_flow.hpp), λ₂ [m] the arm
/// spacing so far, c [m³/kg] the content, S the solubility of both phases (material/gas.hpp), x volume of gas
/// over that of metal and g its share of the room. There are pores from the moment at which the pressure of
/// the gas in solution exceeds p.
#pragma once

#include <optional>
#include <vector>

#include "material/material.hpp"

namespace solidus::criteria {

struct GasOptions {
  bool follow = true;
  std::optional<double> content = {};                       ///< [m³/kg]; absent: that of the card
  double ambient_pressure = material::k_standard_pressure;  ///< p_a [Pa]
};

class GasLaw {
 public:
  /// Nothing where the material has no gas or the melt holds none.
  static std::optional<GasLaw> of(const material::Material& material, const GasOptions& options);

  /// The metal around a node.
  struct Place {
    double temperature;     ///< [K]
    double solid_fraction;  ///< f
    double freezing_time;   ///< since it began to freeze [s]
  };
  /// g at a pressure P of the melt [Pa].
  double pores(const Place& place, double pressure) const;
  /// dg/dP, not above zero [1/Pa].
  double slope(const Place& place, double pressure) const;
  /// The pressure P of the melt at which g is this share [Pa]; without pores, that at which they open.
  double pressure_at(const Place& place, double pores) const;

 private:
  struct Pore {
    double gas = 0, gas_by_pressure = 0;  ///< x, dx/dp [1/Pa]
  };
  Pore pore(const Place& place, double pressure) const;
  double tension(const Place& place) const;  ///< 2 σ/r [Pa]

  material::Gas gas_;
  material::Casting casting_;
  double density_ = 0, solidus_ = 0, content_ = 0, ambient_ = 0;
};

}  // namespace solidus::criteria
