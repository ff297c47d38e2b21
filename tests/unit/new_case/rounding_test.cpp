/// Numbers that a person would write into a case file.
#include <gtest/gtest.h>

#include <cmath>

#include "new_case/rounding.hpp"

namespace solidus::new_case {
namespace {

TEST(Rounding, APlaceThatIsRoundButForItsMeasuringIsRound) {
  EXPECT_EQ(round_place(-8.75e-8, 0.12), 0);
  EXPECT_FALSE(std::signbit(round_place(-8.75e-8, 0.12)));
  EXPECT_DOUBLE_EQ(round_place(0.0299995, 0.06), 0.03);
  EXPECT_DOUBLE_EQ(round_place(0.0333333, 0.12), 0.0333333);
  EXPECT_DOUBLE_EQ(round_place(1.27e-2, 0.12), 1.27e-2);
}

TEST(Rounding, WallsHaveWholeMillimetresAndSizesTwoDigits) {
  EXPECT_DOUBLE_EQ(of_wall(0.0281), 0.029);
  EXPECT_DOUBLE_EQ(of_wall(0.00261), 0.0027);
  EXPECT_DOUBLE_EQ(two_digits(0.08749), 0.087);
}

}  // namespace
TEST(Rounding, AHotSpotOnThePlaneOfSymmetryStandsThereWithoutTheNoiseOfItsSearch) {
  EXPECT_EQ(to_micrometre(-1.02723e-9), 0);
  EXPECT_FALSE(std::signbit(to_micrometre(-1.02723e-9)));
  EXPECT_DOUBLE_EQ(to_micrometre(0.1378168), 0.137817);
}

}  // namespace solidus::new_case
