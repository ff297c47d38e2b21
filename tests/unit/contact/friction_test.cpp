#include "contact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "friction_laws.hpp"

namespace solidus::contact {
namespace {

using enum InternalVariable;

constexpr double k_penalty = 1e11;  ///< ε_T of 7.2 [Pa/m]

TEST(FrictionLaw, SticksBelowTheCoefficientTimesThePressure) {
  const FrictionLaw law(friction_spec({0.3}), k_penalty);
  const auto r = law.update({2.9e6, 1e7, 0, 293});
  EXPECT_TRUE(r.sticks);
  EXPECT_EQ(r.traction, 2.9e6);
  EXPECT_EQ(r.trial_slope, 1);
  EXPECT_EQ(r.pressure_slope, 0);
  EXPECT_EQ(r.slip, 0);
  EXPECT_EQ(r.dissipation, 0);
}

TEST(FrictionLaw, SlipsAtCoulombsLimitWithAConstantCoefficient) {
  const FrictionLaw law(friction_spec({0.3}), k_penalty);
  const auto r = law.update({5e6, 1e7, 2, 293});
  EXPECT_EQ(r.status, FrictionStatus::converged);
  EXPECT_FALSE(r.sticks);
  EXPECT_DOUBLE_EQ(r.traction, 3e6);
  EXPECT_DOUBLE_EQ(r.slip, 2e-5);
  EXPECT_DOUBLE_EQ(r.internal_variable, 2 + 200);
  EXPECT_DOUBLE_EQ(r.dissipation, 60);
  EXPECT_EQ(r.trial_slope, 0);
  EXPECT_DOUBLE_EQ(r.pressure_slope, 0.3);
}

TEST(FrictionLaw, WithoutPressureItSlidesFreely) {
  const auto r = FrictionLaw(friction_spec({0.3, -0.01}, 1e6), k_penalty).update({5e6, 0, 2, 293});
  EXPECT_EQ(r.status, FrictionStatus::converged);
  EXPECT_EQ(r.traction, 0);
  EXPECT_DOUBLE_EQ(r.slip, 5e-5);
  EXPECT_EQ(r.dissipation, 0);
}

/// A law and a step drawn at random, softening at most half as fast as the penalty allows.
struct Draw {
  FrictionSpec spec;
  FrictionInput in;
  double capacity;
};
class Random {
 public:
  double between(double a, double b) { return a + (b - a) * uniform_(engine_); }
  double decades(double a, double b) { return std::pow(10, between(std::log10(a), std::log10(b))); }
  int below(int n) { return static_cast<int>(between(0, n)); }

  Draw draw() {
    Draw d;
    const double pressure = decades(1e3, 1e9), mu = decades(0.01, 1), theta = between(280, 900);
    const double trial = mu * pressure * decades(0.5, 100), slip = trial / k_penalty;
    const std::array<double, 3> per_slip{pressure, mu * pressure, 1};  // ζ a metre of slip
    const int kind = below(3);
    const double zeta = per_slip[kind] * slip;  // what a step adds, about
    // Over the step μ changes by a part of itself, no faster than the penalty can follow.
    const double change = std::min(0.15 * mu, 0.2 * k_penalty * slip / pressure) / zeta;
    const auto term = [&](double share) {
      const double a = share * between(-1, 1);
      return Table({280, 900}, {a, a * between(-1, 1)});
    };
    d.spec.coefficient.terms = {Table({280, 900}, {mu * between(1, 1.3), mu}), term(change)};
    if (below(2)) d.spec.coefficient.terms.push_back(term(0.3 * change / zeta));
    d.spec.coefficient.unit = decades(1e-3, 1e6);
    double power = 1;
    for (Table& t : d.spec.coefficient.terms) {
      t = t.scaled(power);
      power *= d.spec.coefficient.unit;
    }
    d.spec.internal_variable = static_cast<InternalVariable>(kind);
    d.in = {trial, pressure, zeta * between(0, 1) * below(2), theta};
    d.capacity = below(4) ? decades(1, 1e5) : 0;
    return d;
  }

 private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_;
};

TEST(FrictionLaw, AMillionRandomStepsEndOnTheSlipSurface) {
  Random random;
  int slid = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Draw d = random.draw();
    const FrictionLaw law(d.spec, k_penalty, d.capacity);
    const auto r = i % 2 ? law.update(d.in) : law.isentropic(d.in);
    ASSERT_EQ(r.status, FrictionStatus::converged) << i;
    ASSERT_GE(r.dissipation, 0);
    if (r.sticks) continue;
    ++slid;
    const double balance = d.in.trial - k_penalty * r.slip - r.traction;
    ASSERT_LE(std::abs(balance), 1e-12 * d.in.trial) << i;
    ASSERT_GT(r.slip, 0);
    ASSERT_GT(r.coefficient, 0);
  }
  EXPECT_GT(slid, 600000);
}

}  // namespace
}  // namespace solidus::contact
