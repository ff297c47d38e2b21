// Texts that say the same of several things are told once.
#include "system/alike_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using solidus::logging::told_once;
using ::testing::ElementsAre;

TEST(AlikeTexts, ThatDifferInNamesAndNumbersAreToldOnceWithAllNames) {
  EXPECT_THAT(told_once({"case.toml:3:1: the body 'rod' is thin",
                         "case.toml:34:1: contact 'nut_1_mould' takes 0.6792 mm",
                         "case.toml:34:1: contact 'nut_2_mould' takes 6e-05 mm",
                         "case.toml:34:1: contact 'nut_3_mould' takes 1.5 mm"}),
              ElementsAre("case.toml:3:1: the body 'rod' is thin",
                          "case.toml:34:1: contact 'nut_1_mould' takes 0.6792 mm; likewise 'nut_2_mould', "
                          "'nut_3_mould'"));
}

TEST(AlikeTexts, OfTwoNamesTheOneThatBothHaveIsNotRepeated) {
  EXPECT_THAT(told_once({"no contact joins 'a' and 'sand'", "no contact joins 'b' and 'sand'",
                         "no contact joins 'c' and 'die'"}),
              ElementsAre("no contact joins 'a' and 'sand'; likewise 'b', 'c' with 'die'"));
}

TEST(AlikeTexts, ThatDifferInNumbersOrWordsAloneStayApart) {
  const std::vector<std::string> apart = {"probe at 3 mm is outside", "probe at 4 mm is outside",
                                          "the body's skin is bare", "the body's wall is bare"};
  EXPECT_EQ(told_once(apart), apart);
}

TEST(AlikeTexts, ThatAreEqualAreOne) {
  EXPECT_THAT(told_once({"body 'a' melts", "body 'a' melts"}), ElementsAre("body 'a' melts"));
}

}  // namespace
