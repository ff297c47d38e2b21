/// A pair of two blocks on each other, its heat and displacements, and the check of a tangent by differences.
#pragma once

#include <cmath>
#include <vector>

#include "bodies.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "contact/pair.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact::pairs {

inline ContactParameters spec(IntegrationRule rule = IntegrationRule::segments) {
  ContactParameters s;
  s.name = "interface";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  s.penalty = 1e10;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.integration = rule;
  return s;
}

inline HeatTransferSpec heat_spec() {
  HeatTransferSpec h;
  h.contact_law = contact_law(PowerContact{2300});
  h.gap_law = gap_law(TableGap{{}, Table({0, 6e-5, 1e-4}, {2300, 350, 300})});
  return h;
}

inline AnalysisKind kind_of(const mesh::Mesh& mesh) {
  return mesh.dimension == 2 ? AnalysisKind::axisymmetric : AnalysisKind::solid;
}
inline std::size_t last_axis(const mesh::Mesh& mesh) {
  return static_cast<std::size_t>(mesh.dimension - 1);
}

/// A smooth displacement under which the interface is closed on one side and open on the other.
inline std::vector<double> rocking(const mesh::Mesh& mesh, double lift = 0) {
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(static_cast<std::size_t>(mesh.dimension));
    u[0] = 1e-4 * std::sin(9 * x[0]);
    u[last_axis(mesh)] = upper ? lift + 2e-4 * (x[0] - 0.14) + 1e-4 * x[1] : 3e-5 * std::cos(8 * x[0]);
    return u;
  });
}

inline linear::BlockMatrix make_matrix(const mesh::Mesh& mesh, int block, linear::Contribution& term) {
  linear::NodeGraph graph(mesh);
  term.add_to_graph(graph);
  return {mesh, block, std::move(graph)};
}

/// max |(r(x + h d) − r(x − h d)) / 2h − K d| / max |K d| over the owned rows, for a smooth d.
inline double tangent_defect(const mesh::Mesh& mesh, linear::Contribution& term, int block,
                             const std::vector<double>& x, double h) {
  linear::BlockMatrix matrix = make_matrix(mesh, block, term);
  term.bind(matrix);
  term.add_tangent(x, matrix);
  std::vector<double> d(x.size()), up = x, down = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& p = mesh.x[i / static_cast<std::size_t>(block)];
    d[i] = std::sin(31 * p[0] + 17 * p[1] + 13 * p[2] +
                    static_cast<double>(i % static_cast<std::size_t>(block)));
    up[i] += h * d[i];
    down[i] -= h * d[i];
  }
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes * block);
  std::vector<double> r_up(n, 0), r_down(n, 0), product(n, 0);
  term.add_residual(up, r_up);
  term.add_residual(down, r_down);
  matrix.multiply(d, product);
  double defect = 0, size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    defect = std::max(defect, std::abs((r_up[i] - r_down[i]) / (2 * h) - product[i]));
    size = std::max(size, std::abs(product[i]));
  }
  return parallel::global_max(defect) / parallel::global_max(size);
}

}  // namespace solidus::contact::pairs
