/// The deepest places of a casting below the skin that cools it.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::check {

/// The greatest depth of a body below its cooled skin, and places that are as deep or nearly so.
struct Deepest {
  double depth = 0;  ///< [m]
  std::vector<mesh::Point> places;
};

/// Nodes and points of the cooled skin are thinned out where there are very many. Collective; the same on
/// every process.
/// @param cloud  points of the skin, of all processes
Deepest deepest_below(const mesh::Mesh& mesh, std::size_t body, const std::vector<mesh::Point>& cloud);

}  // namespace solidus::check
