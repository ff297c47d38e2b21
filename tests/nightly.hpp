/// What tests of a program take on in `./dev nightly` alone.
#pragma once

#include <cstdlib>

namespace solidus::testing {

/// Whether tests take their time: all combinations and the shortest steps. `./dev test` takes samples of
/// them, so that it stays short. CMake sets SOLIDUS_NIGHTLY for the tests of the sources that it names
/// test_nightly_*.
inline bool nightly() {
  return std::getenv("SOLIDUS_NIGHTLY") != nullptr;
}

}  // namespace solidus::testing
