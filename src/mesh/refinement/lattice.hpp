/// Each shape cut into parts of half its edges: places of the nodes of the parts, and which nodes each has.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/shape.hpp"

namespace solidus::mesh {

/// A node of the parts of an element.
struct LatticePoint {
  Point xi{};    ///< in the element's reference coordinates
  int old = -1;  ///< node of the element that it is; −1: a new one
  /// Vertices of the edge, face or element that it lies within, two to eight.
  std::vector<int> vertices;
  /// Of each of these, whole numbers that tell the place within the edge or face.
  std::vector<std::uint8_t> weights;
  std::array<int, 3> quarters{};  ///< reference coordinates from the first vertex on, in quarters
};

/// A child has as many nodes as its parent.
using Children = std::vector<std::vector<int>>;

struct Lattice {
  std::vector<LatticePoint> points;
  /// Nodes of each child, places in `points`. Of tetrahedra three lists, one for each diagonal of the
  /// octahedron that is left between the corners; else one.
  std::vector<Children> choices;
  /// The ends of the diagonal of each choice; empty: there is one choice.
  std::vector<std::array<int, 2>> diagonals;
  /// [point][node of the element]: basis functions.
  std::vector<std::vector<double>> basis;
};

/// Of every shape but cells that are split when a file is read.
const Lattice& lattice_of(Shape shape);

/// The corner of a cube (or quadrilateral) that a vertex of the reference shape is, by bits: 1 for the upper
/// end of the first coordinate, 2 of the second, 4 of the third.
int corner_bits(int vertex);
/// The vertex at such a corner.
int vertex_at(int bits);

}  // namespace solidus::mesh
