/// Makes the mesh of a case.
#pragma once

#include "cases/case_spec.hpp"
#include "mesh/raw_mesh.hpp"
#include "setup/made_mesh.hpp"

namespace solidus::setup {

/// Reads the file or makes the built-in shape, finds its interfaces, orients it and checks it against the
/// case. On process 0 only. Throws InputError.
mesh::RawMesh raw_mesh(cases::CaseSpec spec);

/// The same with the interfaces that were found. Not collective.
MadeMesh make_mesh(cases::CaseSpec spec);

/// The part of the mesh that this process holds; the surfaces in contact are on all of them. Collective: what
/// goes wrong on process 0 is thrown on all. The contacts that interfaces make are added to those of the
/// case.
/// @param made  the mesh where process 0 has it already, which is moved from; null: it is made. Other
///              processes have none.
mesh::Mesh load_mesh(cases::CaseSpec& spec, MadeMesh* made = nullptr);
/// Throws InputError where the mesh that was loaded is not sound, after the findings of a case have told what
/// else is wrong. Collective.
void require_sound_mesh(const cases::CaseSpec& spec);

}  // namespace solidus::setup
