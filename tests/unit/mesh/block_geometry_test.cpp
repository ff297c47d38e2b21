// Jacobians, volumes, weights and normals against Gmsh, closed forms and the divergence theorem.
#include "mesh/block_geometry.hpp"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "sample_mesh.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;

const std::map<Shape, int> k_gmsh_type{{Shape::tri3, 2},   {Shape::tri6, 9},  {Shape::quad4, 3},
                                       {Shape::quad8, 16}, {Shape::tet4, 4},  {Shape::tet10, 11},
                                       {Shape::hex8, 5},   {Shape::hex20, 17}};

AnalysisKind plain_kind(Shape shape) {
  return mesh::dimension(shape) == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain;
}

// One distorted element, numbered as the reference shape is.
Mesh one_element(Shape shape) {
  Mesh m;
  m.dimension = mesh::dimension(shape);
  m.bodies = {{"body"}};
  ElementBlock block;
  block.shape = shape;
  block.body = 0;
  for (const QuadraturePoint& p : nodal_rule(shape)) {
    block.nodes.push_back(m.n_nodes());
    Point x = p.xi;
    x[0] += 0.08 * std::sin(3 * p.xi[1] + p.xi[2]) + 2;
    x[1] += 0.07 * std::sin(2 * p.xi[0] - p.xi[2]) + 1;
    if (m.dimension == 3) x[2] += 0.06 * std::cos(2 * p.xi[0] + p.xi[1]);
    m.x.push_back(x);
  }
  block.input_element = {1};
  block.n_counted = 1;
  m.n_owned_nodes = m.n_nodes();
  m.blocks = {block};
  return m;
}

class EveryBodyShape : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryBodyShape, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryBodyShape, JacobiansAndGradientsAreThoseOfGmsh) {
  const Shape shape = GetParam();
  const Mesh m = one_element(shape);
  const Rule rule = gauss_rule(shape, 4);
  const BlockGeometry g(m, m.blocks[0], plain_kind(shape), rule);

  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("one element");
  gmsh::model::addDiscreteEntity(m.dimension, 1);
  std::vector<std::size_t> tags;
  std::vector<double> x, points, jacobians, determinants, places, slopes;
  for (Index i = 0; i < m.n_nodes(); ++i) {
    tags.push_back(static_cast<std::size_t>(i) + 1);
    for (const double c : m.x[static_cast<std::size_t>(i)]) x.push_back(c);
  }
  for (const QuadraturePoint& p : rule) points.insert(points.end(), p.xi.begin(), p.xi.end());
  gmsh::model::mesh::addNodes(m.dimension, 1, tags, x);
  gmsh::model::mesh::addElementsByType(1, k_gmsh_type.at(shape), {1}, tags);
  gmsh::model::mesh::getJacobians(k_gmsh_type.at(shape), points, jacobians, determinants, places);
  int components = 0, orientations = 0;
  gmsh::model::mesh::getBasisFunctions(k_gmsh_type.at(shape), points, "GradLagrange", components, slopes,
                                       orientations);
  gmsh::finalize();

  const auto nn = static_cast<std::size_t>(g.n_nodes), dim = static_cast<std::size_t>(g.dim);
  for (std::size_t p = 0; p < rule.size(); ++p) {
    EXPECT_NEAR(g.weight[p][0], rule[p].weight * determinants[p], 1e-14);
    // Chain rule with Gmsh's matrices: ∂N/∂ξ_j = Σ_i ∂N/∂x_i ∂x_i/∂ξ_j; Gmsh stores columns ∂x/∂ξ_j behind
    // each other.
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t j = 0; j < dim; ++j) {
        double slope = 0;
        for (std::size_t i = 0; i < dim; ++i)
          slope += g.gradients_at(0, static_cast<int>(p))[a * dim + i][0] * jacobians[9 * p + 3 * j + i];
        EXPECT_NEAR(slope, slopes[(p * nn + a) * 3 + j], 1e-13);
      }
  }
}

TEST_P(EveryBodyShape, GradientsOfALinearFieldAreExactOnADistortedMesh) {
  RawMesh raw = sample_box(GetParam());
  distort(raw, 0.05);
  const Mesh m = distribute(raw, {"block"}, {});
  const Point slope{2, -3, m.dimension == 3 ? 5.0 : 0.0};
  for (const ElementBlock& block : m.blocks) {
    const BlockGeometry g(m, block, plain_kind(GetParam()), stiffness_rule(block.shape));
    for (Index b = 0; b < g.n_batches; ++b)
      for (int p = 0; p < g.n_points; ++p)
        for (int i = 0; i < g.dim; ++i) {
          Lane sum(0.0);
          for (int a = 0; a < g.n_nodes; ++a) {
            Lane field(0.0);
            for (int lane = 0; lane < k_lanes; ++lane) {
              const Point& x = m.x[static_cast<std::size_t>(
                  g.nodes[static_cast<std::size_t>((b * g.n_nodes + a) * k_lanes + lane)])];
              field.set(lane, slope[0] * x[0] + slope[1] * x[1] + slope[2] * x[2]);
            }
            sum += field * g.gradients_at(b, p)[a * g.dim + i];
          }
          for (int lane = 0; lane < k_lanes; ++lane)
            EXPECT_NEAR(sum[lane], slope[static_cast<std::size_t>(i)], 1e-11);
        }
  }
}

TEST_P(EveryBodyShape, GradientsAreTheSameInWhateverOrderBatchesAreAskedFor) {
  RawMesh raw = sample_box(GetParam());
  distort(raw, 0.05);
  const Mesh m = distribute(raw, {"block"}, {});
  for (const ElementBlock& block : m.blocks) {
    const BlockGeometry up(m, block, plain_kind(GetParam()), stiffness_rule(block.shape));
    BlockGeometry down = up;
    if (up.n_batches == 0) continue;
    const auto stride = static_cast<std::size_t>(up.n_nodes * up.dim);
    down.gradients_at(0, 0);
    down.shift_gradients(PackVector<Lane>(static_cast<std::size_t>(up.n_batches) * stride, Lane(0.25)));
    for (Index batch = 0; batch < up.n_batches; ++batch)
      for (const Index other : {up.n_batches - 1 - batch, batch})
        for (int p = up.n_points - 1; p >= 0; --p)
          for (std::size_t i = 0; i < stride; ++i)
            EXPECT_EQ(down.gradients_at(other, p)[i][0], up.gradients_at(other, p)[i][0] + 0.25);
  }
}

TEST_P(EveryBodyShape, VolumeOfABoxIsExactAndNothingIsCountedTwice) {
  const Mesh m = distribute(sample_box(GetParam()), {"block"}, {});
  EXPECT_NEAR(volume(m, plain_kind(GetParam())), m.dimension == 3 ? 0.06 : 0.15, 1e-15);
}

TEST_P(EveryBodyShape, NodalWeightsArePositiveAndSumToTheVolume) {
  for (const AnalysisKind kind : {plain_kind(GetParam()), AnalysisKind::axisymmetric}) {
    if (kind == AnalysisKind::axisymmetric && mesh::dimension(GetParam()) == 3) continue;
    RawMesh raw = sample_box(GetParam());
    if (kind != AnalysisKind::axisymmetric) distort(raw, 0.05);
    const Mesh m = distribute(raw, {"block"}, {});
    double total = 0;
    for (const ElementBlock& block : m.blocks) {
      const PackVector<Lane> w = nodal_weights(m, block, kind);
      const int nn = node_count(block.shape);
      for (Index e = 0; e < block.size(); ++e)
        for (int a = 0; a < nn; ++a) {
          const double weight = w[static_cast<std::size_t>(e / k_lanes * nn + a)][e % k_lanes];
          EXPECT_GT(weight, 0);
          if (e < block.n_counted) total += weight;
        }
      for (Index pad = block.size(); pad % k_lanes != 0; ++pad)
        for (int a = 0; a < nn; ++a)
          EXPECT_EQ(w[static_cast<std::size_t>(pad / k_lanes * nn + a)][pad % k_lanes], 0);
    }
    const double whole = volume(m, kind);
    EXPECT_NEAR(global_sum(total), whole, 1e-13 * whole);
  }
}

TEST_P(EveryBodyShape, OutwardNormalsSatisfyTheDivergenceTheorem) {
  RawMesh raw = sample_box(GetParam());
  distort(raw, 0.05);
  const Mesh m = distribute(raw, {"block"}, {});
  Point closed{};
  double flux = 0;
  for (const auto& [side, surface] : m.surfaces)
    for (const ElementBlock& faces : surface.faces) {
      EXPECT_EQ(faces.body, 0);
      const Rule rule = gauss_rule(faces.shape, 6);
      const FaceGeometry g(m, faces, plain_kind(GetParam()), rule);
      for (Index f = 0; f < g.n_counted; ++f)
        for (int p = 0; p < g.n_points; ++p) {
          const auto at = static_cast<std::size_t>(f * g.n_points + p);
          Point x{};
          for (int a = 0; a < g.n_nodes; ++a)
            for (std::size_t i = 0; i < 3; ++i)
              x[i] += g.values[static_cast<std::size_t>(p * g.n_nodes + a)] *
                      m.x[static_cast<std::size_t>(faces.element(f)[a])][i];
          for (std::size_t i = 0; i < 3; ++i) {
            closed[i] += g.weight[at] * g.normal[at][i];
            flux += g.weight[at] * g.normal[at][i] * x[i];
          }
        }
    }
  for (const double c : closed) EXPECT_NEAR(global_sum(c), 0, 1e-14);  // ∮ n dA = 0
  // ∮ x·n dA = dim V
  EXPECT_NEAR(global_sum(flux), m.dimension * volume(m, plain_kind(GetParam())), 1e-13);
}

TEST(Axisymmetry, ARectangleTurnsIntoARingOfPappus) {
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
    const Mesh m = distribute(sample_box(shape, 0.2), {"block"}, {});
    const double pi = std::numbers::pi;
    EXPECT_NEAR(volume(m, AnalysisKind::axisymmetric), 2 * pi * 0.45 * 0.15, 1e-14);
    double top = 0, outside = 0;
    for (const auto& [side, area] : {std::pair{"y_max", &top}, std::pair{"x_max", &outside}}) {
      if (!m.surfaces.contains(side)) continue;
      for (const ElementBlock& faces : m.surfaces.at(side).faces) {
        const FaceGeometry g(m, faces, AnalysisKind::axisymmetric, gauss_rule(faces.shape, 3));
        for (Index k = 0; k < g.n_counted * g.n_points; ++k) *area += g.weight[static_cast<std::size_t>(k)];
      }
    }
    EXPECT_NEAR(global_sum(top), pi * (0.7 * 0.7 - 0.2 * 0.2), 1e-14);
    EXPECT_NEAR(global_sum(outside), 2 * pi * 0.7 * 0.3, 1e-14);
  }
}

TEST(Axisymmetry, TheAluminiumCylinderHasTheVolumesOfItsDrawing) {
  const CylinderInMould c{0.015, 0.07, 0.02, 0.02, 0.09, 0.0015, 0.003};
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
    const RawMesh raw = make_cylinder_in_mould(c, shape);
    const double pi = std::numbers::pi, part = pi * 0.015 * 0.015 * 0.07,
                 mould = pi * 0.035 * 0.035 * 0.09 - part;
    EXPECT_NEAR(volume(distribute(raw, {"part"}, {}), AnalysisKind::axisymmetric), part, 1e-13 * part);
    EXPECT_NEAR(volume(distribute(raw, {"mould"}, {}), AnalysisKind::axisymmetric), mould, 1e-13 * mould);
  }
}

TEST(Axisymmetry, InverseRadiusIsOneOverTheRadiusOfThePoint) {
  const Mesh m = distribute(sample_box(Shape::quad4, 0.2), {"block"}, {});
  for (const ElementBlock& block : m.blocks) {
    const BlockGeometry g(m, block, AnalysisKind::axisymmetric, stiffness_rule(block.shape));
    for (Index b = 0; b < g.n_batches; ++b)
      for (int p = 0; p < g.n_points; ++p)
        for (int lane = 0; lane < k_lanes; ++lane) {
          double r = 0;
          for (int a = 0; a < g.n_nodes; ++a)
            r += g.values[static_cast<std::size_t>(p * g.n_nodes + a)] *
                 m.x[static_cast<std::size_t>(
                     g.nodes[static_cast<std::size_t>((b * g.n_nodes + a) * k_lanes + lane)])][0];
          EXPECT_NEAR(g.inverse_radius[static_cast<std::size_t>(b * g.n_points + p)][lane] * r, 1, 1e-14);
        }
  }
}

}  // namespace
