/// Cooling channels as lines: the heat that they take from any mesh, the way of their fluid, and its
/// properties.
#include "heat/channels/channels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "block.hpp"
#include "heat/loads/channel_film.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

constexpr double k_pi = std::numbers::pi;

/// ln r around an axis along z, as the temperature around a channel that takes q' from conductivity k.
class Logarithm final : public PlaceLaw {
 public:
  Logarithm(Position axis, double wall, double q, double k, double radius)
      : axis_(axis), wall_(wall), slope_(q / (2 * k_pi * k)), radius_(radius) {}
  void values(std::span<const Position> x, double, std::span<double> values) const override {
    for (std::size_t i = 0; i < x.size(); ++i)
      values[i] = wall_ + slope_ * std::log(std::hypot(x[i][0] - axis_[0], x[i][1] - axis_[1]) / radius_);
  }
  bool uses_time() const override { return false; }

 private:
  Position axis_;
  double wall_, slope_, radius_;
};

/// A fluid of round numbers, so fast that it does not warm up.
heat::Channel straight_channel(double diameter, std::vector<Position> path) {
  heat::Channel c;
  c.name = "water";
  c.body = "block";
  c.path = std::move(path);
  c.diameter = diameter;
  c.flow = 1e3;
  c.inlet = 300.0;
  c.fluid = {Table(1000.0), Table(4000.0), Table(0.6), Table(1e9)};  // laminar
  c.laminar = 100;
  return c;
}

material::Material steel() {
  material::Material m = test::metal(10);
  m.conductivity = Table(30.0);
  m.phase_changes.clear();
  return m;
}

struct Square {
  mesh::Shape shape;
  int divisions;
  double diameter;
  double most;  ///< error of the heat
};

class ChannelInASquare : public ::testing::TestWithParam<Square> {};

/// A bore through a square of 80 mm, off its middle and off the nodes; the exact field is prescribed at its
/// rim. The resistance of the film is as large as that of the metal.
TEST_P(ChannelInASquare, TakesTheHeatOfTheExactField) {
  const auto [shape, n, diameter, most] = GetParam();
  const bool solid = mesh::dimension(shape) == 3;
  const double thickness = 0.08 / n * 2;
  const mesh::Mesh mesh = solid ? test::block_mesh(shape, {0.08, 0.08, thickness}, {n, n, 2})
                                : test::block_mesh(shape, {0.08, 0.08}, {n, n});
  const Position axis{0.0411, 0.0383, 0};
  heat::Channel channel = straight_channel(diameter, {axis});
  if (solid) channel.path = {{axis[0], axis[1], 0}, {axis[0], axis[1], thickness}};
  const double film = channel.laminar * 0.6 / diameter, q = 1e4, k = 30;
  const double wall = 300 + q / (film * k_pi * diameter);
  heat::ThermalConditions conditions;
  conditions.channels = {channel};
  const PlaceFunction exact(std::make_shared<Logarithm>(axis, wall, q, k, 0.5 * diameter));
  for (const char* side : {"x_min", "x_max", "y_min", "y_max"})
    conditions.temperatures.push_back({side, side, exact});
  heat::ThermalPhase phase(mesh, solid ? AnalysisKind::solid : AnalysisKind::plane_strain, {steel()},
                           conditions);
  heat::ThermalState end;
  const heat::ThermalReport report = phase.solve_steady(phase.states().initial(std::array{400.0}), end, 0);
  ASSERT_EQ(report.channels.size(), 1U);
  const double length = solid ? thickness : 1.0;
  EXPECT_NEAR(report.channels[0].heat / (q * length), 1, most);
  EXPECT_NEAR(report.channels[0].wall - 300, wall - 300, most * (wall - 300));
  EXPECT_TRUE(report.channels[0].found);
  // What the fluid took up is what came from the rim.
  double from_rim = 0, from_channel = 0;
  for (const heat::ConditionHeat& c : report.balance.conditions)
    (c.name == "water" ? from_channel : from_rim) += c.heat;
  EXPECT_NEAR(report.channels[0].heat, -from_channel, 1e-8 * q * length);
  EXPECT_NEAR(report.channels[0].heat, from_rim, 1e-8 * q * length);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, ChannelInASquare,
    ::testing::Values(
        Square{mesh::Shape::quad4, 10, 0.008, 0.005}, Square{mesh::Shape::quad4, 10, 0.002, 0.005},
        Square{mesh::Shape::quad4, 40, 0.008, 0.005}, Square{mesh::Shape::tri3, 10, 0.008, 0.005},
        Square{mesh::Shape::tri3, 20, 0.008, 0.005}, Square{mesh::Shape::tri3, 40, 0.012, 0.005},
        Square{mesh::Shape::tri6, 10, 0.008, 0.005}, Square{mesh::Shape::quad8, 10, 0.008, 0.005},
        Square{mesh::Shape::hex8, 10, 0.008, 0.005}, Square{mesh::Shape::hex8, 30, 0.008, 0.005},
        Square{mesh::Shape::tet4, 10, 0.008, 0.005}, Square{mesh::Shape::tet4, 30, 0.008, 0.005},
        Square{mesh::Shape::tet10, 10, 0.008, 0.005}));

/// A long channel in a block of one temperature: the fluid comes to it exponentially.
TEST(Channels, FluidWarmsUpAlongItsWay) {
  const mesh::Mesh mesh = test::block_mesh(mesh::Shape::hex8, {0.4, 0.04, 0.04}, {40, 4, 4});
  heat::Channel channel = straight_channel(0.01, {{0, 0.021, 0.019}, {0.4, 0.021, 0.019}});
  channel.laminar = 4.36;
  channel.flow = 0.005;
  material::Material metal = steel();
  metal.conductivity = Table(1e7);
  heat::ThermalConditions conditions;
  conditions.channels = {channel};
  for (const char* side : {"y_min", "y_max", "z_min", "z_max"})
    conditions.temperatures.push_back({side, side, 400.0});
  heat::ThermalPhase phase(mesh, AnalysisKind::solid, {metal}, conditions);
  heat::ThermalState end;
  const heat::ThermalReport report = phase.solve_steady(phase.states().initial(std::array{400.0}), end, 0);
  const double units = 4.36 * 0.6 * k_pi * 0.4 / (0.005 * 4000);
  EXPECT_NEAR(report.channels[0].outlet, 400 - 100 * std::exp(-units), 0.01);
  EXPECT_NEAR(report.channels[0].heat, 0.005 * 4000 * (report.channels[0].outlet - 300), 1e-9);
  EXPECT_NEAR(report.channels[0].film, 4.36 * 0.6 / 0.01, 1e-9);
}

/// One channel cut in two that follow each other is the channel: in a block that cools, step after step.
TEST(Channels, OutletOfOneFeedsTheNext) {
  const mesh::Mesh mesh = test::block_mesh(mesh::Shape::hex8, {0.2, 0.04, 0.04}, {20, 4, 4});
  const auto cooled = [&](std::vector<heat::Channel> channels) {
    heat::ThermalConditions conditions;
    conditions.channels = std::move(channels);
    heat::ThermalPhase phase(mesh, AnalysisKind::solid, {steel()}, conditions);
    heat::ThermalState state = phase.states().initial(std::array{500.0});
    double taken = 0, outlet = 0, defect = 0;
    for (int step = 1; step <= 5; ++step) {
      const heat::ThermalReport report =
          phase.solve(state, state, {.time = 2.0 * step, .dt = 2, .stepping = heat::ThermalStepping::sdirk2});
      for (const heat::ChannelReading& r : report.channels) taken += r.heat;
      outlet = report.channels.back().outlet;
      defect += std::abs(report.balance.defect());
      double out = 0, up = 0;
      for (const heat::ConditionHeat& c : report.balance.conditions) out += c.heat;
      for (const heat::ChannelReading& r : report.channels) up += r.heat;
      EXPECT_NEAR(up, -out, 1e-10 * up);
    }
    EXPECT_LT(defect, 1e-9 * taken);
    return std::pair(taken, outlet);
  };
  heat::Channel whole = straight_channel(0.01, {{0, 0.021, 0.019}, {0.2, 0.021, 0.019}});
  whole.flow = 0.02;
  heat::Channel first = whole, second = whole;
  first.path[1][0] = second.path[0][0] = 0.1;
  second.name = "more";
  second.after = "water";
  const auto [taken, outlet] = cooled({whole});
  const auto [in_two, outlet_of_two] = cooled({first, second});
  EXPECT_GT(outlet, 330);
  EXPECT_NEAR(in_two, taken, 2e-3 * taken);
  EXPECT_NEAR(outlet_of_two, outlet, 2e-3 * (outlet - 300));
}

/// A half of the block with the middle of the channel in its plane of symmetry gives half of the heat.
TEST(Channels, InAPlaneOfSymmetryAreHalf) {
  const auto taken = [&](double height, std::vector<int> divisions, double share) {
    const mesh::Mesh mesh = test::block_mesh(mesh::Shape::hex8, {0.1, 0.04, height}, std::move(divisions));
    heat::Channel channel = straight_channel(0.01, {{0, 0.021, 0.02}, {0.1, 0.021, 0.02}});
    channel.flow = 0.01;
    channel.share = share;
    heat::ThermalConditions conditions;
    conditions.channels = {channel};
    conditions.temperatures = {{"top", "z_min", 500.0}};
    if (share == 1) conditions.temperatures.push_back({"bottom", "z_max", 500.0});
    heat::ThermalPhase phase(mesh, AnalysisKind::solid, {steel()}, conditions);
    heat::ThermalState end;
    return phase.solve_steady(phase.states().initial(std::array{400.0}), end, 0).channels[0];
  };
  const heat::ChannelReading whole = taken(0.04, {10, 6, 8}, 1), half = taken(0.02, {10, 6, 4}, 0.5);
  EXPECT_NEAR(half.heat, 0.5 * whole.heat, 1e-3 * whole.heat);
  EXPECT_NEAR(half.outlet, whole.outlet, 1e-3 * (whole.outlet - 300));
}

/// A ring around the axis, of which the length counts; without flow nothing is exchanged.
TEST(Channels, OfRevolutionAreRingsAndStandingWaterTakesNothing) {
  const mesh::Mesh mesh = test::block_mesh(mesh::Shape::quad4, {0.05, 0.05}, {10, 10}, [](mesh::Point x) {
    return mesh::Point{x[0] + 1, x[1], 0};
  });
  heat::Channel ring = straight_channel(0.01, {{1.026, 0.024, 0}});
  material::Material metal = steel();
  metal.conductivity = Table(1e6);
  heat::ThermalConditions conditions;
  conditions.channels = {ring};
  conditions.temperatures = {{"rim", "x_max", 400.0}};
  heat::ThermalPhase phase(mesh, AnalysisKind::axisymmetric, {metal}, conditions);
  heat::ThermalState end;
  const heat::ThermalState start = phase.states().initial(std::array{400.0});
  const double film = 100 * 0.6 / 0.01, area = k_pi * 0.01 * 2 * k_pi * 1.026;
  EXPECT_NEAR(phase.solve_steady(start, end, 0).channels[0].heat / (film * area * 100), 1, 2e-3);
  conditions.channels[0].flow = 0.0;
  phase.set_conditions(conditions);
  const heat::ThermalReport stands = phase.solve(start, end, 1.0, 1.0);
  EXPECT_EQ(stands.channels[0].heat, 0);
  EXPECT_FALSE(stands.channels[0].found);
  EXPECT_EQ(stands.channels[0].reynolds, 0);
}

/// Values of textbooks: Incropera and others, Fundamentals of Heat and Mass Transfer, table A.6 for water at
/// 300 K, and IAPWS R7-97, table 36, for the boiling point.
TEST(ChannelFluid, WaterHasItsPublishedProperties) {
  const heat::ChannelFluid& water = heat::water();
  EXPECT_NEAR(water.density.value(300), 1 / 1.003e-3, 1);
  EXPECT_NEAR(water.specific_heat.value(300), 4179, 5);
  EXPECT_NEAR(water.viscosity.value(300), 855e-6, 15e-6);
  EXPECT_NEAR(water.conductivity.value(300), 0.613, 0.005);
  EXPECT_NEAR(water.prandtl(373.15), 1.76, 0.03);
  EXPECT_NEAR(heat::boiling_point_of_water(0.1e6), 372.755919, 1e-6);
  EXPECT_NEAR(heat::boiling_point_of_water(1e6), 453.035632, 1e-6);
  EXPECT_NEAR(heat::boiling_point_of_water(10e6), 584.149488, 1e-6);
  const double warm = water.heated(290, 4e5);
  EXPECT_NEAR(water.specific_heat.integral(290, warm), 4e5, 1e-6);
}

/// Worked by hand: Re = 50 000 and Pr = 5 have ζ = 0.02099 and Nu = 292.1 by Gnielinski, 251.2 by Dittus and
/// Boelter.
TEST(ChannelFilm, FollowsTheLawsAndIsContinuousBetweenThem) {
  using heat::ChannelLaw;
  EXPECT_NEAR(heat::nusselt(ChannelLaw::dittus_boelter, 3.66, 5e4, 5, true), 251.4, 0.5);
  const double zeta = std::pow(0.79 * std::log(5e4) - 1.64, -2);
  EXPECT_NEAR(zeta, 0.02100, 1e-5 * 5);
  EXPECT_NEAR(heat::nusselt(ChannelLaw::gnielinski, 3.66, 5e4, 5, true),
              zeta / 8 * 49000 * 5 / (1 + 12.7 * std::sqrt(zeta / 8) * (std::pow(5, 2.0 / 3) - 1)), 1e-6);
  for (const ChannelLaw law : {ChannelLaw::dittus_boelter, ChannelLaw::gnielinski}) {
    EXPECT_EQ(heat::nusselt(law, 3.66, 1000, 5, true), 3.66);
    for (const double re : {2300.0, 4000.0, 1e4})
      EXPECT_NEAR(heat::nusselt(law, 3.66, re * (1 - 1e-9), 5, true),
                  heat::nusselt(law, 3.66, re * (1 + 1e-9), 5, true), 1e-4);
  }
  EXPECT_NEAR(heat::reynolds_number(0.1, 0.01, 1e-3), 4 * 0.1 / (k_pi * 1e-5), 1e-9);
}

}  // namespace
}  // namespace solidus
