#include "mesh/element_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/parts/distribute.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {
namespace {

class ElementSearchTest : public ::testing::TestWithParam<Shape> {};

/// A mesh that every process holds as its own.
Mesh whole_block(Shape shape) {
  const bool solid = dimension(shape) == 3;
  RawMesh raw = make_block({solid ? std::vector{2.0, 1.0, 1.0} : std::vector{2.0, 1.0},
                            {},
                            solid ? std::vector{4, 3, 2} : std::vector{4, 3},
                            "block"},
                           shape);
  for (Point& x : raw.x) x[1] += 0.1 * std::sin(3 * x[0]);
  Mesh mesh;
  mesh.dimension = raw.dimension;
  mesh.x = raw.x;
  mesh.n_owned_nodes = static_cast<Index>(raw.x.size());
  mesh.bodies = {{"block"}};
  for (const RawBlock& block : raw.groups.at("block").blocks) {
    ElementBlock copy{.shape = block.shape, .body = 0, .nodes = block.nodes, .input_element = {}};
    copy.n_counted = copy.size();
    copy.input_element.resize(static_cast<std::size_t>(copy.size()));
    mesh.blocks.push_back(copy);
  }
  return mesh;
}

TEST_P(ElementSearchTest, FindsThePlaceOfEveryPoint) {
  const Mesh mesh = whole_block(GetParam());
  const ElementSearch search(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<std::vector<double>> x(3);
  for (const Point& p : mesh.x)
    for (std::size_t i = 0; i < 3; ++i) x[i].push_back(p[i]);
  for (int k = 0; k < 50; ++k) {
    const Point p{2 * number(random), 0.15 + 0.7 * number(random),
                  dimension(GetParam()) == 3 ? number(random) : 0};
    const ElementSearch::Found found = search.find(p);
    if (p[1] > 0.12 && p[1] < 0.88) {
      EXPECT_LT(found.distance, 1e-9);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.share(x[i]), p[i], 1e-8);
    }
    double sum = 0;
    for (const double w : found.weights) sum += w;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
}

TEST_P(ElementSearchTest, OutsideTheNearestPlaceAnswers) {
  const Mesh mesh = whole_block(GetParam());
  const ElementSearch search(mesh);
  const Point p{-3, 0.5, dimension(GetParam()) == 3 ? 0.5 : 0};
  const ElementSearch::Found found = search.find(p);
  EXPECT_NEAR(found.distance, 3, 1e-9);
  std::vector<double> x;
  for (const Point& node : mesh.x) x.push_back(node[0]);
  EXPECT_NEAR(found.share(x), 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(, ElementSearchTest,
                         ::testing::Values(Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4,
                                           Shape::tet10, Shape::hex8, Shape::hex20),
                         [](const auto& each) { return std::string(name(each.param)); });

}  // namespace
}  // namespace solidus::mesh
