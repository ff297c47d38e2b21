/// Gas that a metal holds in solution, and the pores that it makes as the metal freezes: [gas] of its file
/// (docs/theory/gas.md).
///
/// A gas of two atoms dissolves by Sieverts' law, S(Θ, p) = S₁(Θ) √(p/p₁) with p₁ one atmosphere and
///
///   log₁₀ S₁ = a − b/Θ   [cm³ at standard state per 100 g]
///
/// in melt and in solid (hydrogen in aluminium: C. E. Ransley, H. Neufeld, The solubility of hydrogen in
/// liquid and solid aluminium, J. Inst. Metals 74 (1948) 599–620).
#pragma once

#include <array>
#include <string>

namespace solidus::material {

inline constexpr double k_standard_pressure = 101325;  ///< p₁, also that of the standard state [Pa]
inline constexpr double k_standard_state = 273.15;     ///< temperature of the standard state [K]

struct Gas {
  std::string name;                       ///< which one it is, for people: "hydrogen"
  std::array<double, 2> melt{}, solid{};  ///< a [1], b [K] of each
  double content = 0;          ///< of the melt as it is poured usually [m³ at standard state per kg]
  double surface_tension = 0;  ///< σ of the melt against the gas [N/m]
  std::string source;

  /// S₁ at a temperature [K] and a solid fraction: what both phases hold together [m³/kg].
  double solubility(double temperature, double solid_fraction) const;
  /// The pressure at which all of a content [m³/kg] stays in solution [Pa].
  double pressure(double content, double temperature, double solid_fraction) const;
  /// The gas that leaves solution at a pressure [Pa], as its volume over that of the metal [1].
  /// @param density  of the metal [kg/m³]
  double free_volume(double content, double temperature, double solid_fraction, double pressure,
                     double density) const;
};

}  // namespace solidus::material
