// Integration points: CalculiX CrunchiX user's manual, "Element types", and Gauss's schemes there.
#include "results/formats/deck_elements.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesh/files/abaqus_elements.hpp"
#include "mesh/quadrature.hpp"

namespace solidus::results {

using mesh::Point;
using mesh::Shape;

namespace {

/// Points of the square or cube with coordinates from a list, the first one fastest.
std::vector<Point> lattice(const std::vector<double>& along, int dimension) {
  std::vector<Point> points;
  for (const double z : dimension == 3 ? along : std::vector<double>{0.0})
    for (const double y : along)
      for (const double x : along) points.push_back({x, y, z});
  return points;
}

/// In the plane of two-dimensional shapes, of one layer.
std::vector<Point> points_of_layer(Shape shape) {
  // Positions of Gauss points for two and three a direction; a and b are those of the tetrahedron's
  // four.
  const double g2 = 1 / std::sqrt(3.0), g3 = std::sqrt(0.6);
  constexpr double a = 0.13819660112501052, b = 0.58541019662496845;
  switch (shape) {
    case Shape::tri3:
      return {{1.0 / 3, 1.0 / 3, 0}};
    case Shape::tri6:
      return {{1.0 / 6, 1.0 / 6, 0}, {2.0 / 3, 1.0 / 6, 0}, {1.0 / 6, 2.0 / 3, 0}};
    case Shape::quad4:
      return lattice({-g2, g2}, 2);
    case Shape::quad8:
      return lattice({-g3, 0, g3}, 2);
    case Shape::tet4:
      return {{0.25, 0.25, 0.25}};
    case Shape::tet10:
      return {{a, a, a}, {b, a, a}, {a, b, a}, {a, a, b}};
    case Shape::hex8:
      return lattice({-g2, g2}, 3);
    case Shape::hex20:
      return lattice({-g3, 0, g3}, 3);
    default:
      throw std::invalid_argument("no integration points of a shape that is no body");
  }
}

int layers(Shape shape) {
  if (mesh::dimension(shape) == 3) return 1;
  return mesh::order(shape) == 1 ? 2 : 3;
}

int nearest(const mesh::Rule& rule, const Point& x) {
  int found = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t q = 0; q < rule.size(); ++q) {
    const Point& y = rule[q].xi;
    const double distance = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    if (distance < least) {
      least = distance;
      found = static_cast<int>(q);
    }
  }
  return found;
}

}  // namespace

std::string deck_element_type(AnalysisKind kind, Shape shape) {
  const bool solid = kind == AnalysisKind::solid;
  if (mesh::dimension(shape) != (solid ? 3 : 2)) throw std::invalid_argument("a shape of another dimension");
  const char* family = solid ? "C3D" : kind == AnalysisKind::axisymmetric ? "CAX" : "CPE";
  return family + std::to_string(mesh::node_count(shape));
}

std::vector<int> calculix_points(Shape shape) {
  const mesh::Rule rule = mesh::stiffness_rule(shape);
  std::vector<int> points;
  for (int layer = 0; layer < layers(shape); ++layer)
    for (const Point& x : points_of_layer(shape)) points.push_back(nearest(rule, x));
  return points;
}

int deck_face_label(Shape shape, int face) {
  for (int label = 1; label <= mesh::face_count(shape); ++label)
    if (mesh::face_of_abaqus_label(shape, label) == face) return label;
  throw std::invalid_argument("no such face");
}

}  // namespace solidus::results
