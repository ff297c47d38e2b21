/// Parameters of a material that the foundry engineer's criteria need besides its properties: [casting] of
/// its file (docs/theory/criteria.md, docs/theory/melt.md).
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace solidus::material {

struct Casting {
  /// Solid fraction from which the solid is a coherent network that carries strain.
  double coherency_fraction = 0.75;
  /// Solid fractions between which it cracks rather than strains, and no melt heals it.
  std::array<double, 2> brittle_range = {0.90, 0.99};

  /// Critical strain in the brittle range, ε_c = φ/(ε̇^m ΔT_B^n) with its strain rate ε̇ [1/s] and width ΔT_B
  /// [K] (criteria/mush_strain.hpp). Absent: not known; fitted to carbon steels φ = 0.02821.
  std::optional<double> crack_strain;    ///< φ
  double crack_rate_exponent = 0.3131;   ///< m
  double crack_range_exponent = 0.8638;  ///< n

  /// Of a mould: the share of the expansion of graphite that it holds, so that it feeds; the wall gives way
  /// to the rest (criteria/feeding.hpp).
  double rigidity = 1;

  /// Tension of metal below coherency at which pores open in it, counted from the atmosphere [Pa]
  /// (mechanics/elements/pores.hpp): next to none, for cast metal holds films of oxide and gas that open at
  /// once.
  double pore_tension = 100;

  /// Coarsening of secondary arms: λ₂ = c (t_f/1 s)ⁿ, t_f the local solidification time (W. Kurz,
  /// D. J. Fisher, Fundamentals of Solidification, 4th ed. 1998, eq. 4.25). Absent: the spacing is not known.
  std::optional<double> arm_spacing;     ///< c [m], the spacing after a solidification time of one second
  double arm_spacing_exponent = 1. / 3;  ///< n
  /// λ₂ after a local solidification time [s]; absent where c is.
  std::optional<double> secondary_arm_spacing(double time) const {
    if (!arm_spacing) return {};
    return *arm_spacing * std::pow(time, arm_spacing_exponent);
  }

  /// Newtonian shear viscosity μ of the melt at the liquidus [Pa s]. Absent: not known.
  std::optional<double> melt_viscosity;
  /// ΔP_cr: the drop of the melt's pressure at which pores form [Pa].
  double critical_pressure_drop = 101325;

  std::string source;
};

}  // namespace solidus::material
