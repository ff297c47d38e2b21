/// [vary] and [spread] of a case, and the spreads of the library of interface laws.
#include "cases/variation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "cases/case_materials.hpp"
#include "cases/interface_library.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "material/cards/library.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string k_air = R"([[thermal_condition]]
name = "air"
group = "x_max"
kind = "film"
coefficient = { of = "time", argument_unit = "s", unit = "W/m2/K", points = [[0, 10], [5, 30]] }
ambient = "20 degC"
)";

std::string error(const std::string& more) {
  try {
    CaseSpec spec = test::bar_case(k_air + more);
    vary_conditions(spec);
    vary_contacts(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Vary, MovesConditionsAndTheStart) {
  CaseSpec spec = test::bar_case(k_air + R"([vary.body.bar]
initial_temperature = "-7 K"
[vary.thermal_condition.air]
coefficient = 1.5
temperature = "4 degC"
)");
  vary_conditions(spec);
  EXPECT_DOUBLE_EQ(spec.bodies[0].initial_temperature.table.value(0), 593);
  EXPECT_DOUBLE_EQ(spec.thermal_conditions[0].coefficient.table.value(0), 15);
  EXPECT_DOUBLE_EQ(spec.thermal_conditions[0].coefficient.table.value(5), 45);
  EXPECT_DOUBLE_EQ(spec.thermal_conditions[0].ambient.table.value(0), 297.15);
}

TEST(Vary, ReachesTheMaterialOfTheBodyItNames) {
  CaseSpec spec = test::bar_case("[vary.body.bar]\nconductivity = 1.3\n");
  spec.bodies[0].material = "green_sand";
  spec.analysis.physics = Physics::heat;
  const double given = material::find_material("green_sand", material_folders()).conductivity.value(500);
  EXPECT_DOUBLE_EQ(load_materials(spec)[0].conductivity.value(500), 1.3 * given);
}

TEST(Vary, RefusesWhatTheCaseHasNot) {
  EXPECT_EQ(error("[vary.body.bar]\ndensity = 1.1\n"), "");
  EXPECT_THAT(
      error("[vary.body.bra]\ndensity = 1.1\n"),
      AllOf(HasSubstr("case.toml:"), HasSubstr("no body named 'bra'"), HasSubstr("did you mean 'bar'")));
  EXPECT_THAT(error("[vary.body.bar]\ndensity = -1.1\n"), HasSubstr("-1.1"));
  EXPECT_THAT(error("[vary.thermal_condition.wind]\ncoefficient = 1.1\n"), HasSubstr("no thermal condition"));
  EXPECT_THAT(error("[vary.contact.wall]\nconductance = 1.1\n"), HasSubstr("no contact named 'wall'"));
  EXPECT_THAT(error("[spread.body.bra]\ndensity = { relative = 0.1, estimate = true }\n"),
              HasSubstr("no body named 'bra'"));
  EXPECT_THAT(error("[spread.body.bar]\ninitial_temperature = { relative = 0.1, estimate = true }\n"),
              AllOf(HasSubstr("case.toml:"), HasSubstr("'initial_temperature' of 'bar' is a temperature")));
}

TEST(InterfaceLibrary, EveryCardSaysHowFarItsLawMayBeOff) {
  const std::vector<InterfaceCard> cards = interface_cards();
  EXPECT_GE(cards.size(), 19u);
  for (const InterfaceCard& card : cards) {
    ASSERT_TRUE(card.spread.conductance && card.spread.conductance->factor) << card.name;
    EXPECT_GT(*card.spread.conductance->factor, 1) << card.name;
    const contact::HeatTransferLaw law(card.heat);
    const bool falls = law.at(-1e-4, 0, 600).value < 0.99 * law.at(0, 0, 600).value;
    EXPECT_EQ(card.spread.gap.has_value(), falls) << card.name;
  }
}

}  // namespace
}  // namespace solidus::cases
