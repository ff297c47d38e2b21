/// The integrators on one degree of freedom, without any mesh.
#include "mechanics/loads/motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "linear/dense.hpp"

namespace solidus {
namespace {

using mechanics::Motion;

/// The step (u, v Δt, a Δt²)_n → the same at t_{n+1} of u'' = −ω² u, with w = ω Δt.
linear::dense::Matrix amplification(const Motion& m, double w) {
  linear::dense::Matrix step(3, 3);
  for (std::size_t column = 0; column < 3; ++column) {
    std::array<double, 3> old{};
    old[column] = 1;
    // Linear in u_1: the balance at u_1 = 0 and its slope.
    const auto balance = [&](double u) {
      const double a = m.acceleration(u - old[0], old[1], old[2], 1);
      return (1 - m.alpha_m) * a + m.alpha_m * old[2] + w * w * ((1 - m.alpha_f) * u + m.alpha_f * old[0]);
    };
    const double u = -balance(0) / (balance(1) - balance(0));
    const double a = m.acceleration(u - old[0], old[1], old[2], 1);
    step(0, column) = u;
    step(1, column) = m.velocity(old[1], old[2], a, 1);
    step(2, column) = a;
  }
  return step;
}

double spectral_radius(const Motion& m, double w) {
  double largest = 0;
  for (const auto& value : linear::dense::eigensystem(amplification(m, w).all()).values)
    largest = std::max(largest, std::abs(value));
  return largest;
}

TEST(GeneralisedAlpha, LeavesItsParameterOfTheHighestFrequencies) {
  // Double roots, and a triple one at ρ = 0: what rounding does to them are its square and cube roots.
  for (const double rho : {0.3, 0.5, 0.8, 0.95, 1.0})
    EXPECT_NEAR(spectral_radius(Motion::generalised_alpha(rho), 1e6), rho, 2e-4);
  EXPECT_LT(spectral_radius(Motion::generalised_alpha(0), 1e6), 1e-2);
}

TEST(Motion, IsStableForEveryStep) {
  for (const Motion& m :
       {Motion::backward_euler(), Motion::newmark(0.6, 0.3025), Motion::newmark(0.9, 0.6),
        Motion::trapezoidal(), Motion::generalised_alpha(0), Motion::generalised_alpha(0.8)})
    for (double w = 1e-3; w < 1e4; w *= 1.3) EXPECT_LT(spectral_radius(m, w), 1 + 1e-9) << w;
}

TEST(TrapezoidalRule, DampsNothing) {
  for (const Motion& m : {Motion::trapezoidal(), Motion::generalised_alpha(1)})
    for (double w = 1e-3; w < 1e3; w *= 2) EXPECT_NEAR(spectral_radius(m, w), 1, 1e-9) << w;
}

// Chung and Hulbert 1993, equations 17, 25 and 33.
TEST(GeneralisedAlpha, WithOneIsTheMidpointRuleInNewmarksFormulas) {
  const Motion m = Motion::generalised_alpha(1);
  EXPECT_DOUBLE_EQ(m.alpha_m, 0.5);
  EXPECT_DOUBLE_EQ(m.alpha_f, 0.5);
  EXPECT_DOUBLE_EQ(m.gamma, 0.5);
  EXPECT_DOUBLE_EQ(m.beta, 0.25);
}

TEST(NewmarksMethod, IsRefusedWhereItWouldNotBeStable) {
  EXPECT_THROW(Motion::newmark(0.49, 0.3), std::invalid_argument);
  EXPECT_THROW(Motion::newmark(0.6, 0.3), std::invalid_argument);
  EXPECT_THROW(Motion::generalised_alpha(1.01), std::invalid_argument);
  EXPECT_NO_THROW(Motion::newmark(0.6, 0.3025));  // the least, with its rounding
}

}  // namespace
}  // namespace solidus
