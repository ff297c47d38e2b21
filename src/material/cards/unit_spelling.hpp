/// Units as data sheets and programs spell them.
#pragma once

#include <string>
#include <string_view>

#include "input/units.hpp"

namespace solidus::material {

/// The conversion of a column's values. Read in addition to what UDUNITS reads: "W/m.K", "W/mK", "W/(m*K)",
/// "W/m K", "W/m-K", "W m-1 K-1", "W/m°C" (all behind a slash is below it, as data sheets have it),
/// "g/(cm)^3", "g/cc", "lbm/in^3", "ksi", "msi", "Btu/lb-F", "C", "F" and "R" for degrees, "wt.%"; for
/// coefficients of expansion, which are printed in millionths, every power of ten of six, "10-6/K", "10^6/K",
/// "10e-6 1/K", "1/K x 10^6" and "ppm/K".
/// @param unit      as the header has it
/// @param expected  of the quantity, "W/m/K"; "K" is a temperature with its zero
/// Throws std::invalid_argument with what was expected and an example.
units::Conversion conversion_of_spelling(std::string_view unit, std::string_view expected);

/// Whether a unit is for each mole, and the unit without it: "J/mol-K" is "J/K".
bool take_mole(std::string& unit);

}  // namespace solidus::material
