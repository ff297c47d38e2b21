/// Checks of a case against its mesh.
#pragma once

#include "cases/case_spec.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::setup {

/// Checks that the mesh has the bodies of the case. Throws InputError. On process 0.
void check_bodies_of(const cases::CaseSpec& spec, const mesh::RawMesh& mesh);

/// Checks that the mesh has the dimension of the analysis and every group the case names, each of a dimension
/// that supports what the case asks of it. Throws InputError with the place in the case and the groups there
/// are. On process 0, which has the mesh.
void check_groups(const cases::CaseSpec& spec, const mesh::RawMesh& mesh);

}  // namespace solidus::setup
