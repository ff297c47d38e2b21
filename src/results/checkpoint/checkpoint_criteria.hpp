/// State of the criteria in a checkpoint: one table per column, by the numbers of nodes and elements.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "criteria/criteria_state.hpp"
#include "results/checkpoint/checkpoint_tables.hpp"

namespace solidus::results {

/// Collective.
void write_criteria(TableWriter& out, const mesh::Mesh& mesh, const criteria::CriteriaState& state);
/// Fills `state`, which has the records of this run; tables get the rows that the file has. Collective.
void take_criteria(TableReader& in, const mesh::Mesh& mesh, criteria::CriteriaState& state);

}  // namespace solidus::results
