/// A block under constant pressure, pulled along: friction over the way against the solutions of
///
///   dζ/dg_p = t_N,  μ(ζ) t_N,  or 1       g = g_p + μ(ζ) t_N/ε_T
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "friction_laws.hpp"

namespace solidus::contact {
namespace {

using enum InternalVariable;
constexpr double k_pressure = 39.2e6;  ///< 3.92 kN on 1 cm²
constexpr double k_penalty = 1e11;

struct Sliding {
  double slip = 0, zeta = 0, traction = 0, dissipation = 0;
};
Sliding slide(const FrictionLaw& law, double way, int steps, double pressure = k_pressure) {
  Sliding s;
  for (int i = 0; i < steps; ++i) {
    const auto r = law.update({s.traction + k_penalty * way / steps, pressure, s.zeta, 300});
    EXPECT_EQ(r.status, FrictionStatus::converged);
    s.slip += r.slip;
    s.zeta = r.internal_variable;
    s.traction = r.traction;
    s.dissipation += r.dissipation;
  }
  return s;
}

/// dζ/dg_p = rate(ζ) by the classical Runge–Kutta method.
double integrate(const std::function<double(double)>& rate, double way) {
  constexpr int k_steps = 20000;
  const double h = way / k_steps;
  double z = 0;
  for (int i = 0; i < k_steps; ++i) {
    const double a = rate(z), b = rate(z + 0.5 * h * a), c = rate(z + 0.5 * h * b), d = rate(z + h * c);
    z += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return z;
}

TEST(SlidingBlock, FollowsTheClosedFormOfNormalWorkAndOfSlipInAnyNumberOfSteps) {
  const double way = 0.2;
  for (const int steps : {1, 20, 400}) {
    // Linear: μ = μ_0 + a ζ, ζ = t_N g_p and g_p + μ t_N/ε_T = g.
    const double mu_0 = 0.178, a = -0.666e-8;
    const double slip = (way - mu_0 * k_pressure / k_penalty) / (1 + a * k_pressure * k_pressure / k_penalty);
    const auto s = slide(FrictionLaw(friction_spec({mu_0, a}), k_penalty), way, steps);
    EXPECT_NEAR(s.slip, slip, 1e-12 * slip);
    EXPECT_NEAR(s.traction, (mu_0 + a * k_pressure * slip) * k_pressure, 1e-11 * s.traction);
    EXPECT_NEAR(s.dissipation, mu_0 * k_pressure * slip, 1e-12 * s.dissipation) << "3.58";

    const double per_metre = 0.3;  // μ = μ_0 + b g_p
    const double way_only = (way - mu_0 * k_pressure / k_penalty) / (1 + per_metre * k_pressure / k_penalty);
    const auto w = slide(FrictionLaw(friction_spec({mu_0, per_metre}, 1, InternalVariable::slip), k_penalty),
                         way, steps);
    EXPECT_NEAR(w.zeta, way_only, 1e-12 * way_only);
    EXPECT_NEAR(w.traction, (mu_0 + per_metre * way_only) * k_pressure, 1e-11 * w.traction);
  }
}

TEST(SlidingBlock, FollowsTheExponentialOfFrictionalWorkToFirstOrder) {
  // dζ/dg_p = (μ_0 + a ζ) t_N
  const double way = 0.2, mu_0 = 0.178;
  for (const double a : {-0.666e-7, 0.5e-7}) {
    const FrictionLaw law(friction_spec({mu_0, a}, 1, frictional_work), k_penalty);
    const auto error = [&](int steps) {
      const auto s = slide(law, way, steps);
      const double exact = mu_0 / a * std::expm1(a * k_pressure * s.slip);
      EXPECT_NEAR(s.dissipation, s.zeta, 1e-9 * s.zeta) << "all the work of friction is dissipated";
      return std::abs(s.zeta / exact - 1);
    };
    const double coarse = error(2000), fine = error(4000);
    EXPECT_LT(fine, 1e-4);
    EXPECT_NEAR(coarse / fine, 2, 0.02);
  }
}

TEST(SlidingBlock, FollowsTheOdeOfAnyPolynomialAndTableForEveryInternalVariable) {
  const double way = 0.2;
  struct Case {
    InternalVariable variable;
    double unit;
  };
  // The whole range of table 7.5, ζ from 0 to about 8 units, for each.
  for (const Case c :
       {Case{normal_work, 1e6}, Case{frictional_work, 1.5e5}, Case{InternalVariable::slip, 0.025}})
    for (const bool table : {false, true}) {
      FrictionParameters spec = friction_spec(electrogalvanised(), c.unit, c.variable);
      if (table) {
        spec.coefficient.terms.clear();
        spec.coefficient.curves = {{0, Table({0, 2, 5, 12}, {0.16, 0.13, 0.2, 0.3})}};
      }
      const FrictionLaw law(spec, k_penalty);
      const auto mu = [&](double zeta) { return law.coefficient().value(zeta, 300).value; };
      const auto rate = [&](double zeta) {
        if (c.variable == normal_work) return k_pressure;
        return c.variable == frictional_work ? mu(zeta) * k_pressure : 1;
      };
      const auto error = [&](int steps) {
        const auto s = slide(law, way, steps);
        const double zeta = integrate(rate, s.slip);
        EXPECT_NEAR(s.slip + mu(zeta) * k_pressure / k_penalty, way, 1e-4 * way);
        return std::abs(s.traction / (mu(zeta) * k_pressure) - 1);
      };
      if (c.variable == frictional_work) {
        const double coarse = error(4000), fine = error(8000);
        EXPECT_LT(fine, 1e-4);
        EXPECT_NEAR(coarse / fine, 2, 0.1);
      } else {
        EXPECT_LT(error(20), 1e-10) << "ζ does not depend on μ: any number of steps is exact";
      }
    }
}

TEST(SlidingBlock, WearsGalvannealedAndElectrogalvanisedSheetsAsInTwentyPassesOfTheMonograph) {
  // A point meets 1 cm of tool 20 times: 0.392 kN/mm a pass at 3.92 kN.
  const auto after = [](std::vector<Table> terms, double unit, InternalVariable variable, int steps) {
    const FrictionLaw law(friction_spec(std::move(terms), unit, variable), k_penalty);
    const auto s = slide(law, 20 * 0.01, steps);
    return law.coefficient().value(s.zeta, 300).value;
  };
  EXPECT_NEAR(after(galvannealed(), 1e6, normal_work, 400), 0.126, 5e-4);
  EXPECT_NEAR(after(electrogalvanised(), 1e6, normal_work, 400), 0.251, 5e-4);
  double least = 1;
  for (int steps = 1; steps < 400; ++steps) {
    const FrictionLaw law(friction_spec(electrogalvanised(), 1e6), k_penalty);
    least = std::min(least, law.update({k_penalty * 0.0005 * steps, k_pressure, 0, 300}).coefficient);
  }
  EXPECT_NEAR(least, 0.129, 5e-4);
  EXPECT_NEAR(after(galvannealed(), 1e5, frictional_work, 4000), 0.106, 5e-4) << "frictional work in kN/cm";
}

TEST(SlidingBlock, SaysThatNormalWorkInKilonewtonPerCentimetreMakesGalvannealedFrictionNegative) {
  const FrictionLaw law(friction_spec(galvannealed(), 1e5), k_penalty);
  FrictionResponse r;
  double zeta = 0, traction = 0;
  for (int i = 0; i < 400 && r.status == FrictionStatus::converged; ++i) {
    r = law.update({traction + k_penalty * 0.0005, k_pressure, zeta, 300});
    zeta = r.internal_variable;
    traction = r.traction;
  }
  EXPECT_EQ(r.status, FrictionStatus::coefficient_vanishes);
}

}  // namespace
}  // namespace solidus::contact
