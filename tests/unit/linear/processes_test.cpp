/// Messages of processes to each other (system/processes.hpp); on one and on two.
#include "system/processes.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace solidus {
namespace {

TEST(Processes, SumExtremesAndNumbersBeforeAreOfAll) {
  const int rank = processes::rank(), n = processes::count();
  std::array<double, 2> sums{1, 0.5 * rank};
  processes::sum(sums);
  EXPECT_EQ(sums[0], n);
  EXPECT_EQ(sums[1], 0.25 * n * (n - 1));
  std::vector<double> largest{1.0 * rank, -1.0 * rank};
  processes::largest(largest);
  EXPECT_EQ(largest, (std::vector<double>{n - 1.0, 0.0}));
  std::vector<std::int64_t> least{10 - rank};
  processes::least(least);
  EXPECT_EQ(least[0], 11 - n);
  EXPECT_EQ(processes::least(rank + 3), 3);
  EXPECT_EQ(processes::sum_before(rank + 1), rank * (rank + 1) / 2);
}

TEST(Processes, TheLargestOfEqualNumbersIsThatOfTheLowestProcess) {
  EXPECT_EQ(processes::find_largest(7).rank, 0);
  const processes::Largest last = processes::find_largest(-1.0 / (1 + processes::rank()));
  EXPECT_EQ(last.rank, processes::count() - 1);
  EXPECT_EQ(last.value, -1.0 / processes::count());
}

TEST(Processes, WhatIsGatheredStandsInTheOrderOfTheRanks) {
  const int rank = processes::rank(), n = processes::count();
  const std::vector<double> mine(static_cast<std::size_t>(rank), rank);  // none, 1, 2 2, …
  std::vector<double> expected;
  for (int p = 0; p < n; ++p) expected.insert(expected.end(), static_cast<std::size_t>(p), p);
  EXPECT_EQ(processes::gather(mine), expected);
  EXPECT_EQ(processes::gather_on_first(mine), rank == 0 ? expected : std::vector<double>{});
  EXPECT_EQ(processes::gather(std::int64_t{rank}).back(), n - 1);
}

TEST(Processes, TextsOfAnyLengthAndBytesTravel) {
  const int rank = processes::rank(), last = processes::count() - 1;
  std::string text = rank == last ? "of the last process" : "";
  processes::broadcast(text, last);
  EXPECT_EQ(text, "of the last process");
  std::array<double, 1> number{rank == 0 ? 2.5 : 0};
  processes::broadcast(number);
  EXPECT_EQ(number[0], 2.5);
  if (rank == 0)
    for (int p = 1; p <= last; ++p) processes::send(std::vector<char>{'a', static_cast<char>('a' + p)}, p);
  else
    EXPECT_EQ(processes::receive(0), (std::vector<char>{'a', static_cast<char>('a' + rank)}));
  EXPECT_TRUE(processes::all_arrive(60));
}

TEST(Processes, OneAloneLoadsNoPlugInThatReachesOthersOrLooksForDevices) {
  if (processes::count() > 1) GTEST_SKIP() << "several processes reach each other";
  std::ifstream in("/proc/self/maps");
  const std::string loaded(std::istreambuf_iterator<char>(in), {});
#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION < 5  // later ones have these plug-ins in the library
  EXPECT_NE(loaded.find("/mca_pml_ob1.so"), std::string::npos);  // Open MPI's plug-ins are seen there
#endif
  for (const char* name : {"mca_coll_tuned", "mca_coll_han", "mca_osc_rdma", "mca_op_avx", "mca_btl_tcp",
                           "hwloc_pci", "hwloc_opencl", "hwloc_gl"})
    EXPECT_EQ(loaded.find(name), std::string::npos) << name;
  EXPECT_EQ(std::getenv("HWLOC_SYNTHETIC"), nullptr);  // what the start set is taken away again
}

}  // namespace
}  // namespace solidus
