/// The refined part of a process, of which only what touches its own nodes is kept.
#pragma once

#include "mesh/refinement/exchange.hpp"
#include "mesh/refinement/level.hpp"

namespace solidus::mesh {

/// @param level  with the final places of all nodes; is used up
/// Collective.
Part fine_part(const Level& level, const Sharing& sharing);

}  // namespace solidus::mesh
