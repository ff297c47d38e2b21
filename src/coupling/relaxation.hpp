/// Relaxation of a fixed-point iteration x ← F(x):
///
///   x ← x + ω r,   r = F(x) − x
///
/// ω fixed, or from the last two changes (Aitken's Δ², for vectors: B. Irons, R. C. Tuck, A version of the
/// Aitken accelerator for computer iteration, Int. J. Numer. Meth. Engng 1 (1969) 275–277):
///
///   ω ← −ω r_old · (r − r_old) / |r − r_old|²
///
/// which minimises |r_old + (r − r_old) s| over s: exact after one pair where r has one mode only. It is also
/// the second step length of Barzilai and Borwein for the linear system r(x) = 0, with which they converge
/// where −∂r/∂x is symmetric positive definite (M. Raydan, IMA J. Numer. Anal. 13 (1993) 321–326).
#pragma once

#include <span>
#include <vector>

namespace solidus::coupling {

struct RelaxationOptions {
  enum class Kind { none, fixed, aitken };
  Kind kind = Kind::none;
  double factor = 1;  ///< ω of `fixed`, the first one of `aitken`
};

class Relaxation {
 public:
  explicit Relaxation(RelaxationOptions options) : options_(options) {}

  /// Forgets: a new iteration begins.
  void begin();
  /// ω for this change.
  /// @param change  r of the owned nodes; collective with Aitken
  double factor(std::span<const double> change);

  /// Aitken's factor stays within these: about an optimum for a coupling number of twenty below, and above
  /// the largest with which both kinds of passes converge (docs/theory/coupling.md).
  static constexpr double k_least = 0.05, k_largest = 4.0 / 3.0;

 private:
  RelaxationOptions options_;
  bool first_ = true;
  double factor_ = 0;
  std::vector<double> last_;  ///< r of the call before
};

}  // namespace solidus::coupling
