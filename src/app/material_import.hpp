/// The work of the verbs `materials import` and `materials scheil`.
#pragma once

#include <string>
#include <vector>

#include "app/exit_code.hpp"

namespace solidus::app {

struct MaterialImportArguments {
  std::string file;    ///< a table, CSV or JSON
  std::string output;  ///< the material file to write; empty: stdout
  std::string like, title, source;
  std::string latent_heat, volume_change, molar_mass;  ///< quantities with units; empty: not given
  std::vector<std::string> columns;                    ///< "QUANTITY=HEADER" or "QUANTITY=HEADER:UNIT"
};
/// A material card from the table of a thermodynamic program.
ExitCode import_material(const MaterialImportArguments& arguments);

struct SolidificationArguments {
  std::string alloy;         ///< "Al-9Si-3Cu-0.3Mg"
  bool lever = false;        ///< the lever rule instead of Scheil's equation
  std::string system;        ///< a file with the liquidus; empty: that of the library
  double tolerance = 0.002;  ///< of the chords, in solid fraction
  std::string output;        ///< a file; empty: stdout
};
/// The fraction curve of an alloy by Scheil's equation or the lever rule.
ExitCode solidification_path(const SolidificationArguments& arguments);

}  // namespace solidus::app
