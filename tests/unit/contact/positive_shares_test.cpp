/// The functions of the linear parts of a quadratic face.
#include "contact/points/positive_shares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "contact/surfaces/slave_rule.hpp"
#include "mesh/shape.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

int dimension_of_bodies(Shape face) {
  return mesh::dimension(face) + 1;
}

std::vector<double> shares(Shape shape, const Point& xi, std::vector<double>* slope = nullptr) {
  const auto n = static_cast<std::size_t>(mesh::node_count(shape));
  std::vector<double> values(n), positive(n);
  mesh::basis_values(shape, xi, values);
  if (slope != nullptr) slope->assign(n * n, 0.0);
  positive_shares(dimension_of_bodies(shape), values, positive,
                  slope != nullptr ? std::span<double>(*slope) : std::span<double>());
  return positive;
}

/// Points over the face, some of them on the seams of its parts.
std::vector<Point> places(Shape shape) {
  std::vector<Point> points;
  const bool triangle = shape == Shape::tri3 || shape == Shape::tri6;
  for (int i = 0; i <= 12; ++i)
    for (int k = 0; k <= (mesh::dimension(shape) == 1 ? 0 : 12); ++k) {
      const double a = i / 12.0, b = k / 12.0;
      if (triangle && a + b > 1) continue;
      points.push_back(triangle ? Point{a, b, 0}
                                : Point{2 * a - 1, mesh::dimension(shape) == 1 ? 0 : 2 * b - 1, 0});
    }
  return points;
}

TEST(PositiveShares, AreNowhereBelowZeroSumToOneAndAreLinearInThePlace) {
  for (const Shape shape : {Shape::line2, Shape::line3, Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8})
    for (const Point& xi : places(shape)) {
      const std::vector<double> l = shares(shape, xi);
      Point at{};
      double sum = 0;
      for (std::size_t a = 0; a < l.size(); ++a) {
        EXPECT_GE(l[a], -1e-15) << mesh::name(shape);  // 1 - a - b rounds
        sum += l[a];
        at = add_scaled(at, l[a], node_xi(shape, a));
      }
      EXPECT_NEAR(sum, 1, 1e-14) << mesh::name(shape);
      EXPECT_LT(distance(at, xi), 1e-14) << mesh::name(shape) << xi[0] << " " << xi[1];
    }
}

TEST(PositiveShares, AreOneAtTheirNodes) {
  for (const Shape shape : {Shape::line3, Shape::tri6, Shape::quad8})
    for (std::size_t node = 0; node < static_cast<std::size_t>(mesh::node_count(shape)); ++node) {
      const std::vector<double> l = shares(shape, node_xi(shape, node));
      for (std::size_t a = 0; a < l.size(); ++a)
        EXPECT_NEAR(l[a], a == node ? 1 : 0, 1e-14) << mesh::name(shape);
    }
}

TEST(PositiveShares, HaveTheSlopesThatDifferencesShow) {
  for (const Shape shape : {Shape::quad4, Shape::line3, Shape::tri6, Shape::quad8}) {
    const auto n = static_cast<std::size_t>(mesh::node_count(shape));
    for (const Point& xi : {Point{0.137, 0.211, 0}, Point{0.031, 0.742, 0}, Point{0.613, 0.118, 0}}) {
      std::vector<double> slope, values(n), up(n), down(n);
      shares(shape, xi, &slope);
      mesh::basis_values(shape, xi, values);
      constexpr double h = 1e-6;
      for (std::size_t b = 0; b < n; ++b) {
        std::vector<double> more = values, less = values;
        more[b] += h;
        less[b] -= h;
        positive_shares(dimension_of_bodies(shape), more, up, {});
        positive_shares(dimension_of_bodies(shape), less, down, {});
        // The nearest place on a triangle is found by its sum, which differences along one value change.
        for (std::size_t a = 0; a < n && shape != Shape::tri6; ++a)
          EXPECT_NEAR((up[a] - down[a]) / (2 * h), slope[a * n + b], 1e-8) << mesh::name(shape) << a << b;
      }
      // Along the face, as the partner of a point moves.
      const Point there{xi[0] + h, xi[1], 0}, here{xi[0] - h, xi[1], 0};
      const std::vector<double> ahead = shares(shape, there), behind = shares(shape, here);
      std::vector<double> n_ahead(n), n_behind(n);
      mesh::basis_values(shape, there, n_ahead);
      mesh::basis_values(shape, here, n_behind);
      for (std::size_t a = 0; a < n; ++a) {
        double by_chain = 0;
        for (std::size_t b = 0; b < n; ++b) by_chain += slope[a * n + b] * (n_ahead[b] - n_behind[b]);
        EXPECT_NEAR(by_chain, ahead[a] - behind[a], 1e-12) << mesh::name(shape) << a;
      }
    }
  }
}

}  // namespace
}  // namespace solidus::contact
