/// A brake shoe on a faceted shaft that turns back and forth over many faces.
///
///         ┌────────────┐        shoe: elastic, its back moves as u_y(t), the slave
///         └─╲________╱─┘
///       ╱‾‾‾╲________╱‾‾‾╲      shaft: all nodes turn by θ(t) about the origin, faces of 5°
///
/// Without averaged normals the direction of the pressure jumps wherever a point passes an edge; with them
/// the forces go on smoothly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_rubbing.hpp"
#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

constexpr double k_degree = std::numbers::pi / 180, k_radius = 0.1, k_friction = 0.3;

/// Turning: 0 → 1: press; 1 → 3: to 20°; 3 → 7: to −20°; 7 → 9: to 0°. 9 → 11: lifted, turned by 10° and
/// pressed again; 11 → 12: turned on.
double angle(double time) {
  return k_degree * Table({0, 1, 3, 7, 9, 9.5, 10.5, 11, 12}, {0, 0, 20, -20, 0, 0, 10, 10, 20}).value(time);
}
const Table k_lift({0, 1, 9, 9.5, 10.5, 11, 12}, {0, -1e-3, -1e-3, 1e-3, 1e-3, -1e-3, -1e-3});
constexpr int k_steps = 40;  ///< a unit of time: quarters of a degree

mesh::Point bend(double x_over_degrees, double r) {
  const double a = x_over_degrees * k_degree;
  return {r * std::sin(a), r * std::cos(a), 0};
}

test::Rubbing make_brake(bool smoothing, contact::IntegrationRule rule) {
  mesh::RawMesh raw = test::raw_blocks({{120, 0.01}, {24, 0.02}, {24, 1}, {10, 4}, 0}, mesh::Shape::quad4);
  test::map_body(raw, "lower", [](mesh::Point x) { return bend(x[0] - 60, k_radius - 0.01 + x[1]); });
  test::map_body(raw, "upper", [](mesh::Point x) { return bend(x[0] - 12, k_radius - 0.01 + x[1]); });
  mesh::Mesh mesh = test::distribute_blocks(raw);
  mechanics::MechanicalConditions c;
  std::vector<double> times;
  for (int i = 0; i <= 12 * k_steps; ++i) times.push_back(static_cast<double>(i) / k_steps);
  test::move_rigidly(
      mesh, "lower", times,
      [](mesh::Point x, double time) {
        const double s = std::sin(angle(time)), k = std::cos(angle(time));
        return mesh::Point{k * x[0] + s * x[1], -s * x[0] + k * x[1], 0};
      },
      c);
  c.displacements.push_back({"upper_y_max", 0, 0.0});
  c.displacements.push_back({"upper_y_max", 1, k_lift});
  contact::ContactParameters spec = test::rubbing(test::coulomb(k_friction), 1e12);
  spec.smoothing = smoothing;
  spec.integration = rule;
  spec.search_distance = 0.01;
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = 1e-9;
  // The shaft's own stress is no matter: all its nodes are held.
  return {
      std::move(mesh), AnalysisKind::plane_strain, {test::elastic(1, 0.3), test::elastic(1e9, 0.3)}, c, spec,
      options};
}

struct Jumps {
  std::vector<double> torque_of_angle;  ///< up to t = 5, over μ N R
  double force = 0, torque = 0;         ///< largest from step to step while sliding, relative
  int iterations = 0;
};

Jumps run(bool smoothing, contact::IntegrationRule rule = contact::IntegrationRule::gauss) {
  test::Rubbing brake = make_brake(smoothing, rule);
  Jumps jumps;
  double before = 0, torque_before = 0, torque_work = 0, angle_before = 0, pressed = 0;
  for (int i = 1; i <= 12 * k_steps; ++i) {
    brake.advance(static_cast<double>(i) / k_steps, 1);
    const contact::ContactSums s = brake.sums();
    if (brake.time <= 5)
      jumps.torque_of_angle.push_back(s.moment[2] / (k_friction * k_radius * std::max(s.force, 1.0)));
    // Sliding at full slip since a tenth of a unit.
    const double t = brake.time, since = t < 3        ? t - 1
                                         : t < 7      ? t - 3
                                         : t < 9      ? t - 7
                                         : t < 11.001 ? -1
                                                      : t - 11;
    if (since > 0.2) {
      EXPECT_EQ(s.sticking_points, 0) << t;
      jumps.force = std::max(jumps.force, std::abs(s.resultant[1] - before) / std::abs(s.resultant[1]));
      jumps.torque = std::max(jumps.torque, std::abs(s.moment[2] - torque_before) / std::abs(s.moment[2]));
    }
    if (t > 9.49 && t < 10.51) {
      EXPECT_EQ(s.closed_points, 0) << t;
    }
    // The master turns clockwise by a positive angle against the friction that acts on it.
    torque_work += s.moment[2] * (angle(t) - angle_before);
    angle_before = angle(t);
    before = s.resultant[1];
    torque_before = s.moment[2];
    if (i == 9 * k_steps) pressed = s.force;
    jumps.iterations = std::max(jumps.iterations, brake.report.newton.iterations);
    for (std::size_t p = 0; p < brake.contact.points.size(); ++p)
      EXPECT_GE(brake.contact.points[p].dissipation, brake.contact_before.points[p].dissipation);
  }
  EXPECT_EQ(brake.n_cuts, 0);
  const contact::ContactSums end = brake.sums();
  // All the work of a friction that does not harden is dissipated, and ζ_c is the normal work.
  EXPECT_NEAR(end.dissipation, end.work, 1e-12 * end.work);
  const double zeta = brake.integral([](const auto& p) { return p.internal_variable; });
  EXPECT_NEAR(k_friction * zeta, end.work, 1e-12 * end.work);
  // The shaft was turned with the work that friction took; the shoe gives back what it has stored.
  EXPECT_NEAR(torque_work, end.work, 0.02 * end.work);
  // Contact comes back as it was.
  EXPECT_NEAR(end.force, pressed, 0.05 * pressed);
  return jumps;
}

TEST(BackAndForth, OverManyFacesForcesJumpByLessThanAPercentWithAveragedNormals) {
  const Jumps smooth = run(true), facets = run(false);
  auto csv = verification::table("contact_brake", "time,averaged_normals,facets");
  for (std::size_t i = k_steps; i < smooth.torque_of_angle.size(); ++i)
    csv << fmt::format("{},{},{}\n", static_cast<double>(i + 1) / k_steps, smooth.torque_of_angle[i],
                       facets.torque_of_angle[i]);
  ::testing::Test::RecordProperty("smooth", fmt::format("force {:.2e} torque {:.2e} iterations {}",
                                                        smooth.force, smooth.torque, smooth.iterations));
  ::testing::Test::RecordProperty("facets", fmt::format("force {:.2e} torque {:.2e} iterations {}",
                                                        facets.force, facets.torque, facets.iterations));
  EXPECT_LT(smooth.force, 0.01);
  EXPECT_LT(smooth.torque, 0.01);
}

TEST(BackAndForth, OverManyFacesForcesJumpByLessThanAPercentWithAveragedNormalsAndSegments) {
  const Jumps smooth = run(true, contact::IntegrationRule::segments);
  ::testing::Test::RecordProperty("smooth", fmt::format("force {:.2e} torque {:.2e} iterations {}",
                                                        smooth.force, smooth.torque, smooth.iterations));
  EXPECT_LT(smooth.force, 0.01);
  EXPECT_LT(smooth.torque, 0.01);
}

}  // namespace
}  // namespace solidus
