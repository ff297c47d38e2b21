/// Cells are polygons in reference coordinates, so that one description serves straight and curved faces.
#include "contact/surfaces/face_cells.hpp"

#include "mesh/quadrature.hpp"

namespace solidus::contact {

std::vector<std::vector<Point>> face_cells(mesh::Shape shape) {
  const auto v = reference_vertices(shape);
  const std::size_t n = v.size();
  // Each vertex has the quarter of the face next to it; a triangle has a cell in its middle too.
  if (n == 2) return {{v[0], Point{}}, {Point{}, v[1]}};
  std::vector<std::vector<Point>> result;
  std::vector<Point> middle(n);
  // The middles of the edges bound the cells; a quadrangle's cells meet in its centre as well.
  for (std::size_t e = 0; e < n; ++e) middle[e] = scale(0.5, add(v[e], v[(e + 1) % n]));
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back({v[i], middle[i], middle[(i + n - 1) % n]});
    if (n == 4) result.back().insert(result.back().begin() + 2, reference_centre(shape));
  }
  if (n == 3) result.push_back(middle);
  return result;
}

std::size_t cell_of(mesh::Shape shape, const Point& xi) {
  switch (reference_vertices(shape).size()) {
    case 2:
      return xi[0] < 0 ? 0 : 1;
    case 3:
      if (xi[0] + xi[1] < 0.5) return 0;
      if (xi[0] > 0.5) return 1;
      return xi[1] > 0.5 ? 2 : 3;
    default:
      if (xi[1] < 0) return xi[0] < 0 ? 0 : 1;
      return xi[0] < 0 ? 3 : 2;
  }
}

std::vector<SlaveRulePoint> cell_rule(const Face& face, AnalysisKind kind, const std::vector<Point>& cell,
                                      int degree) {
  using mesh::Shape;
  // The rule of the cell's own shape, by its corners in the space of ξ.
  Face part;  // the cell as a face in the space of ξ
  part.n_nodes = static_cast<int>(cell.size());
  part.shape = cell.size() == 2 ? Shape::line2 : cell.size() == 3 ? Shape::tri3 : Shape::quad4;
  std::copy(cell.begin(), cell.end(), part.x.begin());
  std::vector<SlaveRulePoint> points;
  // Gauss's rule on the cell, mapped to the face and from there to the body.
  for (const auto& q : mesh::gauss_rule(part.shape, degree)) {
    const Point xi = part.at(q.xi);
    points.push_back(
        {xi, q.weight * part.jacobian(q.xi) * face.jacobian(xi) * circumference(kind, face.at(xi))});
  }
  return points;
}

}  // namespace solidus::contact
