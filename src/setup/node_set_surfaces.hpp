/// Surfaces from sets of nodes, which decks of Abaqus and CalculiX often have in their place.
#pragma once

#include "cases/case_spec.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::setup {

/// Where a condition, a contact or layers of the case need a surface and the mesh has a set of nodes of this
/// name, the set becomes the faces on the skin of the case's bodies whose vertices are all in it; the log
/// says how many. Throws InputError where there is no such face. On process 0.
void make_surfaces_of_node_sets(const cases::CaseSpec& spec, mesh::RawMesh& mesh);

}  // namespace solidus::setup
