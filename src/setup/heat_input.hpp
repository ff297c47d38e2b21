/// Makes the thermal phase's conditions and options from the case.
#pragma once

#include <string>

#include "case/case_spec.hpp"
#include "case/stage_input.hpp"
#include "heat/loads/thermal_conditions.hpp"

namespace solidus::model {

/// @param stage  whose conditions; null: those of all stages
heat::ThermalConditions thermal_conditions(const CaseSpec& spec, const StageRun* stage = nullptr);
/// Returns the reason why the thermal phase cannot have two stages a step in this case; empty: it can.
std::string against_two_stages(const CaseSpec& spec);
/// Includes the settings that the coupling requires of the thermal phase: the form of sensible heat, and the
/// stepping where the case leaves it open.
heat::HeatOptions heat_options(const CaseSpec& spec);

}  // namespace solidus::model
