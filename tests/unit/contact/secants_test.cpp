#include "contact/forces/secants.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace solidus::contact {
namespace {

using Values = Secants::Values;

double dot(const Values& a, const Values& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// f(x) = b − A x with the rates of springs of different stiffness that act on each other.
Values residual(const Values& x) {
  constexpr double k_rates[] = {1, 0.5, 0.2, 0.1, 0.02};
  Values f(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    f[i] = 1 - k_rates[i] * x[i];
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != i) f[i] -= 0.005 * x[j];
  }
  return f;
}

double left_after(int turns, bool by_secants) {
  Values x(5, 0.0), f = residual(x);
  Secants secants;
  for (int turn = 0; turn < turns; ++turn) {
    secants.look(f, dot);
    const Values step = by_secants ? secants.step(dot) : f;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step[i];
    secants.took(step);
    f = residual(x);
  }
  return std::sqrt(dot(f, f));
}

TEST(Secants, ALinearResidualIsZeroAfterOneStepMoreThanUnknowns) {
  EXPECT_LT(left_after(6, true), 1e-9);
  EXPECT_GT(left_after(60, false), 0.1);
}

TEST(Secants, TheFirstStepIsThePlainOne) {
  Secants secants;
  const Values f = {1, -2, 0.5};
  secants.look(f, dot);
  EXPECT_EQ(secants.step(dot), f);
}

TEST(Secants, StepsThatHaveLedToMoreAreForgotten) {
  Secants secants;
  secants.look({1, 0}, dot);
  secants.took({1, 0});
  secants.look({0.5, 0}, dot);  // a half is left
  EXPECT_NEAR(secants.step(dot)[0], 1, 1e-14);
  secants.took({0, 1});
  secants.look({0.5, 4}, dot);  // eight times as much, by a step in the other direction alone
  EXPECT_NEAR(secants.step(dot)[0], 0.5, 1e-14) << "one, were the first secant still known";
}

}  // namespace
}  // namespace solidus::contact
