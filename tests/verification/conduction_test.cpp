/// Conduction without phase change against closed forms: order of convergence of every element, films,
/// radiation.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic/conduction.hpp"
#include "numbers/types.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using verification::is_3d;

const std::vector<Shape> k_shapes{Shape::tri3, Shape::tri6,  Shape::quad4, Shape::quad8,
                                  Shape::tet4, Shape::tet10, Shape::hex8,  Shape::hex20};

material::Material conductor(Table k) {
  material::Material m;
  m.name = "conductor";
  m.density = 2500;
  m.conductivity = std::move(k);
  m.specific_heat = Table(1000.0);
  return m;
}

AnalysisKind kind_of(Shape shape) {
  return is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain;
}
heat::HeatOptions options_of(bool closed) {
  heat::HeatOptions options;
  options.integration = closed ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
  options.solver = linear::SolverKind::direct;
  return options;
}
std::string name_of(Shape shape, bool closed) {
  return std::string(mesh::name(shape)) + (closed ? "_closed" : "_open");
}

class Order : public testing::TestWithParam<std::tuple<Shape, bool>> {
 protected:
  Shape shape() const { return std::get<0>(GetParam()); }
  bool closed() const { return std::get<1>(GetParam()); }
  double expected() const { return mesh::order(shape()) + 1; }
};

/// A quarter of an annulus, curved elements; the block's x runs along the radius.
TEST_P(Order, OfTheSteadyTemperatureInAnAnnulusIsThatOfTheElementPlusOne) {
  const analytic::Annulus exact{0.1, 0.3, 800, 300};
  const auto map = [](mesh::Point x) {
    const double r = 0.1 + 0.2 * x[0], angle = 0.5 * std::numbers::pi * x[1];
    return mesh::Point{r * std::cos(angle), r * std::sin(angle), x[2]};
  };
  std::vector<double> errors;
  for (const int n : is_3d(shape()) ? std::vector{3, 6} : std::vector{6, 12}) {
    const mesh::Mesh mesh =
        verification::block(shape(), is_3d(shape()) ? std::vector{1.0, 1.0, 0.2} : std::vector{1.0, 1.0},
                            is_3d(shape()) ? std::vector{n, n, 1} : std::vector{n, n}, map);
    heat::ThermalConditions conditions;
    conditions.temperatures.push_back({"inner", "x_min", Table(exact.inner_temperature)});
    conditions.temperatures.push_back({"outer", "x_max", Table(exact.outer_temperature)});
    heat::ThermalPhase phase(mesh, kind_of(shape()), {conductor(Table(50.0))}, conditions,
                             options_of(closed()));
    heat::ThermalState state = phase.states().initial(std::vector<double>{500.0});
    phase.solve_steady(state, state, 0.0);
    errors.push_back(verification::l2_error(
        mesh, kind_of(shape()), state.temperature,
        [&](const mesh::Point& x) { return exact.temperature(std::hypot(x[0], x[1])); }));
  }
  const double rate = std::log2(errors[0] / errors[1]);
  verification::csv("annulus_" + name_of(shape(), closed()), "coarse_error[K],fine_error[K],rate[1]")
      << errors[0] << ',' << errors[1] << ',' << rate << '\n';
  EXPECT_GE(rate, expected() - 0.3);
  EXPECT_LE(rate, expected() + 0.6);
}

/// Backward Euler's own error is taken out, so only the mesh is measured. The closed rule of quadratic
/// elements lumps their heat content by diagonal scaling, which is of second order only.
TEST_P(Order, OfATransientCosineIsThatOfTheElementPlusOne) {
  const analytic::CosineSlab exact{0.1, 600, 200, 4e-5};
  const int steps = 4;
  const double dt = 0.1 / exact.rate();
  std::vector<double> errors;
  for (const int n : {8, 16}) {
    const mesh::Mesh mesh = verification::strip(shape(), exact.length, n);
    heat::ThermalPhase phase(mesh, kind_of(shape()), {conductor(Table(100.0))}, {}, options_of(closed()));
    std::vector<double> start;
    for (const mesh::Point& x : mesh.x) start.push_back(exact.temperature(x[0], 0.0));
    heat::ThermalState state = phase.states().initial_at_nodes(start);
    for (int i = 1; i <= steps; ++i) phase.solve(state, state, i * dt, dt);
    errors.push_back(
        verification::l2_error(mesh, kind_of(shape()), state.temperature,
                               [&](const mesh::Point& x) { return exact.stepped(x[0], steps, dt); }));
  }
  const double rate = std::log2(errors[0] / errors[1]);
  verification::csv("cosine_" + name_of(shape(), closed()), "coarse_error[K],fine_error[K],rate[1]")
      << errors[0] << ',' << errors[1] << ',' << rate << '\n';
  EXPECT_GE(rate, (closed() ? 2.0 : expected()) - 0.3);
  EXPECT_LE(rate, expected() + 0.6);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Order, testing::Combine(testing::ValuesIn(k_shapes), testing::Bool()),
                         [](const auto& instance) {
                           return name_of(std::get<0>(instance.param), std::get<1>(instance.param));
                         });

TEST(Conduction, IsOfFirstOrderInTheTimeStep) {
  const analytic::CosineSlab exact{0.1, 600, 200, 4e-5};
  const mesh::Mesh mesh = verification::strip(Shape::quad8, exact.length, 20);
  const double end = 1.0 / exact.rate();
  std::vector<double> errors;
  for (const int steps : {10, 20, 40}) {
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {conductor(Table(100.0))}, {},
                             options_of(false));
    std::vector<double> start;
    for (const mesh::Point& x : mesh.x) start.push_back(exact.temperature(x[0], 0.0));
    heat::ThermalState state = phase.states().initial_at_nodes(start);
    for (int i = 1; i <= steps; ++i) phase.solve(state, state, i * end / steps, end / steps);
    errors.push_back(
        verification::l2_error(mesh, AnalysisKind::plane_strain, state.temperature,
                               [&](const mesh::Point& x) { return exact.temperature(x[0], end); }));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_GE(std::log2(errors[i - 1] / errors[i]), 0.85);
    EXPECT_LE(std::log2(errors[i - 1] / errors[i]), 1.15);
  }
}

TEST(Conduction, OfAnAxisymmetricTubeCarriesTheHeatOfTheClosedForm) {
  const analytic::Annulus exact{0.1, 0.3, 800, 300};
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8})
    for (const bool closed : {true, false}) {
      std::vector<double> errors;
      double heat = 0;
      for (const int n : {10, 20}) {
        const mesh::Mesh mesh = verification::block(shape, {0.2, 0.05}, {n, 2}, [](mesh::Point x) {
          return mesh::Point{0.1 + x[0], x[1], 0.0};
        });
        heat::ThermalConditions conditions;
        conditions.temperatures.push_back({"inner", "x_min", Table(exact.inner_temperature)});
        conditions.temperatures.push_back({"outer", "x_max", Table(exact.outer_temperature)});
        heat::ThermalPhase phase(mesh, AnalysisKind::axisymmetric, {conductor(Table(50.0))}, conditions,
                                 options_of(closed));
        heat::ThermalState state = phase.states().initial(std::vector<double>{500.0});
        heat = phase.solve_steady(state, state, 0.0).balance.conditions[0].heat;
        errors.push_back(
            verification::l2_error(mesh, AnalysisKind::axisymmetric, state.temperature,
                                   [&](const mesh::Point& x) { return exact.temperature(x[0]); }));
      }
      EXPECT_NEAR(heat / (0.05 * exact.heat(50.0)), 1.0, 2e-3) << name_of(shape, closed);
      EXPECT_GE(std::log2(errors[0] / errors[1]), mesh::order(shape) + 0.7) << name_of(shape, closed);
    }
}

TEST(Conduction, WithAConductivityThatVariesIsExactInOneDimensionAndConvergesQuadratically) {
  const analytic::KirchhoffSlab exact{0.1, 300, 1300, 20, 2e-3};
  const Table k({0, 2000}, {exact.k0, exact.k0 * (1 + 2000 * exact.slope)});
  for (const bool closed : {true, false})
    for (const Shape shape :
         {Shape::tri3, Shape::quad4, Shape::quad8, Shape::tet4, Shape::hex8, Shape::tet10}) {
      const mesh::Mesh mesh = verification::strip(shape, exact.length, 20);
      heat::ThermalConditions conditions;
      conditions.temperatures.push_back({"cold", "x_min", Table(exact.cold)});
      conditions.temperatures.push_back({"hot", "x_max", Table(exact.hot)});
      heat::HeatOptions options = options_of(closed);
      options.tolerance = 1e-12;
      heat::ThermalPhase phase(mesh, kind_of(shape), {conductor(k)}, conditions, options);
      heat::ThermalState state = phase.states().initial(std::vector<double>{500.0});
      const auto report = phase.solve_steady(state, state, 0.0).newton;
      EXPECT_LE(report.iterations, 6) << name_of(shape, closed);
      // Quadratic: the digits about double, once the residual is small and above rounding.
      int doubled = 0;
      for (std::size_t i = 1; i + 1 < report.residuals.size(); ++i)
        if (report.residuals[i] < 0.05 && report.residuals[i + 1] > 1e-13)
          doubled += std::log(report.residuals[i + 1]) <= 1.6 * std::log(report.residuals[i]) ? 1 : 0;
      EXPECT_GE(doubled, 1) << name_of(shape, closed);
      // The potential is linear between two temperatures, which every element represents.
      for (std::size_t i = 0; i < state.temperature.size(); ++i)
        EXPECT_NEAR(state.temperature[i], exact.temperature(mesh.x[i][0]), 1e-6) << name_of(shape, closed);
    }
}

TEST(Surface, CoolsALumpedBodyByFilmAndRadiationAsTheScalarEquationsSay) {
  const mesh::Mesh mesh = verification::block(Shape::quad4, {0.02, 0.01}, {4, 2});
  const analytic::LumpedBody body{2.5e6 * 0.02 * 0.01, 0.01, 1200, 300};  // one side of 0.01 m, per metre
  for (const bool closed : {true, false}) {
    // So conductive that the body has one temperature.
    heat::ThermalConditions film, radiation;
    film.films.push_back({"film", "x_min", {Table(300.0), false}, Table(body.ambient)});
    radiation.radiations.push_back({"glow", "x_min", {Table(0.8), false}, Table(body.ambient)});
    heat::ThermalPhase filmed(mesh, AnalysisKind::plane_strain, {conductor(Table(1e9))}, film,
                              options_of(closed));
    heat::ThermalPhase glowing(mesh, AnalysisKind::plane_strain, {conductor(Table(1e9))}, radiation,
                               options_of(closed));
    heat::ThermalState a = filmed.states().initial(std::vector<double>{body.start}), b = a;
    const int steps = 20;
    const double dt = 10.0;
    for (int i = 1; i <= steps; ++i) {
      filmed.solve(a, a, i * dt, dt);
      glowing.solve(b, b, i * dt, dt);
    }
    EXPECT_NEAR(a.temperature[0], body.film(300, steps, dt), 1e-3);
    EXPECT_NEAR(b.temperature[0], body.radiation(0.8 * k_stefan_boltzmann, steps, dt), 1e-3);
  }
}

}  // namespace
}  // namespace solidus
