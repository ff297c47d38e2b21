/// Groups of elements that are born together.
#pragma once

#include <vector>

#include "linear/growing_mesh.hpp"

namespace solidus::linear {

/// Rounds times of birth up to multiples of `interval` from the first one on, where it is above zero; more
/// than GrowingMesh::k_most_times different ones are rounded to so many. Collective. Returns the different
/// times, rising, the same on all processes.
std::vector<double> group_times(std::vector<GrowingMesh::Births>& births, double interval);

/// Divides the blocks of a mesh so that all elements of a block are born at one time: those that are there
/// from the start (−∞), one block for each group of group_times(), those that never are (+∞). Blocks without
/// births stay as they are. All processes have the same blocks. Collective.
/// @param births  [block], as GrowingMesh takes them; becomes that of the new blocks
void divide_by_birth(mesh::Mesh& mesh, std::vector<GrowingMesh::Births>& births, double interval = 0);

}  // namespace solidus::linear
