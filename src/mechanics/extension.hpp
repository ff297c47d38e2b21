/// Where nodes come to lie at which elements are born: their displacement is an elastic extension of that of
/// the metal that is there.
#pragma once

#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "mechanics/mechanical_bodies.hpp"

namespace solidus::mechanics {

/// Gives nodes that have just become active the displacement with which an elastic body of the new elements,
/// with Poisson's ratio zero, is in equilibrium:
///
///   ∫ B̄ᵀ C B̄ dV u = 0   over the new elements,
///
/// where u is that of the nodes that were active before, what supports prescribe, and on a face that stays
/// plane the common value. A rigid motion of what they sit on is theirs, too. Elements that touch nothing
/// keep zero. Collective.
/// @param bodies        with the loads and the active nodes of now
/// @param before        the active nodes of before
/// @param born          whether the elements of a block are new, [block]
/// @param time          at which supports are asked [s]
/// @param displacement  [local node][component], ghosts up to date
void extend_displacement(const MechanicalBodies& bodies, const linear::ActiveSet& before,
                         const std::vector<char>& born, double time, std::vector<double>& displacement);

}  // namespace solidus::mechanics
