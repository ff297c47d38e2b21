/// The nodes of dies that a criterion follows.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::criteria {

/// Returns the followed body of every node, −1 where there is none; a node that two of them share belongs to
/// the first. Ghosts included. Collective.
/// @param followed  [body]
std::vector<int> die_nodes(const mesh::Mesh& mesh, const std::vector<char>& followed);

}  // namespace solidus::criteria
