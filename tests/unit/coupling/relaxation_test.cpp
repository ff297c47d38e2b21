#include "coupling/relaxation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace solidus {
namespace {

using coupling::Relaxation;
using coupling::RelaxationOptions;
using Kind = RelaxationOptions::Kind;

TEST(Relaxation, TakesWholeOrFixedSteps) {
  const std::array<double, 2> change{1, -2};
  EXPECT_EQ(Relaxation({Kind::none, 0.3}).factor(change), 1);
  EXPECT_EQ(Relaxation({Kind::fixed, 0.3}).factor(change), 0.3);
}

TEST(Relaxation, AitkenIsExactAfterTwoChangesOfOneMode) {
  Relaxation relaxation({Kind::aitken, 1});
  double x = 5;
  for (int i = 0; i < 2; ++i) {
    const std::array<double, 1> change{-2 * x + 3 - x};  // x ← 3 − 2 x, which diverges by itself
    x += relaxation.factor(change) * change[0];
  }
  EXPECT_NEAR(x, 1, 1e-14);
}

// The range of the isothermal passes at a coupling number of two.
TEST(Relaxation, AitkenConvergesWhereTheIterationAloneDiverges) {
  Relaxation relaxation({Kind::aitken, 1});
  const std::array<double, 4> slope{0, -0.3, -1.1, -2};
  std::array<double, 4> x{1, -1, 2, 0.5}, change{};
  int n = 0;
  for (double size = 1; size > 1e-10 && n < 100; ++n) {
    size = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      change[i] = (slope[i] - 1) * x[i];
      size = std::max(size, std::abs(change[i]));
    }
    const double factor = relaxation.factor(change);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * change[i];
  }
  EXPECT_LT(n, 40);
}

TEST(Relaxation, ForgetsAtTheStartOfAStep) {
  Relaxation relaxation({Kind::aitken, 0.7});
  const std::array<double, 1> first{1}, second{-2};
  EXPECT_EQ(relaxation.factor(first), 0.7);
  EXPECT_NE(relaxation.factor(second), 0.7);
  relaxation.begin();
  EXPECT_EQ(relaxation.factor(second), 0.7);
}

TEST(Relaxation, AitkensFactorStaysInItsRange) {
  Relaxation relaxation({Kind::aitken, 1});
  const std::array<double, 1> first{1}, grown{1.5}, reversed{-100};
  relaxation.factor(first);
  EXPECT_EQ(relaxation.factor(grown), Relaxation::k_least);  // would step backwards
  relaxation.begin();
  relaxation.factor(first);
  EXPECT_EQ(relaxation.factor(reversed), Relaxation::k_least);
}

}  // namespace
}  // namespace solidus
