/// [contact.friction] and [contact.wear]: what they mean and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input/document.hpp"
#include "setup/friction_input.hpp"
#include "small_case.hpp"
#include "system/errors.hpp"

namespace solidus::cases {
namespace {

using ::testing::HasSubstr;

contact::FrictionParameters read(const std::string& keys) {
  return setup::friction_spec(friction_keys().read(parse_document(keys, "case.toml")));
}
double coefficient(const std::string& keys, double zeta, double theta) {
  return contact::FrictionCoefficient(read(keys).coefficient).value(zeta, theta).value;
}
std::string error(const std::string& keys) {
  try {
    read(keys);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

const std::string k_curves = R"([[curve]]
temperature = "20 degC"
internal_variable = [0, 4]
coefficient = [0.2, 0.4]
[[curve]]
temperature = "120 degC"
internal_variable = [0, 2]
coefficient = [0.1, 0.3]
)";

TEST(FrictionKeys, ANumberIsAConstantCoefficient) {
  const auto spec = read("coefficient = 0.3\n");
  EXPECT_DOUBLE_EQ(coefficient("coefficient = 0.3\n", 1e9, 400), 0.3);
  EXPECT_EQ(spec.internal_variable, contact::InternalVariable::normal_work);
  EXPECT_FALSE(spec.tangential_penalty);
  EXPECT_EQ(spec.tangential_penalty_factor, 1);
  EXPECT_FALSE(spec.symmetric);
}

TEST(FrictionKeys, ATableIsACoefficientOfTemperature) {
  EXPECT_DOUBLE_EQ(
      coefficient("coefficient = { of = \"temperature\", argument_unit = \"degC\", unit = \"1\", "
                  "points = [[0, 0.3], [100, 0.1]] }\n",
                  5, 323.15),
      0.2);
}

TEST(FrictionKeys, AListIsAPolynomialOfTheInternalVariableInItsUnit) {
  EXPECT_DOUBLE_EQ(
      coefficient("coefficient = [0.178, -0.666e-2]\ninternal_variable_unit = \"kN/mm\"\n", 2e6, 300),
      0.178 - 2 * 0.666e-2);
  EXPECT_DOUBLE_EQ(coefficient("coefficient = [0.2, 0.01]\ninternal_variable = \"slip\"\n"
                               "internal_variable_unit = \"mm\"\n",
                               0.005, 300),
                   0.25);
  const std::string thermal =
      "coefficient = [0.2, { of = \"temperature\", argument_unit = \"K\", unit = \"1\", points = [[300, "
      "0.1], "
      "[400, 0.3]] }]\n";
  EXPECT_DOUBLE_EQ(coefficient(thermal, 2, 350), 0.2 + 2 * 0.2);
}

TEST(FrictionKeys, CurvesOverTheInternalVariableMayDependOnTemperature) {
  EXPECT_DOUBLE_EQ(coefficient(k_curves, 1, 343.15), 0.5 * (0.25 + 0.2));
  EXPECT_DOUBLE_EQ(coefficient("[[curve]]\ninternal_variable = [0, 4]\ncoefficient = [0.2, 0.4]\n", 1, 900),
                   0.25);
}

TEST(FrictionKeys, WhatMakesNoLawIsRefused) {
  EXPECT_THAT(error("symmetric = true\n"), HasSubstr("no coefficient of friction"));
  EXPECT_THAT(error("coefficient = 0.2\n" + k_curves), HasSubstr("two coefficients"));
  EXPECT_THAT(error("coefficient = -0.2\n"), HasSubstr("above zero"));
  EXPECT_THAT(error("coefficient = 0.2\ninternal_variable_unit = \"mm\"\n"), HasSubstr("no unit of work"));
  EXPECT_THAT(error("coefficient = 0.2\ninternal_variable = \"slip\"\ninternal_variable_unit = \"kN/mm\"\n"),
              HasSubstr("as \"mm\""));
  EXPECT_THAT(error("coefficient = { of = \"temperature\", argument_unit = \"K\", unit = \"1\", points = "
                    "[[300, 0.1], [400, 0.3]] }\n"),
              HasSubstr("3.60"));
  EXPECT_THAT(error(k_curves + "[[curve]]\ninternal_variable = [0]\ncoefficient = [0.1]\n"),
              HasSubstr("has no temperature"));
  EXPECT_THAT(error("[[curve]]\ninternal_variable = [0, 1]\ncoefficient = [0.1]\n"), HasSubstr("as many"));
  EXPECT_THAT(error("[[curve]]\ninternal_variable = [0, 0]\ncoefficient = [0.1, 0.1]\n"),
              HasSubstr("not beyond the point before"));
}

TEST(WearKeys, HardnessMayDependOnTemperature) {
  const auto wear = setup::wear_spec(wear_keys().read(
      parse_document("archard = 1e-4\nhardness = { of = \"temperature\", argument_unit = \"K\", unit = "
                     "\"MPa\", points = [[300, 2000], [500, 1000]] }\n",
                     "case.toml")));
  EXPECT_DOUBLE_EQ(wear.depth_increment(1e7, 0.1, 400), 1e-4 * 1e7 * 0.1 / 1.5e9);
}

TEST(WearKeys, TheMastersShareIsNoneUnlessGivenAndAtMostAll) {
  const std::string keys = "archard = 1e-4\nhardness = \"1 GPa\"\n";
  const auto share = [&](const std::string& more) {
    return setup::wear_spec(wear_keys().read(parse_document(keys + more, "case.toml"))).master_share;
  };
  EXPECT_EQ(share(""), 0);
  EXPECT_EQ(share("master_share = 0.25\n"), 0.25);
  EXPECT_THROW(share("master_share = 1.5\n"), InputError);
}

/// Error message for a contact with these keys.
std::string contact_error(const std::string& keys) {
  try {
    return test::refusal(test::bar_case("[[contact]]\nname = \"c\"\nslave = \"a\"\nmaster = \"b\"\n" + keys));
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(ContactKeys, ThatWouldChangeNothingAreRefused) {
  EXPECT_THAT(contact_error("smoothing = true\n"), HasSubstr("smoothing"));
  EXPECT_THAT(contact_error("penetration_tolerance = 1e-8\n"), HasSubstr("penetration_tolerance"));
  EXPECT_THAT(contact_error("[contact.interface]\nheat_capacity = \"500 J/m2/K\"\n"),
              HasSubstr("the interface of the contact 'c' stores heat, but nothing conducts heat to it"));
}

}  // namespace
}  // namespace solidus::cases
