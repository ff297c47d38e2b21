/// A quantity over position and time as specified in a case file: a formula, a table of points or a field of
/// a results file (docs/guide/places.md).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "input/document.hpp"
#include "input/formula.hpp"
#include "input/units.hpp"
#include "numbers/table.hpp"

namespace solidus {

class Key;

/// Names that a formula and the columns of a table of points may use, in the order of their values.
inline const std::vector<std::string> k_place_variables = {"x", "y", "z", "r", "t"};
inline constexpr std::size_t k_variable_t = 4;

struct PlaceSpec {
  enum class Kind { formula, points, field };
  Kind kind = Kind::formula;
  std::string key;                         ///< for messages: "coefficient"
  std::string key_unit;                    ///< SI
  std::shared_ptr<const Formula> formula;  ///< of k_place_variables, in SI
  std::string file;                        ///< of points (.csv) or a field (.vtu, .pvtu)
  std::string column;                      ///< of the file: a column or a field; may be empty for points
  int body = -1;           ///< of a field: the cells whose data `body` is this; −1: all cells
  double length = 1;       ///< of a field: metres per unit of its coordinates
  units::Conversion unit;  ///< from the numbers of a formula or field to SI
  bool unit_given = false;
  std::array<double, 3> velocity{};  ///< with which it moves [m/s]
  std::size_t velocity_components = 0;
  bool with_time = true;          ///< else neither t nor a velocity
  bool outside_is_error = false;  ///< else outside of a file the nearest value
  double lower = 0, upper = 0;    ///< values allowed, SI
  bool lower_open = false;
  SourceLocation where;

  bool moves() const { return velocity != std::array<double, 3>{}; }
};

/// Whether a table of the case file is a place rather than a table of one argument.
bool is_place(const Value& table);

/// Throws InputError with the place in the case file.
/// @param with_time  formulas may use t, files have a column of it, and a place may move
std::shared_ptr<const PlaceSpec> read_place(const Value& table, const Key& key, bool with_time);

}  // namespace solidus
