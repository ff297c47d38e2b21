#include "contact/surfaces/polygon.hpp"

#include <gtest/gtest.h>

namespace solidus::contact {
namespace {

const Polygon k_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Clipping, OfTwoShiftedSquaresLeavesTheirOverlap) {
  const Polygon shifted{{0.25, 0.5}, {1.25, 0.5}, {1.25, 1.5}, {0.25, 1.5}};
  EXPECT_NEAR(signed_area(clip(shifted, k_square, 1e-12)), 0.75 * 0.5, 1e-15);
}

TEST(Clipping, OfADiamondAroundASquareLeavesTheSquareWithItsCornersCut) {
  const Polygon diamond{{0.5, -0.25}, {1.25, 0.5}, {0.5, 1.25}, {-0.25, 0.5}};
  const Polygon piece = clip(diamond, k_square, 1e-12);
  EXPECT_EQ(piece.size(), 8u);
  EXPECT_NEAR(signed_area(piece), 1 - 4 * 0.5 * 0.25 * 0.25, 1e-15);
}

TEST(Clipping, OfPolygonsThatOnlyTouchLeavesNothing) {
  const Polygon beside{{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  EXPECT_NEAR(signed_area(clip(beside, k_square, 1e-12)), 0, 1e-15);
  const Polygon away{{3, 0}, {4, 0}, {4, 1}, {3, 1}};
  EXPECT_TRUE(clip(away, k_square, 1e-12).empty());
}

TEST(Clipping, KeepsItsDigitsFarFromTheOrigin) {
  Polygon a = k_square, b = k_square;
  for (auto& p : a) p = {p[0] + 1e6, p[1] - 1e6};
  for (auto& p : b) p = {p[0] + 1e6 + 0.5, p[1] - 1e6 + 0.5};
  EXPECT_NEAR(signed_area(clip(a, b, 1e-9)), 0.25, 1e-9);  // coordinates of 1e6 carry 1e-10
}

}  // namespace
}  // namespace solidus::contact
