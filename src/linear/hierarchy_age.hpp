/// Decides whether a multigrid hierarchy made for one matrix is used for the next one too. The setup costs as
/// much as twenty iterations or more: it is repeated if the matrix has become several times stiffer at some
/// node (stiffness_growth.hpp), or if a solve takes 1.5 times as many iterations per digit as the first one
/// with this hierarchy, and a few more.
#pragma once

#include <algorithm>
#include <cmath>

#include "linear/linear_solver.hpp"
#include "linear/stiffness_growth.hpp"

namespace solidus::linear {

class HierarchyAge {
 public:
  /// Whether the next solve needs a new one.
  bool stale() const { return stale_; }
  void renew() { stale_ = true; }
  /// Whether a solve with this matrix needs a new one. Collective.
  bool stale_for(BlockMatrix& a) {
    constexpr double k_stiffer = 5;
    if (!stale_ && growth_.since(a) > k_stiffer) stale_ = true;
    return stale_;
  }
  /// One has been made for this matrix.
  void made_for(BlockMatrix& a) { growth_.remember(a); }
  /// After a solve with it. Since tolerances differ, iterations are counted per digit of reduction.
  /// @param reduction  requested reduction of the residual
  void judge(const LinearReport& report, double reduction) {
    constexpr double k_slower = 0.5, k_more_iterations = 4;
    const double digits = std::max(0.1, -std::log10(reduction));
    if (stale_) first_rate_ = report.iterations / digits;
    const double expected = first_rate_ * digits;
    stale_ =
        !report.converged || report.iterations > expected + std::max(k_slower * expected, k_more_iterations);
  }

 private:
  bool stale_ = true;
  StiffnessGrowth growth_;
  double first_rate_ = 0;  ///< iterations per digit with a new hierarchy
};

}  // namespace solidus::linear
