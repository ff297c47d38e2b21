#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "contact/surfaces/master_analytic.hpp"
#include "sliding_bodies.hpp"

namespace solidus::contact {
namespace {

using test::Asked;
using Shape = RigidSurface::Shape;

constexpr Point k_down{0, -1, 0}, k_up{0, 1, 0};

TEST(RigidSurfaces, MeasurePenetrationFromTheirOutside) {
  const AnalyticMaster plane(2, {.shape = Shape::plane, .point = {5, 1, 0}, .direction = {0, 2, 0}}, 1);
  EXPECT_NEAR(plane.find({0, 0.9, 0}, k_down, -1).penetration, 0.1, 1e-15);
  EXPECT_NEAR(plane.find({0, 1.3, 0}, k_down, -1).penetration, -0.3, 1e-15);
  EXPECT_EQ(plane.find({0, 0.9, 0}, k_up, -1).face, -1) << "the slave looks away";
  EXPECT_EQ(plane.find({0, 2.1, 0}, k_down, -1).face, -1) << "beyond the search distance";
  EXPECT_NEAR(plane.find({0, -4, 0}, k_down, -1).penetration, 5, 1e-15) << "however deep";

  const AnalyticMaster ball(3, {.shape = Shape::sphere, .point = {1, 0, 0}, .radius = 2}, 1);
  EXPECT_NEAR(ball.find({1, 1.5, 0}, k_down, -1).penetration, 0.5, 1e-15);
  EXPECT_EQ(ball.find({1, 0, 0}, k_down, -1).face, -1) << "the centre has no closest point";

  const AnalyticMaster bore(
      3, {.shape = Shape::cylinder, .direction = {1, 0, 0}, .radius = 2, .hollow = true}, 1);
  const Partner p = bore.find({7, 2.25, 0}, k_up, -1);
  EXPECT_NEAR(p.penetration, 0.25, 1e-15);
  EXPECT_NEAR(distance(p.normal, k_down), 0, 1e-15);
}

// The slave's face lies at y = 0.101 m above the lower block: 0.2 m behind a plane at 0.3 m it never meets
// it, 0.05 m behind it does, and does so when the plane has come 2 m on.
TEST(RigidSurfaces, PushOutWhatHasMetThemAndLeaveWhatStartsBehindThem) {
  const mesh::Mesh mesh = test::two_blocks(mesh::Shape::quad4);
  const std::vector<double> u(mesh.x.size() * 2, 0.0);
  const ContactSurface slave(mesh, "upper_bottom");
  const double y = slave.reference_face(0).x[0][1];
  for (const double depth : {0.05, 0.2}) {
    RigidSurface plane{.shape = Shape::plane, .point = {0, y + depth, 0}, .direction = {0, 1, 0}};
    plane.motion.translation[1] = Table({0, 1}, {0, 2});
    SlidingKinematics k(mesh, AnalysisKind::plane_strain, slave,
                        std::make_unique<AnalyticMaster>(2, plane, 0.1), {});
    for (const double time : {0.0, 1.0}) {
      k.set_time(time);
      k.place(u);
      for (Index p = 0; p < k.n_points(); ++p) {
        const PointMotion m = k.motion(p, {}, Asked::motion);
        ASSERT_EQ(m.partnered, depth < 0.1) << depth << " at " << time;
        if (!m.partnered) continue;
        EXPECT_NEAR(m.penetration, depth + 2 * time, 1e-14);
        EXPECT_NEAR(k.master_way(p, 0, 0.5)[1], 1, 1e-14);
      }
    }
  }
}

TEST(RigidSurfaces, MoveByTheirTables) {
  RigidSurface surface{.shape = Shape::plane, .point = {0, 1, 0}, .direction = {0, 1, 0}};
  surface.motion.translation[1] = Table({0, 2}, {0, 0.4});
  surface.motion.angle = Table({0, 2}, {0, std::numbers::pi / 2});
  surface.motion.centre = {0, 1, 0};
  AnalyticMaster plane(2, surface, 1);
  plane.place({}, 2);
  // Turned by a quarter about (0, 1), its outside is −x.
  const Partner p = plane.find({0.2, 3, 0}, {1, 0, 0}, -1);
  EXPECT_NEAR(p.penetration, 0.2, 1e-15);
  plane.place({}, 1);
  EXPECT_NEAR(plane.find({0, 1.2, 0}, {1, -1, 0}, -1).penetration, 0, 1e-15);
}

// A cylinder that turns under a body at rest by one radian in 200 steps.
TEST(RigidSurfaces, ThatTurnUnderABodyAtRestSlipByTheArc) {
  const mesh::Mesh mesh = test::two_blocks(mesh::Shape::quad4);
  RigidSurface roll{
      .shape = Shape::cylinder, .point = {0.15, -0.4, 0}, .direction = {0, 0, 1}, .radius = 0.5};
  roll.motion.centre = roll.point;
  roll.motion.angle = Table({0, 1}, {0, 1});
  SlidingKinematics k(mesh, AnalysisKind::plane_strain, ContactSurface(mesh, "upper_bottom"),
                      std::make_unique<AnalyticMaster>(2, roll, 0.1), {});
  const std::vector<double> u(mesh.x.size() * 2, 0.0);
  std::vector<ContactPointState> states(static_cast<std::size_t>(k.n_points()));
  std::vector<double> way(states.size()), arm(states.size());
  const int steps = 200;
  for (int i = 0; i <= steps; ++i) {
    k.set_time(static_cast<double>(i) / steps);
    k.place(u);
    for (Index p = 0; p < k.n_points(); ++p) {
      ContactPointState& s = states[static_cast<std::size_t>(p)];
      if (i == 0) s.traction = {};
      const PointMotion m = k.motion(p, s, Asked::motion);
      ASSERT_TRUE(m.partnered);
      // The roll runs towards −x at its top: the partner falls behind in its own frame, towards +x.
      const Point pushed = times(m.push, m.slip);
      way[static_cast<std::size_t>(p)] += norm(pushed);
      // An open point counts its own way, at its distance from the roll's axis.
      arm[static_cast<std::size_t>(p)] = roll.radius + std::max(-m.penetration, 0.0);
      EXPECT_GE(pushed[0], 0);
      EXPECT_NEAR(norm(pushed), norm(m.slip), 1e-15);
      if (i > 0) {
        EXPECT_NEAR(norm(m.carried), 3, 1e-13);
        EXPECT_NEAR(dot(m.carried, m.master_normal), 0, 1e-13);
      }
      s.anchored = true;
      s.anchor = m.anchor;
      s.master_normal = m.master_normal;
      s.traction = scale(3, Point{m.master_normal[1], -m.master_normal[0], 0});
    }
  }
  // Each step counts the projected chord, sin δ instead of δ = 1/200: short by δ²/6.
  for (std::size_t p = 0; p < way.size(); ++p)
    EXPECT_NEAR(way[p], arm[p], arm[p] / (6.0 * steps * steps) * 1.01);
}

TEST(RigidSurfaces, ActOnTheSlaveAloneAndNeedNoNodesOfTheirOwnInTheGraph) {
  const mesh::Mesh mesh = test::two_blocks(mesh::Shape::hex8);
  SlidingKinematics k(
      mesh, AnalysisKind::solid, ContactSurface(mesh, "upper_bottom"),
      std::make_unique<AnalyticMaster>(
          3, RigidSurface{.shape = Shape::plane, .point = {0, 0, 0.101}, .direction = {0, 0, 1}}, 0.1),
      {});
  EXPECT_EQ(k.coverage(), 1);
  for (Index p = 0; p < k.n_points(); ++p) {
    const PointMotion m = k.motion(p, {}, Asked::rates);
    EXPECT_EQ(static_cast<int>(m.nodes.size()), m.n_slave);
    EXPECT_NEAR(m.penetration, 1e-3, 1e-15);
  }
  struct Count : ContactKinematics::CliqueSink {
    int cliques = 0;
    void add(std::span<const Index> nodes) override { cliques += nodes.size() == 4; }
  } count;
  EXPECT_TRUE(k.graph_outdated());
  k.add_to_graph(count);
  EXPECT_EQ(count.cliques, ContactSurface(mesh, "upper_bottom").n_faces());
  EXPECT_FALSE(k.graph_outdated());
}

}  // namespace
}  // namespace solidus::contact
