#include "contact/interface/friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
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
  FrictionParameters spec;
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
    const auto kind = static_cast<std::size_t>(below(3));
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
    // At fixed entropy Θ_c changes by up to about a tenth: |K_Θ| <= ½ (2 ζ)² · 2 change/620 K, some more by
    // μ_2.
    d.capacity = below(4) ? change * zeta * zeta / 620 * decades(30, 1e5) : 0;
    return d;
  }

 private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_;
};

TEST(FrictionLaw, AMillionRandomStepsEndOnTheSlipSurface) {
  Random random;
  int slid = 0;
  Draw d;
  std::optional<FrictionLaw> drawn;
  for (int i = 0; i < 1000000; ++i) {
    if (i % 10 == 0) d = random.draw();
    const FrictionLaw& law = i % 10 ? *drawn : drawn.emplace(d.spec, k_penalty, d.capacity);
    FrictionInput in = d.in;
    in.trial *= 1 - 0.05 * (i % 10);
    const auto r = i % 2 ? law.update(in) : law.isentropic(in);
    ASSERT_EQ(r.status, FrictionStatus::converged) << i;
    ASSERT_GE(r.dissipation, 0);
    if (r.sticks) continue;
    ++slid;
    const double balance = in.trial - k_penalty * r.slip - r.traction;
    ASSERT_LE(std::abs(balance), 1e-12 * in.trial) << i;
    ASSERT_GT(r.slip, 0);
    ASSERT_GT(r.coefficient, 0);
  }
  EXPECT_GT(slid, 600000);
}

/// Central differences of fourth order over a small part of the argument.
double difference(const std::function<double(double)>& f, double x) {
  const double h = 2e-4 * x;
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

TEST(FrictionLaw, HasTheDerivativesOfTheSolutionItFound) {
  Random random;
  int slid = 0;
  for (int i = 0; i < 20000; ++i) {
    const Draw d = random.draw();
    const bool isentropic = i % 2;
    const FrictionLaw law(d.spec, k_penalty, d.capacity);
    const auto solve = [&](FrictionInput in) { return isentropic ? law.isentropic(in) : law.update(in); };
    const auto r = solve(d.in);
    if (r.sticks || r.coefficient * d.in.pressure > 0.99 * d.in.trial) continue;  // near the corner
    ++slid;
    const auto of_trial = [&](double trial) {
      FrictionInput in = d.in;
      in.trial = trial;
      return solve(in).traction;
    };
    const auto of_pressure = [&](double pressure) {
      FrictionInput in = d.in;
      in.pressure = pressure;
      return solve(in).traction;
    };
    // Differences carry the rounding of ‖T‖ <= ‖T^trial‖, 1e-15 ‖T^trial‖/(2e-4 x).
    ASSERT_NEAR(r.trial_slope, difference(of_trial, d.in.trial), 1e-8) << i;
    ASSERT_NEAR(r.pressure_slope, difference(of_pressure, d.in.pressure),
                1e-8 * std::max(1.0, d.in.trial / d.in.pressure))
        << i;
  }
  EXPECT_GT(slid, 10000);
}

TEST(FrictionLaw, IsentropicPhaseKeepsTheEntropyAndHardensMore) {
  Random random;
  int changed = 0;
  for (int i = 0; i < 100000; ++i) {
    const Draw d = random.draw();
    const FrictionLaw law(d.spec, k_penalty, d.capacity);
    const auto r = law.isentropic(d.in), isothermal = law.update(d.in);
    if (r.sticks) continue;
    if (d.capacity == 0 || d.spec.internal_variable != normal_work) {
      ASSERT_EQ(r.temperature, d.in.temperature);
      ASSERT_EQ(r.traction, isothermal.traction);
      continue;
    }
    // Along the lines of the tables at Θ_n, which is their value while Θ_c stays between their points.
    const double entropy = r.structural_entropy + d.capacity * std::log(r.temperature / d.in.temperature);
    ASSERT_LE(std::abs(entropy), 1e-12 * (d.capacity + std::abs(r.structural_entropy))) << i;
    changed += std::abs(r.temperature - d.in.temperature) > 1;
    if (d.spec.coefficient.terms.size() > 2) continue;  // ∂(μ − μ_0)/∂Θ may change its sign
    ASSERT_GE(r.traction, isothermal.traction * (1 - 1e-10)) << i;
    ASSERT_LE(r.slip, isothermal.slip * (1 + 1e-10)) << i;
  }
  EXPECT_GT(changed, 1000);
}

TEST(FrictionLaw, SaysWhereSofteningIsSteeperThanThePenalty) {
  // μ = 0.5 − 1e4 γ under 100 MPa falls by 1e12 Pa/m; the penalty gives back 1e11.
  FrictionParameters spec = friction_spec({0.5}, 1, InternalVariable::slip);
  spec.coefficient.terms.clear();
  spec.coefficient.curves = {{0, Table({0, 4e-5, 1}, {0.5, 0.1, 0.1})}};
  const FrictionInput in{6e7, 1e8, 0, 300};
  const auto r = FrictionLaw(spec, 1e11).update(in);
  EXPECT_EQ(r.status, FrictionStatus::not_unique);
  EXPECT_NEAR(r.traction, 1e7, 1) << "a solution all the same";
  EXPECT_EQ(FrictionLaw(spec, 2e12).update(in).status, FrictionStatus::converged);
  EXPECT_NE(std::string(reason(r.status)).find("tangential penalty"), std::string::npos);
}

TEST(FrictionLaw, SaysWhereFrictionalWorkHardensTooFastForTheStep) {
  // ζ = γ t_N (0.1 + c ζ²) has no solution beyond γ = 0.5 mm, where friction has only doubled.
  const FrictionLaw law(friction_spec({0.1, 0, 1e-9}, 1, frictional_work), k_penalty);
  EXPECT_EQ(law.update({k_penalty * 1e-4, 1e8, 0, 300}).status, FrictionStatus::converged);
  EXPECT_EQ(law.update({k_penalty * 1e-3, 1e8, 0, 300}).status, FrictionStatus::not_unique);
}

TEST(FrictionLaw, SaysWhereTheCoefficientVanishes) {
  const FrictionLaw law(friction_spec({0.2, -1e-6}), k_penalty);
  EXPECT_EQ(law.update({1e7, 1e7, 1.995e5, 300}).status, FrictionStatus::coefficient_vanishes);
  EXPECT_EQ(law.update({1e7, 1e7, 2.01e5, 300}).status, FrictionStatus::coefficient_vanishes);
  EXPECT_EQ(law.update({1e7, 1e7, 1.9e5, 300}).status, FrictionStatus::converged);
}

TEST(FrictionLaw, SaysWhereTheInterfaceCannotHoldTheHeatOfItsHardening) {
  const FrictionLaw law(friction_spec({0.1, Table({300, 900}, {0.5, 0.1})}, 1e6), k_penalty, 1);
  EXPECT_EQ(law.isentropic({4e7, 5e7, 1e6, 600}).status, FrictionStatus::temperature_runs_off);
  EXPECT_EQ(law.update({4e7, 5e7, 1e6, 600}).status, FrictionStatus::converged);
}

TEST(FrictionLaw, RefusesAPenaltyThatIsNone) {
  EXPECT_THROW(FrictionLaw(friction_spec({0.2}), 0), InputError);
  EXPECT_THROW(FrictionLaw(friction_spec({0.2}), 1, -1), InputError);
}

}  // namespace
}  // namespace solidus::contact
