/// Elements to compare with the stabilised triangles and tetrahedra, and the measure of a pressure that
/// oscillates from element to element.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "mechanics_bodies.hpp"

namespace solidus::verification {

/// A shape and how it treats the volume.
struct Element {
  const char* name;  ///< as column of a table
  mesh::Shape shape;
  mechanics::Simplices simplices = mechanics::Simplices::mixed;
  mechanics::Stabilisation stabilisation = mechanics::Stabilisation::orthogonal;

  void choose(mechanics::MechanicsOptions& options) const {
    options.simplices = simplices;
    options.stabilisation = stabilisation;
  }
};

inline const Element k_quad4{"quad4", mesh::Shape::quad4};  ///< with B-bar
inline const Element k_hex8{"hex8", mesh::Shape::hex8};     ///< with B-bar
inline const Element k_tri3_locking{"tri3_displacement", mesh::Shape::tri3,
                                    mechanics::Simplices::displacement};
inline const Element k_tet4_locking{"tet4_displacement", mesh::Shape::tet4,
                                    mechanics::Simplices::displacement};
inline const Element k_tri3{"tri3_orthogonal", mesh::Shape::tri3};
inline const Element k_tet4{"tet4_orthogonal", mesh::Shape::tet4};
inline const Element k_tri3_algebraic{"tri3_algebraic", mesh::Shape::tri3, mechanics::Simplices::mixed,
                                      mechanics::Stabilisation::algebraic};
inline const Element k_tet4_algebraic{"tet4_algebraic", mesh::Shape::tet4, mechanics::Simplices::mixed,
                                      mechanics::Stabilisation::algebraic};

/// Volume and centre of volume of the elements of a block.
struct Cells {
  std::vector<double> volume;
  std::vector<mesh::Point> centre;

  Cells(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind) {
    const PackVector<Lane> integrals = mesh::basis_integrals(mesh, block, kind);
    const auto n = static_cast<std::size_t>(mesh::node_count(block.shape));
    for (Index e = 0; e < block.size(); ++e) {
      double v = 0;
      mesh::Point x{};
      for (std::size_t a = 0; a < n; ++a) {
        const double share = integrals[static_cast<std::size_t>(e / k_lanes) * n + a][e % k_lanes];
        v += share;
        for (std::size_t i = 0; i < 3; ++i)
          x[i] += share * mesh.x[static_cast<std::size_t>(block.element(e)[a])][i];
      }
      for (double& coordinate : x) coordinate /= v;
      volume.push_back(v);
      centre.push_back(x);
    }
  }
  /// The mean of a field over the volume.
  double mean(const std::vector<double>& field) const {
    double sum = 0, total = 0;
    for (std::size_t e = 0; e < volume.size(); ++e) {
      sum += volume[e] * field[e];
      total += volume[e];
    }
    return sum / total;
  }
  /// The root of the mean square of a field less its mean.
  double spread(const std::vector<double>& field) const {
    const double middle = mean(field);
    double sum = 0, total = 0;
    for (std::size_t e = 0; e < volume.size(); ++e) {
      sum += volume[e] * (field[e] - middle) * (field[e] - middle);
      total += volume[e];
    }
    return std::sqrt(sum / total);
  }
};

/// How far a field of elements oscillates: the root mean square of its difference to the mean of the
/// neighbours across faces, over that of its difference to its mean over the body. Elements at the boundary
/// do not count. A smooth field has O(h²) on a regular mesh; one that changes its sign from element to
/// element has 2. On one process.
inline double roughness(const mesh::ElementBlock& block, const Cells& cells,
                        const std::vector<double>& field) {
  std::map<std::vector<Index>, std::vector<Index>> faces;
  for (Index e = 0; e < block.size(); ++e)
    for (int f = 0; f < mesh::face_count(block.shape); ++f) {
      std::vector<Index> nodes;
      for (const int a : mesh::face_nodes(block.shape, f)) nodes.push_back(block.element(e)[a]);
      std::sort(nodes.begin(), nodes.end());
      faces[nodes].push_back(e);
    }
  std::vector<double> sum(field.size(), 0.0);
  std::vector<int> count(field.size(), 0);
  for (const auto& [nodes, sides] : faces) {
    if (sides.size() != 2) continue;
    for (const std::size_t k : {0u, 1u}) {
      sum[static_cast<std::size_t>(sides[k])] += field[static_cast<std::size_t>(sides[1 - k])];
      ++count[static_cast<std::size_t>(sides[k])];
    }
  }
  double oscillation = 0, total = 0;
  for (std::size_t e = 0; e < field.size(); ++e) {
    if (count[e] != mesh::face_count(block.shape)) continue;
    const double difference = field[e] - sum[e] / count[e];
    oscillation += cells.volume[e] * difference * difference;
    total += cells.volume[e];
  }
  return std::sqrt(oscillation / total) / cells.spread(field);
}

/// The roughness of the pressure of a solved body.
inline double roughness(const test::Body& body, const test::Solved& solved) {
  const mesh::ElementBlock& block = body.mesh.blocks[0];
  return roughness(block, Cells(body.mesh, block, body.kind), test::element_fields(solved)[0].pressure);
}

}  // namespace solidus::verification
