/// Conduction of each body is assembled by itself, so that nodes of several bodies can tell their shares.
#include "heat/conduction/kept_conduction.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

KeptConduction::KeptConduction(const mesh::Mesh& mesh, ConductionElements& elements)
    : mesh_(mesh), elements_(elements) {}

void KeptConduction::bind(linear::BlockMatrix& matrix) {
  matrix_ = &matrix;
  forget();
}

/// Limits belong to a matrix: with them switched on or off it is assembled again.
void KeptConduction::limit(bool on) {
  if (on == (limiter_ != nullptr)) return;
  limiter_.reset();
  forget();
  if (on) limiter_ = std::make_unique<ConductionLimiter>(mesh_, elements_.potentials());
}

void KeptConduction::forget() {
  std::vector<double>().swap(kept_);
  std::vector<double>().swap(diagonal_);
}

void KeptConduction::keep() {
  // With one body the sum is built in the matrix itself; with several it needs an array of its own, since the
  // matrix holds one body at a time.
  if (kept()) return;
  const auto n = as_size(matrix_->row_start().back());
  find_node_bodies();
  shared_.clear();
  const std::span<const KirchhoffPotential> potentials = elements_.potentials();
  const bool one_body = potentials.size() == 1;
  kept_.assign(one_body ? 0 : n, 0.0);
  if (limiter_) limiter_->clear();
  // The matrix of each body in turn, with its mean conductivity.
  for (std::size_t body = 0; body < potentials.size(); ++body) {
    matrix_->set_zero();
    elements_.add_unit(static_cast<int>(body));
    if (limiter_) limiter_->add_body(static_cast<int>(body), *matrix_);
    double* const values = matrix_->block(0);
    for (std::size_t s = 0; s < n; ++s) {
      const double entry = potentials[body].reference() * values[s];
      if (one_body)
        values[s] = entry;
      else
        kept_[s] += entry;
    }
    if (!node_body_.empty()) find_shared_pairs(static_cast<int>(body));
  }
  if (limiter_) limiter_->finish(*matrix_);
  if (parallel::any_process(std::ranges::any_of(node_body_, [](int body) { return body < 0; })))
    apart_ = true;
  // The sum goes back into the matrix, and is copied out again where other terms need the room.
  if (!one_body) std::copy(kept_.begin(), kept_.end(), matrix_->block(0));
  std::vector<double>().swap(kept_);
  diagonal_.resize(as_size(mesh_.n_owned_nodes));
  for (std::size_t i = 0; i < diagonal_.size(); ++i) diagonal_[i] = *matrix_->diagonal_block(as_index(i));
  if (!only_diagonal_beside()) keep_apart();
}

/// The entries of the matrix, which holds one body, between nodes of several.
void KeptConduction::find_shared_pairs(int body) {
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  const double* const values = matrix_->block(0);
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    if (node_body_[i] >= 0) continue;
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const Index j = columns[as_size(s)];
      if (values[s] != 0 && node_body_[as_size(j)] < 0)
        shared_.push_back({as_index(i), j, body, values[s], s});
    }
  }
}

/// Whether all other terms of the matrix are on its diagonal, so that conduction can stay in the matrix from
/// iteration to iteration.
bool KeptConduction::only_diagonal_beside() const {
  return !apart_ && others_diagonal_ && !(limiter_ && limiter_->needed());
}

/// Copies conduction out of the matrix, which other terms are going to fill.
void KeptConduction::keep_apart() {
  apart_ = true;
  if (diagonal_.empty()) return;
  for (std::size_t i = 0; i < diagonal_.size(); ++i) *matrix_->diagonal_block(as_index(i)) = diagonal_[i];
  const double* const values = matrix_->block(0);
  kept_.assign(values, values + matrix_->row_start().back());
  std::vector<double>().swap(diagonal_);
}

void KeptConduction::find_node_bodies() {
  node_body_.clear();
  if (mesh_.bodies.size() == 1) return;
  constexpr int k_none = -2;
  node_body_.assign(mesh_.x.size(), k_none);
  // The one body of each node, or none where several share it.
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (!elements_.active().body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& body = node_body_[as_size(node)];
      if (body == k_none) body = block.body;
      if (body != block.body) body = -1;
    }
  }
}

std::span<double> KeptConduction::flow(std::span<const double> temperature) {
  keep();
  // The potential of each body, over its mean conductivity.
  const std::span<const KirchhoffPotential> potentials = elements_.potentials();
  std::vector<const double*> potential(potentials.size());
  std::vector<double> factor(potentials.size(), 1.0);
  for (std::size_t b = 0; b < potentials.size(); ++b) {
    potential[b] = elements_.potential(b, temperature);
    if (!potentials[b].constant()) factor[b] = 1.0 / potentials[b].reference();
  }
  flow_.assign(mesh_.x.size(), 0.0);
  const bool half = matrix_->storage() == linear::BlockMatrix::Storage::upper;
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  const double* const entries = kept_.empty() ? matrix_->block(0) : kept_.data();
  // The diagonal adds nothing. Rows of ghosts are scrap.
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    const int own = node_body_.empty() ? 0 : node_body_[i];
    double sum = 0;
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = as_size(columns[as_size(s)]);
      const int body = own >= 0 ? own : node_body_[j];
      if (body < 0) continue;
      const auto b = as_size(body);
      const double flow = entries[s] * (factor[b] * (potential[b][j] - potential[b][i]));
      sum += flow;
      if (half) flow_[j] -= flow;
    }
    flow_[i] += sum;
  }
  // Pairs of nodes that both belong to several bodies: each body has its own conductance and potential there.
  for (const SharedPair& pair : shared_) {
    const auto i = as_size(pair.i), j = as_size(pair.j), b = as_size(pair.body);
    const double k = pair.k * potentials[b].reference();
    const double flow = k * (factor[b] * (potential[b][j] - potential[b][i]));
    flow_[i] += flow;
    if (half) flow_[j] -= flow;
  }
  return flow_;
}

bool KeptConduction::assemble_diagonal(std::span<const double> slopes,
                                       const std::function<void()>& add_others) {
  if (diagonal_.empty() || !only_diagonal_beside()) return false;
  // The other terms are derivatives by temperature: a division makes them those by the potential.
  for (std::size_t i = 0; i < diagonal_.size(); ++i) *matrix_->diagonal_block(as_index(i)) = 0;
  add_others();
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    double& diagonal = *matrix_->diagonal_block(as_index(i));
    if (!elements_.nodal().identity()) diagonal /= slopes[i];
    diagonal += diagonal_[i];
  }
  return true;
}

void KeptConduction::add(std::span<const double> temperature, std::span<const double> slopes,
                         SharedNodes shared, UnsymmetricPart& rest) const {
  // With one body, or where shared nodes are taken as plain ones, the kept matrix is added as it is.
  double* values = matrix_->block(0);
  if (elements_.nodal().identity() || node_body_.empty() || shared == SharedNodes::plain) {
    for (std::size_t s = 0; s < kept_.size(); ++s) values[s] += kept_[s];
    return;
  }
  const auto factor = [&](int body, Index node) {
    const auto i = as_size(node);
    const KirchhoffPotential& u = elements_.potentials()[as_size(body)];
    return u.conductivity(temperature[i]) / (u.reference() * slopes[i]);
  };
  const auto add = [&](linear::BlockMatrix::Slot slot, Index i, Index j, double k, double g_i, double g_j) {
    const double entry = k * std::sqrt(g_i * g_j);
    values[slot] += entry;
    if (i != j) rest.note(*matrix_, mesh_.n_owned_nodes, i, j, entry, k * g_j, k * g_i);
  };
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  // Else entries to shared nodes scale with the conductivity of the body over the slope of the shared curve;
  // symmetric ones take the geometric mean.
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    const auto i = as_index(row);
    const int own = node_body_[row];
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s) {
      const Index j = columns[as_size(s)];
      const int other = node_body_[as_size(j)], body = own >= 0 ? own : other;
      if (body < 0) continue;  // below
      // A ghost may belong to further bodies whose elements are not here: its slope tells.
      const double kept = kept_[as_size(s)];
      const bool plain = own >= 0 && other >= 0 && j < mesh_.n_owned_nodes;
      if (plain)
        values[s] += kept;
      else
        add(s, i, j, kept, own >= 0 ? 1.0 : factor(body, i), factor(body, j));
    }
  }
  for (const SharedPair& pair : shared_)
    add(pair.slot, pair.i, pair.j, pair.k * elements_.potentials()[as_size(pair.body)].reference(),
        factor(pair.body, pair.i), factor(pair.body, pair.j));
}

void KeptConduction::release_work() {
  std::vector<double>().swap(flow_);
  elements_.release_work();
}

std::size_t KeptConduction::bytes() const {
  std::size_t total = (flow_.capacity() + kept_.capacity() + diagonal_.capacity()) * sizeof(double) +
                      node_body_.capacity() * sizeof(int) + shared_.capacity() * sizeof(SharedPair);
  if (limiter_) total += limiter_->bytes();
  return total;
}

}  // namespace solidus::heat
