/// Sweeps of Gauss and Seidel's method over the nodes where the residual of a step is concentrated.
///
/// After the sweeps over all nodes (truncated_newton.hpp) most of Σ|F_i| is left at a few nodes, those that
/// the front of a phase change has reached: there the curves bend within the step of Newton's method. Which
/// of them freeze depends on their neighbours alone, and sweeps over these nodes find it out at a small part
/// of the cost of one more linear system. They lower the functional E as any sweep does.
#pragma once

#include <span>
#include <vector>

#include "algebra/block_matrix.hpp"

namespace solidus::heat {

/// What the relaxation of one node changes.
struct NodeChange {
  double potential = 0;  ///< v, the unknown of the matrix
  double stored = 0;     ///< (H − H*)/Δt [W]
};

class LocalSweeps {
 public:
  /// Chooses the nodes whose |F_i| is at least `share` of the mean over all nodes of all processes. Nodes
  /// beside those of other processes are left out: processes then do not disturb one another. Collective.
  /// @param residual  F, [owned node]; where `fixed` is not zero it does not count
  LocalSweeps(const algebra::BlockMatrix& matrix, std::span<const double> residual,
              std::span<const char> fixed, double share);

  double sum() const { return sum_; }  ///< Σ|F_i| over all processes before these sweeps [W]
  /// Returns |F_i| from which on nodes are chosen [W].
  double threshold() const { return threshold_; }

  /// Sweeps there and back `rounds` times.
  /// @param residual  F, [owned node]; that of the chosen nodes follows all changes, with the linear matrix
  /// @param relax     relax(node, F) balances the equation of an owned node for which F is given
  template <class Relax>
  void run(int rounds, std::span<double> residual, const Relax& relax) {
    for (int round = 0; round < rounds; ++round) {
      for (const std::size_t i : nodes_) ahead_[i] = residual[i];
      for (const std::size_t i : nodes_) {
        change_[i] = relax(i, ahead_[i]);
        if (change_[i].potential != 0) add_to_later(i, ahead_);
      }
      follow(residual);
      for (const std::size_t i : nodes_) change_[i] = {};
      for (std::size_t k = nodes_.size(); k-- > 0;) {
        const std::size_t i = nodes_[k];
        change_[i] = relax(i, residual[i] + of_later(i));
      }
      follow(residual);
    }
  }

 private:
  void add_to_later(std::size_t node, std::span<double> residual) const;
  double of_later(std::size_t node) const;
  void follow(std::span<double> residual);

  const algebra::BlockMatrix& matrix_;
  std::vector<std::size_t> nodes_;  ///< in rising order
  double sum_ = 0, threshold_ = 0;
  std::vector<NodeChange> change_;  ///< of the sweep of now, [owned node]
  std::vector<double> ahead_;       ///< F with the changes of earlier nodes, [owned node]
};

}  // namespace solidus::heat
