/// Builds the criteria of a run from the case.
#pragma once

#include <memory>
#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/phases.hpp"
#include "material/local_law.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::setup {

using LocalLaws = std::vector<std::vector<material::LocalLaw>>;

/// Strength and grain by where the metal froze, of the cards of bodies that criteria follow, [body]. Throws
/// InputError for a card that cannot be read.
LocalLaws local_laws(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                     const std::vector<InitialTemperatureRange>& start);

/// Checks the fatigue of dies. Throws InputError.
void check_die_lives(const cases::CaseSpec& spec);

/// Creates the criteria of a case; null: none, because nothing can freeze or the case says so. Collective.
/// @param mesh       the elements that are there
/// @param start      temperatures, [body]: what is poured is followed (cast_bodies.hpp)
/// @param laws       of local_laws()
/// @param phases     without criteria yet; it, mesh and materials outlive the criteria
/// @param all_elements  of a mesh of which elements are activated; null: `mesh` has all of them
/// Throws InputError for a feeder that is no group of the mesh.
std::unique_ptr<criteria::Criteria> make_criteria(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const LocalLaws& laws, const coupling::Phases& phases,
                                                  const mesh::Mesh* all_elements = nullptr);

}  // namespace solidus::setup
