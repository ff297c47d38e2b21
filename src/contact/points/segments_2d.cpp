/// A line of the slave is cut at the ends of the master's lines that lie opposite to it, and Gauss's rule
/// is applied between two cuts.
#include <algorithm>
#include <cmath>

#include "contact/points/point_list.hpp"
#include "mesh/quadrature.hpp"

namespace solidus::contact {

namespace {

// Pieces shorter than this part of the face hold nothing but rounding.
constexpr double k_least_piece = 1e-10;

// ξ on the slave face whose normal line passes through p: the closest point of the extended curve. False when
// it lies nowhere near the face.
bool parameter_of(const Face& slave, const Point& p, double& xi) {
  const double allowed = std::max(1e-13, slave.rounding());
  xi = 0;
  for (int i = 0; i < 50; ++i) {
    const Point x{xi, 0, 0};
    const Point r = subtract(slave.at(x), p), t = slave.tangents(x)[0];
    const double gradient = dot(r, t);
    double hessian = dot(t, t);
    if (const double exact = hessian + dot(r, slave.curvatures(x)[0]); exact > 0.1 * hessian) hessian = exact;
    const double step = -gradient / hessian;
    xi += std::clamp(step, -1.0, 1.0);
    if (std::abs(xi) > 50) return false;
    if (std::abs(step) < allowed) return true;
  }
  return false;
}

}  // namespace

int product_degree(const Face& slave, const Face& master) {
  const auto degree = [](const Face& f) {
    const int order = mesh::order(f.shape);
    if (f.dimension() == 1) return f.affine() ? order : order + 1;
    const bool triangle = f.shape == mesh::Shape::tri3 || f.shape == mesh::Shape::tri6;
    if (f.affine()) return triangle ? order : order + 1;
    return order + 4;
  };
  return 2 * std::max(degree(slave), degree(master));
}

void cut_line(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              const CutOptions& options, std::vector<PairedPoint>& points) {
  // Cuts lie at the ends of the slave's face, at its middle where pressure has two cells, and where
  // an end of a master face projects onto it.
  std::vector<double> cuts{-1, 1};
  if (options.cells) cuts.push_back(0);
  for (Index m : candidates)
    for (std::size_t end = 0; end < 2; ++end) {
      double xi;
      if (parameter_of(slave, master.face(m).x[end], xi) && std::abs(xi) < 1) cuts.push_back(xi);
    }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    // Between two cuts the partner is one and the same face, found from the middle of the piece.
    const double length = cuts[c + 1] - cuts[c], middle = 0.5 * (cuts[c] + cuts[c + 1]);
    if (length < 2 * k_least_piece) continue;
    const Point centre{middle, 0, 0};
    const SurfacePoint partner =
        master.along(slave.at(centre), slave.normal(centre), options.search_distance, 1e-9, candidates);
    if (partner.face < 0) continue;
    const Face& partner_face = master.face(partner.face);
    // One degree more than the product for the radius of axisymmetric bodies.
    const int degree = options.degree > 0 ? options.degree : product_degree(slave, partner_face) + 1;
    // Gauss's rule then meets smooth functions only.
    for (const auto& q : mesh::gauss_rule(mesh::Shape::line2, degree)) {
      const Point xi{middle + 0.5 * length * q.xi[0], 0, 0};
      const Projection projection =
          project_along(partner_face, slave.at(xi), slave.normal(xi), 0.05);  // curved faces end skew
      if (!projection.found) continue;
      points.push_back({partner.face, xi, projection.xi, 0.5 * length * q.weight * slave.jacobian(xi)});
    }
  }
}

}  // namespace solidus::contact
