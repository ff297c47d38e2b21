/// Freezing told from temperatures that are known: times, gradient, cooling rate and what follows from them.
#include "criteria/freezing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"

namespace solidus {
namespace {

using test::Casting;

constexpr double k_rounding = 1e-9;

// T = 910 + g·x − r t, a plane front through a block.
class LinearCooling : public testing::TestWithParam<mesh::Shape> {};

TEST_P(LinearCooling, GivesTimesGradientAndRateExactly) {
  const bool solid = mesh::dimension(GetParam()) == 3;
  Casting casting(test::block_mesh(GetParam(), solid ? std::vector{0.1, 0.1, 0.1} : std::vector{0.1, 0.1},
                                   solid ? std::vector{3, 3, 3} : std::vector{4, 4}),
                  40);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  const mesh::Point g{100, 50, solid ? 20.0 : 0.0};
  const double rate = 2, slope = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  const auto above = [&](const mesh::Point& x) { return 910 + g[0] * x[0] + g[1] * x[1] + g[2] * x[2]; };
  const auto at = [&](double t) { return [=](const mesh::Point& x) { return above(x) - rate * t; }; };
  casting.start(freezing, 0, at(0));
  for (const double t : {1.0, 7.0, 9.5, 14.0, 21.0, 22.5, 31.0, 40.0}) casting.step(freezing, t, at(t));
  auto fields = casting.fields(freezing);
  const double freezing_time = 40 / rate, ny = slope / std::sqrt(rate), spacing = 10e-6 * std::sqrt(20.0);
  const double beta = 0.05 / 0.95, number = spacing * ny * std::sqrt(1e5 / (1e-3 * beta * 40));
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i) {
    EXPECT_NEAR(fields["solidified_at"][i], (above(casting.mesh.x[i]) - 860) / rate, k_rounding);
    EXPECT_NEAR(fields["local_solidification_time"][i], freezing_time, k_rounding);
    EXPECT_NEAR(fields["cooling_rate"][i], rate, k_rounding);
    EXPECT_NEAR(fields["thermal_gradient"][i], slope, slope * k_rounding);
    EXPECT_NEAR(fields["front_speed"][i], rate / slope, k_rounding);
    EXPECT_NEAR(fields["secondary_arm_spacing"][i], spacing, spacing * k_rounding);
    EXPECT_NEAR(fields["niyama"][i], ny, ny * k_rounding);
    EXPECT_NEAR(fields["dimensionless_niyama"][i], number, number * k_rounding);
    EXPECT_GT(fields["shrinkage_porosity"][i], 0);
    EXPECT_LT(fields["shrinkage_porosity"][i], 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Freezing, LinearCooling,
                         testing::Values(mesh::Shape::tri3, mesh::Shape::tri6, mesh::Shape::quad4,
                                         mesh::Shape::tet4, mesh::Shape::hex8),
                         [](const auto& i) { return std::string(mesh::name(i.param)); });

TEST(Freezing, OfAPureMetalHasTheGradientBehindTheFrontAndTheSpeedOfItsArrival) {
  Casting casting(test::block_mesh(mesh::Shape::tri3, {0.1, 0.02}, {20, 4}), 0);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  // Solid with the slope g behind a front that moves with v, melt at 900 K before it.
  const double g = 2000, v = 1e-3;
  const auto at = [&](double t) {
    return [=](const mesh::Point& x) { return x[0] < v * t ? 900 + g * (x[0] - v * t) : 900.01; };
  };
  casting.start(freezing, 0, at(0));
  constexpr double k_step = 0.5;  // ten steps an element
  for (int i = 1; i <= 220; ++i) casting.step(freezing, i * k_step, at(i * k_step));
  auto fields = casting.fields(freezing);
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i) {
    // A time is known to the step, over an element of five seconds: speeds to a tenth.
    EXPECT_NEAR(fields["thermal_gradient"][i], g, 0.1 * g);
    EXPECT_NEAR(fields["front_speed"][i], v, 0.1 * v);
    EXPECT_NEAR(fields["cooling_rate"][i], g * v, 0.2 * g * v);
    EXPECT_NEAR(fields["niyama"][i], std::sqrt(g / v), 0.1 * std::sqrt(g / v));
    EXPECT_EQ(fields["dimensionless_niyama"][i], 0);  // no freezing range
    for (const auto& [name, values] : fields) EXPECT_TRUE(std::isfinite(values[i])) << name;
  }
}

TEST(Freezing, OfAnIsothermalChangeIsTimedByTheHeatContent) {
  Casting casting(test::block_mesh(mesh::Shape::quad4, {0.1, 0.1}, {2, 2}), 0);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  // Latent heat 2e8 J/m³; the heat falls by 1e7 W/m³ from 2.5e8: melt to 5 s, solid from 25 s on.
  const auto at = [](double t) { return [=](const mesh::Point&) { return 2.5e8 - 1e7 * t; }; };
  casting.start_heat(freezing, 0, at(0));
  for (const double t : {2.0, 9.0, 17.0, 40.0}) casting.step_heat(freezing, t, at(t));
  auto fields = casting.fields(freezing);
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i) {
    EXPECT_NEAR(fields["solidified_at"][i], 25, 1e-6);
    EXPECT_NEAR(fields["local_solidification_time"][i], 20, 1e-6);
    for (const auto& [name, values] : fields) EXPECT_TRUE(std::isfinite(values[i])) << name;
  }
}

// Lists of the elements around nodes, 95 bytes a node of tetrahedra, live within a step alone.
TEST(Freezing, KeepsNoListsOfElementsBetweenSteps) {
  Casting casting(test::block_mesh(mesh::Shape::tet4, {0.1, 0.1, 0.1}, {8, 8, 8}), 40);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  const auto at = [](double t) { return [=](const mesh::Point& x) { return 910 + 200 * x[0] - 10 * t; }; };
  casting.start(freezing, 0, at(0));
  for (const double t : {1.0, 3.0, 5.0}) casting.step(freezing, t, at(t));
  EXPECT_LE(freezing.bytes(), 10 * casting.mesh.x.size());
}

TEST(Freezing, SaysNothingOfWhatHasNotFrozenAndForgetsWhatMeltsAgain) {
  Casting casting(test::block_mesh(mesh::Shape::quad4, {0.1, 0.1}, {2, 2}), 40);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  const auto uniform = [](double t) { return [=](const mesh::Point&) { return t; }; };
  const auto everywhere = [&](const char* field, double value) {
    const std::vector<double> values = casting.fields(freezing)[field];
    for (const double v : values) EXPECT_NEAR(v, value, k_rounding) << field;
  };
  casting.start(freezing, 0, uniform(950));
  casting.step(freezing, 10, uniform(870));
  everywhere("solidified_at", -1);
  everywhere("local_solidification_time", 0);
  casting.step(freezing, 20, uniform(850));
  everywhere("solidified_at", 15);
  everywhere("local_solidification_time", 15 - 6.25);
  everywhere("niyama", 0);  // no gradient
  casting.step(freezing, 30, uniform(880));
  everywhere("solidified_at", -1);
  casting.step(freezing, 40, uniform(840));
  everywhere("solidified_at", 35);
  everywhere("local_solidification_time", 5);  // since it melted
  casting.step(freezing, 50, uniform(950));
  casting.step(freezing, 60, uniform(850));
  everywhere("local_solidification_time", 4);
}

// T_e = 864 K: at 862 K the fraction is 0.95, which is not what gradient and rate are about.
TEST(Freezing, KeepsWhatAPartialRemeltDoesNotReach) {
  Casting casting(test::block_mesh(mesh::Shape::quad4, {0.1, 0.1}, {4, 4}), 40);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  // 1000 K/m
  const auto graded = [](double t) { return [=](const mesh::Point& x) { return t + 1000 * x[0]; }; };
  const auto uniform = [](double t) { return [=](const mesh::Point&) { return t; }; };
  casting.start(freezing, 0, graded(920));
  for (int i = 1; i <= 20; ++i) casting.step(freezing, 10.0 * i, graded(920 - 10 * i));
  const auto once = casting.fields(freezing);
  EXPECT_GT(once.at("niyama").front(), 0);
  casting.step(freezing, 210, uniform(850));
  casting.step(freezing, 1000, uniform(862));
  const auto between = casting.fields(freezing);
  for (const double v : between.at("solidified_at")) EXPECT_EQ(v, -1);
  casting.step(freezing, 1010, uniform(859));
  const auto twice = casting.fields(freezing);
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i) {
    for (const char* kept : {"niyama", "thermal_gradient", "cooling_rate", "front_speed"})
      EXPECT_NEAR(twice.at(kept)[i], once.at(kept)[i], 1e-9 * once.at(kept)[i]) << kept;
    const double more = 10.0 * 2 / 3;  // from 862 K at 1000 s to 860 K
    EXPECT_NEAR(twice.at("solidified_at")[i], 1000 + more, 1e-6);
    EXPECT_NEAR(twice.at("local_solidification_time")[i], once.at("local_solidification_time")[i] + more,
                1e-6);
  }
}

TEST(Freezing, NamesTheLastNodeThatFroze) {
  Casting casting(test::block_mesh(mesh::Shape::quad4, {0.1, 0.1}, {4, 4}), 40);
  criteria::Freezing freezing(casting.mesh, casting.kind, casting.storage);
  const auto at = [](double t) {
    return [=](const mesh::Point& x) { return 910 + 100 * x[0] + 70 * x[1] - t; };
  };
  casting.start(freezing, 0, at(0));
  for (int t = 5; t <= 100; t += 5) casting.step(freezing, t, at(t));
  bool found = false;
  for (const criteria::CriterionResult& finding : freezing.findings(casting.record)) {
    if (finding.name != "solidified_at_max") continue;
    found = true;
    EXPECT_NEAR(finding.value, 67, k_rounding);
    EXPECT_NEAR(finding.where[0], 0.1, k_rounding);
    EXPECT_NEAR(finding.where[1], 0.1, k_rounding);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace solidus
