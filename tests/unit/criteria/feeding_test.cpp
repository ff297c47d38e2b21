/// Feeding with heat alone: pipes of closed form, cavities, sinks, pores, and their balance; on one process
/// and on two.
#include "criteria/feeding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "feeding_bodies.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using criteria::FeedingTotals;
using mesh::Shape;
using test::FreezingBody;
using test::k_shrinks;

constexpr double k_shrinkage = k_shrinks / (1 + k_shrinks);  // of the metal, (ρ_s − ρ_l)/ρ_s

/// The share of the room around a node beyond `front` on the way from `inner` to `outer`.
double frozen_share(double x, double h, double length, double front, bool around_axis) {
  double inner = std::max(0.0, x - h / 2), outer = std::min(length, x + h / 2);
  front = std::clamp(front, inner, outer);
  if (around_axis) {
    inner *= inner;
    outer *= outer;
    front *= front;
  }
  return (outer - front) / (outer - inner);
}

/// Heights to which metal reaches above the bottom, as shares, by the place x. Collective.
std::map<long, double> surface_heights(FreezingBody& body) {
  std::vector<double> own;
  for (Index i = 0; i < body.mesh.n_owned_nodes; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double room = body.rows()(k, criteria::k_room);
    own.insert(own.end(), {body.mesh.x[k][0], room, room * body.rows().fill(k)});
  }
  const std::vector<double> all = processes::gather(own);
  std::map<long, double> room, metal;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    room[std::lround(1e6 * all[i])] += all[i + 1];
    metal[std::lround(1e6 * all[i])] += all[i + 2];
  }
  for (auto& [x, volume] : metal) volume /= room[x];
  return metal;
}

void expect_closed(const FeedingTotals& totals) {
  EXPECT_LT(std::abs(totals.defect()), 1e-11);
}

class PipeOfClosedForm : public ::testing::TestWithParam<bool> {};

// A plate or a cylinder freezes from its side alone: z/H = (x/L)^b, (r/R)^2b.
TEST_P(PipeOfClosedForm, IsMetWithinThreeThousandths) {
  const bool cylinder = GetParam();
  const int n = 80, steps = 400;
  const double length = 0.04, h = length / n;
  FreezingBody body(test::feeding_block(Shape::quad4, {length, 0.1}, {n, 50}),
                    cylinder ? AnalysisKind::axisymmetric : AnalysisKind::plane_strain,
                    test::shrinking_metal());
  const auto solid = [&](double front) {
    return [=](const mesh::Point& x) { return frozen_share(x[0], h, length, front, cylinder); };
  };
  body.start(solid(length));
  for (int k = 1; k <= steps; ++k) body.step(k, solid(length * (steps - k) / steps));
  const FeedingTotals totals = body.totals();
  EXPECT_NEAR(totals.pipe / totals.room, k_shrinkage, 1e-4);  // the middle empties in the last step
  EXPECT_NEAR(totals.freezing / totals.room, k_shrinkage, 1e-12);
  expect_closed(totals);
  const std::map<long, double> heights = surface_heights(body);
  for (const double share : {0.5, 0.2, 0.1, 0.05})
    EXPECT_NEAR(heights.at(std::lround(1e6 * share * length)),
                std::pow(share, cylinder ? 2 * k_shrinks : k_shrinks), 3e-3)
        << share;
}

INSTANTIATE_TEST_SUITE_P(PlateAndCylinder, PipeOfClosedForm, ::testing::Bool());

/// A block that freezes from all sides at once: its solid fraction by the distance from the skin.
double from_all_sides(const mesh::Point& x, const std::vector<double>& size, double front, double h) {
  double depth = 1;
  for (std::size_t d = 0; d < size.size(); ++d) depth = std::min({depth, x[d], size[d] - x[d]});
  return std::clamp((front - depth) / h + 0.5, 0.0, 1.0);
}

struct Block {
  Shape shape;
  std::vector<double> size;
  std::vector<int> divisions;
};

class ClosedBlock : public ::testing::TestWithParam<Block> {};

TEST_P(ClosedBlock, LeavesACavityBelowItsHighestMelt) {
  const Block& block = GetParam();
  const int dimension = static_cast<int>(block.size.size());
  FreezingBody body(test::feeding_block(block.shape, block.size, block.divisions),
                    dimension == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain,
                    test::shrinking_metal(), {.covered = {"block"}});
  const double h = block.size[0] / block.divisions[0];
  const auto solid = [&](double front) {
    return [&, front](const mesh::Point& x) { return from_all_sides(x, block.size, front, h); };
  };
  body.start(solid(-h));
  const int steps = 60;
  for (int k = 1; k <= steps; ++k)
    body.step(k, solid(-h + (block.size[0] / 2 + 2 * h) * k / static_cast<double>(steps)));
  const FeedingTotals totals = body.totals();
  expect_closed(totals);
  EXPECT_EQ(totals.pipe, 0);
  EXPECT_NEAR((totals.cavity + totals.sink + totals.pores) / totals.room, k_shrinkage, 1e-5);
  EXPECT_GT(totals.cavity, 0.6 * k_shrinkage * totals.room);
  double height = -1;
  for (const criteria::CriterionResult& result : body.feeding->findings(body.record))
    if (result.name == "cavity_1_volume") height = result.where[dimension == 3 ? 2 : 1];
  EXPECT_GT(height, 0.5 * block.size.back());
}

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedBlock,
                         ::testing::Values(Block{Shape::quad4, {0.04, 0.06}, {12, 18}},
                                           Block{Shape::quad8, {0.04, 0.06}, {8, 12}},
                                           Block{Shape::tri3, {0.04, 0.06}, {12, 18}},
                                           Block{Shape::tri6, {0.04, 0.06}, {8, 12}},
                                           Block{Shape::hex8, {0.04, 0.04, 0.06}, {8, 8, 12}},
                                           Block{Shape::hex20, {0.04, 0.04, 0.06}, {6, 6, 8}},
                                           Block{Shape::tet4, {0.04, 0.04, 0.06}, {8, 8, 12}},
                                           Block{Shape::tet10, {0.04, 0.04, 0.06}, {6, 6, 8}}));

// Two heads, of which one is open: the pool splits where the bar between them has frozen.
TEST(Feeding, OfAPoolThatSplitsIsAPipeAndACavity) {
  FreezingBody body(test::feeding_block(Shape::quad4, {0.2, 0.04}, {50, 10}), AnalysisKind::plane_strain,
                    test::shrinking_metal(890, 910), {.covered = {}});
  // A skin on top of the left half is solid from the start, and so is a place in the middle soon.
  const auto solid = [](double t) {
    return [t](const mesh::Point& x) {
      const double middle = 1.6 * t - std::abs(x[0] - 0.1) / 0.03,
                   lid = x[0] < 0.1 && x[1] > 0.037 ? 2.0 : 0.0;
      return std::clamp(std::max({middle, lid, 2 * (t - 0.5)}), 0.0, 1.2);
    };
  };
  body.start(solid(0));
  for (int k = 1; k <= 100; ++k) body.step(k, solid(0.012 * k));
  const FeedingTotals totals = body.totals();
  expect_closed(totals);
  EXPECT_GT(totals.pipe, 0.3 * k_shrinkage * totals.room);
  EXPECT_GT(totals.cavity + totals.sink, 0.1 * k_shrinkage * totals.room);
  EXPECT_GT(body.found("pipe_1_depth"), 0);
}

// Metal that freezes everywhere alike: below coherency it draws its skin in, beyond it nothing feeds it.
TEST(Feeding, OfMetalThatFreezesAtOnceIsASinkAndThenPores) {
  FreezingBody body(test::feeding_block(Shape::quad4, {0.04, 0.06}, {8, 12}), AnalysisKind::plane_strain,
                    test::shrinking_metal(880, 920), {.covered = {"block"}, .cooled = {"x_max", "y_max"}});
  const auto solid = [](double f) { return [f](const mesh::Point&) { return f; }; };
  body.start(solid(0));
  for (int k = 1; k <= 110; ++k) body.step(k, solid(0.01 * k));
  const FeedingTotals totals = body.totals();
  expect_closed(totals);
  EXPECT_EQ(totals.pipe, 0);
  EXPECT_GT(totals.sink, 0.65 * k_shrinkage * totals.room);
  EXPECT_NEAR((totals.sink + totals.cavity + totals.pores) / totals.room, k_shrinkage, 1e-12);
  EXPECT_NEAR(totals.pores / totals.room, 0.25 * k_shrinkage, 0.04 * k_shrinkage);
}

// Whatever freezes, melts, cools and warms: what shrinks is what the holes have got, and metal stays.
TEST(Feeding, BalancesWhateverTheStatesAre) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1);
  for (int run = 0; run < 40; ++run) {
    material::Material metal = test::shrinking_metal(run % 3 == 0 ? 900 : 860, 900);
    metal.expansion = Table({300, 900, 1000}, {20e-6, 25e-6, 35e-6});
    const bool solid3 = run % 4 == 3;
    FreezingBody body(
        solid3 ? test::feeding_block(Shape::tet4, {0.04, 0.04, 0.06}, {4, 4, 6})
               : test::feeding_block(run % 4 == 0 ? Shape::tri3 : Shape::quad4, {0.04, 0.06}, {8, 12}),
        solid3         ? AnalysisKind::solid
        : run % 4 == 1 ? AnalysisKind::axisymmetric
                       : AnalysisKind::plane_strain,
        metal, run % 2 == 0 ? criteria::FeedingOptions{} : criteria::FeedingOptions{.covered = {"block"}});
    std::array<double, 6> a{};
    for (double& c : a) c = 120 * any(random);
    const double swing = any(random);
    const auto solid = [&](double t) {
      return [&, t](const mesh::Point& x) {
        const double wave = std::sin(a[0] * x[0] + a[1] * x[1] + a[2] * x[2] + a[3] * t / 40) +
                            std::cos(a[4] * x[0] - a[5] * x[1]);
        return 2.4 * t - 0.7 + 0.5 * wave * (1 - t) + swing * std::sin(20 * t);
      };
    };
    body.start(solid(0));
    for (int k = 1; k <= 40; ++k) body.step(k, solid(k / 40.0));
    const FeedingTotals totals = body.totals();
    EXPECT_LT(std::abs(totals.defect()), 1e-10) << "run " << run;
    for (Index i = 0; i < body.mesh.n_owned_nodes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      ASSERT_TRUE(std::isfinite(body.rows()(k, criteria::k_metal))) << "run " << run;
      ASSERT_LE(body.rows()(k, criteria::k_pores), 1) << "run " << run;
    }
  }
}

TEST(Feeding, ComplainsAboutAGroupThatIsNone) {
  try {
    FreezingBody body(test::feeding_block(Shape::quad4, {0.04, 0.06}, {4, 6}), AnalysisKind::plane_strain,
                      test::shrinking_metal(), {.vented = {"tap"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), std::string("feeding.vented: the mesh has no group 'tap'"));
  }
}

}  // namespace
}  // namespace solidus
