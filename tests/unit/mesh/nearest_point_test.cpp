/// The nearest of many points is the one that a search through all of them finds.
#include "mesh/nearest_point.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace solidus::mesh {
namespace {

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

/// The first of the nearest ones.
std::size_t among_all(const std::vector<Point>& points, const Point& at) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (squared_distance(points[i], at) < squared_distance(points[best], at)) best = i;
  return best;
}

TEST(NearestPoint, IsTheOneThatASearchThroughAllFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (const std::size_t n : {1u, 2u, 8u, 9u, 17u, 300u}) {
    for (const double thickness : {1.0, 0.01, 0.0}) {
      std::vector<Point> points(n);
      for (Point& x : points) x = {anywhere(random), anywhere(random), thickness * anywhere(random)};
      const NearestPoint nearest(points);
      for (int k = 0; k < 200; ++k) {
        const Point at{2 * anywhere(random), 2 * anywhere(random), anywhere(random)};
        ASSERT_EQ(nearest.find(at), among_all(points, at)) << n << ' ' << thickness;
        ASSERT_EQ(nearest.find(at, n / 2), among_all(points, at)) << n << ' ' << thickness;
      }
    }
  }
}

TEST(NearestPoint, IsTheFirstOfSeveralThatAreAsNear) {
  std::vector<Point> points;
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) points.push_back({static_cast<double>(i), static_cast<double>(j), 0});
  const NearestPoint nearest(points);
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      const Point at{0.5 * i, 0.5 * j, 1};
      EXPECT_EQ(nearest.find(at), among_all(points, at)) << i << ' ' << j;
      EXPECT_EQ(nearest.find(at, 49), among_all(points, at)) << i << ' ' << j;
    }
}

}  // namespace
}  // namespace solidus::mesh
