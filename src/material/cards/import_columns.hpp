/// The columns of an imported table by their quantity, in SI and by rising temperature.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "material/cards/card_import.hpp"

namespace solidus::material {

struct ImportColumns {
  std::string file;
  std::vector<double> temperature;  ///< [K], rising; two rows at one temperature: isothermal
  std::map<std::string, std::vector<double>> values;  ///< of the other quantities, in SI
  std::map<std::string, std::string> headers;         ///< of the columns that were taken
  std::vector<std::string> unused;                    ///< headers of the others
  std::vector<int> lines;                             ///< of the rows

  bool has(const std::string& quantity) const { return values.contains(quantity); }
  const std::vector<double>& of(const std::string& quantity) const { return values.at(quantity); }
  SourceLocation place(std::size_t row) const { return {file, lines[row], 0}; }
};

/// Finds the columns, converts and checks them: numbers everywhere, temperatures in one direction, fractions
/// from 0 to 1 that do not rise with temperature ("liquid_fraction" becomes "solid_fraction"), an enthalpy
/// that does not fall. Throws InputError with file and line.
ImportColumns import_columns(const ColumnTable& table, const ImportOptions& options);

}  // namespace solidus::material
