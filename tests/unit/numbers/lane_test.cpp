#include <gtest/gtest.h>

#include <random>

#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"

namespace solidus {
namespace {

Lane ramp(double from, double step) {
  Lane r;
  for (int i = 0; i < k_lanes; ++i) r.set(i, from + step * i);
  return r;
}

TEST(Lane, ComputesEachLaneAsANumber) {
  const Lane a = ramp(-3.5, 1.25), b = ramp(2, -0.75);
  for (int i = 0; i < k_lanes; ++i) {
    EXPECT_EQ((a + b)[i], a[i] + b[i]);
    EXPECT_EQ((a - b)[i], a[i] - b[i]);
    EXPECT_EQ((a * b)[i], a[i] * b[i]);
    EXPECT_EQ((a / b)[i], a[i] / b[i]);
    EXPECT_EQ((-a)[i], -a[i]);
    EXPECT_EQ(abs(a)[i], std::abs(a[i]));
    EXPECT_EQ(min(a, b)[i], std::min(a[i], b[i]));
    EXPECT_EQ(max(a, b)[i], std::max(a[i], b[i]));
    EXPECT_EQ(sqrt(abs(a))[i], std::sqrt(std::abs(a[i])));
    EXPECT_DOUBLE_EQ(exp(a)[i], std::exp(a[i]));
    EXPECT_DOUBLE_EQ(pow(abs(a), 0.3)[i], std::pow(std::abs(a[i]), 0.3));
    EXPECT_EQ((a < b)[i], a[i] < b[i]);
    EXPECT_EQ(select(a < b, a, b)[i], a[i] < b[i] ? a[i] : b[i]);
  }
}

TEST(Lane, MasksCombineAndAreSummarised) {
  const Lane a = ramp(0, 1);
  EXPECT_TRUE(any(a > Lane(6.5)));
  EXPECT_FALSE(any(a > Lane(7.5)));
  EXPECT_TRUE(all(a >= Lane(0.0)));
  EXPECT_FALSE(all(a >= Lane(1.0)));
  EXPECT_FALSE(any((a < Lane(3.0)) & (a > Lane(4.0))));
  EXPECT_TRUE(all((a < Lane(4.0)) | (a > Lane(3.0))));
  EXPECT_EQ(sum(a), 28);
}

TEST(Lane, LoadsAndStoresAtAnyAddress) {
  double numbers[k_lanes + 1];
  for (int i = 0; i <= k_lanes; ++i) numbers[i] = i;
  const Lane a = Lane::load(numbers + 1);  // not on a 64-byte border
  double back[k_lanes];
  a.store(back);
  for (int i = 0; i < k_lanes; ++i) EXPECT_EQ(back[i], i + 1);
}

TEST(Tensor, DeviatorHasNoTraceAndVonMisesOfAUniaxialStressIsTheStress) {
  Sym<double> stress;
  stress[0] = 120;
  EXPECT_NEAR(trace(dev(stress)), 0, 1e-13);
  EXPECT_NEAR(von_mises(stress), 120, 1e-13);
  Sym<double> shear;
  shear[4] = 10;
  EXPECT_NEAR(von_mises(shear), 10 * std::sqrt(3.0), 1e-13);
  EXPECT_DOUBLE_EQ(norm(shear), 10 * std::sqrt(2.0));
}

TEST(Tensor, IsotropicTangentActsAsBulkAndShear) {
  const double bulk = 5, twice_shear = 3;
  const auto c = Sym4<double>::isotropic(bulk, twice_shear);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sym<double> strain;
  for (int i = 0; i < 6; ++i) strain[i] = uniform(random);
  const Sym<double> expected = twice_shear * dev(strain) + bulk * trace(strain) * Sym<double>::identity();
  for (int a = 0; a < 6; ++a) {
    double stress = 0;
    for (int b = 0; b < 6; ++b)
      stress += c[a][static_cast<std::size_t>(b)] * (b < 3 ? strain[b] : 2 * strain[b]);  // engineering shear
    EXPECT_NEAR(stress, expected[a], 1e-14);
  }
}

}  // namespace
}  // namespace solidus
