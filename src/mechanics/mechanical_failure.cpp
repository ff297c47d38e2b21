/// Describes where and why a step of the mechanical phase fails, for messages.
#include <fmt/format.h>
#include <mpi.h>

#include <cmath>

#include "mechanics/block_kernel.hpp"
#include "mechanics/loads.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

void MechanicalPhase::reject(const std::string& reason, std::span<const double> x) {
  if (const std::string failure = law_failure(x); !failure.empty())
    throw StepRejected("mechanics: a constitutive law asks for a smaller step", failure);
  throw StepRejected("mechanics: " + reason + flowing_body(x), worst_place(x));
}

/// The body that flows in the largest part of its volume at x, where that is more than k_mechanism: its
/// forces have a limit, beyond which there is no equilibrium. Empty where none does.
std::string MechanicalPhase::flowing_body(std::span<const double> x) const {
  constexpr double k_mechanism = 0.25;
  std::vector<double> sums(2 * mesh_.bodies.size(), 0.0);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const FlowingVolume volume = blocks_[b]->flowing(x.first(n_displacements()));
    const auto body = static_cast<std::size_t>(mesh_.blocks[b].body);
    sums[2 * body] += volume.flowing;
    sums[2 * body + 1] += volume.all;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
  double largest = k_mechanism;
  std::string text;
  for (std::size_t body = 0; body < mesh_.bodies.size(); ++body) {
    const double share = sums[2 * body + 1] > 0 ? sums[2 * body] / sums[2 * body + 1] : 0.0;
    if (share <= largest) continue;
    largest = share;
    text = fmt::format("; {:.0f} % of body '{}' flows plastically: at its limit load?", 100 * share,
                       mesh_.bodies[body].name);
  }
  return text;
}

std::string MechanicalPhase::worst_place(std::span<const double> x) {
  std::vector<double> r(n_residuals());
  residual(x, r);
  r.resize(n_forces());
  matrix_->constraints().sum(r);
  struct {
    double value;
    int rank;
  } worst{-1.0, 0}, winner{};
  MPI_Comm_rank(PETSC_COMM_WORLD, &worst.rank);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double size = std::isfinite(r[i]) ? std::abs(r[i]) : HUGE_VAL;
    if (loads_->fixed()[i] || size <= worst.value) continue;
    worst.value = size;
    entry = i;
  }
  MPI_Allreduce(&worst, &winner, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  char text[160] = {};
  if (winner.rank == worst.rank && !r.empty()) {
    const std::size_t node = entry / static_cast<std::size_t>(components_);
    const mesh::Point& p = mesh_.x[node];
    fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) m: unbalanced force {:.4g} N", mesh_.input_node[node],
                p[0], p[1], p[2], r[entry])
        .copy(text, sizeof text - 1);
  }
  MPI_Bcast(text, sizeof text, MPI_CHAR, winner.rank, PETSC_COMM_WORLD);
  return text;
}

/// The first element whose law finds no state at x, of the lowest process that has one; empty without any.
std::string MechanicalPhase::law_failure(std::span<const double> x) const {
  std::string text;
  for (std::size_t b = 0; b < blocks_.size() && text.empty(); ++b) {
    text = blocks_[b]->failure(x.first(n_displacements()));
    if (!text.empty())
      text = fmt::format("body '{}', {}", mesh_.bodies[static_cast<std::size_t>(mesh_.blocks[b].body)].name,
                         text);
  }
  int rank = 0, n_processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  const int mine = text.empty() ? n_processes : rank;
  int first = n_processes;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
  if (first == n_processes) return {};
  auto size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, first, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, first, PETSC_COMM_WORLD);
  return text;
}

}  // namespace solidus::mechanics
