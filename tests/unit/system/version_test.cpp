#include "system/version.hpp"

#include <gtest/gtest.h>

namespace {

using solidus::same_build;

TEST(Version, BuildsAreToldApartByTheirCommits) {
  EXPECT_TRUE(same_build("1.2.0+20261127.2745e1a", "1.2.0+20261127.2745e1a"));
  EXPECT_FALSE(same_build("1.2.0+20261127.2745e1a", "1.2.0+20261127.2745e1a.modified"));
  EXPECT_FALSE(same_build("1.2.0+20261127.2745e1a", "1.2.0+20261126.d4aec1a"));
}

TEST(Version, OneWithoutACommitAgreesWithEveryCommitOfIt) {
  EXPECT_TRUE(same_build("1.2.0", "1.2.0"));
  EXPECT_TRUE(same_build("1.2.0", "1.2.0+20261127.2745e1a"));
  EXPECT_TRUE(same_build("1.2.0+20261127.2745e1a", "1.2.0"));
  EXPECT_FALSE(same_build("1.2.1", "1.2.0+20261127.2745e1a"));
}

}  // namespace
