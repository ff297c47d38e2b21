/// Risers and chills that a case file puts onto the geometry of a casting (mesh/making/casting_geometry.hpp).
/// All lengths in metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "system/errors.hpp"

namespace solidus::cases {

/// A cylindrical riser on or next to a casting.
struct RiserBlockSpec {
  std::string name;
  std::vector<double> foot;             ///< centre of its foot
  double diameter = 0, height = 0;      ///< the height with the neck
  std::optional<double> neck_diameter;  ///< absent: as wide as the riser
  double neck_height = 0;               ///< above the foot
  std::vector<double> neck_to;  ///< a point in the part that a neck leads to from the side; empty: none
  double sleeve = 0;            ///< thickness of a sleeve around what is above the neck; 0: none
  SourceLocation where;
};

/// A block of another metal against the skin of a casting.
struct ChillBlockSpec {
  std::string name;
  std::vector<double> lowest, highest;  ///< corners of a box, of which what lies outside of the parts counts
  SourceLocation where;
};

}  // namespace solidus::cases
