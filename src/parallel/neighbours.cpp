/// Ranges of owners tell which process has a row; each process then learns who has copies of its own.
#include "parallel/neighbours.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::parallel {

std::vector<Neighbour> find_neighbours(Index n_owned, GlobalIndex first_owned,
                                       std::span<const GlobalIndex> ghosts) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  int size = 1;
  MPI_Comm_size(comm, &size);
  std::vector<Neighbour> neighbours;
  if (size == 1) return neighbours;

  std::vector<GlobalIndex> first(as_size(size));
  MPI_Allgather(&first_owned, 1, MPI_INT64_T, first.data(), 1, MPI_INT64_T, comm);

  // Ghosts by owner, then tell every owner which of its nodes are wanted.
  std::vector<std::vector<Index>> wanted(as_size(size));
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    // A process without nodes shares its start with the next one: the last start not above the node is the
    // owner's.
    const auto owner = std::upper_bound(first.begin(), first.end(), ghosts[i]);
    wanted[as_size(owner - first.begin() - 1)].push_back(n_owned + as_index(i));
  }
  std::vector<int> n_wanted(wanted.size()), n_asked(wanted.size());
  std::transform(wanted.begin(), wanted.end(), n_wanted.begin(),
                 [](const auto& w) { return static_cast<int>(w.size()); });
  MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm);

  const auto starts = [](const std::vector<int>& counts) {
    std::vector<int> start(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), start.begin(), 0);
    return start;
  };
  const std::vector<int> start_wanted = starts(n_wanted), start_asked = starts(n_asked);
  std::vector<GlobalIndex> ask, asked(as_size(start_asked.back() + n_asked.back()));
  for (const auto& nodes : wanted)
    for (Index node : nodes) ask.push_back(ghosts[as_size(node - n_owned)]);
  MPI_Alltoallv(ask.data(), n_wanted.data(), start_wanted.data(), MPI_INT64_T, asked.data(), n_asked.data(),
                start_asked.data(), MPI_INT64_T, comm);

  for (int rank = 0; rank < size; ++rank) {
    const auto p = as_size(rank);
    if (n_wanted[p] == 0 && n_asked[p] == 0) continue;
    Neighbour neighbour{rank, {}, std::move(wanted[p])};
    for (int i = 0; i < n_asked[p]; ++i) {
      const GlobalIndex local = asked[as_size(start_asked[p] + i)] - first_owned;
      assert(local >= 0 && local < n_owned);
      neighbour.send.push_back(as_index(local));
    }
    neighbours.push_back(std::move(neighbour));
  }
  return neighbours;
}

}  // namespace solidus::parallel
