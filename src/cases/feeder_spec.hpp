/// Risers, gating and chills that a case file puts onto the geometry of a casting, and the half of it that is
/// kept (mesh/making/casting_geometry.hpp). All lengths in metres.
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

/// Sprue, runner and ingate in one body.
struct GatingBlockSpec {
  std::string name;
  std::vector<double> gate;       ///< middle of the end of the ingate
  std::vector<double> gate_size;  ///< width and height of the ingate
  double gate_length = 0;
  std::vector<double> runner_size;             ///< width and height of the runner
  std::vector<double> sprue;                   ///< middle of the top of the sprue
  double foot_diameter = 0, top_diameter = 0;  ///< of the sprue
  SourceLocation where;
};

/// The half of the geometry that is kept.
struct SymmetrySpec {
  std::string axis;  ///< "x", "y" or "z", normal to the plane
  double at = 0;     ///< the coordinate of the plane [m]; the lower half is kept
  SourceLocation where;
};

}  // namespace solidus::cases
