#include "material/flow_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace solidus::material {
namespace {

/// Three temperatures, uneven strains, one level piece.
FlowCurves sample() {
  return {{0, 0.002, 0.05, 0.3},
          {300, 500, 900},
          {20e6, 30e6, 60e6, 80e6,  //
           15e6, 18e6, 30e6, 30e6,  //
           5e6, 5e6, 6e6, 8e6}};
}

TEST(FlowCurves, AreExactAtTheirPointsAndLinearBetweenThem) {
  const FlowCurves curves = sample();
  EXPECT_DOUBLE_EQ(curves.at(0.05, 300).stress, 40e6);
  EXPECT_DOUBLE_EQ(curves.at(0.05, 500).stress, 15e6);
  EXPECT_DOUBLE_EQ(curves.at(0.05, 900).stress, 1e6);
  EXPECT_DOUBLE_EQ(curves.at(0.05, 400).stress, 0.5 * (40e6 + 15e6));
  EXPECT_DOUBLE_EQ(curves.at(0.175, 300).stress, 50e6);
  EXPECT_DOUBLE_EQ(curves.at(0, 700).stress, 0);
  EXPECT_DOUBLE_EQ(curves.at(0, 700).energy, 0);
}

TEST(FlowCurves, StayLevelBeyondTheLastStrainAndHoldBeyondTheTemperatures) {
  const FlowCurves curves = sample();
  const FlowCurves::Value beyond = curves.at(0.8, 300);
  EXPECT_DOUBLE_EQ(beyond.stress, 60e6);
  EXPECT_EQ(beyond.slope, 0);
  EXPECT_NEAR(beyond.energy, curves.at(0.3, 300).energy + 0.5 * 60e6, 1e-6);
  EXPECT_DOUBLE_EQ(curves.at(0.1, 200).stress, curves.at(0.1, 300).stress);
  EXPECT_DOUBLE_EQ(curves.at(0.1, 2000).stress, curves.at(0.1, 900).stress);
  EXPECT_EQ(curves.at(0.1, 200).stress_theta, 0);
  EXPECT_EQ(curves.at(0.1, 2000).energy_theta, 0);
}

TEST(FlowCurves, TheEnergyIsTheIntegralOfTheStressOverStrain) {
  const FlowCurves curves = sample();
  for (const double theta : {250.0, 300.0, 433.0, 500.0, 899.0, 1000.0})
    for (const double xi : {0.001, 0.002, 0.03, 0.2, 0.3, 0.5}) {
      // The mid-point rule on small pieces; the stress has kinks, so an error of h² slope/8 remains at each.
      const int n = 20000;
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += curves.at((i + 0.5) * xi / n, theta).stress * (xi / n);
      EXPECT_NEAR(curves.at(xi, theta).energy, sum, 1e-6 * sum + 1e-6) << xi << " " << theta;
    }
}

TEST(FlowCurves, DerivativesAreThoseOfDifferences) {
  const FlowCurves curves = sample();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> strain(0.0, 0.4), temperature(280, 1000);
  const double dx = 1e-7, dt = 1e-3;
  for (int trial = 0; trial < 2000; ++trial) {
    const double xi = strain(random), theta = temperature(random);
    const FlowCurves::Value at = curves.at(xi, theta), more = curves.at(xi + dx, theta),
                            hotter = curves.at(xi, theta + dt);
    if (more.slope != at.slope || hotter.stress_theta != at.stress_theta) continue;  // a kink between
    // rounding of values of 1e8 and 1e7 over the difference
    EXPECT_NEAR((more.stress - at.stress) / dx, at.slope, 2.0);
    EXPECT_NEAR((more.energy - at.energy) / dx, at.stress + 0.5 * dx * at.slope, 1.0);
    EXPECT_NEAR((hotter.stress - at.stress) / dt, at.stress_theta, 1e-3);
    EXPECT_NEAR((hotter.energy - at.energy) / dt, at.energy_theta, 1e-3);
  }
}

TEST(FlowCurves, AtAPointTheSlopeIsThatOfThePieceOnTheRight) {
  const FlowCurves curves = sample();
  EXPECT_DOUBLE_EQ(curves.at(0, 300).slope, 10e6 / 0.002);
  EXPECT_DOUBLE_EQ(curves.at(0.002, 300).slope, 30e6 / 0.048);
  EXPECT_EQ(curves.at(0.3, 300).slope, 0);
  EXPECT_DOUBLE_EQ(curves.at(0.3, 500).stress_theta, (3e6 - 15e6) / 400);
  EXPECT_DOUBLE_EQ(curves.at(0.3, 900).stress_theta, (3e6 - 15e6) / 400) << "the left one at the last";
}

TEST(FlowCurves, EveryIntervalIsFoundHoweverUnevenThePoints) {
  const std::vector<double> strains = {0, 1e-9, 2e-9, 0.001, 0.5, 0.50001, 1, 1000};
  std::vector<double> stresses;
  for (std::size_t i = 0; i < strains.size(); ++i) stresses.push_back(1e6 * static_cast<double>(i * i));
  const FlowCurves curves(strains, {300}, stresses);
  for (std::size_t i = 0; i + 1 < strains.size(); ++i)
    for (const double t : {0.0, 0.25, 0.999}) {
      const double xi = strains[i] + t * (strains[i + 1] - strains[i]);
      EXPECT_NEAR(curves.at(xi, 300).stress, stresses[i] + t * (stresses[i + 1] - stresses[i]),
                  1e-6 * stresses.back())
          << xi;
    }
}

TEST(FlowCurves, CurvesWithStrainsOfTheirOwnAreMergedExactly) {
  const FlowCurve cold{300, {0, 0.1, 0.3}, {20e6, 50e6, 60e6}},
      hot{600, {0, 0.04, 0.2, 0.5}, {8e6, 9e6, 11e6, 12e6}}, one_point{800, {0}, {3e6}};
  const FlowCurves curves = FlowCurves::merged({hot, one_point, cold});
  EXPECT_EQ(curves.temperatures().size(), 3u);
  EXPECT_EQ(curves.strains().size(), 6u);
  const auto along = [](const FlowCurve& curve, double xi) {
    for (std::size_t i = 1; i < curve.strains.size(); ++i)
      if (xi <= curve.strains[i])
        return curve.stresses[i - 1] + (curve.stresses[i] - curve.stresses[i - 1]) *
                                           (xi - curve.strains[i - 1]) /
                                           (curve.strains[i] - curve.strains[i - 1]);
    return curve.stresses.back();
  };
  for (double xi = 0; xi < 0.7; xi += 0.0037) {
    const auto risen = [&](const FlowCurve& curve) { return along(curve, xi) - curve.stresses[0]; };
    EXPECT_NEAR(curves.at(xi, 300).stress, risen(cold), 1e-6);  // 60 MPa rounded
    EXPECT_NEAR(curves.at(xi, 600).stress, risen(hot), 1e-6);
    EXPECT_NEAR(curves.at(xi, 375).stress, 0.75 * risen(cold) + 0.25 * risen(hot), 1e-6);
    EXPECT_NEAR(curves.at(xi, 800).stress, 0, 1e-6);
  }
}

TEST(FlowCurves, RefuseWhatIsNoFlowCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto made = [](std::vector<double> strains, std::vector<double> temperatures,
                       std::vector<double> stresses) {
    return FlowCurves(std::move(strains), std::move(temperatures), std::move(stresses));
  };
  EXPECT_THROW(made({}, {300}, {}), std::invalid_argument);
  EXPECT_THROW(made({0}, {}, {}), std::invalid_argument);
  EXPECT_THROW(made({0, 0.1}, {300}, {1}), std::invalid_argument);
  EXPECT_THROW(made({0.01, 0.1}, {300}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(made({0, 0}, {300}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(made({0, 0.1}, {400, 300}, {1, 2, 1, 2}), std::invalid_argument);
  EXPECT_THROW(made({0, 0.1}, {300}, {2, 1}), std::invalid_argument);
  EXPECT_THROW(made({0, 0.1}, {300}, {-2, 1}), std::invalid_argument);
  EXPECT_THROW(made({0, 0.1}, {300}, {2, nan}), std::invalid_argument);
  EXPECT_THROW(FlowCurves::merged({{300, {0}, {1}}, {300, {0}, {2}}}), std::invalid_argument);
  EXPECT_THROW(FlowCurves::merged({{300, {0, 0.1}, {1}}}), std::invalid_argument);
  EXPECT_THROW(FlowCurves::merged({{300, {0.1}, {1}}}), std::invalid_argument);
  EXPECT_THROW(FlowCurves::merged({}), std::invalid_argument);
}

}  // namespace
}  // namespace solidus::material
