/// From the case to the thermal phase's conditions and options.
#pragma once

#include "heat/conditions.hpp"
#include "model/case_spec.hpp"

namespace solidus::model {

heat::Conditions thermal_conditions(const CaseSpec& spec);

}  // namespace solidus::model
