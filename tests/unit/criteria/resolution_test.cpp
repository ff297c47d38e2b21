/// What criteria::Resolution says of fields given by formula.
#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"
#include "criteria/resolution.hpp"

namespace solidus::criteria {
namespace {

using mesh::Point;
using mesh::Shape;

constexpr double k_range = 100;

/// η² of one body whose temperature is this after a step of a second.
double flow_error(Shape shape, int divisions, const test::Casting::Field& temperature) {
  test::Casting casting(test::block_mesh(shape, {1, 1}, {divisions, divisions}), k_range);
  Resolution resolution(casting.mesh, casting.kind, {1});
  casting.start(resolution, 0, temperature);
  casting.step(resolution, 1, temperature);
  const auto told = Resolution::told({{casting.record}});
  return told->flow_error.at(0);
}

TEST(Resolution, OfAnEvenGradientIsWithoutError) {
  const auto even = [](const Point& x) { return 850 + 10 * x[0] - 20 * x[1]; };
  for (const Shape shape : {Shape::tri3, Shape::quad4}) EXPECT_NEAR(flow_error(shape, 4, even), 0, 1e-12);
}

// T = x²: gradients of elements are off by (h/2)² V in the square, where the mean around a node is not.
TEST(Resolution, OfACurvedFieldFallsWithTheSquareOfTheElement) {
  const auto curved = [](const Point& x) { return 850 + 20 * x[0] * x[0]; };
  for (const Shape shape : {Shape::tri3, Shape::quad4}) {
    const double coarse = flow_error(shape, 8, curved), fine = flow_error(shape, 16, curved);
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
  }
}

// A kink in an element costs as much as the element is large, wherever it lies in it.
TEST(Resolution, OfAFrontFallsWithTheElement) {
  const auto error = [](int divisions) {
    const double front = 0.5 + 0.3 / divisions;
    return flow_error(Shape::quad4, divisions,
                      [=](const Point& x) { return 850 - 20 * std::max(0.0, front - x[0]); });
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 1, 0.1);
  EXPECT_NEAR(std::log2(error(16) / error(32)), 1, 0.1);
}

TEST(Resolution, TellsTheStepInWhichANodeFroze) {
  test::Casting casting(test::block_mesh(Shape::quad4, {1, 1}, {2, 2}), k_range);
  Resolution resolution(casting.mesh, casting.kind, {1});
  const auto at = [](double left, double right) {
    return [=](const Point& x) { return x[0] < 0.4 ? left : right; };
  };
  casting.start(resolution, 0, at(950, 950));
  casting.step(resolution, 0.5, at(850, 920));
  casting.step(resolution, 2, at(790, 850));  // the left freezes in a step of 1.5 s
  casting.step(resolution, 2.25, at(780, 790));
  const CriteriaState state{{casting.record}};
  const auto told = Resolution::told(state);
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i)
    EXPECT_EQ(told->frozen_within[i], casting.mesh.x[i][0] < 0.4 ? 1.5 : 0.25);
}

TEST(Resolution, IsKeptNoFurtherOnceAllIsSolid) {
  test::Casting casting(test::block_mesh(Shape::quad4, {1, 1}, {8, 8}), k_range);
  Resolution resolution(casting.mesh, casting.kind, {1});
  const auto curved = [](double t) { return [t](const Point& x) { return t + 20 * x[0] * x[0]; }; };
  casting.start(resolution, 0, curved(850));
  casting.step(resolution, 1, curved(700));
  const double before = Resolution::told({{casting.record}})->flow_error[0];
  casting.step(resolution, 50, [](const Point& x) { return 700 + 400 * std::abs(x[0] - 0.5); });
  EXPECT_EQ(Resolution::told({{casting.record}})->flow_error[0], before);
}

}  // namespace
}  // namespace solidus::criteria
