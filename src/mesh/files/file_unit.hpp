/// Units of length that files of CAD programs name themselves.
#pragma once

#include <optional>
#include <string>

#include "system/errors.hpp"

namespace solidus::mesh {

struct LengthUnit {
  std::string name;   ///< "mm", "inch", …, as the file or its format calls it
  double metres = 1;  ///< of one unit
  bool operator==(const LengthUnit&) const = default;
};

/// The unit that a file says its lengths are in, of the formats that name one (STEP and IGES); nothing where
/// the file says none. Where parts of a STEP file have different ones their names are joined, and `metres` is
/// 0. Throws InputError for a file that is not what its name says.
std::optional<LengthUnit> unit_of_file(const std::string& path);

/// How many metres a unit of length of a mesh or geometry file is, as its reader hands lengths over: those of
/// STEP and IGES come in mm, whatever the file's unit is.
/// @param told       the unit that the user gives; empty: none
/// @param otherwise  the unit of files that name none themselves, where the user gives none
/// @param where      of the user's unit, for messages
/// Throws InputError for a unit that is none of length, and for one that contradicts the file.
double metres_of_unit(const std::string& path, const std::string& told, const std::string& otherwise,
                      const SourceLocation& where);

}  // namespace solidus::mesh
