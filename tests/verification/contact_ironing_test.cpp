/// Ironing: a rigid cylinder is pressed into an elastic block and drawn along it.
///
///            ╭───╮  →             the die: an arc of the mesh, all nodes moved as one; master
///            │   │
///       ┌────╰───╯─────────┐      the block: E, ν, friction; slave, held at the bottom
///       └──────────────────┘
///
/// Smooth force curves that converge with the mesh; a step that jams is cut and tried again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "contact_rubbing.hpp"
#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;

constexpr double k_length = 0.1, k_height = 0.025, k_radius = 0.03, k_depth = 1e-3, k_way = 0.05;
constexpr double k_young = 1e9;

enum class Die { mesh, cylinder };

/// @param n cells over the block's height
test::Rubbing make_ironing(Shape shape, int n, contact::FrictionParameters friction, Die die) {
  const bool flat = mesh::dimension(shape) == 2;
  mesh::TwoBlocks blocks{{k_length, k_height}, {80, 0.01}, {4 * n, n}, {20, 1}, 0};
  if (!flat) blocks = {{k_length, 0.02, k_height}, {80, 0.03, 0.01}, {4 * n, 2, n}, {20, 1, 1}, 0};
  const std::size_t up = flat ? 1 : 2;
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  test::map_body(raw, "upper", [&](mesh::Point x) {
    const double a = (x[0] - 40) * std::numbers::pi / 180, r = k_radius - (x[up] - k_height);
    x[0] = 0.025 + r * std::sin(a);
    x[up] = k_height + k_radius - r * std::cos(a);
    if (!flat) x[1] -= 0.005;
    return x;
  });
  const int last = static_cast<int>(up);
  const std::string bottom = flat ? "lower_y_min" : "lower_z_min";
  mechanics::MechanicalConditions c;
  for (int i = 0; i <= last; ++i) c.displacements.push_back({bottom, i, 0.0});
  const Table along({0, 1, 2}, {0, 0, k_way}), down({0, 1, 2}, {0, -k_depth, -k_depth});
  contact::ContactParameters spec = test::rubbing(std::move(friction), 20 * k_young / (k_height / n));
  spec.slave = "lower_top";
  spec.master = "upper_bottom";
  spec.smoothing = true;
  spec.gauss_degree = 4;
  spec.search_distance = 0.01;
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = 1e-6;
  options.newton.max_iterations = 20;
  const AnalysisKind kind = flat ? AnalysisKind::plane_strain : AnalysisKind::solid;
  const material::Material soft = test::elastic(k_young, 0.3);
  if (die == Die::cylinder) {
    contact::RigidSurface cylinder;
    cylinder.shape = contact::RigidSurface::Shape::cylinder;
    cylinder.point = {0.025, 0, 0};
    cylinder.point[up] = k_height + k_radius;
    cylinder.direction = flat ? mesh::Point{0, 0, 1} : mesh::Point{0, 1, 0};
    cylinder.radius = k_radius;
    cylinder.motion.translation[0] = along;
    cylinder.motion.translation[up] = down;
    spec.rigid_master = cylinder;
    return {mesh::distribute(raw, {"lower"}, {"lower_top"}), kind, {soft}, c, spec, options};
  }
  c.displacements.push_back({"upper", 0, along});
  if (!flat) c.displacements.push_back({"upper", 1, 0.0});
  c.displacements.push_back({"upper", last, down});
  return {test::distribute_blocks(raw), kind, {soft, soft}, c, spec, options};
}

struct Curve {
  std::vector<double> way;                    ///< [m]
  std::vector<std::array<double, 2>> of_way;  ///< press and drag [N]
  double press = 0, drag = 0;                 ///< mean forces in the middle of the way [N]
  double ripple = 0, jump = 0;  ///< deviation from the mean there, change from step to step, over the mean
  int cuts = 0, iterations = 0;
};

Curve iron(Shape shape, int n, const contact::FrictionParameters& friction, int steps, Die die = Die::mesh) {
  test::Rubbing ironing = make_ironing(shape, n, friction, die);
  const std::size_t up = shape == Shape::quad4 ? 1 : 2;
  ironing.advance(1, 4);
  std::vector<double> press, drag;
  Curve c;
  for (int i = 1; i <= steps; ++i) {
    ironing.advance(1 + static_cast<double>(i) / steps, 1);
    const contact::ContactSums s = ironing.sums();
    const double way = (ironing.time - 1) * k_way;
    c.way.push_back(way);
    c.of_way.push_back({s.resultant[up], -s.resultant[0]});
    if (way < 0.3 * k_way || way > 0.7 * k_way) continue;
    press.push_back(s.resultant[up]);
    drag.push_back(-s.resultant[0]);
  }
  const auto count = static_cast<double>(press.size());
  c.press = std::accumulate(press.begin(), press.end(), 0.0) / count;
  c.drag = std::accumulate(drag.begin(), drag.end(), 0.0) / count;
  for (std::size_t i = 0; i < press.size(); ++i) {
    c.ripple = std::max({c.ripple, std::abs(press[i] / c.press - 1), std::abs(drag[i] / c.drag - 1)});
    if (i > 0)
      c.jump = std::max(
          {c.jump, std::abs(press[i] - press[i - 1]) / c.press, std::abs(drag[i] - drag[i - 1]) / c.drag});
  }
  c.cuts = ironing.n_cuts;
  c.iterations = ironing.most_iterations;
  const std::string name =
      fmt::format("{}_{}_{}{}", mesh::name(shape), n, steps, die == Die::mesh ? "" : "_cylinder");
  const std::string value =
      fmt::format("press {:.4g} drag {:.4g} ratio {:.4f} ripple {:.3f} jump {:.3f} cuts {} Newton {}",
                  c.press, c.drag, c.drag / c.press, c.ripple, c.jump, c.cuts, c.iterations);
  ::testing::Test::RecordProperty(name, value);
  return c;
}

TEST(Ironing, InThePlaneGivesForcesThatConvergeAndAreSmooth) {
  const auto with = [](int n, Die die) { return iron(Shape::quad4, n, test::coulomb(0.3), 50, die); };
  const Curve coarse = with(6, Die::mesh), middle = with(12, Die::mesh), fine = with(24, Die::mesh);
  EXPECT_LT(std::abs(fine.press - middle.press), 0.5 * std::abs(middle.press - coarse.press));
  EXPECT_LT(std::abs(fine.drag - middle.drag), 0.5 * std::abs(middle.drag - coarse.drag));
  EXPECT_LT(fine.ripple, middle.ripple);
  EXPECT_LT(middle.ripple, coarse.ripple);
  EXPECT_LT(fine.jump, 0.01);
  auto csv =
      verification::table("contact_ironing",
                          "way[mm],press_6[kN/mm],press_12[kN/mm],press_24[kN/mm],drag_6[kN/mm],drag_12[kN/"
                          "mm],drag_24[kN/mm]");
  for (std::size_t i = 0; i < fine.way.size(); ++i) {
    csv << 1e3 * fine.way[i];
    for (const std::size_t k : {0U, 1U})
      for (const Curve* curve : {&coarse, &middle, &fine}) csv << "," << 1e-6 * curve->of_way[i][k];
    csv << "\n";
  }
  // An analytic cylinder in place of twenty flat faces in 80°.
  const Curve cylinder = with(12, Die::cylinder);
  EXPECT_NEAR(cylinder.press, middle.press, 0.03 * middle.press);
  EXPECT_NEAR(cylinder.drag, middle.drag, 0.03 * middle.drag);
  EXPECT_LT(cylinder.ripple, 0.03);
}

TEST(Ironing, InThreeDimensionsGoesThrough) {
  const Curve die = iron(Shape::hex8, 6, test::coulomb(0.3), 20),
              cylinder = iron(Shape::hex8, 6, test::coulomb(0.3), 20, Die::cylinder);
  EXPECT_EQ(die.cuts + cylinder.cuts, 0);
  EXPECT_LT(die.ripple, 0.1);
  EXPECT_LT(cylinder.ripple, 0.1);
  EXPECT_NEAR(cylinder.press, die.press, 0.03 * die.press);
  EXPECT_NEAR(cylinder.drag, die.drag, 0.03 * die.drag);
}

TEST(Ironing, CutsStepsThatJamAndGoesOn) {
  // Friction that hardens with its own work: backward Euler has a solution for slips below 1/(p μ') only.
  const contact::FrictionParameters hardens =
      contact::friction_spec({0.1, 1}, 1e6, contact::InternalVariable::frictional_work);
  const Curve jams = iron(Shape::quad4, 12, hardens, 2), fine = iron(Shape::quad4, 12, hardens, 50);
  EXPECT_GT(jams.cuts, 0);
  EXPECT_EQ(fine.cuts, 0);
  EXPECT_NEAR(jams.press, fine.press, 0.05 * fine.press);
}

}  // namespace
}  // namespace solidus
