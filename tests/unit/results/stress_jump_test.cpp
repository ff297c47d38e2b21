/// The jump of stress between elements, of stresses given by formula.
#include "results/answers/stress_jump.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../criteria/bodies.hpp"
#include "results/fields/spots.hpp"

namespace solidus::results {
namespace {

using mesh::Shape;

/// The jump of a shear stress that follows the place of an element's centre.
double jump(Shape shape, int divisions, const std::function<double(const mesh::Point&)>& shear) {
  const mesh::Mesh mesh = test::block_mesh(shape, {1, 1}, {divisions, divisions});
  std::vector<double> stress;
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (Index e = 0; e < block.size(); ++e) {
      const double value = shear(centre(mesh, block, e));
      for (const double component : {7.0, 7.0, 7.0, value, 0.0, 0.0}) stress.push_back(component);
    }
  FieldSet fields;
  fields.add({"stress", "Pa", 6, mesh::FieldPlace::cell, stress});
  return stress_jumps(mesh, AnalysisKind::plane_strain, fields).at(0);
}

TEST(StressJump, IsNothingWhereStressIsEven) {
  EXPECT_NEAR(jump(Shape::tri3, 4, [](const mesh::Point&) { return 3.0; }), 0, 1e-7);
}

// A stress that is linear over the body jumps by its slope times the element.
TEST(StressJump, OfALinearStressIsHalvedWithTheElement) {
  const auto linear = [](const mesh::Point& x) { return x[1] - 0.5; };
  const double coarse = jump(Shape::quad4, 16, linear), fine = jump(Shape::quad4, 32, linear);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1);
}

// Up and down from element to element, as in triangles that lock: nothing of it is left in the mean.
TEST(StressJump, OfAStressThatAlternatesIsNearlyItsSize) {
  const auto alternating = [](const mesh::Point& x) {
    return std::fmod(std::floor(8 * x[0]) + std::floor(8 * x[1]), 2) == 0 ? 1.0 : -1.0;
  };
  EXPECT_GT(jump(Shape::quad4, 8, alternating), 0.8);
}

}  // namespace
}  // namespace solidus::results
