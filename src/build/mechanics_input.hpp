/// Makes the mechanical phase's conditions and options from the case.
#pragma once

#include <array>

#include "case/case_spec.hpp"
#include "case/stage_input.hpp"
#include "mechanics/mechanical_phase.hpp"

namespace solidus::model {

/// Acceleration of gravity [m/s²] in the coordinates of the mesh.
std::array<double, 3> gravity(const AnalysisSpec& analysis);

/// @param stage  whose conditions; null: those of all stages
mechanics::MechanicalConditions mechanical_conditions(const CaseSpec& spec, const StageRun* stage = nullptr);
mechanics::MechanicsOptions mechanics_options(const CaseSpec& spec);

}  // namespace solidus::model
