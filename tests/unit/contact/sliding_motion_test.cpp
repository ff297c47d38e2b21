#include <gtest/gtest.h>

#include "sliding_bodies.hpp"

namespace solidus::contact {
namespace {

using test::Asked;
using test::Sliding;

// Turns and shifts x + u of all nodes as one rigid body.
std::vector<double> moved(const mesh::Mesh& mesh, const std::vector<double>& u, double angle) {
  const auto dim = static_cast<std::size_t>(mesh.dimension);
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<double> result = u;
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    Point x = mesh.x[n];
    for (std::size_t i = 0; i < dim; ++i) x[i] += u[n * dim + i];
    Point y{c * x[0] - s * x[1] + 0.3, s * x[0] + c * x[1] - 0.2, x[2] + 0.1};
    if (dim == 3) y = {y[0], c * y[1] - s * y[2], s * y[1] + c * y[2]};
    for (std::size_t i = 0; i < dim; ++i) result[n * dim + i] = y[i] - mesh.x[n][i];
  }
  return result;
}

TEST(SlidingMotion, SeesNoRigidMotionOfBothBodiesTogether) {
  for (mesh::Shape shape : test::k_all_bodies)
    for (bool smoothing : {false, true}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::wavy_blocks(shape);
      const Sliding still(mesh, smoothing), turned(mesh, smoothing);
      const std::vector<double> u = test::overlapping(mesh);
      still->place(u);
      turned->place(moved(mesh, u, 1.1));
      int closed = 0;
      for (Index p = 0; p < still->n_points(); ++p) {
        ContactPointState old;
        old.anchored = true;
        old.anchor = {0.1, 0.1, mesh.dimension == 3 ? 0.1 : 0};
        old.master_normal = mesh.dimension == 3 ? Point{0, 0, 1} : Point{0, 1, 0};
        old.traction = {2, 0, 0};
        const PointMotion a = still->motion(p, old, Asked::motion);
        const PointMotion b = turned->motion(p, old, Asked::motion);
        ASSERT_EQ(a.partnered, b.partnered);
        if (!a.partnered) continue;
        closed += a.penetration > 0;
        // Lengths are 0.3 m; projections end at 1e-13 in reference coordinates.
        EXPECT_NEAR(a.penetration, b.penetration, 1e-13);
        EXPECT_LT(distance(a.slip, b.slip), 1e-13);
        EXPECT_LT(distance(a.carried, b.carried), 1e-12);
        EXPECT_NEAR(norm(a.carried), 2, 1e-14);
        EXPECT_NEAR(norm(times(a.push, a.carried)), norm(times(b.push, b.carried)), 1e-12);
        EXPECT_NEAR(dot(b.normal, times(b.push, b.carried)), 0, 1e-13);
      }
      EXPECT_GT(closed, 0);
    }
}

TEST(SlidingForces, BalanceInSumAndTheirNormalPartInMomentToo) {
  for (mesh::Shape shape : test::k_all_bodies)
    for (bool smoothing : {false, true}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::wavy_blocks(shape);
      const auto dim = static_cast<std::size_t>(mesh.dimension);
      const std::vector<double> u = test::overlapping(mesh);
      const Sliding sliding(mesh, smoothing);
      sliding->place(u);
      for (Index p = 0; p < sliding->n_points(); ++p) {
        const PointMotion m = sliding->motion(p, {}, Asked::motion);
        Point force{}, moment{};
        for (std::size_t b = 0; b < m.nodes.size(); ++b) {
          const auto node = static_cast<std::size_t>(m.nodes[b]);
          Point x = mesh.x[node];
          for (std::size_t i = 0; i < dim; ++i) x[i] += u[node * dim + i];
          force = add_scaled(force, m.share[b], m.normal);
          moment = add_scaled(moment, m.share[b], cross(x, m.normal));
        }
        // Shape functions add up to one, places agree, to a few units in the last place of 0.3 m.
        EXPECT_LT(norm(force), 1e-14);
        EXPECT_LT(norm(moment), 1e-13);
      }
    }
}

// A long flat strip of `n` faces, turned in the plane, under a short block that slides along it.
struct Strip {
  mesh::Mesh mesh;
  Point along{};
  explicit Strip(int n) {
    const mesh::TwoBlocks blocks{{1.0, 0.02}, {0.02, 0.02}, {n, 1}, {2, 1}, 0};
    mesh = test::distribute_blocks(test::raw_blocks(blocks, mesh::Shape::quad4));
    along = {std::cos(0.3), std::sin(0.3), 0};
    for (Point& x : mesh.x) x = {along[0] * x[0] - along[1] * x[1], along[1] * x[0] + along[0] * x[1], 0};
  }
  // The upper block pressed in by `depth` and carried `way` along the strip.
  std::vector<double> pressed(double way, double depth) const {
    return test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      if (!upper) return std::vector{0.0, 0.0};
      return std::vector{way * along[0] + depth * along[1], way * along[1] - depth * along[0]};
    });
  }
};

TEST(SlidingMotion, OverAHundredFacesThereAndBackAddsUpToTheWayAndToZero) {
  const Strip strip(120);
  for (bool smoothing : {false, true}) {
    const Sliding sliding(strip.mesh, smoothing);
    const int steps = 97;
    std::vector<ContactPointState> states(static_cast<std::size_t>(sliding->n_points()));
    std::vector<Point> sum(states.size()), there(states.size());
    for (int i = 0; i <= 2 * steps; ++i) {
      const double way = 0.9 * (steps - std::abs(i - steps)) / steps;
      sliding->place(strip.pressed(way, 1e-4));
      for (std::size_t p = 0; p < states.size(); ++p) {
        const PointMotion m = sliding->motion(static_cast<Index>(p), states[p], Asked::motion);
        ASSERT_TRUE(m.partnered);
        EXPECT_NEAR(m.penetration, 1e-4, 1e-15);
        sum[p] = add(sum[p], m.slip);
        if (i == steps) there[p] = sum[p];
        states[p].anchored = true;
        states[p].anchor = m.anchor;
        states[p].master_normal = m.master_normal;
      }
    }
    for (std::size_t p = 0; p < states.size(); ++p) {
      EXPECT_NEAR(dot(there[p], strip.along), 0.9, 1e-13);
      EXPECT_LT(norm(sum[p]), 1e-13);
    }
  }
}

TEST(SlidingMotion, OnAFlatMasterCrossesFacesWithoutAJump) {
  const Strip strip(10);
  for (bool smoothing : {false, true}) {
    const Sliding sliding(strip.mesh, smoothing);
    ContactPointState old;
    old.anchored = true;
    old.master_normal = {-strip.along[1], strip.along[0], 0};
    old.traction = scale(5, strip.along);
    std::vector<Point> before;
    int crossings = 0;
    std::vector<Index> face;
    for (int i = 0; i < 400; ++i) {
      sliding->place(strip.pressed(0.001 * i, 1e-4));
      for (Index p = 0; p < sliding->n_points(); ++p) {
        const PointMotion m = sliding->motion(p, old, Asked::motion);
        const Point force = add_scaled(times(m.push, m.carried), 7, m.normal);
        const auto k = static_cast<std::size_t>(p);
        if (i == 0) {
          before.push_back(force);
          face.push_back(sliding->points().table().partner[static_cast<std::size_t>(p)].face);
        }
        crossings += face[k] != sliding->points().table().partner[static_cast<std::size_t>(p)].face;
        face[k] = sliding->points().table().partner[static_cast<std::size_t>(p)].face;
        EXPECT_LT(distance(force, before[k]), 1e-12);
      }
    }
    EXPECT_GT(crossings, 10);
  }
}

TEST(SlidingMotion, CrossesEdgesAndVerticesOfAFlatMasterInThreeDimensionsWithoutAJump) {
  for (mesh::Shape shape : {mesh::Shape::tet4, mesh::Shape::tet10, mesh::Shape::hex8, mesh::Shape::hex20})
    for (bool smoothing : {false, true}) {
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      const Sliding sliding(mesh, smoothing, {.rule = IntegrationRule::nodal});
      ContactPointState old;
      old.anchored = true;
      old.master_normal = {0, 0, 1};
      old.traction = {3, -4, 0};
      int met = 0;
      // Nodes of the slave pass right over nodes and edges of the master: at 0.1, 0.0667 from each other.
      for (int i = 0; i <= 30; ++i) {
        sliding->place(test::nodal_field(mesh, 3, [&](const Point&, bool upper) {
          const double s = upper ? i / 30.0 : 0;
          return std::vector{-0.1 * s, -0.2 / 3 * s, upper ? -1e-3 : 0.0};
        }));
        for (Index p = 0; p < sliding->n_points(); ++p) {
          const Point x = sliding->particle(p).position;
          const bool inside = x[0] - 0.1 * i / 30 >= 0 && x[1] - 0.2 / 3 * i / 30 >= 0;
          const PointMotion m = sliding->motion(p, old, Asked::motion);
          EXPECT_TRUE(m.partnered || !inside) << x[0] << " " << x[1] << " " << i;
          if (!m.partnered) continue;
          ++met;
          EXPECT_NEAR(m.penetration, 1e-3, 1e-14);
          const Point force = add_scaled(times(m.push, m.carried), 7, m.normal);
          EXPECT_LT(distance(force, {3, -4, -7}), 1e-11);
        }
      }
      EXPECT_GT(met, 100);
    }
}

// A convex bend of the lower surface at x = 0.12.
mesh::Mesh ridge(double slope) {
  mesh::Mesh mesh = test::two_blocks(mesh::Shape::quad4);
  for (Point& x : mesh.x) x[1] -= slope * std::abs(x[0] - 0.12);
  return mesh;
}

TEST(SlidingMotion, WithAveragedNormalsTurnsTheForceGraduallyOverABend) {
  const mesh::Mesh mesh = ridge(0.2);
  // The largest turn of n in one of 600 small steps, of all points.
  const auto largest_turn = [&](bool smoothing) {
    const Sliding sliding(mesh, smoothing);
    std::vector<Point> before(static_cast<std::size_t>(sliding->n_points()));
    double largest = 0;
    for (int i = 0; i < 600; ++i) {
      const auto u = test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
        return std::vector{upper ? -1e-4 * i : 0.0, upper ? -0.002 : 0.0};
      });
      sliding->place(u);
      for (Index p = 0; p < sliding->n_points(); ++p) {
        if (sliding->points().table().partner[static_cast<std::size_t>(p)].face < 0) continue;
        const Point n = sliding->motion(p, {}, Asked::motion).normal;
        Point& last = before[static_cast<std::size_t>(p)];
        if (i > 0 && norm(last) > 0) largest = std::max(largest, distance(n, last));
        last = n;
      }
    }
    return largest;
  };
  // The bend is 2 atan 0.2 = 0.39 rad. Averaged, it is spread over two faces of 0.06 m: 0.39 · 1e-4/0.06.
  EXPECT_NEAR(largest_turn(false), 2 * std::sin(std::atan(0.2)), 1e-12);
  EXPECT_LT(largest_turn(true), 2e-3);
}

TEST(SlidingMotion, BehindAGrooveTurnsTheNormalThroughTheWedgeWithoutAJump) {
  const mesh::Mesh mesh = ridge(-0.2);
  const Sliding sliding(mesh, false);
  struct Last {
    Partner partner;
    Point normal{};
  };
  std::vector<Last> before(static_cast<std::size_t>(sliding->n_points()));
  int in_wedge = 0;
  for (int i = 0; i < 600; ++i) {
    sliding->place(test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector{upper ? -1e-4 * i : 0.0, upper ? -0.05 : 0.0};
    }));
    for (Index p = 0; p < sliding->n_points(); ++p) {
      const Partner partner = sliding->points().table().partner[static_cast<std::size_t>(p)];
      Last& last = before[static_cast<std::size_t>(p)];
      if (partner.face >= 0 && last.partner.face >= 0) {
        in_wedge += partner.region == Partner::Region::vertex;
        EXPECT_LE(std::abs(partner.penetration - last.partner.penetration), 1.001e-4);
        // A step turns the direction by no more than its length over the distance, 0.03 m and more.
        EXPECT_LE(distance(partner.normal, last.normal), 1e-4 / 0.03);
      }
      last = {partner, partner.normal};
    }
  }
  EXPECT_GT(in_wedge, 10);
}

TEST(SlidingMotion, HasNoPartnerBeyondTheFreeEndOfTheMaster) {
  const Strip strip(10);
  const Sliding sliding(strip.mesh, false);
  // Past the end by half of the block: its points are 2 mm and more from the end, the tolerance is 1 mm.
  sliding->place(strip.pressed(0.99, 1e-4));
  for (Index p = 0; p < sliding->n_points(); ++p) {
    const bool beyond = dot(sliding->particle(p).position, strip.along) + 0.99 > 1.001;
    EXPECT_EQ(sliding->points().table().partner[static_cast<std::size_t>(p)].face >= 0, !beyond);
  }
}

TEST(SlidingMotion, AroundAConvexCornerLosesNoPointOnItsWay) {
  const mesh::Mesh mesh = ridge(0.7);
  const Sliding sliding(mesh, false, {.gauss_degree = 9});
  // Open and closed, right above and inside the bend.
  for (double lift : {-0.004, -1e-9, 0.0, 1e-9, 0.004}) {
    sliding->place(test::nodal_field(mesh, 2, [&](const Point&, bool upper) {
      return std::vector{0.0, upper ? lift : 0.0};
    }));
    for (Index p = 0; p < sliding->n_points(); ++p) {
      const Point& x = sliding->particle(p).position;
      if (x[0] > 0.02 && x[0] < 0.28) {
        ASSERT_GE(sliding->points().table().partner[static_cast<std::size_t>(p)].face, 0)
            << x[0] << " " << lift;
        // The facets of both sides are not one curve: up to the sagitta of the slave's.
        EXPECT_LT(std::abs(sliding->points().table().partner[static_cast<std::size_t>(p)].penetration), 0.05);
      }
    }
  }
}

}  // namespace
}  // namespace solidus::contact
