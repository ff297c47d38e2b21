#include "numbers/jet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>  // needs Core before it

namespace solidus {
namespace {

using Ad = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

/// Every operation of a jet, once.
template <class T>
T sample(const T& x) {
  using std::exp, std::log;
  T a = exp(T(T(-0.3) * x)) + log(x) / (T(2.0) + x * x);
  a += power<T>(T(T(1.0) + x), T(T(0.2) + T(0.1) * x));
  a *= T(3.0) - x;
  a -= T(-x) / T(7.0);
  return a;
}

TEST(Jet, CarriesTheFirstTwoDerivativesOfEveryOperation) {
  for (const double x : {0.3, 1.0, 2.7}) {
    // The derivative of each entry by automatic differentiation is the next entry.
    Ad at(x);
    at.derivatives()[0] = 1;
    const Jet<Ad> f = sample(Jet<Ad>::variable(at));
    EXPECT_NEAR(f.v.derivatives()[0], f.d.value(), 1e-14);
    EXPECT_NEAR(f.d.derivatives()[0], f.dd.value(), 1e-13);
    EXPECT_NEAR(f.v.value(), sample(x), 1e-14);
  }
}

TEST(Jet, OfLanesIsAJetInEachLane) {
  Lane x;
  for (int i = 0; i < k_lanes; ++i) x.set(i, 0.2 + 0.4 * i);
  const Jet<Lane> f = sample(Jet<Lane>::variable(x));
  for (int i = 0; i < k_lanes; ++i) {
    const Jet<double> one = sample(Jet<double>::variable(x[i]));
    EXPECT_NEAR(f.v[i], one.v, 1e-14);
    EXPECT_NEAR(f.d[i], one.d, 1e-14);
    EXPECT_NEAR(f.dd[i], one.dd, 1e-13);
  }
}

TEST(Jet, APowerHasTheValueOfAPowerOfNumbers) {
  const Jet<double> x = Jet<double>::variable(1.7), n(50.0);
  EXPECT_EQ(power(x, n).v, std::pow(1.7, 50.0));  // exp(50 ln x) is 20 units in the last place off
}

TEST(Jet, ComparesAndSelectsByValue) {
  const Jet<double> a(1.0, 5.0, 0.0), b(2.0);
  EXPECT_TRUE(a < b);
  EXPECT_TRUE(b > a);
  EXPECT_TRUE(a <= a);
  EXPECT_TRUE(a >= a);
  EXPECT_EQ(select(a < b, a, b).d, 5.0);
  const Jet<Lane> lanes = select(Lane(1.0) < Lane(2.0), Jet<Lane>::variable(Lane(3.0)), Jet<Lane>(Lane(0.0)));
  EXPECT_EQ(lanes.v[3], 3.0);
  EXPECT_EQ(lanes.d[3], 1.0);
}

}  // namespace
}  // namespace solidus
