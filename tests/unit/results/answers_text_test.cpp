// The answers of a run as lines for people.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/answers/answers.hpp"

namespace {

using namespace solidus::results;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(AnswersText, AGapThatSolidMetalCannotHaveMadeIsASkinThatSank) {
  Answers a;
  a.gaps = {{"casting_die", {3.664e-3, {0, 0, 66e-3}}}};
  a.distortion = ValueAt{0.867e-3, {38e-3, 0, 74e-3}};
  EXPECT_THAT(text(a, {}),
              HasSubstr("3.664 mm at (0, 0, 66) mm, more than solid metal has deformed: the skin sank"));
  a.gaps.front().gap.value = 1.7e-3;  // a bar that shrinks away from one end
  EXPECT_THAT(text(a, {}), Not(HasSubstr("sank")));
  a.distortion.reset();  // a rigid casting
  EXPECT_THAT(text(a, {}), Not(HasSubstr("sank")));
}

TEST(AnswersText, AnOverlapIsToldWhereItIsNotSmallBesideTheDistortion) {
  Answers a;
  a.overlaps = {{"wheel_bottom", {0.784e-3, {188.2e-3, 4e-3, 0}}}};
  a.distortion = ValueAt{2.336e-3, {192e-3, 165e-3, 0}};
  EXPECT_THAT(text(a, {}), HasSubstr("deepest overlap of 'wheel_bottom' "));
  EXPECT_THAT(text(a, {}),
              HasSubstr("0.784 mm at (188.2, 4, 0) mm: the penalty lets metal shrink into its wall"));
  a.overlaps.front().gap.value = 1.2e-6;
  EXPECT_THAT(text(a, {}), Not(HasSubstr("overlap")));
}

}  // namespace
