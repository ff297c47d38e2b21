/// Balance of work and memory over the processes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::results {

/// The largest value of a process over the mean of all; one is even, and one where all are zero. Collective.
double largest_over_mean(double mine);

/// For summary.json. Phases in which processes wait for each other are even in their seconds whatever they
/// compute: what counts are those without messages (assembly, residual).
struct Balance {
  /// Largest over mean of the nodes owned, of the elements computed, and of the seconds of each phase.
  std::vector<std::pair<std::string, double>> largest_over_mean;
  /// Elements at the seams that more than one process computes, as a share of all.
  double computed_again = 0;
};
/// @param seconds  by phase, of this process; the same phases on all. Collective.
Balance balance(const mesh::Mesh& mesh, const std::vector<std::pair<std::string, double>>& seconds);

}  // namespace solidus::results
