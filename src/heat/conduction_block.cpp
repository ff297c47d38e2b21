#include "heat/conduction_block.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "heat/block_shapes.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::heat {

namespace {

bool at_nodes(mesh::Shape shape, bool closed) {
  return closed && (shape == mesh::Shape::quad4 || shape == mesh::Shape::hex8);
}

/// Σ_q w_q g_a(q), [batch][node][dim].
PackVector<Lane> integrated_gradients(const mesh::BlockGeometry& g) {
  const auto stride = static_cast<std::size_t>(g.n_nodes * g.dim);
  PackVector<Lane> sum(static_cast<std::size_t>(g.n_batches) * stride, Lane(0.0));
  for (Index batch = 0; batch < g.n_batches; ++batch)
    for (int q = 0; q < g.n_points; ++q)
      for (std::size_t i = 0; i < stride; ++i)
        sum[static_cast<std::size_t>(batch) * stride + i] +=
            g.weight_at(batch, q) * g.gradients_at(batch, q)[i];
  return sum;
}

/// Points at the nodes with the weights ∫ N_a dV, and the constant shift of the gradients that makes their
/// mean exact; none where it is rounding, as in parallelepipeds.
mesh::BlockGeometry nodal_geometry(const mesh::Mesh& mesh, const mesh::Block& block, AnalysisKind kind) {
  constexpr double k_rounding = 1e-13;
  mesh::BlockGeometry g(mesh, block, kind, mesh::nodal_rule(block.shape));
  const mesh::BlockGeometry gauss(mesh, block, kind, mesh::gauss_rule(block.shape, 3));
  g.weight = mesh::nodal_weights(mesh, block, kind);
  const PackVector<Lane> exact = integrated_gradients(gauss);
  PackVector<Lane> shift = integrated_gradients(g);
  const auto stride = static_cast<std::size_t>(g.n_nodes * g.dim);
  double largest_shift = 0;
  for (Index batch = 0; batch < g.n_batches; ++batch) {
    Lane volume(0.0), gauss_volume(0.0);
    for (int q = 0; q < g.n_points; ++q) volume += g.weight_at(batch, q);
    for (int q = 0; q < gauss.n_points; ++q) gauss_volume += gauss.weight_at(batch, q);
    const auto empty = volume == Lane(0.0);  // padding
    const Lane per_volume = select(empty, Lane(0.0), Lane(1.0) / select(empty, Lane(1.0), volume));
    const Lane per_gauss = select(empty, Lane(0.0), Lane(1.0) / select(empty, Lane(1.0), gauss_volume));
    Lane largest(0.0), size(0.0);
    for (std::size_t i = 0; i < stride; ++i) {
      const std::size_t at = static_cast<std::size_t>(batch) * stride + i;
      shift[at] = exact[at] * per_gauss - shift[at] * per_volume;
      largest = max(largest, abs(shift[at]));
      size = max(size, abs(g.gradients_at(batch, 0)[i]));
    }
    for (int lane = 0; lane < k_lanes; ++lane)
      largest_shift = std::max(largest_shift, largest[lane] / size[lane]);
  }
  if (largest_shift > k_rounding) g.shift_gradients(std::move(shift));
  return g;
}

mesh::BlockGeometry geometry_of(const mesh::Mesh& mesh, const mesh::Block& block, AnalysisKind kind,
                                bool closed) {
  if (at_nodes(block.shape, closed)) return nodal_geometry(mesh, block, kind);
  return {mesh, block, kind, mesh::stiffness_rule(block.shape)};
}

/// @tparam interpolated  k at the points is interpolated from the nodes; otherwise looked up at the point
template <int n_nodes, int dim, bool interpolated>
class Conduction final : public ConductionBlock {
 public:
  Conduction(const mesh::Mesh& mesh, const mesh::Block& block, AnalysisKind kind,
             const material::Material& material, bool closed)
      : geometry_(geometry_of(mesh, block, kind, closed)), conductivity_(material.conductivity) {}

  void bind(const algebra::BlockMatrix& matrix) override {
    slots_ = {matrix, geometry_.nodes, n_nodes, geometry_.n_elements};
  }

  void add_heat(std::span<const double> temperature, const NodalConductivity& k,
                std::span<double> heat) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Element e(*this, batch, temperature, k.value);
      Nodal r{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Lane* g = geometry_.gradients_at(batch, q);
        const Lane wk = geometry_.weight_at(batch, q) * e.conductivity(q);
        const std::array<Lane, dim> gradient = e.gradient(g);
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t i = 0; i < dim; ++i) r[a] += g[a * dim + i] * (wk * gradient[i]);
      }
      scatter<n_nodes>(geometry_, batch, r, heat);
    }
  }

  void add_tangent(std::span<const double> temperature, const NodalConductivity& k, bool exact,
                   algebra::BlockMatrix& matrix) const override {
    exact ? assemble<true>(temperature, k, matrix) : assemble<false>(temperature, k, matrix);
  }

  std::size_t bytes() const override { return geometry_.bytes() + slots_.bytes(); }

 private:
  using Nodal = std::array<Lane, n_nodes>;

  /// The nodal values of one batch.
  struct Element {
    const Conduction& block;
    Nodal t, k{};
    Element(const Conduction& b, Index batch, std::span<const double> temperature,
            std::span<const double> nodal_k)
        : block(b), t(gather<n_nodes>(b.geometry_, batch, temperature)) {
      if constexpr (interpolated)
        if (!b.conductivity_.constant()) k = gather<n_nodes>(b.geometry_, batch, nodal_k);
    }
    const double* values(int q) const { return block.geometry_.values.data() + q * n_nodes; }
    Lane interpolate(const Nodal& nodal, int q) const {
      Lane sum(0.0);
      for (std::size_t a = 0; a < n_nodes; ++a) sum += Lane(values(q)[a]) * nodal[a];
      return sum;
    }
    Lane conductivity(int q) const {
      if (block.conductivity_.constant()) return Lane(block.conductivity_.y()[0]);
      if constexpr (interpolated) return interpolate(k, q);
      return block.conductivity_.value(interpolate(t, q));
    }
    /// Differences to the first node: a uniform temperature has no gradient, to the last bit.
    std::array<Lane, dim> gradient(const Lane* g) const {
      std::array<Lane, dim> sum{};
      for (std::size_t a = 1; a < n_nodes; ++a) {
        const Lane difference = t[a] - t[0];
        for (std::size_t i = 0; i < dim; ++i) sum[i] += g[a * dim + i] * difference;
      }
      return sum;
    }
  };

  template <bool exact>
  void assemble(std::span<const double> temperature, const NodalConductivity& k,
                algebra::BlockMatrix& matrix) const {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Element e(*this, batch, temperature, k.value);
      ElementMatrix<n_nodes> m{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Lane* g = geometry_.gradients_at(batch, q);
        const Lane w = geometry_.weight_at(batch, q), wk = w * e.conductivity(q);
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t b = a; b < n_nodes; ++b) {
            Lane dot = g[a * dim] * g[b * dim];
            for (std::size_t i = 1; i < dim; ++i) dot += g[a * dim + i] * g[b * dim + i];
            m[a][b] += wk * dot;
          }
      }
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t b = 0; b < a; ++b) m[a][b] = m[b][a];
      if constexpr (exact)
        if (!conductivity_.constant()) add_slope(e, batch, k, m);
      scatter_matrix<n_nodes>(slots_.of(batch), m, matrix);
    }
  }

  /// The unsymmetric part: ∂k/∂Θ_b ∇N_a · ∇Θ.
  void add_slope(const Element& e, Index batch, const NodalConductivity& k, ElementMatrix<n_nodes>& m) const {
    Nodal nodal_slope{};
    if constexpr (interpolated) nodal_slope = gather<n_nodes>(geometry_, batch, k.slope);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Lane* g = geometry_.gradients_at(batch, q);
      const std::array<Lane, dim> gradient = e.gradient(g);
      Lane at_point(1.0);
      if constexpr (!interpolated) at_point = conductivity_.derivative(e.interpolate(e.t, q));
      for (std::size_t a = 0; a < n_nodes; ++a) {
        Lane flux = g[a * dim] * gradient[0];
        for (std::size_t i = 1; i < dim; ++i) flux += g[a * dim + i] * gradient[i];
        flux *= geometry_.weight_at(batch, q);
        for (std::size_t b = 0; b < n_nodes; ++b) {
          const Lane slope = interpolated ? nodal_slope[b] : at_point;
          m[a][b] += flux * slope * Lane(e.values(q)[b]);
        }
      }
    }
  }

  mesh::BlockGeometry geometry_;
  const Table& conductivity_;
  algebra::LaneSlots slots_;
};

}  // namespace

std::unique_ptr<ConductionBlock> make_conduction_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                                       AnalysisKind kind, const material::Material& material,
                                                       bool closed) {
  return for_shape(block.shape, [&]<int n, int dim>() -> std::unique_ptr<ConductionBlock> {
    constexpr bool linear = n == 3 || n == 4 || n == 8;  // quad8 and hex8 differ by dim
    if constexpr (linear && !(n == 8 && dim == 2))
      if (closed) return std::make_unique<Conduction<n, dim, true>>(mesh, block, kind, material, true);
    return std::make_unique<Conduction<n, dim, false>>(mesh, block, kind, material, closed);
  });
}

}  // namespace solidus::heat
