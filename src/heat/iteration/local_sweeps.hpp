/// Sweeps of Gauss and Seidel's method over the nodes where the residual of a step is concentrated.
///
/// After the sweeps over all nodes (truncated_newton.hpp) most of Σ|F_i| is left at few nodes, those that the
/// front of a phase change has reached: there the curves bend within the step of Newton's method. Which of
/// them freeze depends on their neighbours alone, and sweeps over these nodes find it out at a small part of
/// the cost of one more linear system. They lower the functional E as any sweep does.
///
/// With several processes each sweeps over its own nodes, all at the same time. A node that couples with
/// nodes of other processes has Σ|A_ij| over those added to A_ii, with which E falls whatever their changes
/// are (truncated_newton.hpp); after each round the residuals follow the changes that were made elsewhere.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

/// Changes that the relaxation of one node makes.
struct NodeChange {
  double potential = 0;  ///< v, the unknown of the matrix
  double stored = 0;     ///< (H − H*)/Δt [W]
};

class LocalSweeps {
 public:
  /// Chooses the nodes whose |F_i| is at least the mean over all nodes of all processes. Collective.
  /// @param matrix    A, symmetric
  /// @param residual  F, [owned node]; where `fixed` is not zero it does not count
  /// @param ghosts    of the mesh; must outlive this object
  LocalSweeps(const linear::BlockMatrix& matrix, std::span<const double> residual,
              std::span<const char> fixed, const parallel::GhostExchange& ghosts);

  double sum() const { return sum_; }  ///< Σ|F_i| over all processes before these sweeps [W]

  /// Sweeps there and back, as long as some |F_i| is above that mean, but at most six times. Collective.
  /// @param relax  NodeChange relax(std::size_t node, double residual) balances the equation of a node whose
  ///               F is given, with Σ|A_ij| over nodes of other processes added to A_ii
  template <class Relax>
  void run(const Relax& relax) {
    for (int round = 0; round < k_rounds; ++round) {
      bool changed = false;
      const auto visit = [&](std::size_t k) {
        if (std::abs(residual_[k]) <= mean_) return;
        const NodeChange change = relax(nodes_[k], residual_[k]);
        residual_[k] += change.stored;
        for (std::uint32_t s = start_[k]; s < start_[k + 1]; ++s)
          residual_[neighbours_[s].position] += static_cast<double>(neighbours_[s].entry) * change.potential;
        if (!change_.empty()) change_[nodes_[k]] += change.potential;
        changed = true;
      };
      for (std::size_t k = 0; k < nodes_.size(); ++k) visit(k);
      for (std::size_t k = nodes_.size(); k-- > 0;) visit(k);
      if (!parallel::any_process(changed)) return;
      if (!change_.empty()) follow_other_processes();
    }
  }

 private:
  static constexpr int k_rounds = 6;
  struct Neighbour {
    std::uint32_t position;  ///< among the chosen nodes
    float entry;             ///< of the matrix: F is evaluated again after these sweeps
  };
  /// An entry of a chosen node's row whose column belongs to another process.
  struct Coupling {
    std::uint32_t position;  ///< of the row among the chosen nodes
    Index ghost;             ///< local node
    float entry;
  };
  void copy_rows(const linear::BlockMatrix& matrix, std::size_t n_owned);
  void copy_couplings(const linear::BlockMatrix& matrix, std::size_t n_owned);
  void follow_other_processes();

  const parallel::GhostExchange& ghosts_;
  std::vector<std::uint32_t> nodes_;   ///< chosen, in rising order
  std::vector<double> residual_;       ///< F of now, [chosen node]
  std::vector<std::uint32_t> start_;   ///< of the neighbours of each chosen node, itself included
  std::vector<Neighbour> neighbours_;  ///< that are chosen too
  std::vector<Coupling> couplings_;    ///< with nodes of other processes
  std::vector<double> change_;         ///< of v in this round, [local node]; empty: there is one process
  double sum_ = 0, mean_ = 0;
};

}  // namespace solidus::heat
