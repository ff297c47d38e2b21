#include <gtest/gtest.h>

#include <random>

#include "contact/surfaces/projection.hpp"
#include "contact/surfaces/search.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

Face make_face(Shape shape, std::vector<Point> x) {
  Face f;
  f.shape = shape;
  f.n_nodes = static_cast<int>(x.size());
  std::copy(x.begin(), x.end(), f.x.begin());
  return f;
}

// One face of every shape, flat and curved.
std::vector<Face> faces() {
  return {
      make_face(Shape::line2, {{0, 0, 0}, {2, 1, 0}}),
      make_face(Shape::line3, {{-1, 0, 0}, {1, 0.2, 0}, {0.1, 0.5, 0}}),
      make_face(Shape::tri3, {{0, 0, 0}, {1, 0.1, 0.3}, {0.2, 1, -0.1}}),
      make_face(Shape::tri6,
                {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -0.05, 0.15}, {0.55, 0.5, 0.2}, {0, 0.5, 0.1}}),
      make_face(Shape::quad4, {{0, 0, 0}, {1, 0, 0.2}, {1.2, 1, 0}, {-0.1, 0.9, 0.3}}),
      make_face(Shape::quad8, {{-1, -1, 0},
                               {1, -1, 0},
                               {1, 1, 0},
                               {-1, 1, 0},
                               {0, -1, 0.3},
                               {1.1, 0, 0.1},
                               {0, 1, 0.3},
                               {-1, 0.1, 0.05}}),
  };
}

// The smallest distance over a fine sampling of the reference shape.
double sampled_distance(const Face& face, const Point& p) {
  const int n = face.dimension() == 1 ? 4000 : 300;
  double best = 1e300;
  const bool triangle = face.shape == Shape::tri3 || face.shape == Shape::tri6;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= (face.dimension() == 1 ? 0 : n); ++j) {
      Point xi{static_cast<double>(i) / n, static_cast<double>(j) / n, 0};
      if (triangle && xi[0] + xi[1] > 1 + 1e-12) continue;
      if (!triangle) xi = {2 * xi[0] - 1, face.dimension() == 1 ? 0 : 2 * xi[1] - 1, 0};
      best = std::min(best, distance(face.at(xi), p));
    }
  return best;
}

TEST(ClosestPoint, IsNoFartherThanAnySampleOfTheFaceInsideAndAroundEdgesAndCorners) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (const Face& face : faces())
    for (int trial = 0; trial < 40; ++trial) {
      const Point p{coordinate(random), coordinate(random), face.dimension() == 1 ? 0 : coordinate(random)};
      const Projection found = closest_point(face, p);
      const double sampled = sampled_distance(face, p);
      EXPECT_LE(found.distance, sampled + 1e-12) << mesh::name(face.shape) << " trial " << trial;
      // A sample lies within one spacing of the minimiser; the distance there is larger by its square.
      EXPECT_GE(found.distance, sampled - 0.02) << mesh::name(face.shape) << " trial " << trial;
      EXPECT_LE(outside_by(face.shape, found.xi), 1e-14);
      EXPECT_NEAR(distance(face.at(found.xi), found.y), 0, 1e-14);
    }
}

TEST(ClosestPoint, OfAPointLiftedAlongTheNormalIsItsFoot) {
  for (const Face& face : faces()) {
    const Point xi = add(reference_centre(face.shape), {0.1, face.dimension() == 1 ? 0 : -0.05, 0});
    for (double height : {-0.05, 0.0, 0.05}) {
      const Point p = add_scaled(face.at(xi), height, face.normal(xi));
      const Projection found = closest_point(face, p);
      EXPECT_NEAR(found.xi[0], xi[0], 1e-10) << mesh::name(face.shape);
      EXPECT_NEAR(found.xi[1], xi[1], 1e-10);
      EXPECT_NEAR(found.distance, std::abs(height), 1e-14);
    }
  }
}

TEST(ClosestPoint, BeyondACornerIsTheCorner) {
  const Face quad = faces()[4];
  const Projection found = closest_point(quad, {-3, -3, 0});
  EXPECT_NEAR(distance(found.y, quad.x[0]), 0, 1e-14);
}

TEST(ProjectionAlongALine, MeetsTheFaceWhereTheLineDoes) {
  for (const Face& face : faces()) {
    const bool line = face.dimension() == 1;
    const Point xi = add(reference_centre(face.shape), {-0.2, line ? 0 : 0.1, 0});
    Point d = add(face.normal(xi), {0.2, 0.1, line ? 0 : -0.1});
    d = scale(1 / norm(d), d);
    const Projection found = project_along(face, add_scaled(face.at(xi), -0.7, d), d);
    ASSERT_TRUE(found.found) << mesh::name(face.shape);
    EXPECT_NEAR(found.distance, 0.7, 1e-12);
    EXPECT_NEAR(found.xi[0], xi[0], 1e-10);
    EXPECT_NEAR(found.xi[1], xi[1], 1e-10);
  }
}

TEST(ProjectionAlongALine, MissesAFaceThatTheLinePassesBy) {
  const Face quad = faces()[4];
  EXPECT_FALSE(project_along(quad, {3, 3, 1}, {0, 0, -1}).found);
  EXPECT_FALSE(project_along(quad, {0.5, 0.5, 5}, {1, 0, 0}).found);
}

// A wavy strip of quads.
std::vector<Face> strip(int n) {
  std::vector<Face> result;
  const auto z = [&](double x) { return 0.1 * std::sin(5 * x); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(i + 1) / n;
      const double c = static_cast<double>(j) / n, d = static_cast<double>(j + 1) / n;
      result.push_back(make_face(Shape::quad4, {{a, c, z(a)}, {b, c, z(b)}, {b, d, z(b)}, {a, d, z(a)}}));
    }
  return result;
}

TEST(FaceSearch, FindsTheSameClosestPointAsAllFacesTriedInTurn) {
  const std::vector<Face> all = strip(6);
  const FaceSearch search(all);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  for (int trial = 0; trial < 100; ++trial) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    double best = 1e300;
    for (const Face& f : all) best = std::min(best, closest_point(f, p).distance);
    const SurfacePoint found = search.closest(p, 10);
    ASSERT_GE(found.face, 0);
    EXPECT_NEAR(found.projection.distance, best, 1e-9 * best);
    EXPECT_EQ(search.closest(p, 0.9 * best).face, -1) << "nothing lies within the search distance";
  }
}

TEST(FaceSearch, TakesTheNearestLayerThatLooksAgainstTheNormal) {
  // Three plates at z = 1, 2 and 3; the first shows its back.
  const auto plate = [](double z, bool up) {
    std::vector<Point> x{{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
    if (!up) std::swap(x[1], x[3]);
    return make_face(Shape::quad4, x);
  };
  const FaceSearch search({plate(1, true), plate(2, false), plate(3, false)});
  const Point n{0, 0, 1};
  EXPECT_EQ(search.along({0.3, 0.4, 0}, n, 10, 1e-9).face, 1);
  EXPECT_EQ(search.along({0.3, 0.4, 0}, n, 1.5, 1e-9).face, -1);
  EXPECT_EQ(search.closest({0.3, 0.4, 0}, 10).face, 0);
  EXPECT_EQ(search.closest({0.3, 0.4, 0}, 10, &n).face, 1);
}

}  // namespace
}  // namespace solidus::contact
