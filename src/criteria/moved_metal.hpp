/// Where the metal of castings is, as the criterion of feeding has moved it.
#pragma once

#include <vector>

#include "criteria/criteria_state.hpp"

namespace solidus::criteria {

/// Metal at the nodes, ghosts up to date.
struct NodalMetal {
  std::vector<double> held;    ///< metal over that which was poured; one where there is none, [local node]
  std::vector<double> filled;  ///< share of the room that is not emptied, [local node]
};

/// Reads it from the record of feeding; both are empty where a run has no such record.
NodalMetal metal_at_nodes(const CriteriaState& state);

}  // namespace solidus::criteria
