#include "numbers/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace solidus {
namespace {

/// ∫ by 2-point Gauss on many parts: an independent check; exact for linear pieces whose bends lie on part
/// borders.
template <class F>
double quadrature(const F& f, double a, double b, int parts) {
  const double h = (b - a) / parts, g = 0.5 / std::sqrt(3.0);
  double total = 0;
  for (int i = 0; i < parts; ++i) {
    const double middle = a + (i + 0.5) * h;
    total += 0.5 * h * (f(middle - g * h) + f(middle + g * h));
  }
  return total;
}

const Table k_uneven({300, 310, 310.5, 700, 1500}, {4, 5, 3, 8, 2});

TEST(Table, InterpolatesLinearlyAndIsExactAtItsPoints) {
  for (std::size_t i = 0; i < k_uneven.x().size(); ++i)
    EXPECT_EQ(k_uneven.value(k_uneven.x()[i]), k_uneven.y()[i]);
  EXPECT_DOUBLE_EQ(k_uneven.value(305), 4.5);
  EXPECT_DOUBLE_EQ(k_uneven.value(310.25), 4);
  EXPECT_DOUBLE_EQ(k_uneven.value(1100), 5);
}

TEST(Table, FindsTheSamePieceAsASearchForTablesOfAnySpacing) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const int points : {2, 3, 10, 300, 6000}) {
    std::vector<double> x{300.0}, y{uniform(random)};
    for (int i = 1; i < points; ++i) {
      x.push_back(x.back() + std::pow(10.0, -6 * uniform(random)));  // pieces from a micro- to a whole kelvin
      y.push_back(uniform(random));
    }
    const Table table(x, y);
    for (int k = 0; k < 2000; ++k) {
      const double at = x.front() + uniform(random) * (x.back() - x.front());
      const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
      const double slope = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
      ASSERT_DOUBLE_EQ(table.derivative(at), slope) << points << " points at " << at;
      // To the rounding of a product and a sum, which a fused multiply-add rounds together.
      ASSERT_NEAR(table.value(at), y[i] + slope * (at - x[i]), 1e-15 * (std::abs(y[i]) + std::abs(y[i + 1])));
    }
  }
}

TEST(Table, DerivativeAtAPointIsTheRightHandOneAndTheLeftHandOneAtTheEnd) {
  EXPECT_DOUBLE_EQ(k_uneven.derivative(300), 0.1);
  EXPECT_DOUBLE_EQ(k_uneven.derivative(310), -4);
  EXPECT_DOUBLE_EQ(k_uneven.derivative(1500), -6.0 / 800);
  EXPECT_EQ(k_uneven.derivative(299), 0);
  EXPECT_EQ(k_uneven.derivative(1501), 0);
}

TEST(Table, ContinuesAsItsPolicySays) {
  const std::vector<double> x{0, 1, 2}, y{1, 3, 4};
  const Table constant(x, y), linear(x, y, Extrapolation::linear), error(x, y, Extrapolation::error);
  EXPECT_EQ(constant.value(-1), 1);
  EXPECT_EQ(constant.value(5), 4);
  EXPECT_DOUBLE_EQ(linear.value(-1), -1);
  EXPECT_DOUBLE_EQ(linear.value(5), 7);
  EXPECT_DOUBLE_EQ(linear.derivative(5), 1);
  EXPECT_EQ(error.value(5), 4);
  EXPECT_TRUE(error.outside(5));
  EXPECT_TRUE(error.outside(-0.1));
  EXPECT_FALSE(error.outside(2));
  EXPECT_FALSE(constant.outside(5));
  EXPECT_FALSE(linear.outside(5));
}

TEST(Table, IntegralsAgreeWithQuadratureInsideAcrossAndOutside) {
  for (const auto policy : {Extrapolation::constant, Extrapolation::linear}) {
    const Table table({300, 400, 700, 900}, {4, 5, 3, 8}, policy);
    const std::pair<double, double> ranges[] = {{320, 380}, {350, 850},   {100, 1300},
                                                {100, 200}, {1000, 1200}, {850, 350}};
    for (const auto& [a, b] : ranges) {
      // 12000 parts: bends fall on borders, and the error of y/x is (h/x)⁴ < 1e-12
      EXPECT_NEAR(table.integral(a, b), quadrature([&](double x) { return table.value(x); }, a, b, 12000),
                  1e-8);
      EXPECT_NEAR(table.integral_over_x(a, b),
                  quadrature([&](double x) { return table.value(x) / x; }, a, b, 12000), 1e-10);
    }
  }
}

TEST(Table, IntegralOverAShortStepKeepsItsDigits) {
  const Table table({300, 1300}, {500, 700});
  const double a = 800, b = a + 1e-9;  // a difference of two long integrals would keep six digits
  EXPECT_NEAR(table.integral(a, b) / ((b - a) * table.value(a)), 1, 1e-12);
  EXPECT_NEAR(table.integral_over_x(a, b) / ((b - a) * table.value(a) / a), 1, 1e-11);
}

TEST(Table, LanesAnswerAsNumbersDoForShortAndLongTablesInsideOutsideAndAtThePoints) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(200, 1600);
  for (const auto policy : {Extrapolation::constant, Extrapolation::linear}) {
    const Table few({300, 310, 310.5, 700, 1500}, {4, 5, 3, 8, 2}, policy);
    std::vector<double> x, y;
    for (int i = 0; i < 20; ++i) {
      x.push_back(300 + 3 * i * i);
      y.push_back(uniform(random));
    }
    for (const Table& table : {few, Table(x, y, policy)})
      for (int k = 0; k < 200; ++k) {
        Lane at;
        for (int i = 0; i < k_lanes; ++i) {
          const auto point = static_cast<std::size_t>(k * k_lanes + i);
          at.set(i, point < table.x().size() ? table.x()[point] : uniform(random));
        }
        const auto line = table.line(at);
        for (int i = 0; i < k_lanes; ++i) {
          // rounding: a compiler may fuse multiply and add in one of the two
          ASSERT_NEAR(table.value(at)[i], table.value(at[i]), 1e-14 * (1 + std::abs(at[i]))) << at[i];
          ASSERT_EQ(table.derivative(at)[i], table.derivative(at[i])) << at[i];
          ASSERT_NEAR(line.value[i], table.line(at[i]).value, 1e-14 * (1 + std::abs(at[i])));
          ASSERT_EQ(line.slope[i], table.line(at[i]).slope);
        }
      }
  }
}

TEST(Table, ASinglePointOrANumberIsAConstant) {
  const Table number = 7.0, point({300}, {7});
  for (const Table& table : {number, point}) {
    EXPECT_TRUE(table.constant());
    EXPECT_EQ(table.value(-1e30), 7);
    EXPECT_EQ(table.derivative(300), 0);
    EXPECT_DOUBLE_EQ(table.integral(2, 5), 21);
    EXPECT_DOUBLE_EQ(table.integral_over_x(2, 5), 7 * std::log(2.5));
    EXPECT_EQ(table.value(Lane(3.0))[5], 7);
    EXPECT_EQ(table.scaled(2).value(1), 14);
  }
}

TEST(Table, ScalingMultipliesValuesSlopesAndIntegrals) {
  const Table twice = k_uneven.scaled(2);
  EXPECT_DOUBLE_EQ(twice.value(555), 2 * k_uneven.value(555));
  EXPECT_DOUBLE_EQ(twice.derivative(555), 2 * k_uneven.derivative(555));
  EXPECT_DOUBLE_EQ(twice.integral(100, 999), 2 * k_uneven.integral(100, 999));
  EXPECT_EQ(twice.max_value(), 16);
  EXPECT_EQ(twice.min_value(), 4);
}

TEST(Table, RefusesWhatIsNoFunction) {
  const double nan = std::nan("");
  EXPECT_THROW(Table({1, 2}, {1}), std::invalid_argument);
  EXPECT_THROW(Table({}, {}), std::invalid_argument);
  EXPECT_THROW(Table({1, 1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(Table({2, 1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(Table({1, 2}, {1, nan}), std::invalid_argument);
  EXPECT_THROW(Table({1, nan}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(Table(1.0 / 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace solidus
