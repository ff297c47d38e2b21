// Rules against closed integrals of monomials.
#include "mesh/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace solidus::mesh;

constexpr Shape k_shapes[] = {Shape::line2, Shape::line3, Shape::tri3,  Shape::tri6, Shape::quad4,
                              Shape::quad8, Shape::tet4,  Shape::tet10, Shape::hex8, Shape::hex20};

bool is_simplex(Shape shape) {
  return dimension(shape) > 1 && vertex_count(shape) == dimension(shape) + 1;
}

double factorial(int n) {
  return n < 2 ? 1 : n * factorial(n - 1);
}

// ∫ ξ^a η^b ζ^c over the reference shape.
double exact(Shape shape, std::array<int, 3> power) {
  const int dim = dimension(shape);
  if (is_simplex(shape))
    return factorial(power[0]) * factorial(power[1]) * factorial(power[2]) /
           factorial(power[0] + power[1] + power[2] + dim);
  double product = 1;
  for (int i = 0; i < dim; ++i) {
    const int p = power[static_cast<std::size_t>(i)];
    product *= p % 2 == 1 ? 0.0 : 2.0 / (p + 1);
  }
  return product;
}

double by_rule(const Rule& rule, std::array<int, 3> power) {
  double sum = 0;
  for (const QuadraturePoint& p : rule)
    sum += p.weight * std::pow(p.xi[0], power[0]) * std::pow(p.xi[1], power[1]) * std::pow(p.xi[2], power[2]);
  return sum;
}

class EveryShapeAndDegree : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShapeAndDegree, ::testing::ValuesIn(k_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryShapeAndDegree, GaussRulesIntegrateAllMonomialsOfTheirDegreeExactly) {
  const int dim = dimension(GetParam());
  for (int degree = 0; degree <= 8; ++degree) {
    const Rule rule = gauss_rule(GetParam(), degree);
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; b <= (dim > 1 ? degree : 0); ++b)
        for (int c = 0; c <= (dim > 2 ? degree : 0); ++c) {
          if (is_simplex(GetParam()) && a + b + c > degree) continue;
          // rounding of at most 125 terms of size one
          EXPECT_NEAR(by_rule(rule, {a, b, c}), exact(GetParam(), {a, b, c}), 2e-14)
              << "degree " << degree << ": " << a << " " << b << " " << c;
        }
  }
}

TEST_P(EveryShapeAndDegree, GaussPointsLieInsideWithPositiveWeights) {
  for (int degree = 0; degree <= 8; ++degree)
    for (const QuadraturePoint& p : gauss_rule(GetParam(), degree)) {
      EXPECT_GT(p.weight, 0);
      double sum = 0;
      for (const double c : p.xi) {
        sum += c;
        EXPECT_LT(std::abs(c), 1);
        EXPECT_GT(c, is_simplex(GetParam()) ? -1e-300 : -1.0);
      }
      EXPECT_LT(sum, is_simplex(GetParam()) ? 1.0 : 3.0);
    }
}

TEST_P(EveryShapeAndDegree, NodalRulesHaveThePointsAtTheNodesAndTheVolumeOfTheShape) {
  const Rule rule = nodal_rule(GetParam());
  EXPECT_EQ(static_cast<int>(rule.size()), node_count(GetParam()));
  EXPECT_NEAR(by_rule(rule, {0, 0, 0}), exact(GetParam(), {0, 0, 0}), 1e-14);
}

TEST(Quadrature, StiffnessRulesHaveTheStandardNumbersOfPoints) {
  EXPECT_EQ(stiffness_rule(Shape::tri3).size(), 1u);
  EXPECT_EQ(stiffness_rule(Shape::tri6).size(), 3u);
  EXPECT_EQ(stiffness_rule(Shape::quad4).size(), 4u);
  EXPECT_EQ(stiffness_rule(Shape::quad8).size(), 9u);
  EXPECT_EQ(stiffness_rule(Shape::tet4).size(), 1u);
  EXPECT_EQ(stiffness_rule(Shape::tet10).size(), 4u);
  EXPECT_EQ(stiffness_rule(Shape::hex8).size(), 8u);
  EXPECT_EQ(stiffness_rule(Shape::hex20).size(), 27u);
}

TEST(Quadrature, ADegreeBeyondTheTablesIsRefused) {
  EXPECT_THROW(gauss_rule(Shape::tri3, 21), std::invalid_argument);
  EXPECT_THROW(gauss_rule(Shape::hex8, -1), std::invalid_argument);
}

}  // namespace
