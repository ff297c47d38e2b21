/// The stress that bodies start with: of a file or of functions of position.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::setup {

/// MechanicsOptions::initial_stress: at the middle of each element the functions' values, or those of the
/// place of the file (a point, or the middle of a cell) that is nearest to it. Empty where no body has any.
/// @param start  temperatures of the bodies at the start
/// Collective. Throws InputError on every process: a file that cannot be read, a body that is not wholly
/// solid, stands still or has inertia, a component that the analysis does not have.
std::vector<std::vector<double>> initial_stress(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                const std::vector<material::Material>& materials,
                                                const std::vector<InitialTemperatureRange>& start);

}  // namespace solidus::setup
