/// Stiffness, in a step, of the melts of a mesh whose materials do not give a viscosity (material/melt.hpp).
#pragma once

#include <vector>

#include "linear/active_set.hpp"
#include "material/melt.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

/// One per body of the mesh; zero for bodies that are absent. Collective; the same bits on every number of
/// processes.
/// @param materials   [body]
/// @param conditions  of which gravity and the planes of symmetry count
std::vector<material::MeltModulus> melt_moduli(const mesh::Mesh& mesh, AnalysisKind kind,
                                               const std::vector<material::Material>& materials,
                                               const linear::ActiveSet& active,
                                               const MechanicalConditions& conditions);

}  // namespace solidus::mechanics
