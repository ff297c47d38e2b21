/// Element types of Gmsh by their numbers (Gmsh reference manual, "MSH file format").
#pragma once

#include <optional>
#include <string>

#include "mesh/shape.hpp"

namespace solidus::mesh {

struct GmshElement {
  std::string name;  ///< as Gmsh calls it: "Prism 6"
  int dimension = 0, n_nodes = 0;
  std::optional<Shape> shape;  ///< empty for element types that Solidus does not have
};

/// Null for numbers that are not an element type written by Gmsh for geometries.
const GmshElement* gmsh_element(int type);

/// The shapes that a mesh may have, for messages.
inline constexpr const char* k_shapes_of_meshes =
    "tri3, tri6, quad4, quad8, tet4, tet10, hex8, hex20; wedges and pyramids of first order";

}  // namespace solidus::mesh
