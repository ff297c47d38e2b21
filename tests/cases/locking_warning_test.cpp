/// Triangles that lock with the simultaneous scheme are said to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_run.hpp"

namespace {

std::vector<std::string> warnings_with(const std::string& scheme) {
  solidus::testing::run(
      "cases/aluminium_cylinder", "locking_" + scheme,
      {"time.end=\"1 s\"", "mechanics.simplices=\"automatic\"", "coupling.scheme=\"" + scheme + "\""});
  return solidus::logging::warnings();
}

TEST(LockingWarning, IsOfTheSimultaneousSchemeAlone) {
  using ::testing::Contains, ::testing::HasSubstr, ::testing::Not;
  EXPECT_THAT(warnings_with("simultaneous"), Contains(HasSubstr("locks in melt")));
  EXPECT_THAT(warnings_with("isentropic"), Not(Contains(HasSubstr("locks in melt"))));
}

}  // namespace
