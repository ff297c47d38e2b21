/// The section of bodies: volume over the surface through which they can cool, the modulus of Chvorinov.
///
/// Planes of symmetry and cuts do not count as surface, so that a half and the whole have one section. They
/// are the faces whose displacement along their own normal is prescribed at every corner, and those that stay
/// plane.
#pragma once

#include <vector>

#include "linear/active_set.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

/// V/A of every body of the mesh that deforms [m]; zero for others, and for a body without a surface of its
/// own. Collective; the same bits on any number of processes.
/// @param active  bodies that deform
std::vector<double> sections(const mesh::Mesh& mesh, AnalysisKind kind,
                             const MechanicalConditions& conditions, const linear::ActiveSet& active);

}  // namespace solidus::mechanics
