/// Gradients are averaged over each element once; strains are then sums over its nodes, eight elements at a
/// time.
#include "criteria/element_strain.hpp"

#include <array>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::criteria {

ElementStrain::ElementStrain(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind) {
  mesh::BlockGeometry g(mesh, block, kind, mesh::stiffness_rule(block.shape));
  n_nodes_ = g.n_nodes;
  dim_ = g.dim;
  // Sizes come first, then arrays with their entries ordered [batch][node of the element], in lanes.
  axisymmetric_ = kind == AnalysisKind::axisymmetric;
  n_elements_ = g.n_elements;
  n_batches_ = g.n_batches;
  const auto n = as_size(n_nodes_), dim = as_size(dim_), points = as_size(g.n_points);
  const std::size_t entries = as_size(n_batches_) * n;
  gradient_.assign(entries * dim, Lane(0.0));
  hoop_.assign(axisymmetric_ ? entries : 0, Lane(0.0));
  share_.assign(entries, Lane(0.0));
  volume_.assign(as_size(n_batches_), Lane(0.0));
  // Gradients, hoop terms and shape functions are averaged over each element, weighted by volume.
  for (Index batch = 0; batch < n_batches_; ++batch) {
    Lane volume(0.0);
    for (int q = 0; q < g.n_points; ++q) volume += g.weight_at(batch, q);
    volume_[as_size(batch)] = volume;
    const std::size_t first = as_size(batch) * n;
    for (std::size_t q = 0; q < points; ++q) {
      // Padding has no volume.
      const Lane weight = g.weight_at(batch, static_cast<int>(q));
      const Lane w =
          select(volume > Lane(0.0), weight / select(volume > Lane(0.0), volume, Lane(1.0)), Lane(0.0));
      const Lane* gradients = g.gradients_at(batch, static_cast<int>(q));
      for (std::size_t a = 0; a < n; ++a) {
        // Shape functions give means of nodal values; over the radius they give the hoop strain.
        const Lane value = w * Lane(g.values[q * n + a]);
        share_[first + a] += value;
        if (axisymmetric_) hoop_[first + a] += value * g.inverse_radius[as_size(batch) * points + q];
        for (std::size_t i = 0; i < dim; ++i) gradient_[(first + a) * dim + i] += w * gradients[a * dim + i];
      }
    }
  }
  nodes_ = std::move(g.nodes);
}

namespace {

Lane gather(std::span<const double> field, const Index* nodes, std::size_t width, std::size_t component) {
  Lane value;
  for (int lane = 0; lane < k_lanes; ++lane) value.set(lane, field[as_size(nodes[lane]) * width + component]);
  return value;
}

}  // namespace

Sym<Lane> ElementStrain::strain(std::span<const double> displacement, Index batch) const {
  constexpr int k_place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // in Sym
  const auto dim = as_size(dim_);
  const std::size_t first = as_size(batch) * as_size(n_nodes_);
  Sym<Lane> strain;
  // Symmetric gradient of the displacement with mean gradients; the hoop strain is u_r over the radius.
  for (std::size_t a = 0; a < as_size(n_nodes_); ++a) {
    const Index* of_node = nodes(batch) + a * k_lanes;
    for (std::size_t i = 0; i < dim; ++i) {
      const Lane u = gather(displacement, of_node, dim, i);
      for (std::size_t j = 0; j < dim; ++j)
        strain[k_place[i][j]] += Lane(i == j ? 1.0 : 0.5) * u * gradient_[(first + a) * dim + j];
      if (axisymmetric_ && i == 0) strain[2] += u * hoop_[first + a];
    }
  }
  return strain;
}

Lane ElementStrain::mean(std::span<const double> nodal, Index batch) const {
  const std::size_t first = as_size(batch) * as_size(n_nodes_);
  Lane mean(0.0);
  for (std::size_t a = 0; a < as_size(n_nodes_); ++a)
    mean += share_[first + a] * gather(nodal, nodes(batch) + a * k_lanes, 1, 0);
  return mean;
}

Lane ElementStrain::gradient(std::span<const double> nodal, Index batch) const {
  const auto dim = as_size(dim_);
  const std::size_t first = as_size(batch) * as_size(n_nodes_);
  std::array<Lane, 3> sum{Lane(0.0), Lane(0.0), Lane(0.0)};
  for (std::size_t a = 0; a < as_size(n_nodes_); ++a) {
    const Lane value = gather(nodal, nodes(batch) + a * k_lanes, 1, 0);
    for (std::size_t i = 0; i < dim; ++i) sum[i] += value * gradient_[(first + a) * dim + i];
  }
  return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

std::size_t ElementStrain::bytes() const {
  return nodes_.capacity() * sizeof(Index) +
         (gradient_.capacity() + hoop_.capacity() + share_.capacity() + volume_.capacity()) * sizeof(Lane);
}

}  // namespace solidus::criteria
