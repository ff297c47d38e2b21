/// How the equilibrium at the end of a step changes with its start and with the data: forward differentiation
/// through the step, as heat/step_sensitivity.hpp does it for heat.
///
/// A neighbour is the same phase with data and a state that differ by O(ε). The run has solved r(u) = 0; the
/// neighbour's own residual at that end tells what has changed, and the tangent of the run how the end
/// follows:
///
///   K δu = −[r_ε(u) − r(u)]
///
/// One factorisation a step serves all neighbours. r(u) is what Newton's iteration of the run has left, which
/// is not the neighbours' to remove. Where K is not exact (friction), what it leaves is taken up by further
/// solves. The history of a neighbour's points (flow, damage, phases) is that of its own displacements.
#pragma once

#include <vector>

#include "mechanics/mechanical_phase.hpp"

namespace solidus::mechanics {

class StepSensitivity {
 public:
  /// @param phase     made of the data of the run; must outlive this object. On one process
  /// @param accuracy  residual over that before the first correction, of one neighbour a step, which will do
  StepSensitivity(MechanicalPhase& phase, double accuracy) : phase_(phase), accuracy_(accuracy) {}

  /// Takes a step of the run again, at its end `now`: residual and tangent there. Contacts have begun the
  /// pass.
  /// @param deformation  of the step
  /// Returns false where the history at the end is not that of the run: it has taken the step in another way.
  bool linearise(const MechanicalState& old, const MechanicalPass& pass, const MechanicalState& now,
                 StepDeformation& deformation);
  /// The end of the same step of a neighbour that begins at `old`. Its contacts have begun the pass.
  /// Throws StepRejected where the linear system has no solution.
  MechanicalState follow(MechanicalPhase& neighbour, const MechanicalState& old, const MechanicalPass& pass,
                         StepDeformation& deformation);

 private:
  static std::vector<double> residual(MechanicalPhase& phase, const std::vector<double>& x);
  std::vector<double> solve(std::vector<double> r);

  MechanicalPhase& phase_;
  double accuracy_;
  std::vector<double> end_;   ///< the unknowns at the end of the run's step
  std::vector<double> left_;  ///< the residual there
  bool fresh_ = true;         ///< the tangent has not been solved with yet
  int needed_ = 0;            ///< corrections of a neighbour in this step; zero: not known yet
};

}  // namespace solidus::mechanics
