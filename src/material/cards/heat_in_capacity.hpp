/// A specific heat of a table that holds the heat of freezing, as an apparent heat capacity does.
#pragma once

#include <cstddef>
#include <string>

#include "material/cards/import_columns.hpp"

namespace solidus::material {

/// The heat of freezing that the column `specific_heat` holds: its integral over the freezing range above a
/// line between the rows next to the range [J/kg]; 0 where it is as much as an alloy without it may have: up
/// to half as much again, or 10 kJ/kg.
/// @param solidus, liquidus  rows at the ends of the freezing range
double heat_in_capacity(const ImportColumns& c, std::size_t solidus, std::size_t liquidus);

/// Where the specific heat of a table without enthalpy holds the heat of freezing: makes a column `enthalpy`,
/// to which it integrates, or where the latent heat is given apart a line of it over the freezing range.
/// Returns what was done, for the user; empty: nothing.
std::string take_heat_once(ImportColumns& c, std::size_t solidus, std::size_t liquidus,
                           bool latent_heat_is_given);

}  // namespace solidus::material
