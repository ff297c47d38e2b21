/// Builds inertia and its time integrator from the case.
#pragma once

#include <optional>
#include <string>

#include "cases/case_spec.hpp"
#include "mechanics/loads/inertial_forces.hpp"

namespace solidus::setup {

/// Nothing without [dynamics].
std::optional<mechanics::DynamicsOptions> dynamics_options(const cases::CaseSpec& spec);

/// "newmark", for messages; the trapezoidal rule is one of Newmark's methods.
std::string method_name(const cases::DynamicsSpec& dynamics);

/// Throws InputError for settings that contradict each other.
void check_dynamics(const cases::CaseSpec& spec);

}  // namespace solidus::setup
