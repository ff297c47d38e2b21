/// Bodies that only conduct heat, and bodies that leave and come in the course of the stages (shake-out,
/// ejection, the casting of the next shot).
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "cases/roles.hpp"
#include "cases/stage_input.hpp"
#include "contact/points/parameters.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// The groups of the bodies that are not there in a stage; without a stage none.
std::vector<std::string> gone_bodies(const cases::CaseSpec& spec, const cases::StageRun* stage);

/// The groups of the bodies that take no part in mechanics: those that only conduct heat, and those gone.
std::vector<std::string> absent_from_mechanics(const cases::CaseSpec& spec, const cases::StageRun* stage);

/// Checks that every stage has a body. Throws InputError.
void check_bodies(const cases::CaseSpec& spec);

/// Bodies that are there in a stage and were not in the one before it in the run, [body]: they are new.
/// @param number  of the stage in the run, from zero
std::vector<char> new_bodies(const cases::CaseSpec& spec, const std::vector<cases::StageRun>& runs,
                             std::size_t number);

/// Checks that bodies which come into a run where others deform have nodes of their own. Collective. Throws
/// InputError.
void check_new_bodies(const cases::CaseSpec& spec, const std::vector<cases::StageRun>& runs,
                      const mesh::Mesh& mesh);

/// A body that only conducts heat is a rigid wall in contact: the master where the program chooses the roles.
/// Between two such walls no force acts, and the penalty is any. Collective.
void set_walls(const cases::CaseSpec& spec, const mesh::Mesh& mesh, contact::ContactParameters& pair);

/// Whether a contact is active in a stage: it is one of its stages, and no body of its surfaces has been
/// removed.
bool holds(const cases::CaseSpec& spec, const cases::ContactSpec& contact, const mesh::Mesh& mesh,
           const cases::StageRun* stage);

/// The names of the conditions and contacts of a stage that find no body: all that they act on has gone, or
/// only conducts heat where they are mechanical. Throws InputError where the user names that stage for one
/// whose body has gone, or where a contact's surface belongs to a body that has gone and one that stays.
/// Collective.
std::vector<std::string> without_body(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                      const cases::StageRun* stage);

}  // namespace solidus::setup
