/// The first law of two elastic blocks that stick, slip, part and meet again, mechanics alone:
///
///   W = ΔΨ_bodies + ΔΨ_contact + D_c + numerical
///
/// W is the work of the supports with the forces at t_{n+1}. Ψ_contact: springs and what hardening stores.
/// Backward Euler takes energy out, numerical >= 0; slip dissipates in every step at every point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "contact_rubbing.hpp"
#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;

/// The upper block goes down, forth and back, up, further and down again, on and back.
test::Rubbing make_blocks(Shape shape, contact::FrictionParameters friction, bool rigid, bool segments) {
  const bool flat = mesh::dimension(shape) == 2;
  mesh::TwoBlocks blocks{{0.2, 0.04}, {0.06, 0.03}, {17, 3}, {7, 3}, 0};
  if (!flat) blocks = {{0.2, 0.06, 0.04}, {0.06, 0.04, 0.03}, {11, 2, 2}, {4, 3, 2}, 0};
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  test::map_body(raw, "upper", [&](mesh::Point x) {
    x[0] += 0.05;
    if (!flat) x[1] += 0.01;
    return x;
  });
  const std::string last = flat ? "y" : "z";
  const int up = flat ? 1 : 2;
  mechanics::MechanicalConditions c;
  for (int i = 0; i <= up; ++i)
    c.displacements.push_back({rigid ? "lower" : "lower_" + last + "_min", i, 0.0});
  const std::string top = "upper_" + last + "_max";
  c.displacements.push_back(
      {top, 0, Table({0, 1, 3, 7, 8, 9, 11, 13}, {0, 0, 0.05, -0.03, -0.03, 0.01, 0.04, 0})});
  if (!flat) c.displacements.push_back({top, 1, Table({0, 1, 3}, {0, 0, 0.004})});
  c.displacements.push_back(
      {top, up, Table({0, 1, 7, 7.5, 8.5, 9, 13}, {0, -4e-5, -6e-5, 1e-3, 1e-3, -4e-5, -4e-5})});
  contact::ContactParameters spec = test::rubbing(std::move(friction), 5e12);
  if (segments) spec.integration = contact::IntegrationRule::segments;
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = 1e-10;
  return {test::distribute_blocks(raw),
          flat ? AnalysisKind::plane_strain : AnalysisKind::solid,
          {test::elastic(70e9, 0.3), test::elastic(50e9, 0.3)},
          c,
          spec,
          options};
}

void balance(Shape shape, const contact::FrictionParameters& friction, int steps, const std::string& name,
             bool rigid = false, bool segments = false) {
  SCOPED_TRACE(name);
  test::Rubbing blocks = make_blocks(shape, friction, rigid, segments);
  double work = 0, bodies = 0, numerical = 0, least = 0, unbalanced = 0, stored = 0, dissipated = 0;
  double open = 0;
  for (int i = 1; i <= 13 * steps; ++i) {
    blocks.advance(static_cast<double>(i) / steps, 1);
    const mechanics::MechanicalWork& w = blocks.report.work;
    const contact::ContactSums sums = blocks.sums();
    const double now_bodies = blocks.elastic_energy();
    const double now_stored = sums.energy + sums.work - sums.dissipation;
    // The work of the supports is in the bodies and in contact.
    unbalanced = std::max(unbalanced, std::abs(w.support_work - w.internal_work - blocks.contact_work));
    const double lost =
        w.support_work - (now_bodies - bodies) - (now_stored - stored) - (sums.dissipation - dissipated);
    least = std::min(least, lost);
    numerical += lost;
    work += w.support_work;
    bodies = now_bodies;
    stored = now_stored;
    dissipated = sums.dissipation;
    if (sums.closed_points == 0) open += 1;
    for (std::size_t p = 0; p < blocks.contact.points.size(); ++p)
      EXPECT_GE(blocks.contact.points[p].dissipation, blocks.contact_before.points[p].dissipation);
  }
  EXPECT_EQ(blocks.n_cuts, 0);
  EXPECT_GT(open, 0);
  EXPECT_GT(dissipated, 0.5 * work);
  const std::string value = fmt::format(
      "work {:.5g} bodies {:.3g} contact {:.3g} friction {:.5g} numerical {:.3g} least {:.1e} unbalanced "
      "{:.1e} Newton {}",
      work, bodies, stored, dissipated, numerical, least, unbalanced, blocks.most_iterations);
  ::testing::Test::RecordProperty(name, value);
  EXPECT_LT(unbalanced, 1e-8 * work);
  EXPECT_GT(numerical, 0);
  // On a flat rigid base penetration and slip are linear in the displacement: no step gains. The surface of
  // an elastic one bends, and a step along it is a chord: a gain of second order in the step may remain.
  EXPECT_GE(least, (rigid ? -1e-9 : -5e-4 / (steps * steps)) * work);
}

TEST(FirstLawOfFriction, HoldsWithNumericalLossesThatAreNotNegative) {
  const auto linear = [](double initial, double slope) {
    return contact::friction_spec({initial, slope}, contact::k_kilonewton_per_mm);
  };
  balance(Shape::quad4, test::coulomb(0.3), 10, "rigid_coulomb", true);
  balance(Shape::quad4, linear(0.2, 0.02), 10, "rigid_hardens", true);
  balance(Shape::quad4, linear(0.3, -0.02), 10, "rigid_softens", true);
  balance(Shape::quad4, test::coulomb(0.3), 10, "coulomb_10");
  balance(Shape::quad4, test::coulomb(0.3), 40, "coulomb_40");
  balance(Shape::quad4, linear(0.2, 0.02), 10, "hardens");
  balance(Shape::quad4, linear(0.3, -0.02), 10, "softens");
  balance(Shape::hex8, test::coulomb(0.3), 4, "hex8");
  balance(Shape::quad4, linear(0.2, 0.02), 10, "rigid_hardens_segments", true, true);
  balance(Shape::quad4, test::coulomb(0.3), 10, "coulomb_10_segments", false, true);
  balance(Shape::quad4, linear(0.2, 0.02), 10, "hardens_segments", false, true);
  balance(Shape::hex8, test::coulomb(0.3), 4, "hex8_segments", false, true);
}

}  // namespace
}  // namespace solidus
