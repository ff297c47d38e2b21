/// Groups that a case chooses in a geometry that has none of its own (STEP, BREP, IGES), or more of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// Volumes, or surfaces (of a plane geometry: surfaces, or lines), chosen in one of three ways.
struct GeometryGroup {
  std::string name;
  bool bodies = false;
  std::vector<int> numbers;                 ///< as the file counts them from one
  std::string label;                        ///< the file's own name of them, or its last part
  std::optional<std::array<Point, 2>> box;  ///< corners [m]: those that lie inside, with its boundary
};

struct GeometryChoice {
  std::vector<GeometryGroup> groups;
  /// Bodies that touch share the faces between them, and so the nodes; else each has its own, for contact.
  bool conforming = false;
};

}  // namespace solidus::mesh
