/// Supports and loads, stress at the start and rotation as a case states them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// Origin of the time of functions: the start of the run, or that of the stage.
enum class TimeOrigin { run, stage };

struct MechanicalConditionSpec {
  enum class Kind { displacement, pressure, traction, plane, body_force, metallostatic };
  /// Whether it loads faces.
  bool on_faces() const {
    return kind == Kind::pressure || kind == Kind::traction || kind == Kind::metallostatic;
  }
  std::string name, group;
  Kind kind = Kind::displacement;
  // Functions of time, or of position and time.
  std::optional<Function> ux, uy, uz, ur;  ///< [m]
  Function pressure;                       ///< on the surface, positive inward [Pa]
  std::vector<Function> traction;          ///< one per direction [Pa]
  std::vector<Function> force;             ///< per volume, one per direction [N/m³]
  Function level;                          ///< of a melt against gravity, of time [m]
  Function squeeze;                        ///< pressure on that level, of time [Pa]
  double density = 0;                      ///< of that melt [kg/m³]
  bool relative = false;                   ///< displacements from where nodes are at the start of the stage
  std::vector<std::string> stages;         ///< in which it holds; empty: all
  TimeOrigin clock = TimeOrigin::run;
  SourceLocation where;
};

/// Stress of a body at the start, the field of another run or functions of position.
struct InitialStressSpec {
  std::string file;   ///< .vtu or .pvtu; empty: the functions
  std::string field;  ///< of its cells or points, with all components of a stress
  std::string unit;   ///< of the file's numbers; empty: what the file says, else Pa
  std::string length_unit;
  int body = -1;                                   ///< the file's cells whose data `body` is this; −1: all
  std::optional<Function> xx, yy, zz, xy, yz, xz;  ///< [Pa]
  SourceLocation where;
};

/// Bodies that turn about an axis, seen by who turns with them: a centrifugal force.
struct RotationSpec {
  Function omega;                   ///< [rad/s] of time
  std::vector<double> axis;         ///< of any length > 0; empty: the last axis, in a plane its normal
  std::vector<double> point;        ///< of the axis [m]; empty: the origin
  std::vector<std::string> bodies;  ///< names; empty: all
  SourceLocation where;
};

}  // namespace solidus::cases
