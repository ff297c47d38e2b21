/// How far a casting reaches: no melt comes to a place from further away, and no more metal contracts along
/// it.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::criteria {

/// The longest side of the box along the axes around each body of the mesh [m]; of a part of a casting that
/// symmetry cuts it is that of this part. Collective.
std::vector<double> longest_sides(const mesh::Mesh& mesh);

}  // namespace solidus::criteria
