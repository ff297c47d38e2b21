/// Forcing term of an inexact Newton method: the relative tolerance η of the linear solve, ‖r + A d‖ <= η
/// ‖r‖.
///
///   η_0 = 0.01,  η_k = γ (‖r_k‖/‖r_{k−1}‖)^α          choice 2 of Eisenstat and Walker
///   η_k = max(η_k, goal/(10 ‖r_k‖)),  η_k <= η_max    goal: the ‖r‖ that ends the iteration
///
/// An iteration so goes about as far as its tangent is good for, and the last one no further than it must: to
/// a tenth of the goal, since the residual that is left is an energy that the first law misses. With
/// η_max <= 0.1 the safeguard of the paper, γ η_{k−1}^α where that exceeds 0.1, never acts.
///
/// S. C. Eisenstat, H. F. Walker, SIAM J. Sci. Comput. 17 (1996) 16. The second line, with a half for the
/// tenth: C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations (SIAM 1995), 6.3.
#pragma once

namespace solidus::linear {

class Forcing {
 public:
  /// @param inexact  false: every system is solved as far as the linear solver goes
  /// @param loosest  η_max, 0.1 at most: the smaller, the more an iteration costs besides the linear solver
  Forcing(bool inexact, double loosest) : inexact_(inexact), loosest_(loosest) {}

  /// η of the next linear system; zero for as far as the solver goes.
  /// @param norm  ‖r‖, or another measure whose fall from iteration to iteration is that of the residual
  /// @param goal  the ‖r‖ that ends the iteration over that of now, in the norm of the linear solver
  double next(double norm, double goal);

 private:
  bool inexact_;
  double loosest_;
  double norm_ = 0;  ///< of the iteration before, zero at first
};

}  // namespace solidus::linear
