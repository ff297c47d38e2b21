/// How many cycles of a strain a material bears until a crack begins.
///
///   Δε/2 = (σ_f' − σ_m)/E (2N)^b + ε_f' (2N)^c
///
/// Δε range of strain, N cycles, σ_f' [Pa] and b fatigue strength and its exponent (O. H. Basquin 1910), ε_f'
/// and c fatigue ductility and its exponent (L. F. Coffin 1954, S. S. Manson 1953), σ_m [Pa] mean stress (J.
/// Morrow 1968), E [Pa] modulus. Or a table of the user: N of Δε, straight in both logarithms between its
/// points, and on by its last lines. Valid for cracks by strain, at the temperature of the constants; no
/// oxidation, no time at temperature.
#pragma once

#include <vector>

namespace solidus::criteria {

/// Lives beyond this are not told apart.
inline constexpr double k_most_cycles = 1e9;

struct FatigueLaw {
  double strength = 0, modulus = 0, strength_exponent = 0;  ///< σ_f' [Pa], E [Pa], b < 0
  double ductility = 0, ductility_exponent = 0;             ///< ε_f', c < 0
  double mean_stress = 0;                                   ///< σ_m [Pa]
  /// A table in place of these: ranges of strain, rising, and the cycles of each, falling.
  std::vector<double> strain{}, cycles{};
  /// Whether the deformation of the body is computed, whose strain it then is.
  bool deforms = false;
  /// N of a range of strain, from below one up to k_most_cycles.
  double life(double strain_range) const;
};

}  // namespace solidus::criteria
