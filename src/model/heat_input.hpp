/// From the case to the thermal phase's conditions and options.
#pragma once

#include "heat/conditions.hpp"
#include "model/case_spec.hpp"
#include "model/stage_input.hpp"

namespace solidus::model {

/// @param stage  whose conditions; null: those of all stages
heat::Conditions thermal_conditions(const CaseSpec& spec, const StageRun* stage = nullptr);
/// With what the coupling asks of the thermal phase: the form of sensible heat.
heat::HeatOptions heat_options(const CaseSpec& spec);

}  // namespace solidus::model
