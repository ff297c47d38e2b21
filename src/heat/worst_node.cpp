#include "heat/worst_node.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <petscsys.h>

namespace solidus::heat {

std::string WorstNode::text(const mesh::Mesh& mesh, std::span<const double> temperature,
                            std::span<const double> residual) const {
  struct {
    double value;
    int rank;
  } mine{size, 0}, winner{};
  MPI_Comm_rank(PETSC_COMM_WORLD, &mine.rank);
  MPI_Allreduce(&mine, &winner, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  char words[200] = {};
  if (winner.rank == mine.rank && mesh.n_owned_nodes > 0) {
    const mesh::Point& p = mesh.x[node];
    std::string place = fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) m: {:.6g} K", mesh.input_node[node],
                                    p[0], p[1], p[2], temperature[node]);
    if (!residual.empty()) place += fmt::format(", unbalanced heat {:.4g} W", residual[node]);
    place.copy(words, sizeof words - 1);
  }
  MPI_Bcast(words, sizeof words, MPI_CHAR, winner.rank, PETSC_COMM_WORLD);
  return words;
}

}  // namespace solidus::heat
