// The outlook on a mesh before it is made.
#include "mesh/making/meshing_outlook.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "mesh/making/reader_message.hpp"

namespace {

using namespace solidus::mesh;

TEST(MeshingOutlook, NodesGoWithTheCubeOfTheSizeWhereElementsAreSmall) {
  // A cube of one metre: its skin counts less and less.
  const auto nodes = [](double size) { return expected_nodes({{6.0, size}}, 1.0, size, 0.4); };
  EXPECT_NEAR(nodes(0.1), 1500 + 360, 1e-6);
  EXPECT_NEAR(nodes(0.01) / nodes(0.02), 8, 0.2);
  EXPECT_NEAR(expected_nodes({{6.0, 0.1}}, 1.0, 0.1, 0.0), nodes(0.1), 1e-6) << "without growth";
}

TEST(MeshingOutlook, SizesThatGrowInwardSaveNodes) {
  // ∫ 1.5/(s + g d)³ dd to the depth V/A = 1/6 by Simpson's rule, and 0.6/s² on the skin.
  constexpr double s = 0.02, g = 0.4, depth = 1.0 / 6, largest = 1;
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double size = s + g * depth * i / n;
    sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * 1.5 / (size * size * size);
  }
  const double expected = 6 * (sum * depth / n / 3 + 0.6 / (s * s));
  EXPECT_NEAR(expected_nodes({{6.0, s}}, 1.0, largest, g), expected, 1e-6 * expected);
  EXPECT_LT(expected, 0.25 * expected_nodes({{6.0, s}}, 1.0, s, 0.0));
}

TEST(MeshingOutlook, GrowthEndsAtTheLargestSize) {
  constexpr double s = 0.02, g = 0.5, largest = 0.04;
  const double reach = (largest - s) / g;
  const double growing = 1.5 * (1 / (s * s) - 1 / (largest * largest)) / (2 * g);
  const double rest = 1.5 * (1.0 / 6 - reach) / (largest * largest * largest);
  EXPECT_NEAR(expected_nodes({{6.0, s}}, 1.0, largest, g), 6 * (growing + rest + 0.6 / (s * s)), 1e-6);
}

TEST(MeshingOutlook, IsToldInUnitsThatOneReads) {
  EXPECT_EQ(outlook_text({{0.14, 0.088, 0.112}, 361e-6, 0.00101, 0.0084, 15600}),
            "140 x 88 x 112 mm and 361 cm3 in elements of 1.01 mm to 8.4 mm, some 16 thousand nodes");
  EXPECT_EQ(outlook_text({{1.4, 0.88, 1.12}, 0.361, 0.0084, 0.0084, 3.4e6}),
            "1.4 x 0.88 x 1.12 m and 361 dm3 in elements of 8.4 mm, some 3.4 million nodes");
  EXPECT_EQ(outlook_text({{0.02, 0.01, 0}, 0, 0, 0, 0}), "20 x 10 x 0 mm");
}

TEST(MeshingOutlook, ArrivesAsItWasAndIsRefusedWhereItIsNoNumber) {
  std::string bytes;
  std::size_t at = 0;
  const PutBytes put = [&](const void* from, std::size_t n) {
    bytes.append(static_cast<const char*>(from), n);
  };
  const TakeBytes take = [&](void* to, std::size_t n) {
    bytes.copy(static_cast<char*>(to), n, at);
    at += n;
  };
  put_outlook({{1, 2, 3}, 4, 5, 6, 7, "'a' and 'b'"}, put);
  const MeshingOutlook back = take_outlook(take);
  EXPECT_EQ(back.overlap, "'a' and 'b'");
  EXPECT_THAT(back.sides, ::testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(back.volume, 4);
  EXPECT_EQ(back.smallest, 5);
  EXPECT_EQ(back.largest, 6);
  EXPECT_EQ(back.nodes, 7);
  put_outlook({{1, 2, 3}, 4, 5, 6, std::numeric_limits<double>::infinity()}, put);
  EXPECT_THROW(take_outlook(take), MessageError);
}

}  // namespace
