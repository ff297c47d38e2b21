/// Pairs of nodes with an entry of the wrong sign are listed once for each body; per solve the flows of
/// these pairs are summed into and out of each node, compared with what the node may take, and limited in
/// proportion.
#include "heat/conduction/conduction_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

constexpr double k_rounding = 1e-12;  ///< K_ij over the diagonal that is an entry of zero
constexpr double k_supply = 20.0;     ///< c: large enough for linear fields at surfaces with a flux
/// Differences of temperature [K] below which a field counts as even, and nothing is let through: what
/// rounding and tolerances leave must not decide over the flows of a front that arrives.
constexpr double k_noise = 1e-4;
constexpr double k_reserve = 1.5;  ///< γ over the least value for linear fields
constexpr double k_least_factor = 0.25, k_largest_factor = 4.0;  ///< of γ

double value(const KirchhoffPotential& u, double temperature) {
  return u.constant() ? u.reference() * temperature : u.value(temperature);
}

}  // namespace

ConductionLimiter::ConductionLimiter(const mesh::Mesh& mesh, std::span<const KirchhoffPotential> potentials)
    : mesh_(mesh), potentials_(potentials), ghosts_(mesh), held_(mesh, nodes_) {}

void ConductionLimiter::clear() {
  bodies_.clear();
  nodes_.clear();
}

void ConductionLimiter::add_body(int body, linear::BlockMatrix& matrix) {
  // A pair of nodes needs a limit where its entry of the conduction matrix is positive, beyond rounding
  // against the smaller of the two diagonals.
  const auto n = as_size(mesh_.n_owned_nodes);
  std::vector<double> diagonal(mesh_.x.size());
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = *matrix.diagonal_block(as_index(i));
  ghosts_.update(diagonal, 1);
  const std::span<const std::int64_t> start = matrix.row_start();
  const std::span<const Index> columns = matrix.columns();
  Body of_body{body, {}, {}};
  for (std::size_t i = 0; i < n; ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const Index j = columns[as_size(s)];
      const double k = *matrix.block(s);
      if (j > as_index(i) && k > k_rounding * std::min(diagonal[i], diagonal[as_size(j)]))
        of_body.pairs.push_back({as_index(i), j, k, s, matrix.slot(j, as_index(i))});
    }
  of_body.pairs.shrink_to_fit();
  // Diagonals are kept for the bounds.
  for (std::size_t i = 0; i < n; ++i)
    if (diagonal[i] > 0) of_body.diagonal.push_back({as_index(i), diagonal[i]});
  bodies_.push_back(std::move(of_body));
}

void ConductionLimiter::finish(const linear::BlockMatrix& matrix) {
  // Nodes that have a pair with a positive entry on any body take part; all others need no share and no
  // bounds. Whether there is anything to limit is decided by all processes together, because finding shares
  // is collective.
  const auto n = as_size(mesh_.n_owned_nodes);
  std::vector<char> has_pairs(mesh_.x.size(), 0);
  std::size_t n_pairs = 0;
  for (const Body& body : bodies_) {
    n_pairs += body.pairs.size();
    for (const Pair& p : body.pairs) has_pairs[as_size(p.i)] = has_pairs[as_size(p.j)] = 1;
  }
  needed_ = parallel::any_process(n_pairs > 0);
  quadratic_ = parallel::any_process(
      std::any_of(mesh_.blocks.begin(), mesh_.blocks.end(),
                  [](const mesh::ElementBlock& b) { return mesh::order(b.shape) == 2; }));
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    if (has_pairs[as_size(i)] != 0) nodes_.push_back(i);
  // The diagonal is kept at nodes with pairs alone, since only their bounds are computed.
  for (Body& body : bodies_) {
    std::erase_if(body.diagonal, [&](const Diagonal& d) { return has_pairs[as_size(d.node)] == 0; });
    body.diagonal.shrink_to_fit();
  }
  if (!needed_) {
    bodies_.clear();
    return;
  }
  // Storage for bounds, sums and shares is made once here; two numbers a node are for what may flow in and
  // out.
  highest_.resize(n);
  lowest_.resize(n);
  sums_.resize(2 * n);
  shares_.assign(2 * mesh_.x.size(), 1.0);
  left_.assign(n_pairs, 0.0);
  held_.release();
  matrix_ = &matrix;
  find_factors();
}

/// γ_i: the largest P over Σ K_ii [u(max) − u_i] of linear fields, over a set of directions of their
/// gradient. A direction that leads out of the body has no limit, because no neighbour is hotter there.
void ConductionLimiter::find_factors() {
  constexpr double k_outward = 0.1;  ///< of the longest edge
  const auto n = as_size(mesh_.n_owned_nodes);
  // The neighbours of every owned node, from half of the matrix or all of it.
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  const auto for_pairs = [&](auto f) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const Index j = columns[as_size(s)];
        if (j > as_index(i)) f(as_index(i), j);
      }
  };
  std::vector<std::int64_t> count(n + 1, 0);
  const auto owned = [&](Index j) { return j < mesh_.n_owned_nodes; };
  for_pairs([&](Index i, Index j) {
    ++count[as_size(i) + 1];
    if (owned(j)) ++count[as_size(j) + 1];
  });
  // Rows of neighbours in one array: counts become starts, then the pairs are filled in.
  for (std::size_t i = 1; i <= n; ++i) count[i] += count[i - 1];
  std::vector<Index> neighbours(as_size(count[n]));
  std::vector<std::int64_t> next(count.begin(), count.end() - 1);
  for_pairs([&](Index i, Index j) {
    neighbours[as_size(next[as_size(i)]++)] = j;
    if (owned(j)) neighbours[as_size(next[as_size(j)]++)] = i;
  });
  // Flows of the pairs at the reference conductivity, and the diagonal that bounds them.
  std::vector<std::vector<std::pair<Index, double>>> partners(n);
  std::vector<double> diagonal(n, 0.0);
  for (const Body& body : bodies_) {
    const double kappa = potentials_[as_size(body.body)].reference();
    for (const Pair& p : body.pairs) {
      partners[as_size(p.i)].emplace_back(p.j, kappa * p.k);
      if (owned(p.j)) partners[as_size(p.j)].emplace_back(p.i, kappa * p.k);
    }
    for (const Diagonal& d : body.diagonal) diagonal[as_size(d.node)] += kappa * d.k;
  }
  gamma_.assign(n, k_least_factor);
  const auto minus = [&](Index j, Index i) {
    mesh::Point d = mesh_.x[as_size(j)];
    for (std::size_t k = 0; k < 3; ++k) d[k] -= mesh_.x[as_size(i)][k];
    return d;
  };
  const auto dot = [](const mesh::Point& a, const mesh::Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  std::vector<mesh::Point> edges;
  for (const Index i : nodes_) {
    edges.clear();
    double longest = 0;
    for (std::int64_t s = count[as_size(i)]; s < count[as_size(i) + 1]; ++s) {
      edges.push_back(minus(neighbours[as_size(s)], i));
      longest = std::max(longest, std::sqrt(dot(edges.back(), edges.back())));
    }
    // Of a linear field with the gradient g: the neighbours' highest rise `reach`, and what the
    // pairs draw from the node, `pull`.
    double needed = 0;
    const auto look = [&](const mesh::Point& g) {
      double reach = 0, pull = 0;
      for (const mesh::Point& d : edges) reach = std::max(reach, dot(g, d));
      if (reach <= k_outward * longest * std::sqrt(dot(g, g))) return;
      for (const auto& [j, k] : partners[as_size(i)]) pull += k * std::max(0.0, -dot(g, minus(j, i)));
      needed = std::max(needed, pull / (diagonal[as_size(i)] * reach));
    };
    // Directions are those of the edges and of the axes with their diagonals: among them one is
    // close to the worst.
    for (const mesh::Point& d : edges) {
      look(d);
      look({-d[0], -d[1], -d[2]});
    }
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0)
            look({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    // The reserve makes up for directions between those that were looked at.
    gamma_[as_size(i)] = std::clamp(k_reserve * needed, k_least_factor, k_largest_factor);
  }
}

void ConductionLimiter::find_extremes(std::span<const double> temperature) {
  // The highest and lowest temperature around each node, over its row. Of a matrix stored by halves each
  // entry serves both of its nodes.
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  for (std::size_t i = 0; i < highest_.size(); ++i) highest_[i] = lowest_[i] = temperature[i];
  for (std::size_t i = 0; i < highest_.size(); ++i) {
    const double here = temperature[i];
    double high = highest_[i], low = lowest_[i];
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = as_size(columns[as_size(s)]);
      const double there = temperature[j];
      high = std::max(high, there);
      low = std::min(low, there);
      if (j > i && j < highest_.size()) {
        highest_[j] = std::max(highest_[j], here);
        lowest_[j] = std::min(lowest_[j], here);
      }
    }
    highest_[i] = high;
    lowest_[i] = low;
  }
}

template <class F>
void ConductionLimiter::for_flows(std::span<const double> temperature, const F& f) const {
  std::size_t position = 0;
  for (const Body& body : bodies_) {
    const KirchhoffPotential& u = potentials_[as_size(body.body)];
    for (const Pair& p : body.pairs) {
      const double ti = temperature[as_size(p.i)], tj = temperature[as_size(p.j)];
      f(position++, p, p.k * (u.constant() ? u.reference() * (ti - tj) : u.value(ti) - u.value(tj)));
    }
  }
}

bool ConductionLimiter::find_shares(std::span<const double> temperature, std::span<const double> gain,
                                    std::span<const double> loss, std::span<const char> fixed,
                                    double negligible, std::span<LimitedFlow* const> flows) {
  if (!needed_) return false;
  // Σ of all limited flows into (2 i) and out of (2 i + 1) each node: P⁺ and P⁻ of a flux-corrected
  // transport.
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for_flows(temperature, [&](std::size_t, const Pair& p, double flow) {
    const std::size_t i = 2 * as_size(p.i), j = 2 * as_size(p.j);
    sums_[flow > 0 ? i : i + 1] += std::abs(flow);
    if (j < sums_.size()) sums_[flow > 0 ? j + 1 : j] += std::abs(flow);
  });
  // Flows of surfaces count along, since they are limited together with those of pairs.
  for (const LimitedFlow* f : flows) {
    const std::size_t from = 2 * as_size(f->from) + (f->heat > 0 ? 1 : 0),
                      to = 2 * as_size(f->to) + (f->heat > 0 ? 0 : 1);
    if (from < sums_.size()) sums_[from] += std::abs(f->heat);
    if (to < sums_.size()) sums_[to] += std::abs(f->heat);
  }
  find_extremes(temperature);
  // What a node may gain at most without passing its neighbours (Q⁺, Q⁻): first what its
  // surroundings supply,
  for (const Index node : nodes_) {
    const std::size_t i = as_size(node);
    shares_[2 * i] = k_supply * gain[i];
    shares_[2 * i + 1] = k_supply * loss[i];
  }
  // then what flows of the monotone part allow, γ K_ii (u_max − u_i).
  for (const Body& body : bodies_) {
    const KirchhoffPotential& u = potentials_[as_size(body.body)];
    for (const Diagonal& d : body.diagonal) {
      const std::size_t i = as_size(d.node);
      const double here = value(u, temperature[i]), factor = gamma_[i] * d.k;
      shares_[2 * i] += factor * std::max(value(u, highest_[i]) - here, 0.0);
      shares_[2 * i + 1] += factor * std::max(here - value(u, lowest_[i]), 0.0);
      // Where flows are rounding the quotient would jump from one evaluation to the next.
      const double noise = k_noise * d.k * u.reference();
      if (sums_[2 * i] > 0) sums_[2 * i] += noise;
      if (sums_[2 * i + 1] > 0) sums_[2 * i + 1] += noise;
    }
  }
  // The share of a node is Q/P; nodes with a prescribed temperature need no bound, and nodes that
  // are held take nothing.
  for (const Index node : nodes_) {
    const std::size_t i = as_size(node);
    for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
      shares_[k] = sums_[k] > 0 ? std::min(1.0, shares_[k] / sums_[k]) : 0.0;
      if (quadratic_) shares_[k] = 1;
      if (held_.holds(k)) shares_[k] = 0;
      if (fixed[i] != 0) shares_[k] = 1;
    }
  }
  // A flow takes the smaller share of its two nodes, of which one may be another process's.
  ghosts_.update(shares_, 2);
  // Where nothing flows yet the direction is unknown, and the processes of the two nodes must agree: the
  // smaller share of both directions is taken.
  const auto left_of = [&](const Pair& p, double flow) {
    const std::size_t i = 2 * as_size(p.i), j = 2 * as_size(p.j);
    const double into_i = std::min(shares_[i], shares_[j + 1]), into_j = std::min(shares_[i + 1], shares_[j]);
    return 1.0 - (flow > 0 ? into_i : flow < 0 ? into_j : std::min(into_i, into_j));
  };
  const auto left_of_flow = [&](const LimitedFlow& f) {
    const std::size_t from = 2 * as_size(f.from), to = 2 * as_size(f.to);
    return 1.0 -
           (f.heat > 0 ? std::min(shares_[from + 1], shares_[to]) : std::min(shares_[from], shares_[to + 1]));
  };
  // The change that the new shares make is measured in watt before they are taken.
  double change = 0;
  for_flows(temperature, [&](std::size_t position, const Pair& p, double flow) {
    change += std::abs((left_of(p, flow) - left_[position]) * flow) * (p.j < mesh_.n_owned_nodes ? 1.0 : 0.5);
  });
  for (const LimitedFlow* f : flows)
    if (f->from < mesh_.n_owned_nodes) change += std::abs((left_of_flow(*f) - f->left) * f->heat);
  if (!(parallel::global_sum(change) > negligible)) return false;
  for (LimitedFlow* f : flows) f->left = left_of_flow(*f);
  for_flows(temperature,
            [&](std::size_t position, const Pair& p, double flow) { left_[position] = left_of(p, flow); });
  return true;
}

HeldNodes::Found HeldNodes::hold(std::span<const double> temperature, double lowest, double highest) {
  if (held_.empty()) held_.assign(2 * as_size(mesh_.n_owned_nodes), 0);
  auto found = Found::none;
  // A node that is out of bounds once is held on that side from then on.
  for (const Index node : nodes_) {
    const std::size_t i = as_size(node);
    if (temperature[i] >= lowest && temperature[i] <= highest) continue;
    char& now = held_[2 * i + (temperature[i] > highest ? 0 : 1)];
    found = std::max(found, now == 0 ? Found::further : Found::as_before);
    now = 1;
  }
  // A process may have held none: the answer is the strongest of all.
  return static_cast<Found>(static_cast<int>(parallel::global_max(static_cast<int>(found))));
}

void ConductionLimiter::add_heat(std::span<const double> temperature, std::span<double> r) const {
  if (!needed_) return;
  for_flows(temperature, [&](std::size_t position, const Pair& p, double flow) {
    r[as_size(p.i)] += left_[position] * flow;
    if (p.j < mesh_.n_owned_nodes) r[as_size(p.j)] -= left_[position] * flow;
  });
}

template <class F>
void ConductionLimiter::for_held(const F& f) const {
  if (!needed_) return;
  std::size_t position = 0;
  for (const Body& body : bodies_) {
    const KirchhoffPotential& u = potentials_[as_size(body.body)];
    for (const Pair& p : body.pairs) {
      const double left = left_[position++];
      if (left != 0) f(u, p, left);
    }
  }
}

void ConductionLimiter::add_symmetric_tangent(linear::BlockMatrix& matrix) const {
  for_held([&](const KirchhoffPotential& u, const Pair& p, double left) {
    const double held = left * u.reference() * p.k;
    *matrix.block(p.ij) -= held;
    *matrix.block(p.ji) -= held;
    *matrix.diagonal_block(p.i) += held;
    if (p.j < mesh_.n_owned_nodes) *matrix.diagonal_block(p.j) += held;
  });
}

void ConductionLimiter::add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const {
  for_held([&](const KirchhoffPotential& u, const Pair& p, double left) {
    // What is left of each pair as a flow between two potentials, by its slopes.
    const auto slope = [&](Index node) {
      return left * p.k * (u.constant() ? u.reference() : u.conductivity(temperature[as_size(node)]));
    };
    const double of_i = slope(p.i), of_j = slope(p.j);
    *matrix.block(p.ij) -= of_j;
    *matrix.block(p.ji) -= of_i;
    *matrix.diagonal_block(p.i) += of_i;
    if (p.j < mesh_.n_owned_nodes) *matrix.diagonal_block(p.j) += of_j;
  });
}

std::size_t ConductionLimiter::bytes() const {
  std::size_t total = 0;
  for (const Body& body : bodies_)
    total += body.pairs.capacity() * sizeof(Pair) + body.diagonal.capacity() * sizeof(Diagonal);
  for (const auto* v : {&gamma_, &highest_, &lowest_, &sums_, &shares_, &left_})
    total += v->capacity() * sizeof(double);
  return total + nodes_.capacity() * sizeof nodes_[0] + held_.bytes();
}

}  // namespace solidus::heat
