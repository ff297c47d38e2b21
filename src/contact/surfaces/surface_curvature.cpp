/// A shape operator is fitted to each face and its neighbours by least squares, from normals or, for
/// triangles, from a quadric through the nodes; principal curvatures follow from it.
#include "contact/surfaces/surface_curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

/// A curvature whose radius is this many sizes of the face is rounding of a plane.
constexpr double k_plane = 1e-8;
/// Where κ_1 g and κ_2 g differ by less, they count as one.
constexpr double k_alike = 1e-6;
/// Weight of a vanishing curvature against the neighbours: what they do not tell is zero.
constexpr double k_untold = 1e-9;

double stretched(double curvature, double distance) {
  return std::max(1 + curvature * distance, SurfaceCurvature::k_least_area);
}

/// A face in short: its centre with unit normal and a tangent.
struct Facet {
  Point centre, normal, along;
};

/// The least part of the turn that S foretells which a neighbour shows, twice counted: half of it is scatter.
/// Neighbours in directions in which S bends little say nothing.
double agreement(const Facet& here, const std::vector<const Facet*>& neighbours, const ShapeOperator& s) {
  constexpr double k_bends = 0.2;
  const double most = std::hypot(s.s11, s.s22, std::sqrt(2.0) * s.s12);
  double least = 1;
  for (const Facet* there : neighbours) {
    const Point way = subtract(there->centre, here.centre), turn = subtract(there->normal, here.normal);
    const double foretold = s.turn_along(way);
    if (std::abs(foretold) < k_bends * most * dot(way, way)) continue;
    least = std::min(least, 2 * dot(turn, way) / foretold);
  }
  return std::max(least, 0.0);
}

/// S of n_j − n_i ≈ S (x_j − x_i) over the neighbours j, by least squares.
ShapeOperator fitted(const Facet& here, const std::vector<const Facet*>& neighbours) {
  // Differences of place and normal are measured in the tangent plane, with the axes `along` and
  // `across`.
  const Point across = cross(here.normal, here.along);
  double a11 = 0, a12 = 0, a22 = 0, b11 = 0, b12 = 0, b22 = 0;  // Σ dx_α dx_β, Σ dn_α dx_β symmetric
  for (const Facet* there : neighbours) {
    const Point way = subtract(there->centre, here.centre), turn = subtract(there->normal, here.normal);
    const double x1 = dot(way, here.along), x2 = dot(way, across);
    const double n1 = dot(turn, here.along), n2 = dot(turn, across);
    a11 += x1 * x1;
    a12 += x1 * x2;
    a22 += x2 * x2;
    b11 += n1 * x1;
    b12 += n1 * x2 + n2 * x1;
    b22 += n2 * x2;
  }
  // Normal equations of S_11, S_12, S_22: S A + A S = B in components.
  const double ridge = k_untold * (a11 + a22);
  const double m[3][3] = {{a11 + ridge, a12, 0}, {a12, a11 + a22 + ridge, a12}, {0, a12, a22 + ridge}};
  const double rhs[3] = {b11, b12, b22};
  // Cramer's rule for the three unknowns.
  const auto determinant = [&](int column) {
    double c[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) c[i][j] = j == column ? rhs[i] : m[i][j];
    return c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
           c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
           c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
  };
  const double whole = determinant(-1);
  ShapeOperator shape{.along = here.along, .across = across};
  if (!(whole > 0)) return shape;
  shape.s11 = determinant(0) / whole;
  shape.s12 = determinant(1) / whole;
  shape.s22 = determinant(2) / whole;
  shape.agreement = agreement(here, neighbours, shape);
  return shape;
}

/// The same for triangles, whose normals are not those of the surface at their centres: the quadric through
/// the nodes of the face and its neighbours, z = c + g·d − ½ dᵀ S d over the tangent plane of the face.
ShapeOperator fitted_to_nodes(const Facet& here, double size, const std::vector<Point>& nodes,
                              const std::vector<const Facet*>& neighbours) {
  ShapeOperator shape{.along = here.along, .across = cross(here.normal, here.along)};
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(nodes.size()), 6);
  Eigen::VectorXd heights(terms.rows());
  for (Eigen::Index i = 0; i < terms.rows(); ++i) {
    const Point d = scale(1 / size, subtract(nodes[as_size(i)], here.centre));
    const double x = dot(d, shape.along), y = dot(d, shape.across);
    terms.row(i) << 1, x, y, -0.5 * x * x, -x * y, -0.5 * y * y;
    heights[i] = dot(d, here.normal);
  }
  const Eigen::VectorXd found = terms.completeOrthogonalDecomposition().solve(heights);
  shape.s11 = found[3] / size;
  shape.s12 = found[4] / size;
  shape.s22 = found[5] / size;
  shape.agreement = agreement(here, neighbours, shape);
  return shape;
}

/// Eigenvalues of S.
SurfaceCurvature principal(const ShapeOperator& s) {
  const double mean = 0.5 * (s.s11 + s.s22), root = std::hypot(0.5 * (s.s11 - s.s22), s.s12);
  return {mean + root, mean - root};
}

}  // namespace

double SurfaceCurvature::area(double distance) const {
  return stretched(first, distance) * stretched(second, distance);
}

double SurfaceCurvature::area_slope(double distance) const {
  const auto slope = [&](double curvature) {
    return 1 + curvature * distance > k_least_area ? curvature : 0.0;
  };
  return slope(first) * stretched(second, distance) + slope(second) * stretched(first, distance);
}

double SurfaceCurvature::plane_gap(double gap) const {
  if (!(gap > 0) || (first == 0 && second == 0)) return gap;
  const double spread = (first - second) * gap;
  if (std::abs(spread) < k_alike) return gap / std::sqrt(area(gap));
  return (std::log(stretched(first, gap)) - std::log(stretched(second, gap))) / (first - second);
}

double ShapeOperator::turn_along(const Point& d) const {
  const double x = dot(d, along), y = dot(d, across);
  return s11 * x * x + 2 * s12 * x * y + s22 * y * y;
}

std::vector<ShapeOperator> shape_operators(const ContactSurface& surface, double feature_angle) {
  // Centre, normal and a tangent of each face, and the faces at each node.
  std::vector<Facet> facets;
  std::unordered_map<Index, std::vector<std::size_t>> at_node;
  std::unordered_map<Index, Point> place;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Face face = surface.reference_face(f);
    const Point centre = reference_centre(face.shape), along = face.tangents(centre)[0];
    facets.push_back({face.at(centre), face.normal(centre), scale(1 / norm(along), along)});
    for (std::size_t a = 0; a < surface.nodes(f).size(); ++a) {
      at_node[surface.nodes(f)[a]].push_back(facets.size() - 1);
      place[surface.nodes(f)[a]] = face.x[a];
    }
  }
  const double least_cosine = std::cos(feature_angle);
  std::vector<ShapeOperator> shapes;
  // Around each face its neighbours up to sharp edges. Triangles fit a quadric through the nodes of the patch
  // if it has enough of them; all others fit the change of the normals.
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::vector<std::size_t> around;
    for (const Index node : surface.nodes(as_index(f)))
      around.insert(around.end(), at_node.at(node).begin(), at_node.at(node).end());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::vector<const Facet*> neighbours;
    // In the order of the faces, which is that of all processes.
    std::vector<Index> patch;
    const auto gather = [&](Index face) {
      for (const Index node : surface.nodes(face))
        if (std::ranges::find(patch, node) == patch.end()) patch.push_back(node);
    };
    gather(as_index(f));
    for (const std::size_t other : around)
      if (other != f && dot(facets[f].normal, facets[other].normal) > least_cosine) {
        neighbours.push_back(&facets[other]);
        gather(as_index(other));
      }
    const mesh::Shape shape = surface.shape(as_index(f));
    const bool triangle = shape == mesh::Shape::tri3 || shape == mesh::Shape::tri6;
    constexpr std::size_t k_coefficients = 6;
    if (!triangle || patch.size() < k_coefficients) {
      shapes.push_back(fitted(facets[f], neighbours));
      continue;
    }
    std::vector<Point> places;
    for (const Index node : patch) places.push_back(place.at(node));
    const double size = surface.reference_face(as_index(f)).size();
    shapes.push_back(fitted_to_nodes(facets[f], size, places, neighbours));
  }
  return shapes;
}

std::vector<SurfaceCurvature> surface_curvatures(const ContactSurface& surface, AnalysisKind kind,
                                                 double feature_angle) {
  std::vector<SurfaceCurvature> curvatures;
  for (const ShapeOperator& shape : shape_operators(surface, feature_angle)) {
    const Face face = surface.reference_face(as_index(curvatures.size()));
    SurfaceCurvature c = principal(shape);
    if (kind != AnalysisKind::solid) {
      // In a plane all neighbours lie in one direction, and the other principal curvature is that of the
      // hoop.
      c.first = std::abs(c.first) > std::abs(c.second) ? c.first : c.second;
      const Point centre = reference_centre(face.shape);
      const double radius = face.at(centre)[0];
      c.second = kind == AnalysisKind::axisymmetric && radius > 0 ? face.normal(centre)[0] / radius : 0;
    }
    for (double* curvature : {&c.first, &c.second})
      if (std::abs(*curvature) * face.size() < k_plane) *curvature = 0;
    curvatures.push_back(c);
  }
  return curvatures;
}

}  // namespace solidus::contact
