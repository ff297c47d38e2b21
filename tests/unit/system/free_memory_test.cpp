#include "system/free_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <vector>

#include "../../sanitized.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#if defined(SOLIDUS_ADDRESS_SANITIZER) || !defined(__GLIBC__)
#define SOLIDUS_OTHER_ALLOCATOR
#endif

namespace solidus {
namespace {

/// Bytes of this process in memory.
[[maybe_unused]] long resident() {
  std::ifstream file("/proc/self/statm");
  long size = 0, pages = 0;
  file >> size >> pages;
  return pages * sysconf(_SC_PAGESIZE);
}

[[maybe_unused]] long left_by(std::size_t bytes) {
  const long before = resident();
  {
    const std::vector<char> array(bytes, 1);
    const volatile char* read = array.data();  // or the array would be left out
    EXPECT_EQ(read[bytes / 2], 1);
  }
  return resident() - before;
}

TEST(FreeMemory, GoesBackToTheSystemAlsoWhereALibraryWantsToKeepIt) {
#ifdef SOLIDUS_OTHER_ALLOCATOR
  GTEST_SKIP() << "another allocator";
#else
  constexpr long k_size = 192 << 20;  // more than the end of the heap, which is kept
  mallopt(M_MMAP_MAX, 0);             // as SuperLU_DIST does
  mallopt(M_TRIM_THRESHOLD, -1);
  EXPECT_GT(left_by(k_size), k_size / 2);
  return_free_memory();
  give_large_arrays_back();
  EXPECT_LT(left_by(k_size), k_size / 8);
#endif
}

/// Pages that the system had to clear for an array that comes ten times.
[[maybe_unused]] long pages_of_ten(std::size_t bytes) {
  left_by(bytes);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  for (int i = 0; i < 10; ++i) left_by(bytes);
  getrusage(RUSAGE_SELF, &after);
  return after.ru_minflt - before.ru_minflt;
}

TEST(FreeMemory, LargeArraysKeepTheirPagesOnlyWhereALibraryTakesThemAgainAndAgain) {
#ifdef SOLIDUS_OTHER_ALLOCATOR
  GTEST_SKIP() << "another allocator";
#else
  constexpr std::size_t k_size = std::size_t{160} << 20, k_page = 4096;
  give_large_arrays_back();
  {
    const FreedArraysStay during_the_call;
    EXPECT_LT(pages_of_ten(k_size), static_cast<long>(k_size / k_page)) << "less than once";
  }
  EXPECT_LT(left_by(k_size), static_cast<long>(k_size / 8));
#endif
}

TEST(FreeMemory, ArraysThatComeAndGoKeepTheirPages) {
#ifdef SOLIDUS_OTHER_ALLOCATOR
  GTEST_SKIP() << "another allocator";
#else
  give_large_arrays_back();
  const auto come_and_go = [] {
    constexpr std::size_t k_arrays = 16, k_size = 3 << 20;
    std::vector<std::vector<char> > arrays;
    for (std::size_t i = 0; i < k_arrays; ++i) arrays.emplace_back(k_size, 1);
    const volatile char* read = arrays.back().data();  // or the arrays would be left out
    EXPECT_EQ(read[k_size / 2], 1);
  };
  come_and_go();
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  for (int i = 0; i < 20; ++i) come_and_go();
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_minflt - before.ru_minflt, 12288) << "48 MiB are 12 288 pages, which came 20 times";
#endif
}

}  // namespace
}  // namespace solidus
