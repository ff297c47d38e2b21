#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "numbers/simd.hpp"

namespace solidus {
namespace {

constexpr int k_arguments = 100'000;
constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

/// |result - exact| in units in the last place of the exact number, which a long double holds to 64 bits.
/// Where that rounds to infinity only infinity is right.
double ulps(double result, long double exact) {
  const double rounded = static_cast<double>(exact);
  if (std::isinf(rounded) || std::isinf(result)) return result == rounded ? 0 : k_infinity;
  int exponent;
  std::frexp(rounded, &exponent);
  const double unit = std::ldexp(1.0, std::max(exponent - 53, -1074));
  return static_cast<double>(std::abs(result - exact) / unit);
}

/// The largest error of `of_lane(x, a)` against `exact(x, a)` over random pairs of arguments.
template <class Draw, class OfLane, class Exact>
double largest_error(Draw draw, OfLane of_lane, Exact exact) {
  std::mt19937_64 random(20240607);
  double largest = 0;
  for (int i = 0; i < k_arguments / k_lanes; ++i) {
    Lane x, a;
    for (int lane = 0; lane < k_lanes; ++lane) {
      const auto [p, q] = draw(random);
      x.set(lane, p);
      a.set(lane, q);
    }
    const Lane result = of_lane(x, a);
    for (int lane = 0; lane < k_lanes; ++lane) {
      const double error =
          ulps(result[lane], exact(static_cast<long double>(x[lane]), static_cast<long double>(a[lane])));
      if (!(error <= largest)) largest = error;  // a NaN stays
    }
  }
  return largest;
}

auto uniform(double low, double high) {
  return [=](auto& random) { return std::pair(std::uniform_real_distribution(low, high)(random), 0.0); };
}
/// Uniform exponents of two.
auto spread(double low, double high) {
  return [=](auto& random) { return std::pair(std::exp2(uniform(low, high)(random).first), 0.0); };
}

// The bounds are the largest errors that two million arguments gave, rounded up a little: 1.02, 0.83, 1.18.
constexpr double k_exp_bound = 1.1, k_log_bound = 0.9, k_pow_bound = 1.25;

double error_of_exp(auto draw) {
  return largest_error(
      draw, [](Lane x, Lane) { return exp(x); }, [](long double x, long double) { return std::exp(x); });
}
double error_of_log(auto draw) {
  return largest_error(
      draw, [](Lane x, Lane) { return log(x); }, [](long double x, long double) { return std::log(x); });
}
double error_of_pow(auto draw) {
  return largest_error(
      draw, [](Lane x, Lane a) { return pow(x, a); },
      [](long double x, long double a) { return std::pow(x, a); });
}

TEST(LaneMath, ExpIsRightToAboutOneUnitInTheLastPlace) {
  EXPECT_LT(error_of_exp(uniform(-1, 1)), k_exp_bound);
  EXPECT_LT(error_of_exp(uniform(-708, 709.7)), k_exp_bound);
  EXPECT_LT(error_of_exp(spread(-80, 0)), k_exp_bound);
}

TEST(LaneMath, ExpUnderflowsGraduallyAndOverflowsWhereTheNumbersEnd) {
  EXPECT_LT(error_of_exp(uniform(-746, -708)), k_exp_bound);
  EXPECT_LT(error_of_exp(uniform(-2000, 2000)), k_exp_bound);
  EXPECT_LT(error_of_exp(uniform(709.7, 709.9)), k_exp_bound);
}

TEST(LaneMath, LogIsRightToOneUnitInTheLastPlace) {
  EXPECT_LT(error_of_log(uniform(0.5, 2)), k_log_bound);
  EXPECT_LT(error_of_log(uniform(0.999, 1.001)), k_log_bound);
  EXPECT_LT(error_of_log(uniform(0, 1e6)), k_log_bound);
  EXPECT_LT(error_of_log(spread(-1074, 1024)), k_log_bound);
}

TEST(LaneMath, PowIsRightToAboutOneUnitInTheLastPlaceForBasesAndExponentsOfLaws) {
  EXPECT_LT(error_of_pow([](auto& random) {
              return std::pair(spread(-100, 100)(random).first, spread(-4.33, 5.65)(random).first);
            }),
            k_pow_bound);
  EXPECT_LT(error_of_pow([](auto& random) {
              return std::pair(uniform(0, 1)(random).first, uniform(0.05, 50)(random).first);
            }),
            k_pow_bound);
}

TEST(LaneMath, PowKeepsItsDigitsForLargeExponents) {
  EXPECT_LT(error_of_pow([](auto& random) {
              return std::pair(uniform(0.5, 2)(random).first, uniform(-1000, 1000)(random).first);
            }),
            k_pow_bound);
  EXPECT_LT(error_of_pow([](auto& random) {
              return std::pair(1 + uniform(-1e-6, 1e-6)(random).first, uniform(-7e8, 7e8)(random).first);
            }),
            k_pow_bound);
  EXPECT_LT(error_of_pow([](auto& random) {
              return std::pair(spread(-1074, 1024)(random).first, uniform(-3, 3)(random).first);
            }),
            k_pow_bound);
}

TEST(LaneMath, PowWithOneExponentForAllLanesIsPowWithThatLane) {
  Lane x;
  for (int i = 0; i < k_lanes; ++i) x.set(i, 0.3 + 0.7 * i);
  for (int i = 0; i < k_lanes; ++i) EXPECT_EQ(pow(x, 2.7)[i], pow(x, Lane(2.7))[i]);
}

TEST(LaneMath, ExpAndLogKnowTheirLimits) {
  const auto exp_of = [](double x) { return exp(Lane(x))[k_lanes - 1]; };
  EXPECT_EQ(exp_of(0.0), 1);
  EXPECT_EQ(exp_of(-0.0), 1);
  EXPECT_EQ(exp_of(-k_infinity), 0);
  EXPECT_EQ(exp_of(-1e300), 0);
  EXPECT_EQ(exp_of(k_infinity), k_infinity);
  EXPECT_EQ(exp_of(1e300), k_infinity);
  EXPECT_TRUE(std::isnan(exp_of(k_nan)));

  const auto log_of = [](double x) { return log(Lane(x))[k_lanes - 1]; };
  EXPECT_EQ(log_of(1), 0);
  EXPECT_EQ(log_of(0.0), -k_infinity);
  EXPECT_EQ(log_of(-0.0), -k_infinity);
  EXPECT_EQ(log_of(k_infinity), k_infinity);
  EXPECT_TRUE(std::isnan(log_of(-1)));
  EXPECT_TRUE(std::isnan(log_of(-k_infinity)));
  EXPECT_TRUE(std::isnan(log_of(k_nan)));
}

TEST(LaneMath, PowOfLimitsIsThatOfTheStandardLibrary) {
  for (const double x : {0.0, 5e-324, 0.5, 1.0, 2.0, 1e308, k_infinity})
    for (const double a :
         {0.0, 1e-200, 0.05, 1.0, 50.0, 1e300, k_infinity, -1e-200, -1.0, -1e300, -k_infinity})
      EXPECT_LT(ulps(pow(Lane(x), a)[0], std::pow(static_cast<long double>(x), a)), k_pow_bound)
          << x << "^" << a;
}

TEST(LaneMath, PowOfANegativeBaseOrOfNotANumberIsNotANumber) {
  EXPECT_TRUE(std::isnan(pow(Lane(-1e-300), 0.5)[0]));
  EXPECT_TRUE(std::isnan(pow(Lane(-2.0), 2.0)[0]));
  EXPECT_TRUE(std::isnan(pow(Lane(k_nan), 0.0)[0]));
  EXPECT_TRUE(std::isnan(pow(Lane(1.0), k_nan)[0]));
}

TEST(LaneMath, SqrtIsCorrectlyRounded) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const double x = spread(-1074, 1024)(random).first;
    EXPECT_EQ(sqrt(Lane(x))[i % k_lanes], std::sqrt(x));
  }
  EXPECT_TRUE(std::isnan(sqrt(Lane(-1.0))[0]));
}

TEST(LaneMath, LanesDoNotTouchEachOther) {
  const double guests[] = {0.0, -1.0, k_infinity, -k_infinity, k_nan, 1e300, -1e300, 5e-324};
  for (int own = 0; own < k_lanes; ++own) {
    Lane x, a;
    for (int i = 0; i < k_lanes; ++i) {
      x.set(i, guests[i]);
      a.set(i, guests[k_lanes - 1 - i]);
    }
    x.set(own, 1.7);
    a.set(own, 3.1);
    EXPECT_EQ(exp(x)[own], exp(Lane(1.7))[0]);
    EXPECT_EQ(log(x)[own], log(Lane(1.7))[0]);
    EXPECT_EQ(sqrt(x)[own], std::sqrt(1.7));
    EXPECT_EQ(pow(x, a)[own], pow(Lane(1.7), 3.1)[0]);
  }
}

}  // namespace
}  // namespace solidus
