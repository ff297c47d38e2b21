#include "mechanics/balance.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidus::mechanics {

namespace {

// A body under thermal stress alone exchanges no forces: then this share of its internal forces is the
// reference.
constexpr double k_internal_share = 1e-6;

// Bodies that share a node, directly or by way of others, get the same number.
std::vector<std::size_t> groups_of_bodies(const mesh::Mesh& mesh, const algebra::Presence& presence) {
  const std::size_t n = mesh.bodies.size();
  std::vector<int> touching(n * n, 0), first_body(mesh.x.size(), -1);
  for (const mesh::Block& block : mesh.blocks) {
    if (!presence.body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& first = first_body[static_cast<std::size_t>(node)];
      if (first < 0) first = block.body;
      touching[static_cast<std::size_t>(first) * n + static_cast<std::size_t>(block.body)] = 1;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, touching.data(), static_cast<int>(touching.size()), MPI_INT, MPI_MAX,
                PETSC_COMM_WORLD);
  std::vector<std::size_t> group(n);
  for (std::size_t b = 0; b < n; ++b) group[b] = b;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      if (touching[a * n + b] == 0 || group[a] == group[b]) continue;
      const std::size_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
      std::replace(group.begin(), group.end(), from, to);
    }
  return group;
}

}  // namespace

BodyBalance::BodyBalance(const mesh::Mesh& mesh, const algebra::Presence& presence, int components)
    : components_(components),
      body_group_(groups_of_bodies(mesh, presence)),
      node_group_(static_cast<std::size_t>(mesh.n_owned_nodes), 0),
      n_groups_(mesh.bodies.size()),
      sums_(mesh.bodies.size()) {
  for (const mesh::Block& block : mesh.blocks) {
    if (!presence.body(block.body)) continue;
    for (const Index node : block.nodes)
      if (node < mesh.n_owned_nodes)
        node_group_[static_cast<std::size_t>(node)] = body_group_[static_cast<std::size_t>(block.body)];
  }
}

void BodyBalance::begin() {
  std::fill(sums_.begin(), sums_.end(), Sums{});
}

void BodyBalance::add_internal(int body, double squares) {
  sums_[body_group_[static_cast<std::size_t>(body)]].internal += squares;
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
  std::vector<Sums> sums(sums_.size());
  static_assert(sizeof(Sums) == 5 * sizeof(double));
  MPI_Allreduce(sums_.data(), sums.data(), static_cast<int>(5 * sums.size()), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
  double squares = 0, worst = 0, largest = 0;
  const auto look = [&](double residual, double reference) {
    squares += residual;
    if (residual > 0)
      worst = std::max(worst, reference > 0 ? residual / reference : std::numeric_limits<double>::infinity());
  };
  for (const Sums& group : sums) {
    const double reference = std::max(group.exchanged, k_internal_share * k_internal_share * group.internal);
    largest = std::max(largest, reference);
    look(group.residual, reference);
    look(group.volume_residual, group.volume_change);
  }
  return worst > 0 ? std::sqrt(squares / worst) : std::sqrt(largest);
}

}  // namespace solidus::mechanics
