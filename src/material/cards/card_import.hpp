/// A material card from the table of a thermodynamic program: `solidus materials import`
/// (docs/guide/material_import.md).
///
/// The card gives the table's heat content back: at every row the enthalpy of the card differs from the
/// table's by less than 1e-6 J/kg, but for one constant, and its solid fraction is the table's. The heat of
/// the freezing range is that of a specific heat which is a line from the solidus to the liquidus, of the
/// solid fraction times one latent heat, the largest that leaves no row with too much, and of a second phase
/// change with what is left: real alloys release different heats with their primary solid and with their
/// eutectics.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/column_table.hpp"
#include "input/document.hpp"
#include "material/material.hpp"

namespace solidus::material {

struct ImportOptions {
  std::map<std::string, std::string>
      columns;  ///< quantity to header, or header and unit: "enthalpy" to "HM:J/mol"
  std::string title, source, like;
  std::optional<double> latent_heat;    ///< [J/kg], where the table has no enthalpy
  std::optional<double> volume_change;  ///< of the solidification
  std::optional<double> molar_mass;     ///< [kg/mol], for columns per mole
};

struct ImportedCard {
  Value document;                    ///< as it is in a material file
  std::vector<std::string> remarks;  ///< notes on values taken, left out or chosen
};

/// The quantities that a column may hold: "temperature", "solid_fraction", "liquid_fraction", "enthalpy",
/// "specific_heat", "density", "conductivity", "young_modulus", "poisson_ratio", "expansion".
std::vector<std::string> import_quantities();

/// @param base  the material that options.like names, for what the table lacks; null: none
/// Throws InputError with file and line for fractions outside 0 to 1 or rising with temperature, an enthalpy
/// that does not rise, cells without a number, columns without a unit; and for what the card still needs.
ImportedCard import_card(const ColumnTable& table, const ImportOptions& options, const Material* base);

}  // namespace solidus::material
