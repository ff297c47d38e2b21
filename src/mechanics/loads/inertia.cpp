/// The mass matrix is assembled once, consistent or lumped, over the graph of the mesh; products and sums
/// into other matrices use its own rows.
#include "mechanics/loads/inertia.hpp"

#include <algorithm>
#include <cassert>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

namespace {

/// Exact for N_a N_b on straight shapes: det J of quads and hexes, and the radius, add to the degree.
mesh::Rule mass_rule(mesh::Shape shape, AnalysisKind kind) {
  const bool simplex = mesh::vertex_count(shape) == mesh::dimension(shape) + 1;
  const int degree = 2 * mesh::order(shape);
  if (simplex) return mesh::gauss_rule(shape, degree + (kind == AnalysisKind::axisymmetric ? 1 : 0));
  return mesh::gauss_rule(shape, degree + 2);
}

}  // namespace

MassMatrix::MassMatrix(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const double> density,
                       MassKind mass) {
  assert(density.size() == mesh.bodies.size());
  // The lumped matrix keeps the diagonal alone, and its graph has nothing else.
  linear::NodeGraph graph(mesh);  // with the diagonal of every node
  if (mass == MassKind::consistent)
    for (const mesh::ElementBlock& block : mesh.blocks)
      graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  graph.compress(row_start_, columns_);
  values_.assign(columns_.size(), 0.0);
  // By blocks: consistent masses of the shape functions, or masses on the diagonal.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const double rho = density[as_size(block.body)];
    if (mass == MassKind::consistent)
      add_consistent(mesh, block, kind, rho);
    else
      add_lumped(mesh, block, kind, rho);
  }
}

std::size_t MassMatrix::place(Index row, Index column) const {
  const auto begin = columns_.begin() + row_start_[as_size(row)];
  const auto end = columns_.begin() + row_start_[as_size(row) + 1];
  const auto found = std::lower_bound(begin, end, column);
  assert(found != end && *found == column);
  return as_size(found - columns_.begin());
}

void MassMatrix::add_consistent(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
                                double density) {
  // The mass matrix is ρ ∫ N_a N_b, by a rule that is exact for the product. Rows of other processes are
  // theirs.
  const mesh::BlockGeometry g(mesh, block, kind, mass_rule(block.shape, kind));
  const auto n_owned = as_index(row_start_.size()) - 1;
  for (Index e = 0; e < g.n_elements; ++e)
    for (int a = 0; a < g.n_nodes; ++a) {
      const Index row = block.element(e)[a];
      if (row >= n_owned) continue;
      for (int b = 0; b < g.n_nodes; ++b) {
        double m = 0;
        for (int q = 0; q < g.n_points; ++q) {
          const double* values = g.values.data() + q * g.n_nodes;
          m += g.weight_at(e / k_lanes, q)[e % k_lanes] * values[a] * values[b];
        }
        values_[place(row, block.element(e)[b])] += density * m;
      }
    }
}

void MassMatrix::add_lumped(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
                            double density) {
  const PackVector<Lane> weights = mesh::nodal_weights(mesh, block, kind);
  const int n_nodes = mesh::node_count(block.shape);
  const auto n_owned = as_index(row_start_.size()) - 1;
  for (Index e = 0; e < block.size(); ++e)
    for (int a = 0; a < n_nodes; ++a) {
      const Index row = block.element(e)[a];
      if (row >= n_owned) continue;
      const Lane& w = weights[as_size((e / k_lanes) * n_nodes + a)];
      values_[place(row, row)] += density * w[e % k_lanes];
    }
}

void MassMatrix::bind(const linear::BlockMatrix& matrix) {
  slots_.clear();
  slots_.reserve(columns_.size());
  for (std::size_t row = 0; row + 1 < row_start_.size(); ++row)
    for (auto k = row_start_[row]; k < row_start_[row + 1]; ++k)
      slots_.push_back(matrix.slot(as_index(row), columns_[as_size(k)]));
}

void MassMatrix::multiply(std::span<const double> x, int components, std::span<double> y) const {
  const auto n = as_size(components);
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t row = 0; row + 1 < row_start_.size(); ++row)
    for (auto k = as_size(row_start_[row]); k < as_size(row_start_[row + 1]); ++k) {
      const auto column = as_size(columns_[k]);
      for (std::size_t i = 0; i < n; ++i) y[row * n + i] += values_[k] * x[column * n + i];
    }
}

void MassMatrix::add_to(linear::BlockMatrix& matrix, double factor) const {
  const int n = matrix.block_size();
  for (std::size_t k = 0; k < values_.size(); ++k) {
    double* block = matrix.block(slots_[k]);
    for (int i = 0; i < n; ++i) block[i * (n + 1)] += factor * values_[k];
  }
}

std::size_t MassMatrix::bytes() const {
  return values_.capacity() * sizeof(double) + columns_.capacity() * sizeof(Index) +
         row_start_.capacity() * sizeof(std::int64_t) + slots_.capacity() * sizeof(linear::BlockMatrix::Slot);
}

}  // namespace solidus::mechanics
