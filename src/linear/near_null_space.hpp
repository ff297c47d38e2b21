/// Motions of a mesh that cost next to no energy, for multigrid.
#pragma once

#include "mesh/mesh.hpp"
#include "multigrid/multigrid.hpp"

namespace solidus::linear {

/// Translations and infinitesimal rotations of owned nodes, [owned node][component][mode]: 3 in the plane, 6
/// in space.
multigrid::NearNullSpace rigid_body_modes(const mesh::Mesh& mesh, int components);
/// The number of rigid-body modes of a body with 2 or 3 components.
int rigid_body_mode_count(int components);
/// A constant for each component.
multigrid::NearNullSpace constants(const mesh::Mesh& mesh, int components);

}  // namespace solidus::linear
