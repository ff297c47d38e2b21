#include "system/errors.hpp"

#include <gtest/gtest.h>

namespace solidus {
namespace {

TEST(SourceLocation, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ((SourceLocation{"case.toml", 12, 3}.text()), "case.toml:12:3");
  EXPECT_EQ((SourceLocation{"case.toml", 12, 0}.text()), "case.toml:12");
  EXPECT_EQ((SourceLocation{"case.toml", 0, 0}.text()), "case.toml");
  EXPECT_EQ((SourceLocation{"", 7, 2}.text()), "line 7:2");
  EXPECT_EQ(SourceLocation{}.text(), "");
}

TEST(InputError, SaysWhereWhatAndWhatIsAllowed) {
  const InputError error({"case.toml", 4, 1}, "unknown key 'stop'", "did you mean 'step'?");
  EXPECT_STREQ(error.what(), "case.toml:4:1: unknown key 'stop'\n  did you mean 'step'?");
  EXPECT_EQ(error.where().line, 4);
  EXPECT_STREQ(InputError({}, "no mesh").what(), "no mesh");
}

TEST(StepRejected, KeepsTheReasonApartFromThePlace) {
  const StepRejected rejected("heat: no convergence in 25 iterations", "element 7");
  EXPECT_EQ(rejected.reason(), "heat: no convergence in 25 iterations");
  EXPECT_EQ(rejected.where(), "element 7");
  EXPECT_STREQ(rejected.what(), "heat: no convergence in 25 iterations; element 7");
  EXPECT_EQ(rejected.failure(), Failure::other);
}

TEST(StepRejected, TakesAnAdditionToItsReasonOnTheWay) {
  StepRejected rejected("mechanics: no convergence", "node 7", Failure::equilibrium);
  rejected.append(" (contact 'mould')");
  EXPECT_EQ(rejected.reason(), "mechanics: no convergence (contact 'mould')");
  EXPECT_STREQ(rejected.what(), "mechanics: no convergence (contact 'mould'); node 7");
  EXPECT_EQ(rejected.failure(), Failure::equilibrium);
}

}  // namespace
}  // namespace solidus
