/// What turns in a case: its axis, how fast, and the force of it.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"

namespace solidus::setup {

/// Throws InputError for an axis or a point that the analysis does not have, and for unknown bodies.
void check_rotation(const cases::CaseSpec& spec);
/// The axis, with the greatest angular velocity of the run; omega is zero where nothing turns.
mechanics::Turning turning(const cases::CaseSpec& spec);
/// The centrifugal force of each body that turns and deforms.
std::vector<mechanics::BodyForce> centrifugal_forces(const cases::CaseSpec& spec);

}  // namespace solidus::setup
