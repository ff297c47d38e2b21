/// Strength, elongation, hardness and grain size of a cast metal by where it froze: [[local]] of its card
/// (docs/theory/local_properties.md).
///
/// Such relations are measured on castings: values at some wall thicknesses, arm spacings or cooling rates.
/// Between them a power law is taken, a straight line in logarithms, as published curves over section have
/// it (EN 1561:2011, annex E). Beyond them nothing is said.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "system/errors.hpp"

namespace solidus::material {

/// One table of a card: values of one or several properties along one measure of how the metal froze.
struct LocalLaw {
  /// Exactly one of these is given, rising: thickness of the wall [m], secondary arm spacing [m], or cooling
  /// rate near the end of freezing [K/s].
  std::vector<double> section, arm_spacing, cooling_rate;
  /// One value for each of them, above zero: [Pa], [1], Brinell's number [1], [m]. Empty: not known.
  std::vector<double> tensile_strength, elongation, hardness, grain_size;
  double spread = 0;  ///< half width of the range that holds most measured values, as a share of the value
  std::string source;
  SourceLocation where;

  /// The measure that is given.
  const std::vector<double>& measure() const;
  /// A property where the measure is `at`; nothing beyond the ends of the table or without values.
  std::optional<double> value(std::span<const double> values, double at) const;
};

/// Checks a table of a card. Throws InputError with its place.
void check_local_law(const LocalLaw& law);

/// The tables of a material that the user names (library.hpp, find_material). No law of the material needs
/// them, so that they are read where they are followed.
std::vector<LocalLaw> find_local_laws(const std::string& reference,
                                      std::span<const std::filesystem::path> library,
                                      const SourceLocation& where = {});

}  // namespace solidus::material
