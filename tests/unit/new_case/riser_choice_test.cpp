#include "new_case/riser_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/making/parametric_meshes.hpp"

namespace solidus::new_case {
namespace {

/// Bodies that are blocks in one mesh.
class Blocks {
 public:
  void add(const std::string& name, const mesh::Point& low, const std::vector<double>& size) {
    mesh::RawMesh block =
        mesh::make_block({.size = size, .origin = {}, .divisions = {2, 2, 1}}, mesh::Shape::hex8);
    const auto before = static_cast<Index>(mesh_.x.size());
    for (mesh::Point p : block.x) {
      for (std::size_t i = 0; i < 3; ++i) p[i] += low[i];
      mesh_.x.push_back(p);
    }
    mesh::RawGroup group = block.groups.at("block");
    for (mesh::RawBlock& b : group.blocks)
      for (Index& node : b.nodes) node += before;
    mesh_.dimension = 3;
    mesh_.groups[name] = group;
    part_.metal.push_back(name);
  }

  /// Where a riser stands that has metal for such a volume and is 18 mm or more wide.
  DraftRiser riser(const mesh::InscribedSphere& thickest, double volume,
                   const DraftSymmetry* plane = nullptr) {
    return riser(std::vector{thickest}, volume, plane);
  }
  DraftRiser riser(const std::vector<mesh::InscribedSphere>& thickest, double volume,
                   const DraftSymmetry* plane = nullptr) {
    return risers(thickest, volume, {}, plane).risers.front();
  }
  RiserChoice risers(const std::vector<mesh::InscribedSphere>& thickest, double volume,
                     const std::optional<FeedingDistance>& distance = {},
                     const DraftSymmetry* plane = nullptr) {
    part_.mesh = mesh_;
    part_.volume = volume;
    part_.area = volume / 3e-3;
    part_.spheres = thickest;
    return choose_risers(part_, 0.04, distance, plane ? std::optional(*plane) : std::nullopt);
  }

 private:
  mesh::RawMesh mesh_;
  PartMeasures part_;
};

TEST(RiserChoice, StandsOnTheThickestPlaceWhereNothingIsInItsWay) {
  Blocks plate;
  plate.add("plate", {0, 0, 0}, {0.2, 0.2, 0.014});
  const DraftRiser riser = plate.riser({{0.1, 0.11, 0.007}, 0.007}, 1e-4);
  EXPECT_NEAR(riser.foot[0], 0.1, 1e-9);
  EXPECT_NEAR(riser.foot[1], 0.11, 1e-9);
  EXPECT_NEAR(riser.foot[2], 0.014 - 0.05 * riser.diameter, 1e-12);
}

// As in a brake disc, whose hat rises next to the ring that is to be fed: the riser cut the wall of the hat
// and came out of it on the other side, which no mesh could follow.
TEST(RiserChoice, KeepsClearOfAWallBesideThePlaceAndHangsOverTheEdgeForThat) {
  Blocks angle;
  angle.add("plate", {0, 0, 0}, {0.2, 0.06, 0.014});
  angle.add("wall", {0, 0, 0.014}, {0.2, 0.012, 0.05});
  const DraftRiser riser = angle.riser({{0.1, 0.03, 0.007}, 0.007}, 3e-4);
  EXPECT_GT(riser.diameter, 0.04);
  EXPECT_GT(riser.foot[1] - 0.5 * riser.diameter, 0.012 + 0.05 * riser.diameter);
  EXPECT_LT(std::hypot(riser.foot[0] - 0.1, riser.foot[1] - 0.03), 0.41 * riser.diameter);
  EXPECT_NEAR(riser.foot[2], 0.014 - 0.05 * riser.diameter, 1e-12);
}

// As on the lug of a bearing cap, with a spot face of 3 mm for the head of the bolt: the foot stood 1 mm
// above it.
TEST(RiserChoice, FillsAShallowRecessUnderItsFoot) {
  Blocks lug;
  lug.add("lug", {0, 0, 0}, {0.1, 0.06, 0.03});
  lug.add("recess", {0.1, 0, 0}, {0.1, 0.06, 0.027});
  const DraftRiser riser = lug.riser({{0.09, 0.03, 0.015}, 0.015}, 3e-4);
  EXPECT_NEAR(riser.foot[2], 0.027 - 0.05 * riser.diameter, 1e-12);
  EXPECT_NEAR(riser.foot[2] + riser.height, 0.03 + 1.5 * riser.diameter, 1e-3);
}

// As on a kettlebell, whose handle is above its ball.
TEST(RiserChoice, SaysHowMuchMouldLiesBetweenAHandleAndThePlaceBelowIt) {
  Blocks bell;
  bell.add("ball", {0, 0, 0}, {0.1, 0.1, 0.1});
  bell.add("handle", {0.04, 0, 0.15}, {0.02, 0.1, 0.02});
  const DraftRiser riser = bell.riser({{0.05, 0.05, 0.05}, 0.05}, 1e-3);
  ASSERT_TRUE(riser.hollow);
  EXPECT_NEAR(*riser.hollow, 0.05, 1e-6);
  EXPECT_GT(riser.foot[2], 0.1);
}

TEST(RiserChoice, PrefersAPlaceFromWhichMetalLeadsStraightUp) {
  Blocks two;
  two.add("below", {0, 0, 0}, {0.1, 0.1, 0.1});
  two.add("handle", {0.04, 0, 0.15}, {0.02, 0.1, 0.02});
  two.add("open", {0.1, 0, 0}, {0.09, 0.09, 0.3});
  const DraftRiser riser = two.riser({{{0.05, 0.05, 0.05}, 0.05}, {{0.145, 0.045, 0.045}, 0.045}}, 1e-3);
  EXPECT_FALSE(riser.hollow);
  EXPECT_GT(riser.foot[0], 0.1);
}

// As on the L of two blocks that the modulus of the whole part fed with a riser that froze before it.
TEST(RiserChoice, HasTheModulusOfThePlaceThatItFeedsAndNotOfTheWholePart) {
  Blocks part;
  part.add("block", {0, 0, 0}, {0.06, 0.06, 0.06});
  part.add("sheet", {0.06, 0, 0}, {0.3, 0.06, 0.006});
  const DraftRiser riser = part.riser({{0.03, 0.03, 0.03}, 0.03}, 3e-4);
  // Of a cube V/A is a sixth of its edge, a little more where the sheet takes its skin.
  EXPECT_NEAR(riser.modulus, 0.01, 0.0008);
  EXPECT_GE(riser.diameter, 1.2 * riser.modulus / (0.375 / 1.75));
}

TEST(RiserChoice, OfAPlateIsThatOfItsHalfThickness) {
  Blocks plate;
  plate.add("plate", {0, 0, 0}, {0.2, 0.2, 0.014});
  EXPECT_NEAR(plate.riser({{0.1, 0.1, 0.007}, 0.007}, 1e-4).modulus, 0.007, 1e-4);
}

TEST(RiserChoice, EveryThickPlaceThatIsCutOffHasOne) {
  Blocks bells;
  bells.add("left", {0, 0, 0}, {0.06, 0.06, 0.06});
  bells.add("bar", {0.06, 0.02, 0.02}, {0.1, 0.02, 0.02});
  bells.add("right", {0.16, 0, 0}, {0.05, 0.06, 0.06});
  const std::vector<mesh::InscribedSphere> places = {{{0.03, 0.03, 0.03}, 0.03},
                                                     {{0.185, 0.03, 0.03}, 0.025}};
  const RiserChoice choice = bells.risers(places, 4e-4);
  ASSERT_EQ(choice.risers.size(), 2U);
  EXPECT_EQ(choice.risers[0].name, "riser_1");
  EXPECT_NEAR(choice.risers[0].foot[0], 0.03, 0.005);
  EXPECT_NEAR(choice.risers[1].foot[0], 0.185, 0.005);
  EXPECT_LT(choice.risers[1].diameter, choice.risers[0].diameter);
}

TEST(RiserChoice, PlacesThatThickMetalConnectsShareOne) {
  Blocks bar;
  bar.add("bar", {0, 0, 0}, {0.3, 0.06, 0.06});
  const std::vector<mesh::InscribedSphere> places = {{{0.06, 0.03, 0.03}, 0.03}, {{0.24, 0.03, 0.03}, 0.03}};
  EXPECT_EQ(bar.risers(places, 1e-3).risers.size(), 1U);
}

// Bishop and Pellini: 4.5 thicknesses of a plate from the edge of the riser to an end.
TEST(RiserChoice, SteelPlatesThatAreLongerThanOneRiserFeedsHaveMore) {
  Blocks plate;
  plate.add("plate", {0, 0, 0}, {1.0, 0.12, 0.03});
  const std::vector<mesh::InscribedSphere> middle = {{{0.5, 0.06, 0.015}, 0.015}};
  EXPECT_EQ(plate.risers(middle, 3.6e-3).risers.size(), 1U);
  const RiserChoice fed = plate.risers(middle, 3.6e-3, FeedingDistance());
  EXPECT_GE(fed.risers.size(), 3U);
  for (const double end : {0.0, 1.0}) {
    double nearest = 1;
    for (const DraftRiser& r : fed.risers)
      nearest = std::min(nearest, std::abs(r.foot[0] - end) - 0.5 * r.diameter);
    EXPECT_LT(nearest, 4.5 * 0.03 + 0.01);
  }
}

TEST(FeedingDistance, IsThatOfThePlatesAndBarsThatWerePoured) {
  EXPECT_DOUBLE_EQ(FeedingDistance().along(0.0254, true, true), 4.5 * 0.0254);
  EXPECT_DOUBLE_EQ(FeedingDistance().along(0.0254, true, false), 2 * 0.0254);
  EXPECT_DOUBLE_EQ(FeedingDistance().along(4 * 0.0254, false, true), 12 * 0.0254);  // 6 sqrt(4 in)
}

// As on a sheave, whose hub has a bore: a riser next to the bore hangs over the blade that begins there.
TEST(RiserChoice, StandsOnTheMiddleOfABossWithABore) {
  Blocks boss;
  boss.add("west", {0, 0, 0}, {0.02, 0.06, 0.06});
  boss.add("east", {0.04, 0, 0}, {0.02, 0.06, 0.06});
  boss.add("south", {0.02, 0, 0}, {0.02, 0.02, 0.06});
  boss.add("north", {0.02, 0.04, 0}, {0.02, 0.02, 0.06});
  const DraftRiser riser = boss.riser({{0.01, 0.03, 0.03}, 0.01}, 2e-4);
  EXPECT_NEAR(riser.foot[0], 0.03, 0.003);
  EXPECT_NEAR(riser.foot[1], 0.03, 0.003);
}

}  // namespace
}  // namespace solidus::new_case
