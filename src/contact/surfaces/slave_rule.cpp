/// Gauss points carry the weight of their rule; nodes carry their share of the area, or a scaled diagonal
/// where that share would be negative.
#include "contact/surfaces/slave_rule.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

// ∫ N_a dA of a face with 2πr, or, where one of them is negative (quad8), the whole measure shared out in
// the ratio of ∫ N_a² dA (Hinton, Rock, Zienkiewicz 1976).
std::vector<double> nodal_measures(const Face& face, AnalysisKind kind) {
  const auto n = as_size(face.n_nodes);
  // First and second moments of the shape functions over the face.
  std::vector<double> first(n, 0), second(n, 0), values(n);
  double total = 0;
  for (const auto& q : mesh::gauss_rule(face.shape, 8)) {
    mesh::basis_values(face.shape, q.xi, values);
    const double w = q.weight * face.jacobian(q.xi) * circumference(kind, face.at(q.xi));
    total += w;
    for (std::size_t a = 0; a < n; ++a) {
      first[a] += w * values[a];
      second[a] += w * values[a] * values[a];
    }
  }
  // Where all areas are positive they are the consistent ones; values of rounding count as zero.
  if (std::all_of(first.begin(), first.end(), [&](double f) { return f > -1e-12 * total; })) {
    for (double& f : first) f = std::abs(f) <= 1e-12 * total ? 0 : f;
    return first;
  }
  // Otherwise the diagonal of the mass matrix, scaled to the whole area, which is positive.
  double sum = 0;
  for (double s : second) sum += s;
  for (double& s : second) s *= total / sum;
  return second;
}

}  // namespace

double circumference(AnalysisKind kind, const Point& x) {
  return kind == AnalysisKind::axisymmetric ? 2 * std::numbers::pi * x[0] : 1.0;
}

Point node_xi(mesh::Shape shape, std::size_t a) {
  const auto v = reference_vertices(shape);
  return a < v.size() ? v[a] : scale(0.5, add(v[a - v.size()], v[(a - v.size() + 1) % v.size()]));
}

std::vector<SlaveRulePoint> slave_rule(const Face& face, AnalysisKind kind, IntegrationRule rule,
                                       int gauss_degree) {
  assert(rule != IntegrationRule::segments);
  std::vector<SlaveRulePoint> points;
  if (rule == IntegrationRule::gauss) {
    for (const auto& q : mesh::gauss_rule(face.shape, gauss_degree))
      points.push_back({q.xi, q.weight * face.jacobian(q.xi) * circumference(kind, face.at(q.xi))});
    return points;
  }
  // By nodes: each with its own area, where that is positive.
  const std::vector<double> measures = nodal_measures(face, kind);
  for (std::size_t a = 0; a < measures.size(); ++a)
    if (measures[a] > 0) points.push_back({node_xi(face.shape, a), measures[a]});
  return points;
}

}  // namespace solidus::contact
