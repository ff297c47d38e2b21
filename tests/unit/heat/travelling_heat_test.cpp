/// The heat that sources deliver while they travel.
#include "heat/loads/travelling_heat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "block.hpp"

namespace solidus {
namespace {

using heat::TravellingShape;
using Kind = TravellingShape::Kind;

/// Along x at 10 mm/s on the upper face of a box of 200 × 60 × 30 mm.
std::shared_ptr<const TravelPath> line_on_top() {
  return std::make_shared<TravelPath>(
      std::vector<TravelPoint>{{0, {0.05, 0.031, 0.03}, 1}, {10, {0.15, 0.031, 0.03}, 0}});
}

TravellingShape shape(Kind kind) {
  TravellingShape s;
  s.kind = kind;
  s.radius = 1.5e-3;
  s.width = 2e-3, s.depth = 3e-3, s.front = 1e-3, s.rear = 5e-3, s.front_share = 0.3;
  return s;
}

class Shapes : public ::testing::TestWithParam<Kind> {};

/// Elements of 20 mm, of which a source hides in one: in each of a fifth of a second it moves by less than
/// its length, in ten seconds over the whole path. A step before its begin and one behind its end bring
/// nothing.
TEST_P(Shapes, DeliverTheirPowerHoweverCoarseTheMesh) {
  for (const mesh::Shape element : {mesh::Shape::hex8, mesh::Shape::tet4}) {
    const mesh::Mesh mesh = test::block_mesh(element, {0.2, 0.06, 0.03}, {10, 3, 2});
    const PlaceFunction heat(std::make_shared<heat::TravellingHeat>(
        line_on_top(), shape(GetParam()), Table(std::vector{0.0, 10.0}, std::vector{0.6, 0.8}), 0.5));
    heat::ThermalConditions conditions;
    if (GetParam() == Kind::gaussian)
      conditions.fluxes = {{"torch", "z_max", heat, 1000.0}};
    else
      conditions.sources = {{"torch", "block", heat, 1000.0}};
    material::Material metal = test::metal(10);
    metal.phase_changes.clear();
    heat::ThermalPhase phase(mesh, AnalysisKind::solid, {metal}, conditions);
    const heat::ThermalState start = phase.states().initial(std::array{400.0});
    heat::ThermalState end;
    const auto brought = [&](double from, double to) {
      return phase.solve(start, end, to, to - from).balance.conditions[0].heat;
    };
    // A cylinder and a line end with a jump, which the subdivision of elements finds to its smallest part.
    const double tolerance = GetParam() == Kind::line ? 0.02 : GetParam() == Kind::cylinder ? 0.01 : 5e-3;
    EXPECT_NEAR(brought(4.0, 4.2), 0.2 * 1000 * 0.682, tolerance * 136);
    if (element == mesh::Shape::hex8) EXPECT_NEAR(brought(5, 5.6), 0.6 * 1000 * 0.706, tolerance * 424);
    EXPECT_EQ(brought(10, 11), 0);
    EXPECT_EQ(brought(-1, 0), 0);
    // Half of the step lies before its begin.
    EXPECT_NEAR(brought(-0.2, 0.2), 0.2 * 1000 * 0.602, tolerance * 120);
  }
}

std::string name_of_kind(const ::testing::TestParamInfo<Kind>& instance) {
  constexpr std::array k_names{"double_ellipsoid", "gaussian", "cylinder", "line"};
  return k_names[static_cast<std::size_t>(instance.param)];
}

INSTANTIATE_TEST_SUITE_P(All, Shapes,
                         ::testing::Values(Kind::double_ellipsoid, Kind::gaussian, Kind::cylinder,
                                           Kind::line),
                         name_of_kind);

TEST(TravellingHeat, PointsWhereItIsHeadedAndSaysHowFastItMoves) {
  TravellingShape s = shape(Kind::double_ellipsoid);
  const auto turning = std::make_shared<TravelPath>(std::vector<TravelPoint>{
      {0, {0, 0, 0}, 1}, {1, {0.1, 0, 0}, 1}, {2, {0.1, 0.2, 0}, 1}, {3, {0.1, 0.2, 0}, 0}});
  const heat::TravellingHeat heat(turning, s, Table(1.0), 0.5);
  const auto at = [&](double time, Position x) {
    double value = 0;
    heat.values(std::span(&x, 1), time, std::span(&value, 1));
    return value;
  };
  // The tail of 5 mm lies behind, along x first, then along y.
  EXPECT_GT(at(0.5, {0.046, 0, 0}), 0.05 * at(0.5, {0.05, 0, 0}));
  EXPECT_LT(at(0.5, {0.054, 0, 0}), 1e-6 * at(0.5, {0.05, 0, 0}));
  EXPECT_GT(at(1.5, {0.1, 0.096, 0}), 0.05 * at(1.5, {0.1, 0.1, 0}));
  EXPECT_LT(at(1.5, {0.104, 0.1, 0}), 1e-4 * at(1.5, {0.1, 0.1, 0}));
  // Goldak's peak in front: 6 √3 f/(a b c π √π).
  EXPECT_NEAR(at(0.5, {0.05, 0, 0}), 6 * std::sqrt(3.0) * 0.6 / (2e-3 * 3e-3 * 1e-3 * std::pow(M_PI, 1.5)),
              1);
  EXPECT_DOUBLE_EQ(heat.crossing(0, 0.9)->time, 0.06);
  EXPECT_DOUBLE_EQ(heat.crossing(0, 2)->time, 0.03);
  EXPECT_EQ(heat.crossing(2.1, 2.9)->time, HUGE_VAL);
}

TEST(TravellingHeat, ThatMovesAlongItsBeamOrStandsHasSomeFrame) {
  const auto drilling =
      std::make_shared<TravelPath>(std::vector<TravelPoint>{{0, {0, 0, 0}, 1}, {1, {0, 0, -0.1}, 0}});
  const auto standing =
      std::make_shared<TravelPath>(std::vector<TravelPoint>{{0, {0, 0, 0}, 1}, {1, {0, 0, 0}, 0}});
  for (const auto& path : {drilling, standing}) {
    const heat::TravellingHeat heat(path, shape(Kind::double_ellipsoid), Table(1.0), 0.5);
    const Position x = path->at(0.5);
    double value = 0;
    heat.values(std::span(&x, 1), 0.5, std::span(&value, 1));
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_GT(value, 0);
  }
}

}  // namespace
}  // namespace solidus
