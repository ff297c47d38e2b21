/// Decides whether the factors of one tangent precondition the next one of the same Newton iteration. Near
/// the solution contact and yield hardly change from one iteration to the next, so that a few directions of
/// GMRES do with the factors that are there, while new ones cost as much as some thirty of them in three
/// dimensions and ten in the plane.
#pragma once

namespace solidus::linear {

class FactorAge {
 public:
  /// Directions after which the factors of before are given up: half of what new ones cost.
  static constexpr int patience(int dimension) { return dimension == 3 ? 14 : 6; }

  /// There are no factors, or nothing of the past shall count.
  void forget() { made_ = old_ = false; }
  /// Factors have been made for the matrix of now.
  void renew() {
    made_ = true;
    old_ = false;
  }
  /// The matrix of now is solved with factors of an earlier one.
  void keep() { old_ = true; }
  /// Whether the factors are those of an earlier matrix.
  bool old() const { return old_; }
  /// Whether they may serve the next matrix: the residual has fallen since the solve before, as it does from
  /// iteration to iteration, while that of a new step begins higher.
  /// @param norm  of the right-hand side, the same on every process
  bool may_serve(double norm) {
    const bool falls = norm < norm_;
    norm_ = norm;
    return made_ && falls;
  }

 private:
  bool made_ = false, old_ = false;
  double norm_ = 0;  ///< of the last right-hand side
};

}  // namespace solidus::linear
