/// Radiation between surfaces: closed forms of what they exchange, and its balance.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "block.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using heat::Radiation;
using heat::ThermalConditions;
using mesh::Shape;

constexpr double k_sigma = 5.670374419e-8, k_pi = std::numbers::pi;

/// Two blocks, one above the other with a gap between them, put where `map` says.
mesh::Mesh two_blocks(const mesh::TwoBlocks& blocks, Shape shape,
                      const std::function<mesh::Point(mesh::Point)>& map = {}) {
  mesh::RawMesh raw;
  if (test::rank() == 0) {
    raw = mesh::make_two_blocks(blocks, shape);
    if (map)
      for (mesh::Point& x : raw.x) x = map(x);
    mesh::validate_and_orient(raw, "blocks");
  }
  return mesh::distribute(raw, {"lower", "upper"}, {});
}

material::Material conductor(double conductivity) {
  material::Material m = test::metal(10);
  m.phase_changes.clear();
  m.conductivity = Table(conductivity);
  return m;
}

Radiation enclosed(const std::string& surface, double emissivity, double ambient = 300) {
  return {"radiation_" + surface, surface, {PlaceFunction(emissivity)}, ambient, 1.0, true};
}

/// Balls and cylinders within others, held at 1000 and 500 K on their far sides: between grey surfaces with
///
///   Q = A_1 σ (Θ_1⁴ − Θ_2⁴)/(1/ε_1 + A_1/A_2 (1/ε_2 − 1))
///
/// The bodies conduct so well that the surfaces have the temperatures of the far sides.
TEST(Enclosure, ExchangesBetweenRoundBodiesWhatClosedFormsSay) {
  struct Case {
    AnalysisKind kind;
    double area_1, ratio;
  };
  for (const Case& c : {Case{AnalysisKind::axisymmetric, 4 * k_pi * 0.01, 0.25},
                        Case{AnalysisKind::plane_strain, 2 * k_pi * 0.1, 0.5}}) {
    const bool ball = c.kind == AnalysisKind::axisymmetric;
    // Along the first axis once about the middle (half of it for a ball), radius along the second.
    const mesh::TwoBlocks rings{{1, 0.05}, {1, 0.05}, {ball ? 24 : 48, 2}, {ball ? 24 : 48, 2}, 0.1};
    const mesh::Mesh mesh = two_blocks(rings, Shape::quad4, [&](mesh::Point x) {
      const double r = 0.05 + x[1], t = (ball ? k_pi : 2 * k_pi) * x[0];
      return ball ? mesh::Point{r * std::abs(std::sin(t)) * (x[0] == 0 || x[0] == 1 ? 0 : 1), r * std::cos(t),
                                0}
                  : mesh::Point{r * std::sin(t), r * std::cos(t), 0};
    });
    ThermalConditions conditions;
    conditions.temperatures = {{"hot", "lower_y_min", 1000.0}, {"cold", "upper_y_max", 500.0}};
    conditions.radiations = {enclosed("lower_top", 0.8), enclosed("upper_bottom", 0.3)};
    heat::ThermalPhase phase(mesh, c.kind, {conductor(1e7), conductor(1e7)}, conditions);
    heat::ThermalState end;
    const heat::ThermalReport report =
        phase.solve_steady(phase.states().initial(std::array{1000.0, 500.0}), end, 0);
    const double q =
        c.area_1 * k_sigma * (std::pow(1000.0, 4) - std::pow(500.0, 4)) / (1 / 0.8 + c.ratio * (1 / 0.3 - 1));
    double taken = 0;
    for (const heat::ConditionHeat& condition : report.balance.conditions) {
      if (condition.name == "radiation_upper_bottom") EXPECT_NEAR(condition.heat / q, 1, 5e-3) << ball;
      if (condition.name.starts_with("radiation")) taken += condition.heat;
    }
    // Nothing is lost between them.
    EXPECT_NEAR(taken / q, 0, 1e-8);
  }
}

/// Squares of 0.1 m face to face at 0.1 m, black and grey, open at the sides: two clusters would exchange
///
///   [1 − (1 − ε) F/…]: with one view factor F and the open part at Θ_∞ the radiosities of
///   J_1 = ε σΘ_1⁴ + (1 − ε)(F J_2 + (1 − F) σΘ_∞⁴)
///
/// hold in the mean; the radiosity varies over the squares, which these formulas leave out: 1 %.
TEST(Enclosure, OfTwoSquaresIsOpenAtTheSides) {
  constexpr double k_view = 0.19982;
  for (const double e : {1.0, 0.5}) {
    const mesh::TwoBlocks plates{{0.1, 0.1, 0.01}, {0.1, 0.1, 0.01}, {6, 6, 1}, {6, 6, 1}, 0.1};
    const mesh::Mesh mesh = two_blocks(plates, Shape::hex8);
    ThermalConditions conditions;
    conditions.temperatures = {{"hot", "lower_z_min", 1200.0}, {"cold", "upper_z_max", 600.0}};
    conditions.radiations = {enclosed("lower_top", e, 300), enclosed("upper_bottom", e, 300)};
    heat::ThermalPhase phase(mesh, AnalysisKind::solid, {conductor(1e7), conductor(1e7)}, conditions);
    heat::ThermalState end;
    const heat::ThermalReport report =
        phase.solve_steady(phase.states().initial(std::array{1200.0, 600.0}), end, 0);
    const double m1 = k_sigma * std::pow(1200.0, 4), m2 = k_sigma * std::pow(600.0, 4),
                 room = k_sigma * std::pow(300.0, 4);
    // J of both by their two equations.
    double j1 = m1, j2 = m2;
    for (int i = 0; i < 100; ++i) {
      j1 = e * m1 + (1 - e) * (k_view * j2 + (1 - k_view) * room);
      j2 = e * m2 + (1 - e) * (k_view * j1 + (1 - k_view) * room);
    }
    const double q1 = 0.01 * e * (k_view * j2 + (1 - k_view) * room - m1),
                 q2 = 0.01 * e * (k_view * j1 + (1 - k_view) * room - m2);
    for (const heat::ConditionHeat& condition : report.balance.conditions) {
      if (condition.name == "radiation_lower_top") EXPECT_NEAR(condition.heat / q1, 1, 2e-3) << e;
      if (condition.name == "radiation_upper_bottom") EXPECT_NEAR(condition.heat / q2, 1, 1e-2) << e;
    }
  }
}

/// A closed shell of two halves with nothing outside: its heat stays to rounding in every step, one-stage and
/// two-stage, while it evens out; emissivities follow temperature.
TEST(Enclosure, KeepsTheHeatOfAClosedCavityInEveryStep) {
  const mesh::TwoBlocks rings{{1, 0.01}, {1, 0.01}, {24, 1}, {32, 1}, 0.03};
  const mesh::Mesh mesh = two_blocks(rings, Shape::quad4, [&](mesh::Point x) {
    const double r = 0.05 + x[1], t = 2 * k_pi * x[0];
    return mesh::Point{r * std::sin(t), r * std::cos(t), 0};
  });
  ThermalConditions conditions;
  conditions.radiations = {enclosed("lower_top", 0.8), enclosed("upper_bottom", 0.5)};
  conditions.radiations[0].emissivity = {
      PlaceFunction(Table(std::vector{500.0, 1500.0}, std::vector{0.9, 0.4})), true};
  for (const heat::ThermalStepping stepping :
       {heat::ThermalStepping::backward_euler, heat::ThermalStepping::sdirk2}) {
    heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {conductor(30), conductor(30)}, conditions);
    heat::ThermalState state = phase.states().initial(std::array{1400.0, 600.0});
    const double start = phase.states().enthalpy(state);
    double before = 800, time = 0;
    for (int i = 0; i < 12; ++i) {
      const double dt = i < 6 ? 5 : 60;
      time += dt;
      const heat::ThermalReport report =
          phase.solve(state, state, {.time = time, .dt = dt, .stepping = stepping});
      EXPECT_NEAR(report.balance.stored / report.balance.exchanged, 0, 1e-10);
      double sum = 0;
      for (const heat::ConditionHeat& condition : report.balance.conditions) sum += condition.heat;
      EXPECT_NEAR(sum / report.balance.exchanged, 0, 1e-10);
      const double apart =
          phase.states().mean_temperature(state, 0) - phase.states().mean_temperature(state, 1);
      EXPECT_LT(apart, before);
      EXPECT_GT(apart, -0.1);
      before = apart;
    }
    EXPECT_NEAR(phase.states().enthalpy(state) / start, 1, 1e-12);
    EXPECT_LT(before, 150);
  }
}

/// A body that nothing of the enclosure sees but its opening cools as with one ambient temperature.
TEST(Enclosure, OfAConvexBodyIsItsSurroundings) {
  const mesh::Mesh mesh = test::block_mesh(Shape::hex8, {0.1, 0.1, 0.1}, {3, 3, 3});
  std::array<std::vector<double>, 2> results;
  for (const bool sees : {false, true}) {
    ThermalConditions conditions;
    for (const char* side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}) {
      conditions.radiations.push_back(enclosed(side, 0.7));
      conditions.radiations.back().enclosed = sees;
    }
    heat::ThermalPhase phase(mesh, AnalysisKind::solid, {conductor(50)}, conditions);
    heat::ThermalState state = phase.states().initial(std::array{1300.0});
    for (int i = 1; i <= 4; ++i)
      phase.solve(state, state, {.time = 20.0 * i, .dt = 20, .stepping = heat::ThermalStepping::sdirk2});
    results[sees ? 1 : 0] = state.temperature;
  }
  for (std::size_t i = 0; i < results[0].size(); ++i) EXPECT_NEAR(results[0][i], results[1][i], 1e-5);
}

TEST(Enclosure, NeedsTheClosedRule) {
  const mesh::Mesh mesh = test::block_mesh(Shape::hex8, {0.1, 0.1, 0.1}, {1, 1, 1});
  ThermalConditions conditions;
  conditions.radiations = {enclosed("z_max", 0.7)};
  heat::HeatOptions open;
  open.integration = heat::HeatIntegration::open;
  EXPECT_THROW(heat::ThermalPhase(mesh, AnalysisKind::solid, {conductor(50)}, conditions, open), InputError);
}

}  // namespace
}  // namespace solidus
