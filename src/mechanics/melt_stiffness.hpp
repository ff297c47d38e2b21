/// Stiffness, in a step, of the melts of a mesh whose materials do not give a viscosity (material/melt.hpp).
#pragma once

#include <array>
#include <vector>

#include "linear/active_set.hpp"
#include "material/melt.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

/// One per body of the mesh; zero for bodies that are absent. Collective; the same bits on every number of
/// processes.
/// @param materials  [body]
/// @param gravity    acceleration [m/s²]
std::vector<material::MeltModulus> melt_moduli(const mesh::Mesh& mesh,
                                               const std::vector<material::Material>& materials,
                                               const linear::ActiveSet& active,
                                               const std::array<double, 3>& gravity);

}  // namespace solidus::mechanics
