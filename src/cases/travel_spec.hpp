/// Heat that travels along a path, as the case gives it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "heat/loads/travelling_heat.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// A path: a file of points with times, or one straight line.
struct PathSpec {
  std::string file;              ///< empty: the line
  std::vector<double> from, to;  ///< [m]
  std::optional<double> speed;   ///< [m/s]
  double start = 0;              ///< is added to all times; of a line its begin [s]
};

/// A source of heat that travels; setup/source_input.hpp makes the conditions of the heat room of it.
struct SourceSpec {
  std::string name;
  std::vector<std::string> groups;  ///< bodies; of a Gaussian surfaces
  heat::TravellingShape::Kind kind = heat::TravellingShape::Kind::gaussian;
  Function power;       ///< [W] of time
  Function efficiency;  ///< [1] of time
  std::optional<double> radius, width, depth, front, rear, front_share;
  std::vector<double> direction;  ///< of the beam, of any length; empty: down the last axis
  PathSpec path;
  double step_share = 0;  ///< longest step, as a share of the time in which it moves by its own length
  SourceLocation where;
  /// Whether it acts on surfaces rather than in bodies.
  bool on_surface() const { return kind == heat::TravellingShape::Kind::gaussian; }
};

/// How a body is deposited element by element; setup/deposition.hpp lets it grow.
struct DepositionSpec {
  enum class Kind { front, path, times };
  std::string name, body;  ///< group of the mesh
  Kind kind = Kind::front;
  std::vector<double> from, normal;  ///< of the front: a point at its start [m], its direction
  std::optional<double> speed;       ///< of the front [m/s]
  double start = 0;                  ///< of the front [s]
  PathSpec path;
  std::optional<double> width, depth;  ///< of the bead around the path [m]
  std::vector<double> direction;       ///< from the path into the bead; empty: down the last axis
  std::optional<Function> time;        ///< of birth [s], of position
  std::optional<double> interval;      ///< between births [s]
  std::string bare;                    ///< surface that bare faces join; empty: none
  SourceLocation where;
};

}  // namespace solidus::cases
