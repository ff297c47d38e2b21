/// Largest displacement of nodes in one Newton iteration of the simultaneous scheme.
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace solidus::coupling {

/// The factor, at most 1, by which a Newton step of the displacements is shortened before the line search, so
/// that no node moves farther than a twentieth of the mesh's diagonal. A body that was held by contact only,
/// which the previous iteration has opened, has almost no stiffness towards its mould: its Newton step is
/// metres long, and in large sliding the points would not find their partners again. Collective.
/// @param step  [local node][component] [m]
double factor_of_longest_way(const mesh::Mesh& mesh, std::span<const double> step, int components);

}  // namespace solidus::coupling
