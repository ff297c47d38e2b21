/// Everything geometric about a block of elements, in batches of k_lanes elements.
///
/// Gradients are not kept: for an 8-node hexahedron they are 1.5 kB, which come from memory no sooner than
/// they are computed from its corners.
#pragma once

#include <utility>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"

namespace solidus::mesh {

/// Gradients, weights and node numbers of a block at the points of a rule. The last batch is padded with
/// copies of the last element whose weights are zero. Keeps a reference to the mesh.
struct BlockGeometry {
  BlockGeometry(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind, const Rule& rule);

  Shape shape;
  int n_nodes = 0, dim = 0, n_points = 0;
  Index n_elements = 0, n_batches = 0, n_counted = 0;

  std::vector<double> values;       ///< N_a at the points: [point][node], the same for every element
  PackVector<Lane> weight;          ///< quadrature weight × det J × (2π r | 1): [batch][point] [m³]
  PackVector<Lane> inverse_radius;  ///< 1/r at the points (axisymmetric only, else empty): [batch][point]
  std::vector<Index> nodes;         ///< local node numbers: [batch][node][lane]
  PackVector<Lane> counted;         ///< one for elements this process counts, else zero: [batch]

  /// ∂N_a/∂x_i [1/m], [node][dim]; holds until another batch is asked for. Not for several threads.
  const Lane* gradients_at(Index batch, int point) const {
    if (batch != held_batch_) hold_gradients(batch);
    return held_gradients_.data() + static_cast<std::ptrdiff_t>(point) * n_nodes * dim;
  }
  /// From now on adds this to the gradients at all points, [batch][node][dim].
  void shift_gradients(PackVector<Lane> by) {
    shift_ = std::move(by);
    held_batch_ = k_none;
  }
  Lane weight_at(Index batch, int point) const {
    return weight[as_size(batch) * as_size(n_points) + as_size(point)];
  }
  std::size_t bytes() const;

 private:
  static constexpr Index k_none = -1;
  void hold_gradients(Index batch) const;

  const Mesh* mesh_;
  std::vector<double> reference_;  ///< ∂N_a/∂ξ_j: [point][node][dim]
  PackVector<Lane> shift_;         ///< empty: none
  mutable Index held_batch_ = k_none;
  mutable PackVector<Lane> held_gradients_;     ///< [point][node][dim]
  mutable PackVector<Lane> held_determinants_;  ///< det J without the shift, [point]
};

/// The nodal weights of the closed rule, ∫ N_a dV > 0 for linear shapes; for quadratic shapes diagonal
/// scaling V ∫N_a² dV / Σ_b ∫N_b² dV (Hinton, Rock, Zienkiewicz 1976), which is positive too: [batch][node]
/// [m³].
PackVector<Lane> nodal_weights(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind);

/// ∫ N_a dV of every element, which the nodal weights are for linear shapes: [batch][node] [m³].
PackVector<Lane> basis_integrals(const Mesh& mesh, const ElementBlock& block, AnalysisKind kind);

/// Boundary faces: values of N and surface weights (area × 2π r | 1) and outward unit normals, face by face.
struct FaceGeometry {
  FaceGeometry(const Mesh& mesh, const ElementBlock& faces, AnalysisKind kind, const Rule& rule);
  int n_nodes = 0, n_points = 0;
  Index n_faces = 0, n_counted = 0;
  std::vector<double> values;  ///< [point][node]
  std::vector<double> weight;  ///< [face][point] [m²]
  std::vector<Point> normal;   ///< [face][point]
};

}  // namespace solidus::mesh
