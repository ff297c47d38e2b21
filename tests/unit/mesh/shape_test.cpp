// Basis functions and faces of the reference shapes, against Gmsh's own and against differences.
#include "mesh/shape.hpp"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "mesh/quadrature.hpp"

namespace {

using namespace solidus;
using namespace solidus::mesh;

constexpr Shape k_shapes[] = {Shape::line2, Shape::line3, Shape::tri3,  Shape::tri6, Shape::quad4,
                              Shape::quad8, Shape::tet4,  Shape::tet10, Shape::hex8, Shape::hex20};

// Gmsh's numbers of the types (Gmsh reference manual, "MSH file format").
const std::map<Shape, int> k_gmsh_type{
    {Shape::line2, 1},  {Shape::line3, 8}, {Shape::tri3, 2},   {Shape::tri6, 9}, {Shape::quad4, 3},
    {Shape::quad8, 16}, {Shape::tet4, 4},  {Shape::tet10, 11}, {Shape::hex8, 5}, {Shape::hex20, 17}};

// Points inside the reference shape without any symmetry.
std::vector<Point> points_of(Shape shape) {
  const bool simplex = dimension(shape) > 1 && vertex_count(shape) == dimension(shape) + 1;
  std::vector<Point> points =
      simplex ? std::vector<Point>{{0.1, 0.2, 0.3}, {0.31, 0.07, 0.45}, {0.6, 0.25, 0.05}}
              : std::vector<Point>{{0.1, -0.2, 0.3}, {-0.81, 0.07, 0.45}, {0.6, 0.9, -0.7}};
  for (Point& p : points)
    for (std::size_t i = static_cast<std::size_t>(dimension(shape)); i < 3; ++i) p[i] = 0;
  return points;
}

class EveryShape : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, ::testing::ValuesIn(k_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryShape, BasisFunctionsAreAPartitionOfUnity) {
  const auto n = static_cast<std::size_t>(node_count(GetParam())),
             dim = static_cast<std::size_t>(dimension(GetParam()));
  std::vector<double> v(n), g(n * dim);
  for (const Point& xi : points_of(GetParam())) {
    basis_values(GetParam(), xi, v);
    basis_gradients(GetParam(), xi, g);
    double sum = 0;
    for (const double value : v) sum += value;
    EXPECT_NEAR(sum, 1, 1e-14);
    for (std::size_t i = 0; i < dim; ++i) {
      double slope = 0;
      for (std::size_t a = 0; a < n; ++a) slope += g[a * dim + i];
      EXPECT_NEAR(slope, 0, 1e-14);
    }
  }
}

TEST_P(EveryShape, BasisFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  const Rule nodes = nodal_rule(GetParam());
  std::vector<double> v(nodes.size());
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    basis_values(GetParam(), nodes[b].xi, v);
    for (std::size_t a = 0; a < v.size(); ++a) EXPECT_NEAR(v[a], a == b ? 1 : 0, 1e-15) << a << " at " << b;
  }
}

TEST_P(EveryShape, GradientsAreTheDerivativesOfTheBasisFunctions) {
  const auto n = static_cast<std::size_t>(node_count(GetParam())),
             dim = static_cast<std::size_t>(dimension(GetParam()));
  std::vector<double> plus(n), minus(n), g(n * dim);
  const double h = 1e-5;
  for (const Point& xi : points_of(GetParam())) {
    basis_gradients(GetParam(), xi, g);
    for (std::size_t i = 0; i < dim; ++i) {
      Point p = xi, m = xi;
      p[i] += h;
      m[i] -= h;
      basis_values(GetParam(), p, plus);
      basis_values(GetParam(), m, minus);
      // central difference: h² times the third derivative (at most 8), plus rounding 1e-16 / h
      for (std::size_t a = 0; a < n; ++a) EXPECT_NEAR(g[a * dim + i], (plus[a] - minus[a]) / (2 * h), 1e-9);
    }
  }
}

TEST_P(EveryShape, ValuesAndGradientsAreThoseOfGmsh) {
  const auto n = static_cast<std::size_t>(node_count(GetParam())),
             dim = static_cast<std::size_t>(dimension(GetParam()));
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  std::vector<double> v(n), g(n * dim);
  for (const Point& xi : points_of(GetParam())) {
    int components = 0, orientations = 0;
    std::vector<double> values, gradients;
    gmsh::model::mesh::getBasisFunctions(k_gmsh_type.at(GetParam()), {xi[0], xi[1], xi[2]}, "Lagrange",
                                         components, values, orientations);
    gmsh::model::mesh::getBasisFunctions(k_gmsh_type.at(GetParam()), {xi[0], xi[1], xi[2]}, "GradLagrange",
                                         components, gradients, orientations);
    ASSERT_EQ(values.size(), n);
    ASSERT_EQ(gradients.size(), 3 * n);
    basis_values(GetParam(), xi, v);
    basis_gradients(GetParam(), xi, g);
    for (std::size_t a = 0; a < n; ++a) {
      EXPECT_NEAR(v[a], values[a], 1e-13) << "node " << a;
      for (std::size_t i = 0; i < dim; ++i) EXPECT_NEAR(g[a * dim + i], gradients[3 * a + i], 1e-13);
    }
  }
  gmsh::finalize();
}

TEST_P(EveryShape, EveryFaceHasItsMidNodesBetweenItsVertices) {
  const Rule nodes = nodal_rule(GetParam());
  std::set<std::vector<int>> different;
  for (int f = 0; f < face_count(GetParam()); ++f) {
    const Shape face = face_shape(GetParam());
    const auto local = face_nodes(GetParam(), f);
    ASSERT_EQ(static_cast<int>(local.size()), node_count(face));
    std::vector<int> sorted(local.begin(), local.end());
    std::sort(sorted.begin(), sorted.end());
    different.insert(sorted);
    // The face's own reference nodes, carried over by its vertices alone, meet the element's reference nodes.
    const Rule on_face = nodal_rule(face);
    const Shape flat = face == Shape::line3   ? Shape::line2
                       : face == Shape::tri6  ? Shape::tri3
                       : face == Shape::quad8 ? Shape::quad4
                                              : face;
    std::vector<double> v(static_cast<std::size_t>(node_count(flat)));
    for (std::size_t a = 0; a < local.size(); ++a) {
      basis_values(flat, on_face[a].xi, v);
      for (std::size_t i = 0; i < 3; ++i) {
        double x = 0;
        for (std::size_t b = 0; b < v.size(); ++b)
          x += v[b] * nodes[static_cast<std::size_t>(local[b])].xi[i];
        EXPECT_NEAR(x, nodes[static_cast<std::size_t>(local[a])].xi[i], 1e-15);
      }
    }
  }
  EXPECT_EQ(static_cast<int>(different.size()), face_count(GetParam()));
}

}  // namespace
