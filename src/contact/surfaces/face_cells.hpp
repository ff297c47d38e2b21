/// Cells of a face: two halves of a line, four quarters of a triangle or a quad, that meet at the middles of
/// the edges.
#pragma once

#include <vector>

#include "contact/surfaces/slave_rule.hpp"

namespace solidus::contact {

/// Vertices of the cells in reference coordinates, anticlockwise. The cell at vertex i of the face has the
/// number i; the middle of a triangle comes last.
std::vector<std::vector<Point>> face_cells(mesh::Shape shape);
/// The number of the cell that a place of the face lies in.
std::size_t cell_of(mesh::Shape shape, const Point& xi);
/// Gauss points of one cell, exact for polynomials of this degree on affine faces.
std::vector<SlaveRulePoint> cell_rule(const Face& face, AnalysisKind kind, const std::vector<Point>& cell,
                                      int degree);

}  // namespace solidus::contact
