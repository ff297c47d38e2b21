/// Blocks, strips and measures for the verification of heat conduction.
#pragma once

#include <functional>
#include <string>

#include "csv.hpp"
#include "heat/thermal_phase.hpp"
#include "mesh/block_geometry.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::verification {

inline bool is_3d(mesh::Shape shape) {
  return mesh::dimension(shape) == 3;
}
inline bool is_quadratic(mesh::Shape shape) {
  return mesh::order(shape) == 2;
}

/// A rectangle or box of one body "block", its nodes moved by `map`.
inline mesh::Mesh block(mesh::Shape shape, std::vector<double> size, std::vector<int> divisions,
                        const std::function<mesh::Point(mesh::Point)>& map = {}) {
  mesh::RawMesh raw = mesh::make_block({std::move(size), {}, std::move(divisions), "block"}, shape);
  if (map)
    for (mesh::Point& x : raw.x) x = map(x);
  mesh::validate_and_orient(raw, "block");
  return mesh::distribute(raw, {"block"}, {});
}

/// One layer of cells along x.
inline mesh::Mesh strip(mesh::Shape shape, double length, int n) {
  const double h = length / n;
  if (is_3d(shape)) return block(shape, {length, h, h}, {n, 1, 1});
  return block(shape, {length, h}, {n, 1});
}

/// √(∫(T_h − T)² dV / V) over all elements.
inline double l2_error(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<double>& temperature,
                       const std::function<double(const mesh::Point&)>& exact) {
  double sum = 0, volume = 0;
  for (const mesh::ElementBlock& b : mesh.blocks) {
    const mesh::BlockGeometry g(mesh, b, kind, mesh::gauss_rule(b.shape, 5));
    for (Index e = 0; e < b.size(); ++e)
      for (int q = 0; q < g.n_points; ++q) {
        mesh::Point x{};
        double t = 0;
        for (int a = 0; a < g.n_nodes; ++a) {
          const double n = g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
          const auto node = static_cast<std::size_t>(b.element(e)[a]);
          t += n * temperature[node];
          for (std::size_t i = 0; i < 3; ++i) x[i] += n * mesh.x[node][i];
        }
        const double w = g.weight_at(e / k_lanes, q)[e % k_lanes], error = t - exact(x);
        sum += w * error * error;
        volume += w;
      }
  }
  return std::sqrt(sum / volume);
}

}  // namespace solidus::verification
