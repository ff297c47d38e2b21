/// Supports of bodies that only contact held: a structural analysis knows no contact of the run, and a part
/// that may move as a rigid body has a singular matrix.
#pragma once

#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"

namespace solidus::results {

/// Degrees of freedom, [node][component], that have to be held besides so that no connected part can move as
/// a rigid body: as many as it has free rigid motions (six in space, three in plane strain, one along the
/// axis of revolution), far from each other. They are statically determinate: of loads in equilibrium they
/// take nothing.
/// @param fixed  [node][component]: held
/// @param constraints   degrees of freedom that move as one
std::vector<Index> missing_supports(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                                    AnalysisKind kind, std::span<const char> fixed,
                                    std::span<const std::vector<Index>> constraints);

}  // namespace solidus::results
