#include "input/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace solidus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The message of the std::invalid_argument that `f` throws; empty when it does not.
template <class F>
std::string complaint(F f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

struct Accepted {
  const char *text, *unit;
  double value;
};

TEST(Units, ReadTheUnitsOfTheMonographAndOfPractice) {
  const Accepted accepted[] = {{"670 degC", "K", 943.15},
                               {"670 °C", "K", 943.15},
                               {"670°C", "K", 943.15},
                               {"212 degF", "K", 373.15},
                               {"293 K", "K", 293},
                               {"2.3 N/mm/s/K", "W/m2/K", 2300},
                               {"2.3 N/mm/s/degC", "W/m2/K", 2300},
                               {"20 W/m²/K", "W/m2/K", 20},
                               {"20 W/(m2 K)", "W/m2/K", 20},
                               {"20 W m-2 K-1", "W/m2/K", 20},
                               {"69.3E+3 N/mm2", "Pa", 69.3e9},
                               {"69.3e3 N/mm²", "Pa", 69.3e9},
                               {"210 GPa", "Pa", 210e9},
                               {"1.40E+9 mm2/s2/K", "J/kg/K", 1400},
                               {"3.95E+11 mm2/s2", "J/kg", 3.95e5},
                               {"395 kJ/kg", "J/kg", 3.95e5},
                               {"2.65E-9 N s2/mm4", "kg/m3", 2650},
                               {"2.65 g/cm3", "kg/m3", 2650},
                               {"1.0E+7 N s/mm2", "Pa s", 1e13},
                               {"234.46 N/s/degC", "W/m/K", 234.46},
                               {"1.47E-5 1/K", "1/K", 1.47e-5},
                               {"1.47E-5 /K", "1/K", 1.47e-5},
                               {"1.47e-5/°C", "1/K", 1.47e-5},
                               {"14.7 µm/m/K", "1/K", 1.47e-5},
                               {"5 percent", "1", 0.05},
                               {"5 %", "1", 0.05},
                               {"0.3", "1", 0.3},
                               {" +0.3 ", "1", 0.3},
                               {"90 min", "s", 5400},
                               {"-1 mm", "m", -1e-3},
                               {"3.92 kN", "N", 3920}};
  for (const Accepted& a : accepted) {
    double value = 0;
    ASSERT_NO_THROW(value = units::parse_quantity(a.text, a.unit)) << a.text;
    EXPECT_NEAR(value, a.value, 4e-16 * std::abs(a.value)) << a.text;  // two roundings
  }
}

TEST(Units, ATemperatureDifferenceHasNoZeroPoint) {
  EXPECT_DOUBLE_EQ(units::parse_quantity("20 degC", "K", units::Temperature::difference), 20);
  EXPECT_DOUBLE_EQ(units::parse_quantity("18 degF", "K", units::Temperature::difference), 10);
  EXPECT_DOUBLE_EQ(units::parse_quantity("20 degC", "K"), 293.15);
}

TEST(Units, TablesConvertByScaleAndOffset) {
  const auto celsius = units::conversion("degC", "K");
  EXPECT_EQ(celsius.scale, 1);
  EXPECT_EQ(celsius.offset, 273.15);
  EXPECT_DOUBLE_EQ(units::convert(0.35, "N/mm/s/K", "W/m2/K"), 350);
}

TEST(Units, DisplayIsTheInverseOfReading) {
  EXPECT_DOUBLE_EQ(units::to_display(943.15, "K", "degC"), 670);
  EXPECT_DOUBLE_EQ(units::to_display(8e-5, "m", "mm"), 0.08);
  EXPECT_DOUBLE_EQ(units::to_display(20, "K", "degC", units::Temperature::difference), 20);
}

TEST(Units, AnotherDimensionIsRefusedWithTheExpectedOneAndAnExample) {
  const auto message = complaint([] { units::parse_quantity("2.3 W/m/K", "W/m2/K"); });
  EXPECT_EQ(
      message,
      "the unit 'W/m/K' does not fit; expected a heat transfer coefficient, for example \"2.3 N/mm/s/K\"");
  EXPECT_THAT(complaint([] { units::parse_quantity("670", "K"); }),
              HasSubstr("a number without unit does not fit"));
  EXPECT_THAT(complaint([] { units::parse_quantity("0.3 mm", "1"); }),
              HasSubstr("a number without dimension"));
  EXPECT_THAT(complaint([] { units::parse_quantity("5 Hz", "s"); }), HasSubstr("expected a time"));
}

// Data sheets write them so; UDUNITS reads watt per millikelvin and products with kelvin.
TEST(Units, ADivisorWithoutBracketsIsRefusedWithTheUnitThatIsMeant) {
  const auto advice = [](const std::string& unit, const std::string& expected) {
    return complaint([=] { units::parse_quantity("40 " + unit, expected); });
  };
  for (const char* unit : {"W/mK", "W/m K", "W/m.K"})
    EXPECT_THAT(advice(unit, "W/m/K"), AllOf(HasSubstr("'" + std::string(unit) + "' does not fit"),
                                             HasSubstr("needs brackets: \"W/(m K)\"")));
  for (const char* unit : {"W/m2K", "W/m2 K", "W/m2*K"})
    EXPECT_THAT(advice(unit, "W/m2/K"), HasSubstr("\"W/(m2 K)\""));
  EXPECT_THAT(advice("J/kgK", "J/kg/K"), HasSubstr("\"J/(kg K)\""));
  EXPECT_THAT(advice("W/m °C", "W/m/K"), HasSubstr("\"W/(m degC)\""));
  EXPECT_DOUBLE_EQ(units::parse_quantity("40 W/(m K)", "W/m/K"), 40);
  EXPECT_DOUBLE_EQ(units::parse_quantity("40 W/(m degC)", "W/m/K"), 40);
  for (const char* other : {"W/mK", "K", "/K"})
    EXPECT_THAT(advice(other, "W/m2/K"), Not(HasSubstr("brackets")));
}

TEST(Units, WhatIsNoQuantityIsRefusedWithItsText) {
  for (const char* text : {"", "warm", "degC 20", "nan K", "inf K", "1e999 K", "--3 K"})
    EXPECT_THAT(complaint([=] { units::parse_quantity(text, "K"); }),
                HasSubstr("does not begin with a finite number"))
        << text;
  EXPECT_THAT(complaint([] { units::parse_quantity("20 degZ", "K"); }),
              HasSubstr("'degZ' is not a known unit"));
  EXPECT_THAT(complaint([] { units::parse_quantity("1 500 K", "K"); }),
              HasSubstr("'1 500 K' holds two numbers"));
  EXPECT_THAT(complaint([] { units::parse_quantity("1,5 mm", "m"); }),
              HasSubstr("'1,5 mm' has a comma; write a decimal point: '1.5 mm'"));
  EXPECT_THAT(complaint([] { units::parse_quantity("1e308 GPa", "Pa"); }), HasSubstr("too large"));
}

TEST(Units, EveryDimensionWithANameHasAnExampleThatIsAccepted) {
  for (const char* unit : {"1",    "m",     "m2",     "s",    "K",    "kg",  "kg/m3", "m/s",  "m/s2",
                           "N",    "Pa",    "N/m",    "N/m3", "Pa s", "J",   "W",     "J/kg", "J/kg/K",
                           "J/m3", "W/m/K", "W/m2/K", "W/m2", "W/m3", "1/K", "1/s",   "K/s",  "W/m2/K4"}) {
    EXPECT_NO_THROW(units::parse_quantity(units::example(unit), unit)) << unit;
    EXPECT_TRUE(units::compatible(unit, unit));
  }
  EXPECT_EQ(units::dimension_name("K"), "a temperature");
  EXPECT_EQ(units::dimension_name("W/m2/K4"), "a quantity in W/m2/K4");
}

}  // namespace
}  // namespace solidus
