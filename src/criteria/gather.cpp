#include "criteria/gather.hpp"

#include <petscsys.h>

#include <numeric>

namespace solidus::criteria {

std::vector<double> gathered(std::span<const double> own) {
  int size = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (size == 1) return {own.begin(), own.end()};
  const auto n = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(size)), starts(counts.size());
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, PETSC_COMM_WORLD);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  std::vector<double> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(own.data(), n, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                 PETSC_COMM_WORLD);
  return all;
}

}  // namespace solidus::criteria
