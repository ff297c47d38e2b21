/// From the case to its mesh.
#pragma once

#include "mesh/raw_mesh.hpp"
#include "model/case_spec.hpp"

namespace solidus::model {

/// Reads the file or makes the built-in shape, orients it and checks it against the case. On process 0 only.
/// Throws InputError.
mesh::RawMesh raw_mesh(const CaseSpec& spec);

/// The part of the mesh that this process holds; the surfaces in contact are on all of them. Collective: what
/// goes wrong on process 0 is thrown on all.
mesh::Mesh load_mesh(const CaseSpec& spec);

}  // namespace solidus::model
