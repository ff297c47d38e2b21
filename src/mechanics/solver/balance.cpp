/// Bodies are grouped by common nodes; forces, residuals and steps are then summed group by group, so that
/// a heavy mould does not hide the imbalance of a small casting.
#include "mechanics/solver/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

// A body under thermal stress alone exchanges no forces: then this share of its internal forces is the
// reference.
constexpr double k_internal_share = 1e-6;
// A body that moves by less than this share of its extent is at rest: thermal strain of about 1 mK.
constexpr double k_at_rest = 1e-8;

// Bodies that share a node, directly or by way of others, get the same number.
std::vector<std::size_t> groups_of_bodies(const mesh::Mesh& mesh, const linear::ActiveSet& active) {
  const std::size_t n = mesh.bodies.size();
  // A node knows the first body that it was met in; every other body there touches that one.
  std::vector<int> touching(n * n, 0), first_body(mesh.x.size(), -1);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (!active.body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& first = first_body[as_size(node)];
      if (first < 0) first = block.body;
      touching[as_size(first) * n + as_size(block.body)] = 1;
    }
  }
  // Two bodies may share nodes on another process only.
  processes::largest(touching);
  std::vector<std::size_t> group(n);
  for (std::size_t b = 0; b < n; ++b) group[b] = b;
  // Groups that touch are joined, under the smaller of their numbers.
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      if (touching[a * n + b] == 0 || group[a] == group[b]) continue;
      const std::size_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
      std::replace(group.begin(), group.end(), from, to);
    }
  return group;
}

// Corner to corner, over all processes. Zero for a group without nodes.
std::vector<double> extents(const mesh::Mesh& mesh, std::span<const std::size_t> node_group,
                            std::size_t n_groups) {
  constexpr double k_none = -std::numeric_limits<double>::infinity();
  std::vector<double> all(6 * n_groups, k_none);  // the least, with the sign changed
  // Largest coordinates, and largest of the coordinates with their sign changed: one maximum over
  // processes gives both ends of each box.
  for (std::size_t i = 0; i < node_group.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      double* const of_group = &all[6 * node_group[i]];
      of_group[d] = std::max(of_group[d], mesh.x[i][d]);
      of_group[3 + d] = std::max(of_group[3 + d], -mesh.x[i][d]);
    }
  processes::largest(all);
  std::vector<double> extent(n_groups, 0.0);
  for (std::size_t g = 0; g < n_groups; ++g)
    if (all[6 * g] > k_none)
      extent[g] = std::hypot(all[6 * g] + all[6 * g + 3], all[6 * g + 1] + all[6 * g + 4],
                             all[6 * g + 2] + all[6 * g + 5]);
  return extent;
}

}  // namespace

BodyBalance::BodyBalance(const mesh::Mesh& mesh, const linear::ActiveSet& active, int components)
    : components_(components),
      body_group_(groups_of_bodies(mesh, active)),
      node_group_(as_size(mesh.n_owned_nodes), 0),
      n_groups_(mesh.bodies.size()),
      sums_(mesh.bodies.size()) {
  // Bodies that share nodes balance together.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (!active.body(block.body)) continue;
    for (const Index node : block.nodes)
      if (node < mesh.n_owned_nodes) node_group_[as_size(node)] = body_group_[as_size(block.body)];
  }
  extent_ = extents(mesh, node_group_, n_groups_);
}

void BodyBalance::begin() {
  std::fill(sums_.begin(), sums_.end(), Sums{});
}

void BodyBalance::add_internal(int body, double squares) {
  sums_[body_group_[as_size(body)]].internal += squares;
}

void BodyBalance::add_exchanged(std::span<const double> force) {
  for (std::size_t i = 0; i < force.size(); ++i)
    sums_[group_of_entry(i, components_)].exchanged += force[i] * force[i];
}

void BodyBalance::add_residual(std::span<const double> r, std::span<const char> fixed,
                               std::span<const char> supported) {
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (fixed[i] != 0 && supported[i] == 0) continue;
    Sums& sums = sums_[group_of_entry(i, components_)];
    (fixed[i] != 0 ? sums.exchanged : sums.residual) += r[i] * r[i];
  }
}

void BodyBalance::add_volume_residual(std::span<const double> r, int fields) {
  for (std::size_t i = 0; i < r.size(); ++i) sums_[group_of_entry(i, fields)].volume_residual += r[i] * r[i];
}

void BodyBalance::add_volume_change(std::span<const double> change, int fields) {
  for (std::size_t i = 0; i < change.size(); ++i)
    sums_[group_of_entry(i, fields)].volume_change += change[i] * change[i];
}

double BodyBalance::reference() {
  // The sums of squares of each group of bodies are added up over the processes, and the worst ratio of
  // residual to scale counts.
  std::vector<Sums> sums = sums_;
  static_assert(sizeof(Sums) == 5 * sizeof(double));
  processes::sum(std::span(reinterpret_cast<double*>(sums.data()), 5 * sums.size()));
  double squares = 0, worst = 0, largest = 0;
  const auto look = [&](double residual, double reference) {
    squares += residual;
    if (residual > 0)
      worst = std::max(worst, reference > 0 ? residual / reference : std::numeric_limits<double>::infinity());
  };
  for (const Sums& group : sums) {
    // The scale is what a body exchanges, and at least a share of its internal forces; for pressures it is
    // the change of volume.
    const double reference = std::max(group.exchanged, k_internal_share * k_internal_share * group.internal);
    largest = std::max(largest, reference);
    look(group.residual, reference);
    look(group.volume_residual, group.volume_change);
  }
  return worst > 0 ? std::sqrt(squares / worst) : std::sqrt(largest);
}

double BodyBalance::relative_step(std::span<const double> step, std::span<const double> increment) const {
  // The step of Newton's iteration is compared with the motion of the time step, group by group. A group that
  // hardly moves is compared with its extent instead.
  struct Squares {
    double step = 0, increment = 0, entries = 0;
  };
  // Squares of the step and of the increment, and the number of entries, by groups.
  std::vector<Squares> all(n_groups_);
  for (std::size_t i = 0; i < step.size(); ++i) {
    Squares& of_group = all[group_of_entry(i, components_)];
    of_group.step += step[i] * step[i];
    of_group.increment += increment[i] * increment[i];
    of_group.entries += 1;
  }
  static_assert(sizeof(Squares) == 3 * sizeof(double));
  processes::sum(std::span(reinterpret_cast<double*>(all.data()), 3 * n_groups_));
  double largest = 0;
  for (std::size_t g = 0; g < n_groups_; ++g) {
    // A group at rest has an increment of rounding; its extent is then the scale.
    const Squares& group = all[g];
    const double still = k_at_rest * extent_[g];
    const double least = still * still * group.entries / components_;
    if (group.step > 0) largest = std::max(largest, group.step / std::max(group.increment, least));
  }
  return std::sqrt(largest);
}

}  // namespace solidus::mechanics
