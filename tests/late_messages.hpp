/// Messages between processes that arrive in many orders: each process waits at random before it sends.
/// Included by one source of a test program, whose own functions of MPI then come before the library's.
#pragma once

#include <gtest/gtest.h>
#include <petscsys.h>

#include <chrono>
#include <random>
#include <thread>
#include <vector>

#include "system/processes.hpp"

namespace solidus::test {

inline bool messages_are_late = false;
inline std::minstd_rand random_delay;

inline void wait_at_random() {
  if (!messages_are_late) return;
  if (const auto draw = random_delay() % 8; draw < 3)
    std::this_thread::sleep_for(std::chrono::microseconds(20 * draw));
}

/// Expects that `solve` returns the same bits in whatever order messages arrive. Collective.
template <class Solve>
void expect_same_bits(const Solve& solve) {
  constexpr int k_runs = 6;
  const int rank = processes::rank();
  std::vector<double> first;
  for (int run = 0; run < k_runs; ++run) {
    random_delay.seed(static_cast<unsigned>(1 + 100 * run + rank));
    messages_are_late = run > 0;
    std::vector<double> x = solve();
    messages_are_late = false;
    if (run == 0)
      first = std::move(x);
    else
      EXPECT_TRUE(x == first) << "run " << run;
  }
}

}  // namespace solidus::test

// PETSc's headers count these in macros; PETSc itself and this program call them.
#undef MPI_Isend
#undef MPI_Start
#undef MPI_Startall

extern "C" {
int MPI_Isend(const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* of) {
  solidus::test::wait_at_random();
  return PMPI_Isend(data, n, type, to, tag, comm, of);
}
int MPI_Start(MPI_Request* request) {
  solidus::test::wait_at_random();
  return PMPI_Start(request);
}
int MPI_Startall(int n, MPI_Request* requests) {
  solidus::test::wait_at_random();
  return PMPI_Startall(n, requests);
}
}
