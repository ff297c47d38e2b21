/// Neighbouring processes of a process, with the rows of which each holds copies (ghosts): every exchange
/// between processes starts from these lists.
#pragma once

#include <span>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::parallel {

struct Neighbour {
  int rank = 0;
  std::vector<Index> send;     ///< owned entries that the neighbour has as ghosts
  std::vector<Index> receive;  ///< ghosts that the neighbour owns, in the order of its `send`
};

/// In the order of their ranks; owned entries are contiguous over all processes, from `first_owned` on.
/// @param ghosts  numbers over all processes of the local entries behind the owned ones
/// Collective.
std::vector<Neighbour> find_neighbours(Index n_owned, GlobalIndex first_owned,
                                       std::span<const GlobalIndex> ghosts);

}  // namespace solidus::parallel
