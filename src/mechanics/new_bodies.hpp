/// Bodies that come back after they have left: a new casting of the next shot.
#pragma once

#include <vector>

#include "mechanics/mechanical_phase.hpp"

namespace solidus::mechanics {

/// Marks the local nodes of bodies, [local node].
/// @param bodies  [body of the mesh]
std::vector<char> nodes_of_bodies(const mesh::Mesh& mesh, const std::vector<char>& bodies);

/// Puts bodies back to their drawn shape, without displacement, stress and history. They share no nodes with
/// others that deform.
/// @param phase   whose conditions have the bodies among the active ones
/// @param bodies  [body of the mesh]
void renew_history(const MechanicalPhase& phase, const std::vector<char>& bodies, MechanicalState& state);

/// Tells the kernels, which are new where bodies have come back, how the thermal phase spreads heat over
/// nodes.
/// @param closed  it stores heat by the closed rule; bodies with isothermal changes do anyway
void spread_heat_as_stored(const MechanicalPhase& phase, bool closed);

/// Sets the displacement and the nodal pressure of bodies to zero.
void renew_nodes(const mesh::Mesh& mesh, const std::vector<char>& bodies, MechanicalState& state);

}  // namespace solidus::mechanics
