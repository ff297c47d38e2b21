#include "contact/surface_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace solidus::contact {

namespace {

/// A curvature whose radius is this many sizes of the face is rounding of a plane.
constexpr double k_plane = 1e-8;
/// Where κ_1 g and κ_2 g differ by less, they count as one.
constexpr double k_alike = 1e-6;
/// Weight of a vanishing curvature beside the neighbours: what they do not tell is zero.
constexpr double k_untold = 1e-9;

double stretched(double curvature, double distance) {
  return std::max(1 + curvature * distance, SurfaceCurvature::k_least_area);
}

/// A face in short: its centre with unit normal and a tangent.
struct Facet {
  Point centre, normal, along;
};

/// Eigenvalues of the symmetric S of n_j − n_i ≈ S (x_j − x_i) over the neighbours j, in the tangent plane of
/// i, by least squares.
SurfaceCurvature fitted(const Facet& here, const std::vector<const Facet*>& neighbours) {
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
  const auto determinant = [&](int column) {
    double c[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) c[i][j] = j == column ? rhs[i] : m[i][j];
    return c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
           c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
           c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
  };
  const double whole = determinant(-1);
  if (!(whole > 0)) return {};
  const double s11 = determinant(0) / whole, s12 = determinant(1) / whole, s22 = determinant(2) / whole;
  const double mean = 0.5 * (s11 + s22), root = std::hypot(0.5 * (s11 - s22), s12);
  return {mean + root, mean - root};
}

}  // namespace

double SurfaceCurvature::area(double distance) const {
  return stretched(first, distance) * stretched(second, distance);
}

double SurfaceCurvature::plane_gap(double gap) const {
  if (!(gap > 0) || (first == 0 && second == 0)) return gap;
  const double spread = (first - second) * gap;
  if (std::abs(spread) < k_alike) return gap / std::sqrt(area(gap));
  return (std::log(stretched(first, gap)) - std::log(stretched(second, gap))) / (first - second);
}

std::vector<SurfaceCurvature> surface_curvatures(const ContactSurface& surface, AnalysisKind kind,
                                                 double feature_angle) {
  std::vector<Facet> facets;
  std::vector<double> size;
  std::unordered_map<Index, std::vector<std::size_t>> at_node;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Face face = surface.reference_face(f);
    const Point centre = reference_centre(face.shape), along = face.tangents(centre)[0];
    facets.push_back({face.at(centre), face.normal(centre), scale(1 / norm(along), along)});
    size.push_back(face.size());
    for (const Index node : surface.nodes(f)) at_node[node].push_back(facets.size() - 1);
  }
  const double least_cosine = std::cos(feature_angle);
  std::vector<SurfaceCurvature> curvatures;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::vector<std::size_t> around;
    for (const Index node : surface.nodes(static_cast<Index>(f)))
      around.insert(around.end(), at_node.at(node).begin(), at_node.at(node).end());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::vector<const Facet*> neighbours;
    for (const std::size_t other : around)
      if (other != f && dot(facets[f].normal, facets[other].normal) > least_cosine)
        neighbours.push_back(&facets[other]);
    SurfaceCurvature c = neighbours.empty() ? SurfaceCurvature{} : fitted(facets[f], neighbours);
    if (kind != AnalysisKind::solid) {
      // In a plane all neighbours lie in one direction, and the other principal curvature is that of the
      // hoop.
      c.first = std::abs(c.first) > std::abs(c.second) ? c.first : c.second;
      const double radius = facets[f].centre[0];
      c.second = kind == AnalysisKind::axisymmetric && radius > 0 ? facets[f].normal[0] / radius : 0;
    }
    for (double* curvature : {&c.first, &c.second})
      if (std::abs(*curvature) * size[f] < k_plane) *curvature = 0;
    curvatures.push_back(c);
  }
  return curvatures;
}

}  // namespace solidus::contact
