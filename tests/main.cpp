/// The entry point of every test program: PETSc and MPI live as long as the tests.
#include <gtest/gtest.h>
#include <petscsys.h>

#if defined(__SANITIZE_ADDRESS__)
#define SOLIDUS_LEAK_CHECK
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SOLIDUS_LEAK_CHECK
#endif
#endif

#ifdef SOLIDUS_LEAK_CHECK
#include <sanitizer/lsan_interface.h>
#endif

namespace {

/// What MPI keeps from its start to its end, or never frees, is not looked at. Without AddressSanitizer
/// nothing is.
void ignore_leaks([[maybe_unused]] bool ignore) {
#ifdef SOLIDUS_LEAK_CHECK
  ignore ? __lsan_disable() : __lsan_enable();
#endif
}

/// Ends the process where something leaked: before MPI unloads its plug-ins and loses what they hold.
void check_leaks() {
#ifdef SOLIDUS_LEAK_CHECK
  __lsan_do_leak_check();
#endif
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ignore_leaks(true);
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 3;
  ignore_leaks(false);
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank !=
      0) {  // one process reports; a failure elsewhere still fails the run through the combined result
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  int result = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  check_leaks();
  PetscFinalize();
  return result;
}
