#include "coupling/body_norm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "algebra/parallel.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::coupling {

namespace {

double diagonal_of(const mesh::Mesh& mesh) {
  double square = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : mesh.x) {
      low = std::min(low, x[k]);
      high = std::max(high, x[k]);
    }
    const double extent = algebra::global_max(high) - algebra::global_min(low);
    square += extent * extent;
  }
  return std::sqrt(square);
}

}  // namespace

BodyNorm::BodyNorm(const mesh::Mesh& mesh, AnalysisKind kind)
    : n_bodies_(mesh.bodies.size()), n_nodes_(mesh.x.size()), diagonal_(diagonal_of(mesh)) {
  const auto n_owned = static_cast<std::size_t>(mesh.n_owned_nodes);
  std::vector<std::vector<double>> weight(n_bodies_, std::vector<double>(n_owned, 0.0));
  for (const mesh::Block& block : mesh.blocks) {
    const PackVector<Lane> nodal = mesh::nodal_weights(mesh, block, kind);
    const auto n_nodes = static_cast<std::size_t>(mesh::node_count(block.shape));
    for (Index e = 0; e < block.size(); ++e)
      for (std::size_t a = 0; a < n_nodes; ++a) {
        // Every element at an owned node is here, so its weight is whole without the other processes.
        const Index node = block.element(e)[a];
        if (node < mesh.n_owned_nodes)
          weight[static_cast<std::size_t>(block.body)][static_cast<std::size_t>(node)] +=
              nodal[static_cast<std::size_t>(e / k_lanes) * n_nodes + a][static_cast<int>(e % k_lanes)];
      }
  }
  for (std::size_t b = 0; b < n_bodies_; ++b) {
    const double volume = algebra::global_sum(std::accumulate(weight[b].begin(), weight[b].end(), 0.0));
    for (std::size_t i = 0; i < n_owned; ++i)
      if (weight[b][i] > 0)
        shares_.push_back({static_cast<Index>(i), static_cast<int>(b), weight[b][i] / volume});
  }
}

double BodyNorm::operator()(std::span<const double> values, std::span<const char> counts) const {
  const std::size_t width = n_nodes_ > 0 ? values.size() / n_nodes_ : 0;
  std::vector<double> square(n_bodies_, 0.0);
  for (const Share& share : shares_) {
    if (!counts.empty() && counts[static_cast<std::size_t>(share.node)] == 0) continue;
    for (std::size_t k = 0; k < width; ++k) {
      const double v = values[static_cast<std::size_t>(share.node) * width + k];
      square[static_cast<std::size_t>(share.body)] += share.weight * v * v;
    }
  }
  double largest = 0;
  for (const double s : square) {
    const double sum = algebra::global_sum(s);
    if (std::isnan(sum)) return sum;
    largest = std::max(largest, sum);
  }
  return std::sqrt(largest);
}

double BodyNorm::mean(std::span<const double> values) const {
  std::vector<double> sum(n_bodies_, 0.0);
  for (const Share& share : shares_)
    sum[static_cast<std::size_t>(share.body)] += share.weight * values[static_cast<std::size_t>(share.node)];
  double largest = 0;
  for (const double s : sum) {
    const double mean = std::abs(algebra::global_sum(s));
    if (std::isnan(mean)) return mean;
    largest = std::max(largest, mean);
  }
  return largest;
}

}  // namespace solidus::coupling
