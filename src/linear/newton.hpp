/// Newton's method with line search on one or more nodal fields.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "linear/linear_solver.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {

struct NewtonOptions {
  double tolerance =
      1e-3;  ///< ‖r‖ <= tolerance × reference (the monograph's 0.1 % is the default, chapter 7)
  double absolute_tolerance = 0;  ///< or ‖r‖ <= this; at the start only where forces are hardly more
  /// And what NonlinearSystem::relative_step makes of the next step is at most this. A residual that meets
  /// the tolerance says nothing of an error along which the system has next to no stiffness. Zero: the
  /// residual alone ends the iteration.
  double step_tolerance = 0;
  /// Iterations that set out from less than these do not count as effort (NewtonReport::effort), where the
  /// tolerances ask for more.
  double effort_tolerance = 1e-5, effort_step_tolerance = 1e-3;
  int max_iterations = 25;
  bool descends = false;  ///< steps along which the energy rises, d·r > 0, are taken backwards
  bool line_search = true;
  bool chords = true;   ///< steps with the tangent before, where they will do
  bool inexact = true;  ///< iterative solvers go only as far as an iteration gains by (forcing.hpp)
  double line_search_slope = 0.8;  ///< accept α when |d·r(x+αd)| <= this × |d·r(x)|
};

struct NewtonReport {
  bool converged = false;
  bool out_of_iterations = false;  ///< stopped by max_iterations alone: x is a good iterate
  bool no_direction = false;       ///< stopped by the linear solver
  bool began_balanced = false;     ///< ‖r‖ at the start met the tolerance or was rounding
  int iterations = 0;              ///< linear solves
  /// Those of them that set out from farther off than NewtonOptions::effort_tolerance: how hard the solution
  /// is, whatever tolerance is asked for beyond that.
  int effort = 0;
  int linear_iterations = 0;
  std::vector<double> residuals;  ///< ‖r‖/reference before each solve and at the end
  std::string reason;             ///< why it stopped when it did not converge

  /// Counts the solves of an iteration before this one as well.
  void add_solves(const NewtonReport& before) {
    iterations += before.iterations;
    effort += before.effort;
    linear_iterations += before.linear_iterations;
  }
};

/// A system r(x) = 0 in nodal fields [local node][component], which follow one another in x; so do
/// their residuals [owned node][component] in r. What the tangent's matrix says of prescribed and tied
/// degrees of freedom is about the first field; of others, entries that are no unknowns have residuals and
/// steps of zero. With several fields r is to be the monotone form of the problem (the product of r and
/// Newton's direction is negative). All calls are collective.
class NonlinearSystem {
 public:
  virtual ~NonlinearSystem() = default;
  /// r at x on owned nodes; newton() zeroes entries of fixed degrees of
  /// freedom and sums those that are tied. Returns the reference
  /// that ‖r‖ is measured against: the norm of the forces (or heat) before they cancel, reactions included,
  /// over all processes.
  virtual double residual(std::span<const double> x, std::span<double> r) = 0;
  /// The tangent at x, where the residual has been asked for before: terms may find there, for both, which
  /// nodes couple.
  virtual BlockMatrix& tangent(std::span<const double> x) = 0;
  /// Returns the size of the step d that has led to x, as a share of the change of x since the start of the
  /// time step; zero: there is no measure of it. Called if NewtonOptions::step_tolerance is set.
  virtual double relative_step(std::span<const double> /*x*/, std::span<const double> /*d*/) { return 0; }
  /// Called with the accepted step: x is the new point, ghosts up to date. Systems with unknowns of their own
  /// (nodal enthalpy) follow. Without line search it comes before the residual at x, with line search after
  /// the residuals of the trials.
  virtual void accept(std::span<const double> /*x*/, std::span<const double> /*d*/, double /*alpha*/) {}
};

/// Solves r(x) = 0 from the start value x, whose fixed degrees of freedom already hold their values and which
/// satisfies the multi-point constraints.
/// If the previous step has reduced the residual so much that the same tangent suffices for the rest, the
/// tangent is used once more: a chord step, without assembly and set-up of the solver.
/// With a step_tolerance the next step is taken to be as much smaller than the last one as the residual has
/// become; there is at least one step, unless ‖r‖ and the reference are both rounding at the start. Where a
/// tolerance below effort_tolerance is asked for and the reference is far above rounding, a residual that is
/// small enough as rounding alone (absolute_tolerance) is brought down further, while steps leave a tenth.
/// A NaN in the residual at x ends the iteration as not converged; in a trial of the line search it shortens
/// the step. x: [local node][component] of each field, ghosts updated on return.
/// @param components  of each field
NewtonReport newton(NonlinearSystem& system, TangentSolver& solver, const parallel::GhostExchange& ghosts,
                    std::span<const int> components, std::span<double> x, const NewtonOptions& options);

}  // namespace solidus::linear
