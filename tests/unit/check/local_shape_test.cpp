/// What lies around a place of a casting: metal, skin, and the mould behind that skin.
#include "check/local_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "../contact/bodies.hpp"
#include "check/body_measures.hpp"
#include "check/deepest.hpp"

namespace {

using namespace solidus;
using namespace solidus::check;
using solidus::test::distribute_blocks;
using solidus::test::raw_blocks;

constexpr std::size_t k_lower = 0, k_upper = 1;

/// A bar of metal of 400 x 20 mm on a mould of 400 x 30 mm, per metre of thickness.
mesh::Mesh bar_on_mould() {
  return distribute_blocks(raw_blocks({{0.4, 0.03}, {0.4, 0.02}, {100, 8}, {120, 6}}, mesh::Shape::quad4));
}

double volume_of(const std::vector<MouldLayer>& layers) {
  return std::transform_reduce(layers.begin(), layers.end(), 0.0, std::plus<>(),
                               [](const MouldLayer& layer) { return layer.volume; });
}

TEST(LocalShape, IsTheWholeBodyInABallThatHoldsIt) {
  const mesh::Mesh mesh = bar_on_mould();
  const LocalShape shape =
      measure_around(mesh, AnalysisKind::plane_strain, k_upper, {{0.2, 0.04, 0}, 0.02, 1, 0},
                     {{"upper_bottom", k_lower}, {"upper_bottom", {}}});
  EXPECT_NEAR(shape.volume, 0.4 * 0.02, 1e-12);
  for (const std::size_t skin : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_NEAR(shape.area[skin], 0.4, 1e-12);
    EXPECT_NEAR(shape.all[skin], 0.4, 1e-12);
  }
  ASSERT_EQ(shape.layers[0].size(), 3u);
  EXPECT_NEAR(volume_of(shape.layers[0]), 0.4 * 0.03, 1e-12);
  // Faces and elements do not match, so that one face is next to more of the mould than another.
  for (const MouldLayer& layer : shape.layers[0]) EXPECT_NEAR(layer.volume / layer.area, 0.03, 0.01);
  EXPECT_TRUE(shape.layers[1].empty());
}

TEST(LocalShape, SpreadsTheMouldOverTheFacesAroundEach) {
  const mesh::Mesh mesh = bar_on_mould();
  const LocalShape shape = measure_around(mesh, AnalysisKind::plane_strain, k_upper,
                                          {{0.2, 0.04, 0}, 0.02, 1, 0.02}, {{"upper_bottom", k_lower}});
  for (const MouldLayer& layer : shape.layers[0]) EXPECT_NEAR(layer.volume / layer.area, 0.03, 0.001);
}

/// In the middle of a long bar V/A is its thickness where one side is cooled, and the mould as thick as it
/// is.
TEST(LocalShape, OfAPartOfABarIsItsThickness) {
  const mesh::Mesh mesh = bar_on_mould();
  const LocalShape shape = measure_around(mesh, AnalysisKind::plane_strain, k_upper,
                                          {{0.2, 0.03, 0}, 0.02, 0.08, 0.02}, {{"upper_bottom", k_lower}});
  EXPECT_NEAR(shape.volume / shape.area[0], 0.02, 0.001);
  EXPECT_NEAR(shape.area[0], 0.16, 0.004);
  EXPECT_NEAR(shape.all[0], 0.4, 1e-12);
  EXPECT_NEAR(volume_of(shape.layers[0]) / shape.area[0], 0.03, 0.001);
}

/// The places that are as deep are told by one at an end and one in the middle.
TEST(LocalShape, DeepestPlacesAreSpreadOverTheCasting) {
  const mesh::Mesh mesh = bar_on_mould();
  std::vector<mesh::Point> skin;
  for (int i = 0; i <= 400; ++i) skin.push_back({1e-3 * i, 0.03, 0});
  const Deepest deepest = deepest_below(mesh, k_upper, skin);
  EXPECT_NEAR(deepest.depth, 0.02, 1e-5);
  ASSERT_EQ(deepest.places.size(), 3u);
  EXPECT_TRUE(
      std::ranges::any_of(deepest.places, [](const mesh::Point& p) { return std::abs(p[0] - 0.2) < 0.01; }));
  EXPECT_GT(std::abs(deepest.places[2][0] - deepest.places[0][0]), 0.19);
}

TEST(LocalShape, OfABallWithoutSkinHasNone) {
  const mesh::Mesh mesh = bar_on_mould();
  const LocalShape shape = measure_around(mesh, AnalysisKind::plane_strain, k_upper,
                                          {{0.2, 0.045, 0}, 0.02, 0.008, 0}, {{"upper_bottom", k_lower}});
  EXPECT_GT(shape.volume, 0);
  EXPECT_EQ(shape.area[0], 0);
  EXPECT_TRUE(shape.layers[0].empty());
}

}  // namespace
