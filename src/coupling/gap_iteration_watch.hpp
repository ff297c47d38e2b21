/// Whether solving a step again brings its heat and its gaps together.
#pragma once

#include <limits>

namespace solidus::coupling {

/// The fixed-point iteration of a step between gaps and heat can alternate between two states instead of
/// converging: through a closed wall the metal
/// cools and shrinks off it, through the open one it stays warm and touches. Each such iteration costs an
/// equilibrium in which contact opens or closes, and gains nothing.
class GapIterationWatch {
 public:
  enum class Finding {
    nearer,   ///< one more iteration, in the same way
    between,  ///< one more, through gaps between those of this iteration and those that it leads to
    stuck     ///< that has not helped either: no more
  };

  /// @param share  of the heat through interfaces that the gaps of the last iteration have misplaced
  Finding after(double share) {
    constexpr double k_nearer = 0.75;  // of the iteration before; gaps that converge leave a half or less
    const bool nearer = share <= k_nearer * before_;
    before_ = share;
    if (nearer) return Finding::nearer;
    if (relaxed_) return Finding::stuck;
    relaxed_ = true;
    return Finding::between;
  }

 private:
  double before_ = std::numeric_limits<double>::infinity();
  bool relaxed_ = false;  ///< such an iteration has been made
};

}  // namespace solidus::coupling
