/// The temperatures of a run's nodes over time, from the fields that it left.
#pragma once

#include <filesystem>
#include <vector>

#include "mesh/mesh.hpp"
#include "results/formats/structural_deck.hpp"

namespace solidus::results {

/// Reads every moment of a run's collection. Nodes are matched by their numbers in the input.
/// @param collection  fields.pvd
/// @param mesh        of one process, that of the run
/// @param active      bodies whose nodes need a temperature; others have NaN
/// Throws InputError for files that are missing or damaged, have no temperature, or lack a node.
std::vector<TemperatureMoment> read_temperature_history(const std::filesystem::path& collection,
                                                        const mesh::Mesh& mesh,
                                                        const linear::ActiveSet& active);

}  // namespace solidus::results
