/// The fits of 3.47 and 3.48 against the model they are fits of: two surfaces whose sum of heights is
/// Gaussian with the deviation σ and the mean slope m, pressed until the planes of their means are Y apart;
/// asperities yield under the contact hardness H (Cooper, Mikić and Yovanovich 1969; Yovanovich 1981).
///
///   t_N/H = ½ erfc λ,  λ = Y/(√2 σ)            the true area is the overlapped one
///   h_S σ/(k̄ m) = exp(−λ²)/(2 √(2π)) / (1 − √(t_N/H))^1.5
///   a = √(8/π) σ/m exp(λ²) erfc λ              mean radius of the spots
///
/// A hardness that depends on the size of indentations, H_v = c_1 (d/1 µm)^c_2, is that of the square of the
/// spots' area, d = √(2π) a = 4 σ/m exp(λ²) erfc λ (Song and Yovanovich 1987).
#include "contact/interface/asperities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace solidus::contact {
namespace {

using std::numbers::pi;

// λ of t_N/H = ½ erfc λ by bisection.
double separation_of(double relative_pressure) {
  double low = 0, high = 6;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle) > relative_pressure ? low : high) = middle;
  }
  return low;
}

double model_conductance(const Asperities& a, double k, double relative_pressure) {
  const double lambda = separation_of(relative_pressure);
  return k * a.slope / a.roughness * std::exp(-lambda * lambda) / (2 * std::sqrt(2 * pi)) /
         std::pow(1 - std::sqrt(relative_pressure), 1.5);
}

// t_N/H of the model where the hardness depends on the size of the spots: a fixed point.
double model_relative_pressure(const Asperities& a, double pressure) {
  double relative = pressure / a.hardness_coefficient;
  for (int i = 0; i < 200; ++i) {
    const double lambda = separation_of(relative);
    const double diagonal = 4 * a.roughness / a.slope * std::exp(lambda * lambda) * std::erfc(lambda);
    relative = pressure / (a.hardness_coefficient * std::pow(diagonal / 1e-6, a.hardness_exponent));
  }
  return relative;
}

// Blasted steel: σ = 2 µm, m = 0.2, H_v = 6.27 GPa (d/1 µm)^−0.229.
Asperities steel(double exponent) {
  Asperities a;
  a.roughness = 2e-6;
  a.slope = 0.2;
  a.conductivity = Table(30.0);
  a.hardness_coefficient = 6.27e9;
  a.hardness_exponent = exponent;
  return a;
}

TEST(Spots, OfOneHardnessConductAsTheModelDoesToTwoPercent) {
  const Asperities a = steel(0);
  for (double x : {1e-5, 1e-4, 1e-3, 1e-2}) {
    const double model = model_conductance(a, 30, x);
    // 1.25 x^0.95 is a fit.
    EXPECT_NEAR(a.spots(x * a.hardness_coefficient, 300).value, model, 0.02 * model) << x;
  }
}

TEST(Spots, OfAHardnessThatGrowsTowardsSmallOnesFollowTheModelInSiUnits) {
  const Asperities a = steel(-0.229);
  for (double pressure : {1e6, 1e7, 5e7}) {
    const double model = model_conductance(a, 30, model_relative_pressure(a, pressure));
    // Besides the fit of h_S that of the size, 1.62 (t_N/H)^0.071. Were σ/m not turned into micrometres, or
    // the exponent the printed 0.71, h_S would be off by a factor of 21, or 2.7.
    EXPECT_NEAR(a.spots(pressure, 300).value, model, 0.03 * model) << pressure;
  }
}

TEST(Gas, BetweenRoughSurfacesFillsTheDistanceOfTheirMeanPlanes) {
  const Asperities a = steel(0);
  for (double x : {1e-5, 1e-4, 1e-3, 1e-2, 2e-2}) {
    const double model = std::sqrt(2.0) * a.roughness * separation_of(x);
    EXPECT_NEAR(a.separation(x).value, model, 0.02 * model) << x;
  }
}

TEST(Gas, GoesOnWhereTheFitOfTheDistanceEnds) {
  const Asperities a = steel(0);
  const double lost = a.separation(0).value;
  EXPECT_NEAR(lost, 4.47 * a.roughness, 0.01 * a.roughness) << "finite where contact is lost";
  double before = lost;
  for (double x : {1e-6, 9.99e-6, 1.001e-5, 1e-3, 1.999e-2, 2.001e-2, 0.17, 0.18, 0.5, 1.0, 3.0}) {
    const auto y = a.separation(x);
    EXPECT_GT(y.value, 0) << x;
    EXPECT_LT(y.value, before) << x;
    before = y.value;
    const double dx = 1e-4 * x;
    const double difference = (a.separation(x + dx).value - a.separation(x - dx).value) / (2 * dx);
    EXPECT_NEAR(y.slope, difference, 1e-5 * std::abs(difference)) << x;
  }
  // The model itself, far beyond the fit; and a conductance that grows no faster than the pressure.
  for (double x : {0.05, 0.1, 0.2})
    EXPECT_NEAR(a.separation(x).value, std::sqrt(2.0) * a.roughness * separation_of(x), 0.25 * lost) << x;
  EXPECT_LT(a.separation(10).value / a.separation(1000).value, 101);
  for (double end : {1e-5, 2e-2}) {
    const double below = a.separation(end * (1 - 1e-9)).slope, above = a.separation(end * (1 + 1e-9)).slope;
    EXPECT_NEAR(below, above, 1e-7 * std::abs(above)) << "the slope does not jump at " << end;
  }
}

}  // namespace
}  // namespace solidus::contact
