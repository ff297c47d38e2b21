/// Conduction, surfaces and sources: exact for linear fields, consistent tangents, matrices of non-negative
/// type.
#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"
#include "heat/iteration/heat_system.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::block_mesh;

const std::vector<Shape> k_shapes{Shape::tri3, Shape::tri6,  Shape::quad4, Shape::quad8,
                                  Shape::tet4, Shape::tet10, Shape::hex8,  Shape::hex20};

AnalysisKind kind_of(Shape shape) {
  return test::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain;
}

/// A block of unit size, 2 or 3 cells an edge, bent inside so that no element is a parallelogram; its sides
/// stay flat.
mesh::Mesh bent(Shape shape, int cells = 3) {
  const bool solid = test::is_3d(shape);
  const auto bump = [](double s) { return std::sin(3.14159265358979323846 * s); };
  return block_mesh(shape, std::vector<double>(solid ? 3 : 2, 1.0), std::vector<int>(solid ? 3 : 2, cells),
                    [&](mesh::Point x) {
                      const double b = 0.08 * bump(x[0]) * bump(x[1]) * (solid ? bump(x[2]) : 1.0);
                      return mesh::Point{x[0] + b, x[1] - 0.7 * b, solid ? x[2] + 0.5 * b : 0.0};
                    });
}

material::Material conductor(Table k) {
  material::Material m = test::metal(40);
  m.conductivity = std::move(k);
  return m;
}

/// A smooth field that no element represents.
std::vector<double> field(const mesh::Mesh& mesh) {
  std::vector<double> t;
  for (const mesh::Point& x : mesh.x)
    t.push_back(700 + 300 * std::sin(1.3 * x[0] + 0.4) * std::cos(0.8 * x[1] - 0.5 * x[2]));
  return t;
}

class EveryShape : public testing::TestWithParam<std::tuple<Shape, bool>> {};

TEST_P(EveryShape, ReproducesALinearTemperatureOnBentElements) {
  const auto [shape, closed] = GetParam();
  const mesh::Mesh mesh = bent(shape);
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"cold", "x_min", Table(300.0)});
  conditions.fluxes.push_back({"hot", "x_max", Table(2e4)});  // gradient 200 K/m
  heat::HeatOptions options;
  options.integration = closed ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
  options.solver = linear::SolverKind::direct;
  heat::ThermalPhase phase(mesh, kind_of(shape), {conductor(Table(100.0))}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{350.0});
  const heat::ThermalReport report = phase.solve_steady(state, state, 0.0);
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    // Bent quadratic elements keep straight sides only approximately: their mid-nodes follow the map.
    EXPECT_NEAR(state.temperature[i], 300 + 200 * mesh.x[i][0], 1e-8);
  }
  EXPECT_NEAR(report.balance.conditions[0].heat, -2e4, 1e-5);  // unit area
  EXPECT_NEAR(report.balance.defect(), 0.0, 1e-5);
}

TEST_P(EveryShape, HasATangentThatIsTheDerivativeOfItsResidual) {
  const auto [shape, closed] = GetParam();
  const mesh::Mesh mesh = bent(shape, 2);
  heat::ThermalConditions conditions;
  conditions.films.push_back({"film", "x_min", {Table({300, 1100}, {500, 2500}), true}, Table(400.0)});
  conditions.radiations.push_back({"glow", "x_max", {Table({300, 1100}, {0.2, 0.9}), true}, Table(300.0)});
  const std::vector<material::Material> materials{conductor(Table({200, 600, 1200}, {300, 150, 60}))};
  heat::HeatSystem system(mesh, kind_of(shape), materials, conditions, closed, {});
  system.set_window(LoadWindow::at(1.0));
  std::vector<double> t = field(mesh), direction;
  for (const mesh::Point& x : mesh.x) direction.push_back(std::cos(5 * x[0] + 3 * x[1] + 2 * x[2]));
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes);
  std::vector<double> product(n), plus(n), minus(n);
  system.assemble(t);
  system.matrix().multiply(direction, product);
  const double eps = 1e-4;  // kinks of the tables lie further from the nodes than this
  std::vector<double> shifted = t;
  for (std::size_t i = 0; i < t.size(); ++i) shifted[i] = t[i] + eps * direction[i];
  system.residual(shifted, plus);
  for (std::size_t i = 0; i < t.size(); ++i) shifted[i] = t[i] - eps * direction[i];
  system.residual(shifted, minus);
  double scale = 0;
  for (double p : product) scale = std::max(scale, std::abs(p));
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR((plus[i] - minus[i]) / (2 * eps), product[i], 2e-6 * scale);
}

TEST_P(EveryShape, AddsUpSourcesAndFluxesExactly) {
  const auto [shape, closed] = GetParam();
  const mesh::Mesh mesh = bent(shape);
  heat::ThermalConditions conditions;
  conditions.fluxes.push_back({"flux", "y_max", Table({0, 2}, {0, 60})});
  conditions.sources.push_back({"source", "block", Table(7.0)});
  const std::vector<material::Material> materials{conductor(Table(100.0))};
  heat::HeatSystem system(mesh, kind_of(shape), materials, conditions, closed, {});
  system.set_window(LoadWindow::at(1.0));
  std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes));
  system.residual(std::vector<double>(mesh.x.size(), 500.0), r);
  double sum = 0;
  for (double value : r) sum -= value;
  EXPECT_NEAR(parallel::global_sum(sum), 30 + 7, 1e-8);  // unit area, unit volume
  EXPECT_NEAR(system.parts().surfaces.powers()[0].value, 30, 1e-9);
  EXPECT_NEAR(system.parts().sources.powers()[0].value, 7, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Conduction, EveryShape,
                         testing::Combine(testing::ValuesIn(k_shapes), testing::Bool()),
                         [](const auto& instance) {
                           return std::string(mesh::name(std::get<0>(instance.param))) +
                                  (std::get<1>(instance.param) ? "_closed" : "_open");
                         });

TEST(ClosedRule, MakesTheMatrixOfNonNegativeTypeOnRectanglesAndBoxes) {
  for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::hex8}) {
    const bool solid = test::is_3d(shape);
    // Flat cells of aspect 5: with Gauss points quads and hexes would have positive off-diagonal entries.
    const mesh::Mesh mesh =
        block_mesh(shape, solid ? std::vector<double>{1, 0.2, 1} : std::vector<double>{1, 0.2},
                   solid ? std::vector<int>{3, 3, 3} : std::vector<int>{3, 3});
    for (const bool closed : {true, false}) {
      const std::vector<material::Material> materials{conductor(Table({200, 1200}, {300, 60}))};
      heat::HeatSystem system(mesh, kind_of(shape), materials, {}, closed, {});
      system.assemble(field(mesh));
      double worst = 0;
      std::vector<double> unit(mesh.x.size(), 0.0), column(static_cast<std::size_t>(mesh.n_owned_nodes));
      for (std::size_t j = 0; j < unit.size(); ++j) {
        unit[j] = 1;
        system.matrix().multiply(unit, column);
        for (std::size_t i = 0; i < column.size(); ++i)
          if (i != j) worst = std::max(worst, column[i]);
        unit[j] = 0;
      }
      worst = parallel::global_max(worst);
      if (closed || shape == Shape::tri3)
        EXPECT_LE(worst, 1e-10) << mesh::name(shape);
      else
        EXPECT_GT(worst, 1.0) << mesh::name(shape);
    }
  }
}

TEST(ClosedRule, CarriesAnAxialFluxExactlyAlsoOnTheAxis) {
  for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8}) {
    const mesh::Mesh mesh = block_mesh(shape, {0.3, 1.0}, {3, 4});
    heat::ThermalConditions conditions;
    conditions.temperatures.push_back({"cold", "y_min", Table(300.0)});
    conditions.fluxes.push_back({"hot", "y_max", Table(1e4)});
    heat::ThermalPhase phase(mesh, AnalysisKind::axisymmetric, {conductor(Table(100.0))}, conditions);
    heat::ThermalState state = phase.states().initial(std::vector<double>{350.0});
    phase.solve_steady(state, state, 0.0);
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      EXPECT_NEAR(state.temperature[i], 300 + 100 * mesh.x[i][1], 1e-8) << mesh::name(shape);
  }
}

TEST(SteadyState, IsRejectedWhereNothingHoldsTheTemperature) {
  const mesh::Mesh mesh = block_mesh(Shape::quad4, {1, 1}, {4, 4});
  heat::ThermalConditions conditions;
  conditions.fluxes.push_back({"hot", "y_max", Table(1e4)});
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {conductor(Table(100.0))}, conditions);
  heat::ThermalState state = phase.states().initial(std::vector<double>{350.0});
  EXPECT_THROW(phase.solve_steady(state, state, 0.0), StepRejected);
}

TEST(Conditions, NamesTheGroupThatTheMeshLacks) {
  const mesh::Mesh mesh = block_mesh(Shape::quad4, {1, 1}, {2, 2});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"film", "x_mid", {Table(1.0), false}, Table(300.0)});
  try {
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {test::metal(1)}, conditions);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no surface 'x_mid' in the mesh"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("x_max, x_min"), std::string::npos);
  }
}

TEST(Conditions, HoldTheLaterOfTwoPrescribedTemperatures) {
  const mesh::Mesh mesh = block_mesh(Shape::quad4, {1, 1}, {4, 4});
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"all", "block", Table(400.0)});
  conditions.temperatures.push_back({"side", "x_min", Table(300.0)});
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {test::metal(1)}, conditions);
  heat::ThermalState state = phase.states().initial(std::vector<double>{350.0});
  phase.solve(state, state, 1.0, 1.0);
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    EXPECT_EQ(state.temperature[i], mesh.x[i][0] == 0 ? 300.0 : 400.0);
}

}  // namespace
}  // namespace solidus
