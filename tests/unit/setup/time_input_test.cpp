/// What may change in an adaptive step where the case does not say it (setup/time_input.hpp).
#include "setup/time_input.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace solidus::setup {
namespace {

TEST(SolidFractionChange, IsThatOfHeatWhereNothingDeforms) {
  EXPECT_EQ(solid_fraction_change({}, std::vector<double>{0.0}, 0.02), 0.1);
  EXPECT_EQ(solid_fraction_change({}, {}, 0.02), 0.1);
}

TEST(SolidFractionChange, IsTheStandardOneWhereBodiesDeformTimesTheRootOfTheErrorAllowed) {
  const std::vector<double> sections{0.01, 0.02};
  EXPECT_EQ(solid_fraction_change({}, sections, 0.02), 0.02);
  cases::TimeSpec coarse;
  coarse.displacement_error = 4 * displacement_error({}, sections);
  EXPECT_DOUBLE_EQ(solid_fraction_change(coarse, sections, 0.02), 0.04);
  EXPECT_DOUBLE_EQ(skin_change(coarse, sections), 2 * skin_change({}, sections));
}

TEST(SolidFractionChange, ThatIsGivenStaysWhatItIs) {
  cases::TimeSpec given;
  given.solid_fraction_change = 0.07;
  EXPECT_EQ(solid_fraction_change(given, std::vector<double>{0.01}, 0.02), 0.07);
  EXPECT_EQ(solid_fraction_change(given, {}, 0.02), 0.07);
}

}  // namespace
}  // namespace solidus::setup
