#include "input/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

double value(const std::string& text, double x = 0, double t = 0, const Formula::Constants& constants = {}) {
  return Formula(text, {"x", "t"}, constants).value(std::array{x, t});
}

TEST(Formula, FollowsTheRulesOfArithmetic) {
  EXPECT_DOUBLE_EQ(value("2 + 3*x^2", 4), 50);
  EXPECT_DOUBLE_EQ(value("-x^2", 3), -9);
  EXPECT_DOUBLE_EQ(value("log(e) + ln(e) + log10(100) + log2(8) + atan2(0, 1)"), 7);
  EXPECT_DOUBLE_EQ(value("sin(pi/2) + e^0 + sqrt(abs(-9))"), 5);
  EXPECT_DOUBLE_EQ(value("min(x, t, 7) + max(x, t)", 3, 5), 8);
}

TEST(Formula, ComparisonsAreOneOrZero) {
  EXPECT_EQ(value("3000 * (x < 0.1)", 0.05), 3000);
  EXPECT_EQ(value("3000 * (x < 0.1)", 0.15), 0);
  EXPECT_EQ(value("x > 1 && t > 1 ? 5 : 7", 2, 2), 5);
  EXPECT_EQ(value("x > 1 && t > 1 ? 5 : 7", 2, 0), 7);
}

TEST(Formula, AConditionEvaluatesTheBranchThatItTakes) {
  EXPECT_EQ(value("x > 0 ? 1/x : 0", 0), 0);
}

TEST(Formula, IsNotFiniteWhereItIsNotDefined) {
  EXPECT_FALSE(std::isfinite(value("1/x", 0)));
  EXPECT_FALSE(std::isfinite(value("sqrt(x)", -1)));
  EXPECT_FALSE(std::isfinite(value("log(x)", 0)));
}

TEST(Formula, KnowsConstantsAndWhichVariablesItUses) {
  const Formula f("x - v*1", {"x", "t"}, {{"v", 0.5}});
  EXPECT_DOUBLE_EQ(f.value(std::array{2.0, 9.0}), 1.5);
  EXPECT_TRUE(f.uses(0));
  EXPECT_FALSE(f.uses(1));
}

TEST(Formula, SaysWhatItDoesNotKnowAndWhatThereIs) {
  EXPECT_THAT(
      [] {
        value("3*speed*t", 0, 0, {{"sped", 1.0}});
      },
      ThrowsMessage<std::invalid_argument>(
          AllOf(HasSubstr("'speed' is not known at character 3"), HasSubstr("did you mean 'sped'"))));
  EXPECT_THAT([] { value("3*(x"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("parenthesis")));
  EXPECT_THROW(value(""), std::invalid_argument);
  EXPECT_THAT([] { value("x, t"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("2 values")));
  EXPECT_THAT([] { value("x = 3"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("'=='")));
  EXPECT_EQ(value("(x == 3) + (x <= 3) + (x >= 3) + (x != 3)", 3), 3);
}

}  // namespace
}  // namespace solidus
