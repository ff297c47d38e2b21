/// Bodies, tables and measures for the verification of mechanics and coupling; all of it for any number of
/// processes.
#pragma once

#include <cmath>
#include <fstream>
#include <string>

#include "../unit/mechanics/body.hpp"
#include "strip.hpp"
#include "system/processes.hpp"

namespace solidus::verification {

/// The table for the plots of the documentation, written by a run on one process; what other runs write into
/// it is lost.
inline std::ofstream table(const std::string& name, const std::string& header) {
  const int size = processes::count();
  return size == 1 ? csv(name, header) : std::ofstream{};
}

/// The order p of errors that fall like h^p when h is halved.
inline double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

/// A component of the displacement of the node at a place, the same on every process.
inline double displacement_at(const test::Body& body, const test::Solved& solved, const mesh::Point& place,
                              int component) {
  double value = -1e300;
  for (Index node = 0; node < body.mesh.n_owned_nodes; ++node) {
    const mesh::Point& x = body.mesh.x[static_cast<std::size_t>(node)];
    if (std::hypot(x[0] - place[0], x[1] - place[1], x[2] - place[2]) < 1e-9)
      value = solved.u(body, node, component);
  }
  return parallel::global_max(value);
}

/// ‖u_h − u‖/‖u‖ in L2 over the body.
inline double relative_l2_error(const test::Body& body, const std::vector<double>& displacement,
                                const std::function<mesh::Point(const mesh::Point&)>& exact) {
  const auto components = static_cast<std::size_t>(displacement_components(body.kind));
  double error = 0, size = 0;
  for (const mesh::ElementBlock& block : body.mesh.blocks) {
    const mesh::BlockGeometry g(body.mesh, block, body.kind, mesh::gauss_rule(block.shape, 5));
    for (Index e = 0; e < block.n_counted; ++e)
      for (int q = 0; q < g.n_points; ++q) {
        mesh::Point x{}, u{};
        for (int a = 0; a < g.n_nodes; ++a) {
          const double n = g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
          const auto node = static_cast<std::size_t>(block.element(e)[a]);
          for (std::size_t i = 0; i < 3; ++i) x[i] += n * body.mesh.x[node][i];
          for (std::size_t i = 0; i < components; ++i) u[i] += n * displacement[node * components + i];
        }
        const mesh::Point u_exact = exact(x);
        const double w = g.weight_at(e / k_lanes, q)[e % k_lanes];
        for (std::size_t i = 0; i < components; ++i) {
          error += w * (u[i] - u_exact[i]) * (u[i] - u_exact[i]);
          size += w * u_exact[i] * u_exact[i];
        }
      }
  }
  return std::sqrt(parallel::global_sum(error) / parallel::global_sum(size));
}

}  // namespace solidus::verification
