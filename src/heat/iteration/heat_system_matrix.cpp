/// The matrix of the heat system: in the temperatures, and symmetric in Kirchhoff's potential.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "heat/iteration/heat_system.hpp"
#include "mesh/block_part.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

void HeatSystem::assemble(std::span<const double> temperature) {
  assert((nodal_->identity() || matrix_->storage() == linear::BlockMatrix::Storage::whole) &&
         "it is not symmetric");
  // The matrix of the temperature formulation: contributions first, then conduction with the conductivity at
  // the nodes.
  keep_conduction_apart();
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (!exchange_) return;
  // Conductivities are evaluated once for the nodes of each body whose table needs it.
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    if (!fields_[b].nodes.empty()) fields_[b].value.resize(mesh_.x.size());
    for (const Index node : fields_[b].nodes) {
      const auto i = static_cast<std::size_t>(node);
      fields_[b].value[i] = potentials_[b].conductivity(temperature[i]);
    }
  }
  // A constant conductivity is a factor of the whole block.
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

/// Assembles the part that does not change while the pattern stays. It stays in the matrix, but for the
/// diagonal, where other terms have no entries beside that: 8 bytes an entry less than a copy. Without
/// contributions the pattern changes only where a body leaves: then the geometry of the elements, 183 bytes a
/// node of tetrahedra, is made for some of them at a time and not kept.
void HeatSystem::keep_conduction() {
  const auto n = static_cast<std::size_t>(matrix_->row_start().back());
  find_node_bodies();
  shared_.clear();
  const bool one_body = potentials_.size() == 1;
  kept_conduction_.assign(one_body ? 0 : n, 0.0);
  if (limiter_) limiter_->clear();
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  for (std::size_t body = 0; body < potentials_.size(); ++body) {
    matrix_->set_zero();
    for (std::size_t b = 0; b < conduction_.size(); ++b) {
      if (mesh_.blocks[b].body != static_cast<int>(body) || !active_.body(static_cast<int>(body))) continue;
      if (contributions_.empty() && !conduction_[b])
        mesh::for_parts(mesh_.blocks[b], [&](const mesh::ElementBlock& part, Index) {
          make_conduction_block(mesh_, part, kind_, closed_, edges_)->add_tangent_once(1.0, *matrix_);
        });
      else
        conduction(b).add_tangent_once(1.0, *matrix_);
    }
    if (limiter_) limiter_->add_body(static_cast<int>(body), *matrix_);
    double* const values = matrix_->block(0);
    for (std::size_t s = 0; s < n; ++s) {
      const double entry = potentials_[body].reference() * values[s];
      if (one_body)
        values[s] = entry;
      else
        kept_conduction_[s] += entry;
    }
    if (node_body_.empty()) continue;
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
      if (node_body_[i] >= 0) continue;
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const Index j = columns[static_cast<std::size_t>(s)];
        if (values[s] != 0 && node_body_[static_cast<std::size_t>(j)] < 0)
          shared_.push_back({static_cast<Index>(i), j, static_cast<int>(body), values[s], s});
      }
    }
  }
  if (limiter_) limiter_->finish(*matrix_);
  if (parallel::any_process(std::ranges::any_of(node_body_, [](int body) { return body < 0; })))
    keeps_apart_ = true;
  if (!one_body) std::copy(kept_conduction_.begin(), kept_conduction_.end(), matrix_->block(0));
  std::vector<double>().swap(kept_conduction_);
  kept_diagonal_.resize(static_cast<std::size_t>(mesh_.n_owned_nodes));
  for (std::size_t i = 0; i < kept_diagonal_.size(); ++i)
    kept_diagonal_[i] = *matrix_->diagonal_block(static_cast<Index>(i));
  if (!only_diagonal_beside_conduction()) keep_conduction_apart();
}

void HeatSystem::forget_conduction() {
  std::vector<double>().swap(kept_conduction_);
  std::vector<double>().swap(kept_diagonal_);
}

/// Whether terms other than conduction add to the diagonal alone; on this process.
bool HeatSystem::only_diagonal_beside_conduction() const {
  return !keeps_apart_ && contributions_.empty() && !(limiter_ && limiter_->needed()) &&
         std::ranges::all_of(surfaces_, [](const SurfaceHeat& s) { return s.diagonal(); });
}

/// Copies conduction out of the matrix, which gets further terms beside its diagonal.
void HeatSystem::keep_conduction_apart() {
  keeps_apart_ = true;
  if (kept_diagonal_.empty()) return;
  for (std::size_t i = 0; i < kept_diagonal_.size(); ++i)
    *matrix_->diagonal_block(static_cast<Index>(i)) = kept_diagonal_[i];
  const double* const values = matrix_->block(0);
  kept_conduction_.assign(values, values + matrix_->row_start().back());
  std::vector<double>().swap(kept_diagonal_);
}

/// ∂r/∂v where the matrix keeps conduction: its diagonal is found again.
void HeatSystem::assemble_diagonal(std::span<const double> temperature, std::span<const double> slopes) {
  for (std::size_t i = 0; i < kept_diagonal_.size(); ++i) *matrix_->diagonal_block(static_cast<Index>(i)) = 0;
  for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  for (std::size_t i = 0; i < kept_diagonal_.size(); ++i) {
    double& diagonal = *matrix_->diagonal_block(static_cast<Index>(i));
    if (!nodal_->identity()) diagonal /= slopes[i];
    diagonal += kept_diagonal_[i];
  }
}

void HeatSystem::find_node_bodies() {
  node_body_.clear();
  if (mesh_.bodies.size() == 1) return;
  constexpr int k_none = -2;
  node_body_.assign(mesh_.x.size(), k_none);
  // The one body of each node, or none where several share it.
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (!active_.body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& body = node_body_[static_cast<std::size_t>(node)];
      if (body == k_none) body = block.body;
      if (body != block.body) body = -1;
    }
  }
}

/// Notes by how much the derivative differs from an entry beside the diagonal and, where the matrix keeps
/// half of itself, from its mirror image.
/// @param exact, mirrored  the derivatives there
void HeatSystem::note_unsymmetric(Index row, Index column, double entry, double exact, double mirrored) {
  constexpr double k_rounding = 1e-12;
  const double threshold = k_rounding * std::abs(entry);
  if (std::abs(exact - entry) > threshold) unsymmetric_.push_back({row, column, exact - entry});
  if (matrix_->storage() == linear::BlockMatrix::Storage::upper && column < mesh_.n_owned_nodes &&
      std::abs(mirrored - entry) > threshold)
    unsymmetric_.push_back({column, row, mirrored - entry});
}

/// Replaces S = ∂r/∂Θ in the matrix by c^-1/2 S c^-1/2.
void HeatSystem::scale_by_slopes(std::span<const double> slopes) {
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  double* values = matrix_->block(0);
  const auto root = [&](Index i) { return 1.0 / std::sqrt(slopes[static_cast<std::size_t>(i)]); };
  for (std::size_t row = 0; row + 1 < start.size(); ++row)
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s) {
      double& value = values[s];
      if (value == 0) continue;
      const Index column = columns[static_cast<std::size_t>(s)];
      const double by_row = root(static_cast<Index>(row)), by_column = root(column), of_t = value;
      value *= by_row * by_column;
      if (column != static_cast<Index>(row))
        note_unsymmetric(static_cast<Index>(row), column, value, of_t * by_column * by_column,
                         of_t * by_row * by_row);
    }
}

void HeatSystem::add_kept_conduction(std::span<const double> temperature, std::span<const double> slopes,
                                     SharedNodes shared) {
  // With one body, or where shared nodes are taken as plain ones, the kept matrix is added as it is.
  double* values = matrix_->block(0);
  if (nodal_->identity() || node_body_.empty() || shared == SharedNodes::plain) {
    for (std::size_t s = 0; s < kept_conduction_.size(); ++s) values[s] += kept_conduction_[s];
    return;
  }
  const auto factor = [&](int body, Index node) {
    const auto i = static_cast<std::size_t>(node);
    const KirchhoffPotential& u = potentials_[static_cast<std::size_t>(body)];
    return u.conductivity(temperature[i]) / (u.reference() * slopes[i]);
  };
  const auto add = [&](linear::BlockMatrix::Slot slot, Index i, Index j, double k, double g_i, double g_j) {
    const double entry = k * std::sqrt(g_i * g_j);
    values[slot] += entry;
    if (i != j) note_unsymmetric(i, j, entry, k * g_j, k * g_i);
  };
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  // Else entries to shared nodes scale with the conductivity of the body over the slope of the shared curve;
  // symmetric ones take the geometric mean.
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    const auto i = static_cast<Index>(row);
    const int own = node_body_[row];
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s) {
      const Index j = columns[static_cast<std::size_t>(s)];
      const int other = node_body_[static_cast<std::size_t>(j)], body = own >= 0 ? own : other;
      if (body < 0) continue;  // below
      // A ghost may belong to further bodies whose elements are not here: its slope tells.
      const double kept = kept_conduction_[static_cast<std::size_t>(s)];
      const bool plain = own >= 0 && other >= 0 && j < mesh_.n_owned_nodes;
      if (plain)
        values[s] += kept;
      else
        add(s, i, j, kept, own >= 0 ? 1.0 : factor(body, i), factor(body, j));
    }
  }
  for (const SharedPair& pair : shared_)
    add(pair.slot, pair.i, pair.j, pair.k * potentials_[static_cast<std::size_t>(pair.body)].reference(),
        factor(pair.body, pair.i), factor(pair.body, pair.j));
}

void HeatSystem::assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                                    const std::function<void(linear::BlockMatrix&)>& further,
                                    SharedNodes shared) {
  // The symmetric matrix of Kirchhoff's potential: conduction is kept from step to step, so that only the
  // diagonal changes where nothing else adds to it.
  if (exchange_ && !keeps_conduction()) keep_conduction();
  unsymmetric_.clear();
  if (!kept_diagonal_.empty() && exchange_ && !further && only_diagonal_beside_conduction())
    return assemble_diagonal(temperature, slopes);
  // Otherwise all parts are assembled, and scaled from temperature to potential.
  keep_conduction_apart();
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (exchange_)
    for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  if (further) further(*matrix_);
  if (!nodal_->identity()) scale_by_slopes(slopes);
  if (exchange_) add_kept_conduction(temperature, slopes, shared);
  if (limiter_ && exchange_) limiter_->add_symmetric_tangent(*matrix_);
}

}  // namespace solidus::heat
