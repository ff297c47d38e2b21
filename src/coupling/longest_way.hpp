/// How far the nodes may go in one iteration of Newton's method for displacement and temperature at once.
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace solidus::coupling {

/// The factor at most 1 by which a step of the displacements is shortened at the outset, so that no node goes
/// further than a twentieth of the mesh's diagonal. A body that rested on contact alone, which the step
/// before has opened, has next to no stiffness toward its mould: its step is metres long, and surfaces that
/// search for their partners (large sliding) would not find each other again. Collective.
/// @param step  [local node][component] [m]
double factor_of_longest_way(const mesh::Mesh& mesh, std::span<const double> step, int components);

}  // namespace solidus::coupling
