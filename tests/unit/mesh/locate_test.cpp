// Points and means of fields whose values are known everywhere.
#include "mesh/locate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;

// 1 + 2x − 3y + 5z at the nodes.
std::vector<double> linear_field(const Mesh& m) {
  std::vector<double> field;
  for (const Point& x : m.x) field.push_back(1 + 2 * x[0] - 3 * x[1] + 5 * x[2]);
  return field;
}
double linear(const Point& x) {
  return 1 + 2 * x[0] - 3 * x[1] + 5 * x[2];
}

AnalysisKind plain_kind(const Mesh& m) {
  return m.dimension == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain;
}

class EveryShapeLocated : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShapeLocated, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryShapeLocated, ALinearFieldIsExactAtAnyPointAndOneProcessAnswers) {
  RawMesh raw = sample_box(GetParam());
  distort(raw, 0.03);
  const Mesh m = distribute(raw, {"block"}, {});
  const auto field = linear_field(m);
  for (Point x : {Point{0.25, 0.15, 0.2}, Point{0.11, 0.21, 0.33}, Point{0.4, 0.07, 0.11}}) {
    if (m.dimension == 2) x[2] = 0;
    const LocatedPoint p = locate(m, x);
    EXPECT_EQ(global_sum(p.here ? 1 : 0), 1);
    EXPECT_NEAR(p.distance, 0, 1e-12);
    EXPECT_NEAR(global_sum(p.share(field)), linear(x), 1e-11);
    if (!p.here) continue;
    EXPECT_LT(p.element, m.blocks[static_cast<std::size_t>(p.block)].n_counted);
    std::vector<double> v(static_cast<std::size_t>(node_count(GetParam())));
    basis_values(GetParam(), p.xi, v);
    Point back{};
    const ElementBlock& block = m.blocks[static_cast<std::size_t>(p.block)];
    for (std::size_t a = 0; a < v.size(); ++a)
      for (std::size_t i = 0; i < 3; ++i)
        back[i] += v[a] * m.x[static_cast<std::size_t>(block.element(p.element)[a])][i];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], x[i], 1e-12);
  }
}

TEST_P(EveryShapeLocated, ANodeIsFoundAtItsPlace) {
  const Mesh m = distribute(sample_box(GetParam()), {"block"}, {});
  const Point corner{0.5, 0.3, m.dimension == 3 ? 0.4 : 0.0};
  const LocatedPoint p = locate(m, corner);
  EXPECT_NEAR(p.distance, 0, 1e-14);
  EXPECT_NEAR(global_sum(p.share(linear_field(m))), linear(corner), 1e-12);
}

TEST_P(EveryShapeLocated, APointOutsideIsAnsweredByTheNearestPlaceWithItsDistance) {
  const Mesh m = distribute(sample_box(GetParam()), {"block"}, {});
  const auto field = linear_field(m);
  const double z = m.dimension == 3 ? 0.17 : 0.0;
  const LocatedPoint beside = locate(m, {0.6, 0.11, z});
  EXPECT_NEAR(beside.distance, 0.1, 1e-12);
  EXPECT_NEAR(global_sum(beside.share(field)), linear({0.5, 0.11, z}), 1e-11);
  const LocatedPoint corner = locate(m, {-0.3, 0.7, z});
  EXPECT_NEAR(corner.distance, 0.5, 1e-12);
  EXPECT_NEAR(global_sum(corner.share(field)), linear({0, 0.3, z}), 1e-11);
}

TEST_P(EveryShapeLocated, MeansOfALinearFieldAreItsValuesAtTheCentres) {
  const Mesh m = distribute(sample_box(GetParam()), {"block"}, {});
  const auto field = linear_field(m);
  const double z = m.dimension == 3 ? 0.2 : 0.0;
  EXPECT_NEAR(global_sum(group_mean(m, "block", plain_kind(m)).share(field)), linear({0.25, 0.15, z}), 1e-13);
  EXPECT_NEAR(global_sum(group_mean(m, "x_max", plain_kind(m)).share(field)), linear({0.5, 0.15, z}), 1e-13);
  EXPECT_NEAR(group_measure(m, "block", plain_kind(m)), m.dimension == 3 ? 0.06 : 0.15, 1e-15);
  EXPECT_NEAR(group_measure(m, "x_max", plain_kind(m)), m.dimension == 3 ? 0.12 : 0.3, 1e-15);
}

TEST(Locate, CoincidentInterfacesAreToldApartByBody) {
  const CylinderInMould c{0.015, 0.07, 0.02, 0.02, 0.09, 0.0015, 0.003};
  const Mesh m = distribute(make_cylinder_in_mould(c, Shape::tri3), {"part", "mould"}, {});
  for (const int body : {-1, 0, 1}) {
    const LocatedPoint p = locate(m, {0.015, 0.035, 0}, body);
    EXPECT_NEAR(p.distance, 0, 1e-14);
    if (p.here) {
      EXPECT_EQ(m.blocks[static_cast<std::size_t>(p.block)].body, std::max(body, 0));
    }
  }
}

TEST(Locate, MeansInAxisymmetryWeighTheRadius) {
  const Mesh m = distribute(sample_box(Shape::quad4), {"block"}, {});
  std::vector<double> radius;
  for (const Point& x : m.x) radius.push_back(x[0]);
  const auto mean = [&](const char* group) {
    return global_sum(group_mean(m, group, AnalysisKind::axisymmetric).share(radius));
  };
  EXPECT_NEAR(mean("block"), 2.0 / 3 * 0.5, 1e-14);  // ∫r·r dr / ∫r dr
  EXPECT_NEAR(mean("y_max"), 2.0 / 3 * 0.5, 1e-14);
  EXPECT_NEAR(mean("x_min"), 0, 1e-14);  // the axis has no area; its nodes count alike
  EXPECT_NEAR(group_measure(m, "block", AnalysisKind::axisymmetric), std::numbers::pi * 0.25 * 0.3, 1e-15);
}

TEST(Locate, ComponentsOfAVectorFieldAreTakenApart) {
  const Mesh m = distribute(sample_box(Shape::tri3), {"block"}, {});
  std::vector<double> field;
  for (const Point& x : m.x) {
    field.push_back(x[0]);
    field.push_back(7 * x[1]);
  }
  const LocatedPoint p = locate(m, {0.2, 0.1, 0});
  EXPECT_NEAR(global_sum(p.share(field, 2, 0)), 0.2, 1e-14);
  EXPECT_NEAR(global_sum(p.share(field, 2, 1)), 0.7, 1e-14);
}

TEST(Locate, AGroupThatIsNotThereIsAnErrorOfTheUser) {
  const Mesh m = distribute(sample_box(Shape::tri3), {"block"}, {});
  EXPECT_THROW(group_mean(m, "x_mox", AnalysisKind::plane_strain), InputError);
}

}  // namespace
