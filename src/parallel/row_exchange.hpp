/// Exchange of matrix rows between processes: contributions to a row go to the process that owns it, and rows
/// of any length go from their owner to the processes that hold a copy.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "parallel/neighbours.hpp"

namespace solidus::parallel {

class RowExchange {
 public:
  /// The arguments are those of GhostExchange (parallel.hpp). Collective, as all functions of the class.
  RowExchange(Index n_owned, GlobalIndex first_owned, std::span<const GlobalIndex> ghosts)
      : neighbours_(find_neighbours(n_owned, first_owned, ghosts)) {}

  /// Adds the ghosts' values to the owners', in the order of the processes. Ghosts keep theirs.
  void add_to_owners(std::span<float> values, int components) const;
  /// `pack` appends a row, `unpack` gets it.
  using Pack = std::function<void(Index row, std::vector<double>& to)>;
  using Unpack = std::function<void(Index row, std::span<const double> values)>;
  /// Owned rows go to the ghosts.
  void update(const Pack& pack, const Unpack& unpack) const { exchange(false, pack, unpack); }
  /// Sends ghost rows to their owners, which may receive several for one row.
  void give_back(const Pack& pack, const Unpack& unpack) const { exchange(true, pack, unpack); }

 private:
  void exchange(bool to_owners, const Pack& pack, const Unpack& unpack) const;

  std::vector<Neighbour> neighbours_;
};

}  // namespace solidus::parallel
