#include "contact/interface/friction_coefficient.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "friction_laws.hpp"

namespace solidus::contact {
namespace {

FrictionCoefficient terms(std::vector<Table> list, double unit = 1) {
  return FrictionCoefficient({.terms = std::move(list), .unit = unit});
}
FrictionCoefficient thermal() {
  return terms({Table({300, 500}, {0.3, 0.2}), Table({300, 500}, {0.02, -0.01}),
                Table({300, 500}, {0.01, 0.03}), -0.002},
               1e6);
}
FrictionCoefficient family() {
  return FrictionCoefficient(
      {.curves = {{500, Table({0, 1, 4}, {0.2, 0.3, 0.25})}, {300, Table({0, 2, 3}, {0.25, 0.3, 0.5})}},
       .unit = 1e6});
}

/// Central differences of fourth order.
double difference(const std::function<double(double)>& f, double x, double h) {
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

void expect_derivatives(const FrictionCoefficient& mu, double zeta, double theta) {
  const auto at = mu.point(zeta, theta);
  const double dz = 1e-2 * 1e6, dt = 1;  // polynomials of order 4 and lines: differences are exact
  const auto close = [](double a, double b, double size) { EXPECT_NEAR(a, b, 1e-9 * size); };
  close(at.zeta, difference([&](double z) { return mu.point(z, theta).value; }, zeta, dz), 1e-6);
  close(at.theta + at.initial_theta, difference([&](double t) { return mu.point(zeta, t).value; }, theta, dt),
        1e-2);
  close(at.initial_theta, difference([&](double t) { return mu.point(zeta, t).initial; }, theta, dt), 1e-2);
  close(at.zeta_theta, difference([&](double t) { return mu.point(zeta, t).zeta; }, theta, dt), 1e-8);
  close(at.value - at.initial, difference([&](double z) { return mu.point(z, theta).stored; }, zeta, dz), 1);
  close(at.stored_theta, difference([&](double t) { return mu.point(zeta, t).stored; }, theta, dt), 1e4);
  EXPECT_DOUBLE_EQ(mu.value(zeta, theta).value, at.value);
  EXPECT_DOUBLE_EQ(mu.value(zeta, theta).zeta, at.zeta);
}

TEST(FrictionCoefficient, HasTheDerivativesAndTheEnergyOfItsPolynomial) {
  for (const double zeta : {0.1e6, 1.5e6, 7e6})
    for (const double theta : {310.0, 444.0}) expect_derivatives(thermal(), zeta, theta);
}

TEST(FrictionCoefficient, HasTheDerivativesAndTheEnergyOfItsCurves) {
  for (const double zeta : {0.3e6, 1.4e6, 2.5e6, 3.4e6, 5e6})
    for (const double theta : {310.0, 444.0}) expect_derivatives(family(), zeta, theta);
}

TEST(FrictionCoefficient, TakesTheInternalVariableInTheUnitOfItsData) {
  const auto ga = terms(galvannealed(), k_kilonewton_per_mm);
  EXPECT_DOUBLE_EQ(ga.value(2e6, 300).value, 0.178 - 2 * 0.666e-2);
  const auto curves = FrictionCoefficient({.curves = {{0, Table({0, 4}, {0.1, 0.5})}}, .unit = 1e6});
  EXPECT_DOUBLE_EQ(curves.value(1e6, 300).value, 0.2);
  EXPECT_DOUBLE_EQ(curves.point(2e6, 300).stored, 0.5 * 0.1 * 2 * 2 * 1e6);
  EXPECT_DOUBLE_EQ(curves.value(9e6, 300).value, 0.5) << "level beyond the last point";
}

TEST(FrictionCoefficient, BoundsItsSlopeOverARange) {
  const auto contains = [](const FrictionCoefficient& mu, double from, double to, double slack) {
    const auto b = mu.slopes(from, to, 420);
    double low = 1e9, high = -1e9;
    for (int i = 0; i <= 1000; ++i) {
      const double slope = mu.value(from + (to - from) * i / 1000, 420).zeta;
      low = std::min(low, slope);
      high = std::max(high, slope);
    }
    EXPECT_LE(b.low, low + 1e-20);
    EXPECT_GE(b.high, high - 1e-20);
    EXPECT_LE(b.high - b.low, slack * (high - low) + 1e-20);
  };
  contains(thermal(), 0.5e6, 3e6, 10);
  contains(thermal(), 0.5e6, 0.51e6, 10);
  contains(family(), 0.5e6, 5e6, 2);
  contains(terms(electrogalvanised(), 1e6), 3e6, 3.02e6, 20);
}

std::string error_of(FrictionCoefficientSpec spec) {
  try {
    FrictionCoefficient mu(std::move(spec));
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(FrictionCoefficient, RefusesWhatMakesNoLaw) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of({}), HasSubstr("no coefficient of friction"));
  EXPECT_THAT(error_of({.terms = {0.1}, .curves = {{0, Table(0.1)}}}), HasSubstr("two coefficients"));
  EXPECT_THAT(error_of({.terms = {0.0}}), HasSubstr("coefficients above zero"));
  EXPECT_THAT(error_of({.terms = {Table({300, 400}, {0.1, 0.2})}}),
              testing::AllOf(HasSubstr("rises with temperature"), HasSubstr("3.60")));
  EXPECT_THAT(error_of({.curves = {{300, Table(0.1)}, {400, Table(0.2)}}}), HasSubstr("3.60"));
  EXPECT_THAT(error_of({.curves = {{300, Table(0.1)}, {300, Table(0.1)}}}), HasSubstr("two friction curves"));
  EXPECT_THAT(error_of({.curves = {{0, Table({1, 2}, {0.1, 0.2})}}}), HasSubstr("starts at 1"));
  EXPECT_THAT(error_of({.curves = {{0, Table({0, 2}, {0.1, -0.2})}}}), HasSubstr("-0.2"));
  EXPECT_EQ(error_of({.terms = {Table({300, 400}, {0.2, 0.1}), Table({300, 400}, {0.1, 0.2})}}), "no error");
}

}  // namespace
}  // namespace solidus::contact
