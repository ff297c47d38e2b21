/// Whether solving a step again brings its heat and its gaps together.
#pragma once

#include <limits>

namespace solidus::coupling {

/// The turns of a step can go round between two states instead of settling: through a closed wall the metal
/// cools and shrinks off it, through the open one it stays warm and touches. Each such turn costs an
/// equilibrium in which contact opens or closes, and gains nothing.
class TurnWatch {
 public:
  enum class Finding {
    nearer,  ///< a turn more, in the same way
    round,   ///< a turn more, through gaps between those of this turn and those that it asks for
    stuck    ///< that has not helped either: no more
  };

  /// @param share  of the heat through interfaces that the gaps of the turn just made have misplaced
  Finding after(double share) {
    constexpr double k_nearer = 0.75;  // of the turn before; gaps that settle leave a half or less
    const bool nearer = share <= k_nearer * before_;
    before_ = share;
    if (nearer) return Finding::nearer;
    if (relaxed_) return Finding::stuck;
    relaxed_ = true;
    return Finding::round;
  }

 private:
  double before_ = std::numeric_limits<double>::infinity();
  bool relaxed_ = false;  ///< such a turn has been made
};

}  // namespace solidus::coupling
