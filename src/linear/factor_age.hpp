/// Decides whether the factors of one tangent are used as preconditioner for the next one of the same Newton
/// iteration. Near the solution contact and yielding hardly change between iterations, so that a few
/// directions of GMRES with the old factors are enough, while new factors cost as much as about thirty
/// directions in three dimensions and ten in two.
#pragma once

namespace solidus::linear {

class FactorAge {
 public:
  /// Directions after which the old factors are given up: half of the cost of new ones.
  static constexpr int patience(int dimension) { return dimension == 3 ? 14 : 6; }

  /// There are no factors, or they must not be used again.
  void forget() { made_ = old_ = false; }
  /// Factors have been computed for the present matrix.
  void renew() {
    made_ = true;
    old_ = false;
  }
  /// The present matrix is solved with factors of an earlier one.
  void keep() { old_ = true; }
  /// Whether the factors are those of an earlier matrix.
  bool old() const { return old_; }
  /// Whether they may be used for the next matrix: the residual has fallen since the previous solve, as it
  /// does between iterations, while that of a new step begins higher.
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
