/// Contents and quality of a mesh: the report of `solidus mesh-info`. Rank 0 only, as reading is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Elements of one shape in one group.
struct ShapeReport {
  Shape shape;
  std::size_t n_elements = 0;
};

/// A named group. Sizes are zero for groups of points.
struct GroupReport {
  std::string name;
  int dimension = 0;
  std::size_t n_nodes = 0;
  std::vector<ShapeReport> shapes;
  double measure = 0;                                         ///< length [m], area [m²] or volume [m³]
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;  ///< between vertices [m]
  double worst_quality = 1, mean_quality = 1;                 ///< of bodies only
  std::size_t n_poor = 0;                                     ///< elements below k_poor_quality
};

struct ElementReport {
  std::string group;
  Shape shape;
  GlobalIndex input_element;
  double quality;
  Point centre;  ///< [m]
};

struct QualityReport {
  int dimension = 2;
  std::size_t n_nodes = 0, n_unused_nodes = 0;  ///< unused: in no body
  Point lowest{}, highest{};                    ///< bounding box of the bodies [m]
  std::vector<GroupReport> groups;              ///< bodies first, then surfaces, lines, points
  std::vector<ElementReport> worst;             ///< the worst elements of all bodies, worst first
  std::size_t bytes = 0;                        ///< of the mesh as read
};

inline constexpr double k_poor_quality = 0.2;

/// The quality of an element, from 1 (regular) to 0 (flat), negative where it is inverted: the least over the
/// vertices of d |det T|^(2/d) / |T|² with the sign of det T, T the Jacobian relative to the regular
/// element's (mean ratio: Knupp 2001, "Algebraic mesh quality metrics", SIAM J. Sci. Comput. 23, 193–218). It
/// does not depend on the element's size.
double element_quality(const RawMesh& mesh, Shape shape, const Index* nodes);

QualityReport assess(const RawMesh& mesh, std::size_t n_worst = 5);

/// The report as text, a table of some lines; lengths in mm.
std::string to_text(const QualityReport& report);

}  // namespace solidus::mesh
