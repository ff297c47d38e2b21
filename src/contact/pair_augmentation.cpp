/// Multipliers of the augmented Lagrangian of a contact pair, from the penetrations of its nodes.
#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>

#include "contact/fixed_kinematics.hpp"
#include "contact/mechanics_term.hpp"
#include "contact/pair.hpp"
#include "contact/sliding_kinematics.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

std::vector<double> ContactPair::nodal_penetration() const {
  std::vector<double> weight(mesh_.x.size(), 0.0), mean(mesh_.x.size(), 0.0);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    const PointState& point = now_.points[at(p)];
    if (point.status == PointStatus::open) continue;
    const ContactKinematics::Particle particle = kinematics_->particle(p);
    for (std::size_t b = 0; b < particle.nodes.size(); ++b) {
      const double w = particle.weight * particle.share[b] * particle.share[b];
      weight[at(particle.nodes[b])] += w;
      mean[at(particle.nodes[b])] += w * point.penetration;
    }
  }
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = weight[i] > 0 ? mean[i] / weight[i] : 0.0;
  parallel::GhostExchange(mesh_).update(mean, 1);
  return mean;
}

void ContactPair::accelerate(const std::vector<double>& penetration) {
  constexpr double k_longest = 30;
  if (last_penetration_.size() != penetration.size()) {
    step_factor_.assign(penetration.size(), 1.0);
  } else {
    for (std::size_t i = 0; i < penetration.size(); ++i) {
      const double last = last_penetration_[i], fallen = last - penetration[i];
      const double ratio = fallen != 0 ? last / fallen : 1.0;
      step_factor_[i] = ratio > 0 ? std::clamp(step_factor_[i] * ratio, 1.0, k_longest) : 1.0;
    }
  }
  last_penetration_ = penetration;
}

void ContactPair::augment() {
  if (law_.normal.kind != NormalKind::augmented_lagrangian || !active_) return;
  const std::vector<double> penetration = nodal_penetration();
  accelerate(penetration);
  if (start_traction_.empty())
    for (const PointState& from : step_.from) start_traction_.push_back(from.traction);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    PointState& from = step_.from[at(p)];
    const ContactKinematics::Particle particle = kinematics_->particle(p);
    double mean = 0;
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      mean += particle.share[b] * step_factor_[at(particle.nodes[b])] * penetration[at(particle.nodes[b])];
    if (now_.points[at(p)].status == PointStatus::open)
      from.multiplier = least_multiplier(from);
    else
      from.multiplier = std::max(least_multiplier(from), from.multiplier + law_.normal.penalty * mean);
    from.traction = now_.points[at(p)].traction;
  }
}

double ContactPair::excess() const {
  if (law_.normal.kind != NormalKind::augmented_lagrangian || !active_) return 0;
  double largest = 0;
  for (const double g : nodal_penetration()) largest = std::max(largest, std::abs(g));
  largest = parallel::global_max(largest);
  if (!spec_.pressure_tolerance) return largest / allowed_penetration_;
  double pressure = 0;
  for (const PointState& point : now_.points) pressure = std::max(pressure, point.pressure);
  const double allowed = *spec_.pressure_tolerance * parallel::global_max(pressure) / law_.normal.penalty;
  return allowed > 0 ? largest / allowed : 0;
}

std::string ContactPair::worst_penetration() const {
  const std::vector<double> penetration = nodal_penetration();
  struct {
    double value;
    int rank;
  } worst{-1.0, 0}, winner{};
  MPI_Comm_rank(PETSC_COMM_WORLD, &worst.rank);
  std::size_t node = 0;
  for (std::size_t i = 0; i < penetration.size(); ++i) {
    if (std::abs(penetration[i]) <= worst.value) continue;
    worst.value = std::abs(penetration[i]);
    node = i;
  }
  MPI_Allreduce(&worst, &winner, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  char text[160] = {};
  if (winner.rank == worst.rank && !penetration.empty()) {
    const mesh::Point& x = mesh_.x[node];
    fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) m: penetration {:.3g} m", mesh_.input_node[node], x[0],
                x[1], x[2], penetration[node])
        .copy(text, sizeof text - 1);
  }
  MPI_Bcast(text, sizeof text, MPI_CHAR, winner.rank, PETSC_COMM_WORLD);
  return text;
}

}  // namespace solidus::contact
