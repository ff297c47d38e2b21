// Quality of elements whose quality is known, and the report.
#include "mesh/quality.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::HasSubstr;

double quality(Shape shape, const std::vector<Point>& x) {
  RawMesh raw;
  raw.x = x;
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < x.size(); ++i) nodes.push_back(static_cast<Index>(i));
  return element_quality(raw, shape, nodes.data());
}

// The worst element of the sample box.
double worst_of_box(Shape shape) {
  return assess(sample_box(shape)).groups.front().worst_quality;
}

TEST(Quality, RegularElementsAreOneWhateverTheirSize) {
  const double s3 = std::sqrt(3.0);
  for (const double h : {1e-6, 1.0, 1e3}) {
    EXPECT_NEAR(quality(Shape::tri3, {{0, 0, 0}, {h, 0, 0}, {h / 2, h * s3 / 2, 0}}), 1, 1e-14);
    EXPECT_NEAR(quality(Shape::tet4, {{h, h, h}, {-h, h, -h}, {h, -h, -h}, {-h, -h, h}}), 1, 1e-14);
    EXPECT_NEAR(quality(Shape::quad4, {{0, 0, 0}, {h, 0, 0}, {h, h, 0}, {0, h, 0}}), 1, 1e-14);
  }
}

TEST(Quality, KnownTrianglesAndRectanglesHaveTheirMeanRatio) {
  // 4√3 A / Σ l²: the right-angled isosceles triangle √3/2
  EXPECT_NEAR(quality(Shape::tri3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), std::sqrt(3.0) / 2, 1e-15);
  // sides 1 and a: 2a / (1 + a²)
  EXPECT_NEAR(quality(Shape::quad4, {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}), 8.0 / 17, 1e-15);
  // the corner tetrahedron of a cube: 12 (3V)^(2/3) / Σ l², six edges 1, 1, 1, √2, √2, √2
  EXPECT_NEAR(quality(Shape::tet4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
              12 * std::pow(0.5, 2.0 / 3) / 9, 1e-14);
}

TEST(Quality, FlatElementsAreZeroAndInvertedOnesNegative) {
  EXPECT_NEAR(quality(Shape::tri3, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), 0, 1e-15);
  EXPECT_LT(quality(Shape::tri3, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}), 0);
  EXPECT_LT(quality(Shape::quad4, {{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}), 0);  // a dart
}

TEST(Quality, AQuadraticElementWithStraightEdgesIsAsGoodAsItsLinearOne) {
  for (const auto& [linear, quadratic] :
       {std::pair{Shape::tri3, Shape::tri6}, std::pair{Shape::quad4, Shape::quad8},
        std::pair{Shape::tet4, Shape::tet10}, std::pair{Shape::hex8, Shape::hex20}})
    EXPECT_NEAR(worst_of_box(linear), worst_of_box(quadratic), 1e-13);
}

TEST(Quality, TheReportNamesTheWorstElementAndItsPlace) {
  RawMesh raw = sample_box(Shape::quad4);
  // the element with the nodes of the upper right corner, made slim
  for (Point& x : raw.x)
    if (x[0] > 0.49 && x[1] > 0.29) x = {0.4, 0.22, 0};
  const QualityReport report = assess(raw, 3);
  ASSERT_EQ(report.worst.size(), 3u);
  EXPECT_EQ(report.worst[0].input_element, 12);
  EXPECT_LE(report.worst[0].quality, report.worst[1].quality);
  EXPECT_EQ(report.groups.front().name, "block");
  EXPECT_EQ(report.groups.front().worst_quality, report.worst[0].quality);
  EXPECT_GT(report.bytes, 0u);
  const std::string text = to_text(report);
  for (const char* part : {"block", "12 quad4", "x_max", "element 12 (quad4) of 'block' at"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST(Quality, NodesInNoBodyAreCounted) {
  RawMesh raw = sample_box(Shape::hex8);
  raw.x.push_back({9, 9, 9});
  raw.input_node.push_back(999);
  const QualityReport report = assess(raw);
  EXPECT_EQ(report.n_unused_nodes, 1u);
  EXPECT_LT(report.highest[0], 1);
  EXPECT_NEAR(report.groups.front().measure, 0.06, 1e-15);
  EXPECT_NEAR(report.groups.front().shortest_edge, 0.1, 1e-15);
  EXPECT_NEAR(report.groups.front().longest_edge, 0.2, 1e-15);
}

}  // namespace
