/// Quadrature rules on the reference shapes (monograph 6.3): open (Gauss) and closed (at the nodes).
#pragma once

#include <vector>

#include "mesh/shape.hpp"

namespace solidus::mesh {

struct QuadraturePoint {
  Point xi;
  double weight;
};
using Rule = std::vector<QuadraturePoint>;

/// A Gauss rule that integrates polynomials of at least `degree` exactly on the shape (total degree on
/// simplices, each direction on quads and hexes). Throws std::invalid_argument above what is tabulated
/// (simplices: 5 or more must exist).
Rule gauss_rule(Shape shape, int degree);
/// The standard rule for stiffness of the shape: tri3/tet4 1 point, tri6 3, tet10 4, quad4 2×2, quad8 3×3,
/// hex8 2×2×2, hex20 3×3×3.
Rule stiffness_rule(Shape shape);
/// Points at the nodes with the reference weights of the closed rule (vertices; all nodes for quadratic
/// shapes). Only the points matter for BlockGeometry::nodal_weights, whose weights are exact integrals of the
/// basis functions.
Rule nodal_rule(Shape shape);

}  // namespace solidus::mesh
