/// Makes the mechanical phase's conditions and options from the case.
#pragma once

#include <array>
#include <vector>

#include "cases/case_spec.hpp"
#include "cases/stage_input.hpp"
#include "mechanics/mechanics_options.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// Acceleration of gravity [m/s²] in the coordinates of the mesh.
std::array<double, 3> gravity(const cases::AnalysisSpec& analysis);

/// @param stage  whose conditions; null: those of all stages
mechanics::MechanicalConditions mechanical_conditions(const cases::CaseSpec& spec,
                                                      const cases::StageRun* stage = nullptr);
mechanics::MechanicsOptions mechanics_options(const cases::CaseSpec& spec);
/// The sections of the bodies that deform at the start (mechanics::sections), [body] [m]; zeros in an
/// analysis of heat alone. Collective.
std::vector<double> sections_of(const cases::CaseSpec& spec, const mesh::Mesh& mesh);

}  // namespace solidus::setup
