// The lanes behind the last element of a block: they repeat it, bit for bit, so that no decision of a batch
// is theirs and a history that is read back element by element is the whole history.
#include <gtest/gtest.h>

#include "mechanics/elements/padding.hpp"
#include "mechanics/elements/simplices.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mesh::Shape;
using test::Body;
using test::Solved;

struct Case {
  Shape shape;
  AnalysisKind kind;
  std::array<int, 3> cells;  ///< so that the number of elements is no multiple of eight
  Mapping mapping;
};
class Padding : public ::testing::TestWithParam<Case> {};

TEST_P(Padding, RepeatsTheHistoryOfTheLastElement) {
  const Case& p = GetParam();
  test::Lattice lattice{.shape = p.shape, .cells = p.cells, .distortion = 0.15};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.3, x[1], x[2]}; };
  Body body(lattice, p.kind, test::plastic_material());
  body.options.mapping = p.mapping;
  body.options.simplices = mechanics::Simplices::mixed;
  for (int i = 0; i < displacement_components(p.kind); ++i) body.hold("bottom", i);
  body.hold("top", 1, Table({0, 2}, {0, 8e-3}));
  Solved solved(body);
  solved.step(body, 2.0, 1.0);
  const mechanics::BlockHistory& history = solved.state.history[0];
  const Index n = body.mesh.blocks[0].size();
  const Index batch = (n - 1) / k_lanes;
  const auto width = static_cast<std::size_t>(history.n_components * history.n_points);
  double largest = 0;
  for (std::size_t k = 0; k < width; ++k) {
    const Lane& value = history.values[static_cast<std::size_t>(batch) * width + k];
    const int last = static_cast<int>((n - 1) % k_lanes);
    largest = std::max(largest, std::abs(value[last]));
    for (int lane = last + 1; lane < k_lanes; ++lane) EXPECT_EQ(value[lane], value[last]) << k;
  }
  EXPECT_GT(largest, 1e-4);  // it has yielded
}

INSTANTIATE_TEST_SUITE_P(
    Elements, Padding,
    ::testing::Values(Case{Shape::quad4, AnalysisKind::plane_strain, {5, 3, 1}, Mapping::isothermal},
                      Case{Shape::quad4, AnalysisKind::axisymmetric, {5, 3, 1}, Mapping::isentropic},
                      Case{Shape::hex8, AnalysisKind::solid, {3, 3, 1}, Mapping::isothermal},
                      Case{Shape::tri3, AnalysisKind::axisymmetric, {3, 3, 1}, Mapping::isothermal},
                      Case{Shape::tri3, AnalysisKind::axisymmetric, {3, 3, 1}, Mapping::isentropic},
                      Case{Shape::tet4, AnalysisKind::solid, {3, 1, 1}, Mapping::isothermal}));

}  // namespace
}  // namespace solidus
