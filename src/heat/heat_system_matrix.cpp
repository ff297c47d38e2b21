/// The matrix of the heat system: in the temperatures, and symmetric in Kirchhoff's potential.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "heat/heat_system.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

void HeatSystem::assemble(std::span<const double> temperature) {
  assert((nodal_->identity() || matrix_->storage() == linear::BlockMatrix::Storage::whole) &&
         "it is not symmetric");
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (!exchange_) return;
  for (std::size_t b = 0; b < fields_.size(); ++b)
    for (const Index node : fields_[b].nodes) {
      const auto i = static_cast<std::size_t>(node);
      fields_[b].value[i] = potentials_[b].conductivity(temperature[i]);
    }
  for (std::size_t b = 0; b < conduction_.size(); ++b) {
    const auto body = static_cast<std::size_t>(mesh_.blocks[b].body);
    if (!active_.body(static_cast<int>(body))) continue;
    if (potentials_[body].constant())
      conduction(b).add_tangent(potentials_[body].reference(), {}, *matrix_);
    else
      conduction(b).add_tangent(1.0, fields_[body].value, *matrix_);
  }
  for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  if (limiter_) limiter_->add_tangent(temperature, *matrix_);
}

/// Assembles the part that does not change while the pattern stays. Without contributions the pattern changes
/// only where a body leaves: then the geometry of the elements, 137 bytes a node of tetrahedra, is not kept.
void HeatSystem::keep_conduction() {
  const auto n = static_cast<std::size_t>(matrix_->row_start().back());
  find_node_bodies();
  shared_.clear();
  kept_conduction_.assign(n, 0.0);
  if (limiter_) limiter_->clear();
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  for (std::size_t body = 0; body < potentials_.size(); ++body) {
    matrix_->set_zero();
    for (std::size_t b = 0; b < conduction_.size(); ++b) {
      if (mesh_.blocks[b].body != static_cast<int>(body) || !active_.body(static_cast<int>(body))) continue;
      conduction(b).add_tangent_once(1.0, *matrix_);
      if (contributions_.empty()) conduction_[b].reset();
    }
    if (limiter_) limiter_->add_body(static_cast<int>(body), *matrix_);
    const double* values = matrix_->block(0);
    for (std::size_t s = 0; s < n; ++s) kept_conduction_[s] += potentials_[body].reference() * values[s];
    if (node_body_.empty()) continue;
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
      if (node_body_[i] >= 0) continue;
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const Index j = columns[static_cast<std::size_t>(s)];
        if (values[s] != 0 && j != static_cast<Index>(i) && node_body_[static_cast<std::size_t>(j)] < 0)
          shared_.push_back({static_cast<Index>(i), j, static_cast<int>(body), values[s]});
      }
    }
  }
  if (limiter_) limiter_->finish(*matrix_);
}

void HeatSystem::find_node_bodies() {
  node_body_.clear();
  if (mesh_.bodies.size() == 1) return;
  constexpr int k_none = -2;
  node_body_.assign(mesh_.x.size(), k_none);
  for (const mesh::Block& block : mesh_.blocks) {
    if (!active_.body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& body = node_body_[static_cast<std::size_t>(node)];
      if (body == k_none) body = block.body;
      if (body != block.body) body = -1;
    }
  }
}

void HeatSystem::assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                                    const std::function<void(linear::BlockMatrix&)>& further) {
  if (exchange_ && kept_conduction_.empty()) keep_conduction();
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (exchange_)
    for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  if (further) further(*matrix_);
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  double* values = matrix_->block(0);
  if (!nodal_->identity()) {
    roots_.resize(slopes.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) roots_[i] = 1.0 / std::sqrt(slopes[i]);
    for (std::size_t row = 0; row + 1 < start.size(); ++row)
      for (std::int64_t s = start[row]; s < start[row + 1]; ++s)
        if (values[s] != 0)
          values[s] *= roots_[row] * roots_[static_cast<std::size_t>(columns[static_cast<std::size_t>(s)])];
  }
  if (exchange_)
    for (std::size_t s = 0; s < kept_conduction_.size(); ++s) values[s] += kept_conduction_[s];
  if (limiter_ && exchange_) limiter_->add_symmetric_tangent(*matrix_);
}

}  // namespace solidus::heat
