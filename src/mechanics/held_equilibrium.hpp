/// A second attempt of Newton's iteration for equilibrium, which holds what has just lost its contact.
///
/// Next to a melt, or a body that contact alone holds, the springs of contact are 10⁶ to 10⁸ times as stiff
/// as all else: a step that opens some of them leaves next to nothing that holds these points, and the next
/// one takes them far into the other body, where the line search finds no way on. Here the tangent keeps a
/// share s of the stiffness that a node has had in an earlier iteration of the same attempt,
///
///   K_ii + s (max K_ii − K_ii),
///
/// as the Levenberg–Marquardt method does with its damping (J. Nocedal, S. J. Wright, Numerical Optimization,
/// 2nd ed. 2006, section 10.3): s falls with every step that is taken whole, so that the point feels its way,
/// and rises where the line search had to shorten one. Forces, and with them the solution, do not know it.
/// Steps that lead uphill are taken backwards (linear::NewtonOptions::descends).
#pragma once

#include <span>
#include <vector>

#include "linear/newton.hpp"
#include "mechanics/state/mechanical_state.hpp"

namespace solidus::mechanics {

class MechanicalPhase;

/// The second attempt: twice as many iterations as the first may take, and no node farther than a hundredth
/// of the mesh's diagonal in each of them. Collective.
/// @param x     where the iteration starts, and its result
/// @param held  s at first; zero: it stays so, and short steps are all that differs from the first attempt
linear::NewtonReport attempt_again(MechanicalPhase& phase, const MechanicalState& old,
                                   linear::TangentSolver& solver, const parallel::GhostExchange& ghosts,
                                   std::span<const int> fields, std::vector<double>& x,
                                   linear::NewtonOptions options, double held = 1);

}  // namespace solidus::mechanics
