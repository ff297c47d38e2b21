/// The reference shapes as a table: one row each, of all that the program knows of a shape. Node counts,
/// faces, basis functions, quadrature, the numbers and orders of other programs and the instances of the
/// mechanical kernels (mechanics/elements/element_kernels.hpp) follow from the row.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "mesh/shape.hpp"

namespace solidus::mesh {

/// The reference element, of a dimension: a simplex in [0, 1], a cube in [−1, 1]; or none, for cells that are
/// split into simplices (mesh/files/split_cells.hpp).
enum class Reference { point, line, simplex, cube, split };

using Edges = std::span<const std::pair<int, int>>;
using Places = std::span<const int>;

struct ShapeRow {
  Shape shape;
  std::string_view name;
  Reference reference;
  int dimension, order, nodes, vertices, faces;
  Shape face;
  Places face_nodes;     ///< in rows of as many as the face of second order has, counter-clockwise seen from
                         ///< outside
  Edges edges;           ///< that carry the nodes behind the vertices
  int stiffness_degree;  ///< that the quadrature of stiffness is exact to
  bool mixed;            ///< has a kernel with pressures at its nodes (mechanics/elements/mixed_kernel.hpp)
  int gmsh, vtk;         ///< numbers of the type
  Places vtk_nodes;      ///< VTK's node i is ours [i]; empty: the same order
  Places abaqus_nodes;   ///< our node a is theirs [a]; empty: the same order
  Places abaqus_faces;   ///< their label i + 1 is our face [i]; empty: the same order
};

namespace detail {
// Gmsh's order of nodes: the edges of a quadrilateral go round, those of a hexahedron rise with their nodes.
inline constexpr std::array<int, 2> k_line_faces{0, 1};
inline constexpr std::array<int, 9> k_tri_faces{0, 1, 3, 1, 2, 4, 2, 0, 5};
inline constexpr std::array<int, 12> k_quad_faces{0, 1, 4, 1, 2, 5, 2, 3, 6, 3, 0, 7};
inline constexpr std::array<int, 24> k_tet_faces{0, 2, 1, 6, 5, 4, 0, 1, 3, 4, 9, 7,
                                                 0, 3, 2, 7, 8, 6, 1, 2, 3, 5, 8, 9};
inline constexpr std::array<int, 48> k_hex_faces{0, 3, 2, 1, 9,  13, 11, 8,  0, 1, 5, 4, 8,  12, 16, 10,
                                                 0, 4, 7, 3, 10, 17, 15, 9,  1, 2, 6, 5, 11, 14, 18, 12,
                                                 2, 3, 7, 6, 13, 15, 19, 14, 4, 5, 6, 7, 16, 18, 19, 17};
inline constexpr std::array<std::pair<int, int>, 3> k_tri_edges{{{0, 1}, {1, 2}, {2, 0}}};
inline constexpr std::array<std::pair<int, int>, 4> k_quad_edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
inline constexpr std::array<std::pair<int, int>, 6> k_tet_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}}};
inline constexpr std::array<std::pair<int, int>, 12> k_hex_edges{
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
// Gmsh numbers the edges (2,3), (1,3) of a tetrahedron 8, 9; VTK and Abaqus the other way round.
inline constexpr std::array<int, 10> k_tet10_others{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
// VTK goes round the bottom, round the top, then up.
inline constexpr std::array<int, 20> k_hex20_vtk{0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
inline constexpr std::array<int, 20> k_hex20_abaqus{0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                    16, 9, 17, 10, 18, 19, 12, 15, 13, 14};
inline constexpr std::array<int, 4> k_tet_abaqus_faces{0, 1, 3, 2};
inline constexpr std::array<int, 6> k_hex_abaqus_faces{0, 5, 1, 3, 4, 2};
}  // namespace detail

// In the order of Shape.
// clang-format off
inline constexpr std::array<ShapeRow, 13> k_shape_rows{{
    // shape         name     reference           d  o  n   v  f  face           face_nodes            edges                 deg mixed  gmsh vtk vtk_nodes               abaqus_nodes            abaqus_faces
    {Shape::point1, "point1", Reference::point,   0, 1, 1,  1, 0, Shape::point1, {},                   {},                   5, false, 15, 1,  {},                     {},                     {}},
    {Shape::line2,  "line2",  Reference::line,    1, 1, 2,  2, 2, Shape::point1, detail::k_line_faces, {},                   3, false, 1,  3,  {},                     {},                     {}},
    {Shape::line3,  "line3",  Reference::line,    1, 2, 3,  2, 2, Shape::point1, detail::k_line_faces, {},                   5, false, 8,  21, {},                     {},                     {}},
    {Shape::tri3,   "tri3",   Reference::simplex, 2, 1, 3,  3, 3, Shape::line2,  detail::k_tri_faces,  {},                   1, true,  2,  5,  {},                     {},                     {}},
    {Shape::tri6,   "tri6",   Reference::simplex, 2, 2, 6,  3, 3, Shape::line3,  detail::k_tri_faces,  detail::k_tri_edges,  2, false, 9,  22, {},                     {},                     {}},
    {Shape::quad4,  "quad4",  Reference::cube,    2, 1, 4,  4, 4, Shape::line2,  detail::k_quad_faces, {},                   3, false, 3,  9,  {},                     {},                     {}},
    {Shape::quad8,  "quad8",  Reference::cube,    2, 2, 8,  4, 4, Shape::line3,  detail::k_quad_faces, detail::k_quad_edges, 5, false, 16, 23, {},                     {},                     {}},
    {Shape::tet4,   "tet4",   Reference::simplex, 3, 1, 4,  4, 4, Shape::tri3,   detail::k_tet_faces,  {},                   1, true,  4,  10, {},                     {},                     detail::k_tet_abaqus_faces},
    {Shape::tet10,  "tet10",  Reference::simplex, 3, 2, 10, 4, 4, Shape::tri6,   detail::k_tet_faces,  detail::k_tet_edges,  2, false, 11, 24, detail::k_tet10_others, detail::k_tet10_others, detail::k_tet_abaqus_faces},
    {Shape::hex8,   "hex8",   Reference::cube,    3, 1, 8,  8, 6, Shape::quad4,  detail::k_hex_faces,  {},                   3, false, 5,  12, {},                     {},                     detail::k_hex_abaqus_faces},
    {Shape::hex20,  "hex20",  Reference::cube,    3, 2, 20, 8, 6, Shape::quad8,  detail::k_hex_faces,  detail::k_hex_edges,  5, false, 17, 25, detail::k_hex20_vtk,    detail::k_hex20_abaqus, detail::k_hex_abaqus_faces},
    {Shape::wedge6, "wedge6", Reference::split,   3, 1, 6,  6, 0, Shape::point1, {},                   {},                   0, false, 6,  13, {},                     {},                     {}},
    {Shape::pyramid5, "pyramid5", Reference::split,   3, 1, 5,  5, 0, Shape::point1, {},                   {},                   0, false, 7,  14, {},                     {},                     {}},
}};
// clang-format on

constexpr const ShapeRow& row_of(Shape shape) {
  return k_shape_rows[static_cast<std::size_t>(shape)];
}

}  // namespace solidus::mesh
