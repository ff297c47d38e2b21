/// Builds the criteria of a run from the case.
#pragma once

#include <memory>

#include "cases/case_spec.hpp"
#include "coupling/phases.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::setup {

/// Creates the criteria of a case; null: none, because nothing can freeze or the case says so. Collective.
/// @param start      temperatures, [body]: what is poured is followed (cast_bodies.hpp)
/// @param phases     without criteria yet; it, mesh and materials outlive the criteria
/// Throws InputError for a feeder that is no group of the mesh.
std::unique_ptr<criteria::Criteria> make_criteria(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const coupling::Phases& phases);

}  // namespace solidus::setup
