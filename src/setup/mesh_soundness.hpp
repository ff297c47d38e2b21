/// Finds the faults of a mesh that change an answer without a word (mesh/surfaces/soundness.hpp).
#pragma once

#include <map>
#include <string>

#include "cases/case_spec.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::setup {

/// Groups that have to be surfaces, with a place in the case that asks for each.
std::map<std::string, SourceLocation> wanted_surfaces(const cases::CaseSpec& spec);

/// Elements and faces that are there twice are left out, and halves of a body whose faces lie on each other
/// are joined, each with a warning; bodies in pieces are named. The bodies of the case are in the mesh, which
/// has the dimension of the case. Throws InputError for faces inside of a body that a condition or a contact
/// names and for two bodies in one place; says in RawMesh::unsound where nodes hang in a face of their own
/// body. On process 0.
void make_sound(const cases::CaseSpec& spec, mesh::RawMesh& mesh);

}  // namespace solidus::setup
