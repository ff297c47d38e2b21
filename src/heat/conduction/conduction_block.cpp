/// The element loop over batches of eight lanes, as a template on the shape and the kind of analysis; the
/// interface of a block calls the instance that fits.
#include "heat/conduction/conduction_block.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "heat/conduction/block_shapes.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

bool at_nodes(mesh::Shape shape, bool closed) {
  return closed && (shape == mesh::Shape::quad4 || shape == mesh::Shape::hex8);
}

/// Σ_q w_q g_a(q), [batch][node][dim].
PackVector<Lane> integrated_gradients(const mesh::BlockGeometry& g) {
  const auto stride = as_size(g.n_nodes * g.dim);
  PackVector<Lane> sum(as_size(g.n_batches) * stride, Lane(0.0));
  for (Index batch = 0; batch < g.n_batches; ++batch)
    for (int q = 0; q < g.n_points; ++q)
      for (std::size_t i = 0; i < stride; ++i)
        sum[as_size(batch) * stride + i] += g.weight_at(batch, q) * g.gradients_at(batch, q)[i];
  return sum;
}

/// Points at the nodes with the weights ∫ N_a dV, and the constant shift of the gradients that makes their
/// mean exact; none where it is rounding, as in parallelepipeds.
mesh::BlockGeometry nodal_geometry(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                   AnalysisKind kind) {
  constexpr double k_rounding = 1e-13;
  // Points lie at the nodes; their weights are replaced, since those of the rule are of the
  // reference shape.
  mesh::BlockGeometry g(mesh, block, kind, mesh::nodal_rule(block.shape));
  const mesh::BlockGeometry gauss(mesh, block, kind, mesh::gauss_rule(block.shape, 3));
  g.weight = mesh::nodal_weights(mesh, block, kind);
  // ∫ ∇N_a dV by Gauss's rule is exact; the same by the nodal rule is not where elements are
  // distorted.
  const PackVector<Lane> exact = integrated_gradients(gauss);
  PackVector<Lane> shift = integrated_gradients(g);
  const auto stride = as_size(g.n_nodes * g.dim);
  double largest_shift = 0;
  for (Index batch = 0; batch < g.n_batches; ++batch) {
    // Both means are taken over the volume of their own rule. Padding lanes have no volume and are
    // kept at zero, so that no lane divides by it.
    Lane volume(0.0), gauss_volume(0.0);
    for (int q = 0; q < g.n_points; ++q) volume += g.weight_at(batch, q);
    for (int q = 0; q < gauss.n_points; ++q) gauss_volume += gauss.weight_at(batch, q);
    const auto empty = volume == Lane(0.0);  // padding
    const Lane per_volume = select(empty, Lane(0.0), Lane(1.0) / select(empty, Lane(1.0), volume));
    const Lane per_gauss = select(empty, Lane(0.0), Lane(1.0) / select(empty, Lane(1.0), gauss_volume));
    Lane largest(0.0), size(0.0);
    for (std::size_t i = 0; i < stride; ++i) {
      const std::size_t at = as_size(batch) * stride + i;
      shift[at] = exact[at] * per_gauss - shift[at] * per_volume;
      largest = max(largest, abs(shift[at]));
      size = max(size, abs(g.gradients_at(batch, 0)[i]));
    }
    // The shift counts relative to the gradient itself: a length has no scale of its own.
    for (int lane = 0; lane < k_lanes; ++lane)
      largest_shift = std::max(largest_shift, largest[lane] / size[lane]);
  }
  if (largest_shift > k_rounding) g.shift_gradients(std::move(shift));
  return g;
}

mesh::BlockGeometry geometry_of(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
                                bool closed) {
  if (at_nodes(block.shape, closed)) return nodal_geometry(mesh, block, kind);
  return {mesh, block, kind, mesh::stiffness_rule(block.shape)};
}

template <int n_nodes, int dim>
class Conduction final : public ConductionBlock {
 public:
  Conduction(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind, bool closed,
             const EdgeConduction& edges)
      : geometry_(geometry_of(mesh, block, kind, closed)) {
    PackVector<Lane>().swap(geometry_.counted);  // nothing is summed over elements here
    if (edges.empty()) return;
    for (Index e = 0; e < block.size(); ++e)
      if (const std::optional<EdgeLoss> loss = edges.loss(mesh, block.shape, block.element(e)))
        keep(e, *loss);
  }

  void bind(const linear::BlockMatrix& matrix) override {
    matrix_ = &matrix;
    slots_.reset();
  }

  void add_tangent(double factor, std::span<const double> columns,
                   linear::BlockMatrix& matrix) const override {
    assert(&matrix == matrix_);
    if (!slots_) slots_.emplace(matrix, geometry_.nodes, n_nodes, geometry_.n_elements);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch)
      add_batch(batch, factor, columns, slots_->of(batch), matrix);
  }

  void add_tangent_once(double factor, linear::BlockMatrix& matrix) const override {
    constexpr Index k_together = 1024;  // batches
    constexpr std::size_t k_nodes = as_size(n_nodes) * k_lanes;
    // Slots are found for many batches at once, and no more, as they are used only here.
    for (Index first = 0; first < geometry_.n_batches; first += k_together) {
      const Index n = std::min(k_together, geometry_.n_batches - first);
      const std::span<const Index> nodes =
          std::span(geometry_.nodes).subspan(as_size(first) * k_nodes, as_size(n) * k_nodes);
      const linear::LaneSlots slots(matrix, nodes, n_nodes, geometry_.n_elements - first * k_lanes);
      for (Index batch = 0; batch < n; ++batch) add_batch(first + batch, factor, {}, slots.of(batch), matrix);
    }
  }

  void set_shares(std::span<const double> share) override {
    shares_.assign(as_size(geometry_.n_batches), Lane(1.0));
    for (std::size_t e = 0; e < share.size(); ++e)
      shares_[e / k_lanes].set(static_cast<int>(e % k_lanes), share[e]);
  }

  std::size_t bytes() const override {
    return geometry_.bytes() + (slots_ ? slots_->bytes() : 0) + shares_.capacity() * sizeof(Lane);
  }

 private:
  using Nodal = std::array<Lane, n_nodes>;

  using Loss = std::array<std::array<Lane, dim>, dim>;  ///< EdgeLoss of a batch

  void keep(Index element, const EdgeLoss& loss) {
    Loss& of = losses_[element / k_lanes];
    const int lane = static_cast<int>(element % k_lanes);
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) of[i][j].set(lane, loss[i][j]);
  }

  /// m −= w ∇N_a · loss ∇N_b.
  static void subtract(const Loss& loss, const Lane* g, Lane w, ConductionMatrix<n_nodes>& m) {
    // Of each column the flux that is lost, w loss ∇N_b, then its product with every ∇N_a of the
    // lower triangle.
    for (std::size_t b = 0; b < n_nodes; ++b) {
      std::array<Lane, dim> lost{};
      for (std::size_t i = 0; i < dim; ++i) {
        lost[i] = loss[i][0] * g[b * dim];
        for (std::size_t j = 1; j < dim; ++j) lost[i] += loss[i][j] * g[b * dim + j];
      }
      for (std::size_t a = 0; a <= b; ++a) {
        Lane dot = g[a * dim] * lost[0];
        for (std::size_t i = 1; i < dim; ++i) dot += g[a * dim + i] * lost[i];
        m[a][b] -= w * dot;
      }
    }
  }

  void add_batch(Index batch, double factor, std::span<const double> columns,
                 const linear::LaneSlots::Slot* slots, linear::BlockMatrix& matrix) const {
    // The element matrix is ∫ ∇N_a·∇N_b, of which one half is computed. Elements at re-entrant edges lose a
    // part across the edge.
    ConductionMatrix<n_nodes> m{};
    const auto loss = losses_.find(batch);
    const Lane share = shares_.empty() ? Lane(factor) : Lane(factor) * shares_[as_size(batch)];
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Lane* g = geometry_.gradients_at(batch, q);
      const Lane w = geometry_.weight_at(batch, q) * share;
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t b = a; b < n_nodes; ++b) {
          Lane dot = g[a * dim] * g[b * dim];
          for (std::size_t i = 1; i < dim; ++i) dot += g[a * dim + i] * g[b * dim + i];
          m[a][b] += w * dot;
        }
      if (loss != losses_.end()) subtract(loss->second, g, w, m);
    }
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t b = 0; b < a; ++b) m[a][b] = m[b][a];
    // With a conductivity that varies at the nodes, column b has that of node b.
    if (!columns.empty()) {
      const Nodal column = gather<n_nodes>(geometry_, batch, columns);
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t b = 0; b < n_nodes; ++b) m[a][b] *= column[b];
    }
    scatter_matrix<n_nodes>(slots, m, matrix);
  }

  mesh::BlockGeometry geometry_;
  std::unordered_map<Index, Loss> losses_;  ///< of batches next to edges; zero at first
  PackVector<Lane> shares_;                 ///< [batch] of set_shares(); empty: one
  const linear::BlockMatrix* matrix_ = nullptr;
  mutable std::optional<linear::LaneSlots> slots_;  ///< from the first tangent on
};

}  // namespace

std::unique_ptr<ConductionBlock> make_conduction_block(const mesh::Mesh& mesh,
                                                       const mesh::ElementBlock& block, AnalysisKind kind,
                                                       bool closed, const EdgeConduction& edges) {
  return for_shape(block.shape, [&]<int n, int dim>() -> std::unique_ptr<ConductionBlock> {
    return std::make_unique<Conduction<n, dim>>(mesh, block, kind, closed, edges);
  });
}

}  // namespace solidus::heat
