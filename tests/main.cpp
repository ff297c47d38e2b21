/// The entry point of every test program: PETSc and MPI live as long as the tests.
///
/// --source=NAME runs the tests that NAME.cpp defines and no others: a program holds those of many sources.
/// The exit code is 77 where every test that was asked for was skipped, which ctest then counts as skipped.
#include <gtest/gtest.h>
#include <petscsys.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "parallel/petsc_session.hpp"
#include "sanitized.hpp"

#ifdef SOLIDUS_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

namespace {

/// Leaks of memory that MPI keeps from its start to its end, or never frees, are ignored. Without
/// AddressSanitizer no leaks are detected.
void ignore_leaks([[maybe_unused]] bool ignore) {
#ifdef SOLIDUS_ADDRESS_SANITIZER
  ignore ? __lsan_disable() : __lsan_enable();
#endif
}

/// Ends the process where something leaked: before MPI unloads its plug-ins and loses what they hold.
void check_leaks() {
#ifdef SOLIDUS_ADDRESS_SANITIZER
  __lsan_do_leak_check();
#endif
}

/// The filter of GoogleTest that leaves the tests of one source; empty where it has none.
std::string tests_of(std::string_view source) {
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  std::string filter;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const ::testing::TestInfo& test = *suite.GetTestInfo(t);
      if (std::filesystem::path(test.file()).stem() != source) continue;
      filter += std::string(filter.empty() ? "" : ":") + suite.name() + "." + test.name();
    }
  }
  return filter;
}

/// Applies --source. False where the arguments make no sense.
bool select_tests(int argc, char** argv) {
  constexpr std::string_view option = "--source=";
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(option)) {
      std::fprintf(stderr, "unknown argument '%s'; known: --source=NAME and those of GoogleTest\n", argv[i]);
      return false;
    }
    if (::testing::GTEST_FLAG(filter) != "*") {
      std::fprintf(stderr, "--source and --gtest_filter cannot be given together\n");
      return false;
    }
    const std::string filter = tests_of(argument.substr(option.size()));
    if (filter.empty()) {
      std::fprintf(stderr, "%s: no source of this program has that name, or it defines no test\n", argv[i]);
      return false;
    }
    ::testing::GTEST_FLAG(filter) = filter;
  }
  return true;
}

constexpr int k_all_skipped = 77;  ///< SKIP_RETURN_CODE of tests/CMakeLists.txt

/// Whether tests were asked for and each of them was skipped. Prints why tests were skipped, a line a reason.
bool all_skipped() {
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  std::set<std::string> reasons;
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const ::testing::TestResult& result = *suite.GetTestInfo(t)->result();
      for (int part = 0; part < result.total_part_count(); ++part)
        if (result.GetTestPartResult(part).skipped())
          reasons.insert(result.GetTestPartResult(part).message());
    }
  }
  const bool every = all.test_to_run_count() > 0 && all.skipped_test_count() == all.test_to_run_count();
  for (const std::string& reason : reasons)
    std::printf("%s: %s\n", every ? "all of it is skipped" : "skipped", reason.c_str());
  return every;
}

}  // namespace

int main(int argc, char** argv) {
  namespace petsc = solidus::petsc;
  ::testing::InitGoogleTest(&argc, argv);
  if (!select_tests(argc, argv)) return 2;
  ignore_leaks(true);
  if (!petsc::start({})) return 3;
  ignore_leaks(false);
  int rank = 0, n_processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  if (rank !=
      0) {  // one process reports; a failure elsewhere still fails the run through the combined result
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  int result = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  if (result == 0 && n_processes == 1 && all_skipped()) result = k_all_skipped;
  check_leaks();
  petsc::end();
  return result;
}
