/// Groups of rows that become one row of the coarser level (aggregation.hpp).
#pragma once

#include <vector>

#include "multigrid/matrix_view.hpp"

namespace solidus::multigrid {

inline constexpr Index k_no_aggregate = -1;

/// Greedy: first whole neighbourhoods that are still free, then the rows between them join a neighbour's
/// aggregate, then what is left. Neighbours are rows that are strongly coupled: an aggregate that had both
/// melt and solid would move neither as it can. Rows that are strongly coupled with no other are in no
/// aggregate: smoothing alone solves them. Those of nodes without unknowns are among them, which no
/// coarsening would ever make fewer. Returns how many aggregates there are.
Index aggregate(const MatrixView& a, std::vector<Index>& of_row);

}  // namespace solidus::multigrid
