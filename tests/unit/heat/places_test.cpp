/// Conditions that vary with position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "block.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using mesh::Shape;

class Law : public PlaceLaw {
 public:
  using Value = std::function<double(const Position&, double)>;
  explicit Law(Value value) : value_(std::move(value)) {}
  void values(std::span<const Position> x, double time, std::span<double> values) const override {
    for (std::size_t i = 0; i < x.size(); ++i) values[i] = value_(x[i], time);
  }

 private:
  Value value_;
};

PlaceFunction placed(Law::Value value) {
  return PlaceFunction(std::make_shared<Law>(std::move(value)));
}

material::Material solid_metal() {
  material::Material m = test::metal(10);
  m.phase_changes.clear();
  return m;
}

class Places : public ::testing::TestWithParam<std::tuple<Shape, bool>> {
 protected:
  mesh::Mesh mesh(int n = 4) const {
    const bool solid = test::is_3d(shape());
    return test::block_mesh(shape(), solid ? std::vector{0.2, 0.1, 0.1} : std::vector{0.2, 0.1},
                            solid ? std::vector{n, 2, 2} : std::vector{n, 2});
  }
  Shape shape() const { return std::get<0>(GetParam()); }
  AnalysisKind kind() const {
    return test::is_3d(shape()) ? AnalysisKind::solid : AnalysisKind::plane_strain;
  }
  double depth() const { return test::is_3d(shape()) ? 0.1 : 1.0; }
  heat::HeatOptions options() const {
    heat::HeatOptions o;
    o.integration = std::get<1>(GetParam()) ? heat::HeatIntegration::closed : heat::HeatIntegration::open;
    return o;
  }
};

TEST_P(Places, ALinearSourceAndALinearFluxGiveTheirIntegral) {
  const mesh::Mesh mesh = this->mesh();
  heat::ThermalConditions conditions;
  conditions.sources = {{"source", "block", placed([](const Position& x, double) { return 1e6 * x[0]; })}};
  conditions.fluxes = {
      {"flux", "y_max", placed([](const Position& x, double t) { return 1e5 * x[0] * t; }), 2.0}};
  heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
  const heat::ThermalState start = phase.states().initial(std::array{400.0});
  heat::ThermalState end;
  const heat::ThermalReport report = phase.solve(start, end, 3, 0.5);
  ASSERT_EQ(report.balance.conditions.size(), 2U);
  const double mean_time = 2.75;  // of the step
  EXPECT_NEAR(report.balance.conditions[0].heat, 2 * 1e5 * 0.02 * depth() * mean_time * 0.5, 1e-9);
  EXPECT_NEAR(report.balance.conditions[1].heat, 1e6 * 0.02 * 0.1 * depth() * 0.5, 1e-9);
  EXPECT_NEAR(report.balance.defect(), 0, 1e-7 * report.balance.exchanged);
}

TEST_P(Places, APrescribedLinearTemperatureIsTheSteadyState) {
  const mesh::Mesh mesh = this->mesh();
  const auto linear = [](const Position& x, double) { return 400 + 1000 * x[0] + 500 * x[1] + 200 * x[2]; };
  heat::ThermalConditions conditions;
  for (const char* face : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"})
    if (test::is_3d(shape()) || face[0] != 'z')
      conditions.temperatures.push_back({face, face, placed(linear)});
  heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
  heat::ThermalState end;
  phase.solve_steady(phase.states().initial(std::array{400.0}), end, 0);
  double worst = 0;
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    worst = std::max(worst, std::abs(end.temperature[i] - linear(mesh.x[i], 0)));
  EXPECT_LT(worst, 1e-6);
}

TEST_P(Places, AFactorRestrictsAFilmWhoseCoefficientIsATableOfTemperature) {
  const mesh::Mesh mesh = this->mesh();
  const auto heat_in = [&](PlaceFunction factor) {
    heat::ThermalConditions conditions;
    conditions.films = {{"film", "y_max", {Table({300, 500}, {100, 300}), true}, 300.0, std::move(factor)}};
    heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
    heat::ThermalState end;
    return phase.solve(phase.states().initial(std::array{400.0}), end, 1, 1e-4).balance.conditions[0].heat;
  };
  const double whole = heat_in(1.0);
  EXPECT_NEAR(whole, -200 * 100 * 0.2 * depth() * 1e-4, 1e-3 * std::abs(whole));
  EXPECT_NEAR(heat_in(placed([](const Position& x, double) { return x[0] / 0.2; })), whole / 2,
              1e-3 * std::abs(whole));
  EXPECT_EQ(heat_in(placed([](const Position&, double t) { return t > 2 ? 1.0 : 0.0; })), 0);
}

TEST_P(Places, ASpotMuchSmallerThanTheElementsGivesItsIntegralToAPerMille) {
  const mesh::Mesh mesh = this->mesh();
  constexpr double k_sigma = 0.002;  // elements of 50 mm
  const auto spot = [](const Position& x, double) {
    const double a = (x[0] - 0.067) / k_sigma, b = (x[1] - 0.031) / k_sigma;
    return 1e9 * std::exp(-0.5 * (a * a + b * b));
  };
  const auto line = [](const Position& x, double) {
    const double a = (x[0] - 0.067) / k_sigma;
    return -1e9 * std::exp(-0.5 * a * a);
  };
  heat::ThermalConditions conditions;
  conditions.sources = {{"source", "block", placed(spot)}};
  conditions.fluxes = {{"flux", "y_max", placed(line)}};
  heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
  heat::ThermalState end;
  const double dt = 1e-9;
  const heat::ThermalReport report = phase.solve(phase.states().initial(std::array{400.0}), end, dt, dt);
  const double power = 1e9 * 2 * std::numbers::pi * k_sigma * k_sigma * depth();
  EXPECT_NEAR(report.balance.conditions[1].heat, power * dt, 1e-3 * power * dt);
  // A line on triangles, 25 times narrower than they are, shows at none of their nodes and centroids.
  if (shape() == Shape::tet4) return;
  const double flow = -1e9 * std::sqrt(2 * std::numbers::pi) * k_sigma * depth();
  EXPECT_NEAR(report.balance.conditions[0].heat, flow * dt, -1e-3 * flow * dt);
}

TEST_P(Places, AFilmOnASpotSmallerThanTheElementsTakesItsIntegral) {
  const mesh::Mesh mesh = this->mesh();
  constexpr double k_sigma = 0.004;
  const auto spot = [](const Position& x, double) {
    const double a = (x[0] - 0.067) / k_sigma;
    return std::exp(-0.5 * a * a);
  };
  heat::ThermalConditions conditions;
  conditions.films = {{"film", "y_max", {500.0}, 300.0, placed(spot)}};
  heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
  heat::ThermalState end;
  const double dt = 1e-6;
  const heat::ThermalReport report = phase.solve(phase.states().initial(std::array{400.0}), end, dt, dt);
  const double taken = -500 * 100 * std::sqrt(2 * std::numbers::pi) * k_sigma * depth() * dt;
  // On quadratic faces of the closed rule the nodes' areas are not those of the means around them.
  const bool lumped_quadratic = std::get<1>(GetParam()) && mesh::order(shape()) == 2;
  EXPECT_NEAR(report.balance.conditions[0].heat, taken, (lumped_quadratic ? 0.4 : 2e-3) * std::abs(taken));
}

TEST_P(Places, WhatOneProcessCannotEvaluateEveryProcessReports) {
  const mesh::Mesh mesh = this->mesh();
  heat::ThermalConditions conditions;
  conditions.sources = {{"source", "block", placed([](const Position& x, double) {
                           if (x[0] > 0.17) throw InputError({"case.toml", 3, 0}, "no value");
                           return 1.0;
                         })}};
  heat::ThermalPhase phase(mesh, kind(), {solid_metal()}, conditions, options());
  heat::ThermalState end;
  const heat::ThermalState start = phase.states().initial(std::array{400.0});
  EXPECT_THROW(phase.solve(start, end, 1, 1), InputError);
}

INSTANTIATE_TEST_SUITE_P(, Places,
                         ::testing::Combine(::testing::Values(Shape::tri3, Shape::tri6, Shape::quad4,
                                                              Shape::quad8, Shape::tet4, Shape::tet10,
                                                              Shape::hex8, Shape::hex20),
                                            ::testing::Bool()),
                         [](const auto& each) {
                           return std::string(mesh::name(std::get<0>(each.param))) +
                                  (std::get<1>(each.param) ? "_closed" : "_open");
                         });

}  // namespace
}  // namespace solidus
