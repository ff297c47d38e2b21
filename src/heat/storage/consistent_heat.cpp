/// Point storage minus nodal storage: the difference is what the open rule adds next to bodies that keep
/// their heat at the nodes.
#include "heat/storage/consistent_heat.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

ConsistentHeat::ConsistentHeat(const mesh::Mesh& mesh,
                               const std::vector<std::unique_ptr<PointStorage>>& points, NodalEnthalpy nodes)
    : points_(points), nodes_(std::move(nodes)), from_(as_size(mesh.n_owned_nodes)), local_(mesh.x.size()) {}

void ConsistentHeat::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) {
  const bool first = stage.carried == 0;
  dt_ = stage.dt;
  on_ = true;
  // Heat at points and at nodes counts from the state before, or from the extrapolated first stage.
  for (const auto& block : points_) {
    if (first)
      block->start(before, stage.dt);
    else
      block->extrapolate(before, stage.carried);
  }
  // The heat at nodes from which the stage counts, extrapolated in the same way.
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const double heat = nodes_.upper(as_index(i), before[i]);
    from_[i] = first ? heat : from_[i] + stage.carried * (heat - from_[i]);
  }
}

void ConsistentHeat::add_residual(std::span<const double> temperature, std::span<double> r) {
  if (!on_) return;
  std::fill(local_.begin(), local_.end(), 0.0);
  for (const auto& block : points_) block->add_residual(temperature, local_);
  for (std::size_t i = 0; i < from_.size(); ++i)
    r[i] += local_[i] - (nodes_.upper(as_index(i), temperature[i]) - from_[i]) / dt_;
}

void ConsistentHeat::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) {
  if (!on_) return;
  for (const auto& block : points_) block->add_tangent(temperature, matrix);
  for (Index i = 0; i < nodes_.n_nodes(); ++i)
    *matrix.diagonal_block(i) -= nodes_.capacity(i, temperature[as_size(i)]) / dt_;
}

double HeatAtPoints::stored(std::span<const double> temperature) const {
  double sum = 0;
  for (const auto& block : points_) sum += block->stored(temperature);
  for (std::size_t i = 0; i < from_.size(); ++i) sum -= nodes_.upper(as_index(i), temperature[i]) - from_[i];
  return sum;
}

double HeatAtPoints::enthalpy(std::span<const double> temperature) const {
  double sum = 0;
  for (const auto& block : points_) sum += block->enthalpy(temperature);
  for (std::size_t i = 0; i < from_.size(); ++i) sum -= nodes_.upper(as_index(i), temperature[i]);
  return sum;
}

double HeatAtPoints::latent(std::span<const double> from, std::span<const double> to) const {
  double sum = 0;
  for (const auto& block : points_) sum += block->latent(from, to);
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const auto node = as_index(i);
    sum -= nodes_.latent(node, nodes_.upper(node, to[i]), to[i]) -
           nodes_.latent(node, nodes_.upper(node, from[i]), from[i]);
  }
  return sum;
}

EntropyChange HeatAtPoints::entropy_change(std::span<const double> from, std::span<const double> to) const {
  EntropyChange sum;
  // The entropy at points less that at nodes, since only the difference is stored here.
  for (const auto& block : points_) {
    const EntropyChange part = block->entropy_change(from, to);
    sum.change += part.change;
    sum.magnitude += part.magnitude;
  }
  for (std::size_t i = 0; i < from_.size(); ++i) {
    const auto node = as_index(i);
    const double before = nodes_.entropy(node, nodes_.upper(node, from[i]), from[i]);
    sum.change -= nodes_.entropy(node, nodes_.upper(node, to[i]), to[i]) - before;
    sum.magnitude += std::abs(before);
  }
  return sum;
}

}  // namespace solidus::heat
