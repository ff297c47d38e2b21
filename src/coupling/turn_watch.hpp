/// Whether solving a step again brings its heat and its gaps together.
#pragma once

#include <limits>

namespace solidus::coupling {

/// The iterations of a step can alternate between two states instead of settling: through a closed wall the
/// metal cools and shrinks off it, through the open one it stays warm and touches. Each of these costs an
/// equilibrium in which contact opens or closes, and gains nothing.
class TurnWatch {
 public:
  enum class Finding {
    nearer,  ///< one more iteration, in the same way
    round,   ///< one more iteration, through gaps between those of this one and those that it asks for
    stuck    ///< that has not helped either: no more
  };

  /// @param share  of the heat through interfaces that the gaps of the iteration just made have misplaced
  Finding after(double share) {
    constexpr double k_nearer = 0.75;  // of the iteration before; gaps that settle leave a half or less
    const bool nearer = share <= k_nearer * before_;
    before_ = share;
    if (nearer) return Finding::nearer;
    if (relaxed_) return Finding::stuck;
    relaxed_ = true;
    return Finding::round;
  }

 private:
  double before_ = std::numeric_limits<double>::infinity();
  bool relaxed_ = false;  ///< such an iteration has been made
};

}  // namespace solidus::coupling
