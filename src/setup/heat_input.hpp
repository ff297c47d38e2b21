/// Makes the thermal phase's conditions and options from the case.
#pragma once

#include <string>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "heat/loads/thermal_conditions.hpp"

namespace solidus::setup {

/// @param stage  whose conditions; null: those of all stages
heat::ThermalConditions thermal_conditions(const cases::CaseSpec& spec,
                                           const cases::StageRun* stage = nullptr);
/// Returns the reason why the thermal phase cannot have two stages a step in this case; empty: it can.
std::string against_two_stages(const cases::CaseSpec& spec);
/// Includes the settings that the coupling requires of the thermal phase: the form of sensible heat, and the
/// stepping where the case leaves it open.
heat::HeatOptions heat_options(const cases::CaseSpec& spec);

}  // namespace solidus::setup
