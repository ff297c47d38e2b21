#include "contact/interface/heat_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contact/laws/constant_gap.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/sided_contact.hpp"
#include "contact/laws/spots_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {
namespace {

HeatTransferSpec law_spec(std::shared_ptr<const ContactLaw> closed, std::shared_ptr<const GapLaw> open) {
  HeatTransferSpec s;
  s.contact_law = std::move(closed);
  s.gap_law = std::move(open);
  return s;
}

std::shared_ptr<const GapLaw> table_gap(std::optional<Table> table) {
  return gap_law(TableGap{{}, std::move(table)});
}

HeatTransferSpec monograph_spec() {
  // Table 7.9 in SI: N/(mm s °C) = 1000 W/(m² K), mm = 1e-3 m.
  return law_spec(contact_law(PowerContact{2300}), table_gap(Table({0, 6e-5, 1e-4}, {2300, 350, 300})));
}

HeatTransferSpec gas_spec(double exponent, std::optional<double> open = 1200, double conductivity = 0.06,
                          std::optional<double> hardness = 3e8) {
  return law_spec(contact_law(PowerContact{5000, exponent, hardness}),
                  gap_law(GasGap{.conductivity = conductivity, .open_conductance = open}));
}

/// @param opening  of the gap; negative: closed [m]
double at(const HeatTransferLaw& law, double opening, double pressure, double temperature = 300) {
  return law.at(-opening, pressure, temperature).value;
}

TEST(HeatTransfer, IsContinuousWhereContactIsLost) {
  std::vector<HeatTransferSpec> laws{monograph_spec(), gas_spec(0.95), gas_spec(0.5)};
  HeatTransferSpec pressure_with_table = monograph_spec();
  pressure_with_table.contact_law = contact_law(PowerContact{2300, 0.95, 3e8});
  laws.push_back(pressure_with_table);
  laws.push_back(law_spec(contact_law(PowerContact{2300}), nullptr));
  for (const HeatTransferSpec& spec : laws) {
    const HeatTransferLaw law(spec);
    const double at_zero = at(law, 0, 0);
    // 1 nm of gap changes the steepest table by 1e-4; pressures of 1e-6 Pa conduct (3e-15)^0.5 h_co.
    EXPECT_NEAR(at(law, 1e-9, 0), at_zero, 1e-4 * at_zero);
    EXPECT_NEAR(at(law, 1e-12, 0), at_zero, 1e-7 * at_zero);
    EXPECT_NEAR(at(law, -1e-15, 1e-6), at_zero, 1e-6 * at_zero);
  }
}

// 1/h(g) = 1/(f_c h(0)) + (1/h(g) - 1/h(0))/f_g: the gas of a gap of 0.1 mm alone has 0.06/1e-4 = 600 W/(m²
// K).
TEST(HeatTransfer, FactorsMultiplyContactAndWhatTheGapConductsBeyondIt) {
  HeatTransferSpec spec = gas_spec(0, 5000);
  spec.conductance_factor = 2;
  spec.gap_factor = 1.5;
  const HeatTransferLaw law(spec);
  EXPECT_DOUBLE_EQ(at(law, -1e-6, 1e6), 10000);
  EXPECT_NEAR(at(law, 0, 0), 10000, 1e-9);
  EXPECT_NEAR(at(law, 1e-4, 0), 1 / (1.0 / 10000 + 1 / (1.5 * 600)), 1e-9);
  EXPECT_NEAR(at(law, 1e-9, 0), 10000, 2);
}

TEST(HeatTransfer, WithFactorsHasTheDerivativesOfItsValues) {
  std::vector<HeatTransferSpec> laws{gas_spec(0.95), monograph_spec()};
  laws.front().smooth = true;
  laws.push_back(gas_spec(0, 5000));
  for (HeatTransferSpec spec : laws) {
    spec.conductance_factor = 0.4;
    spec.gap_factor = 1.7;
    const HeatTransferLaw law(spec);
    for (const double gap : {3e-7, 2e-5, 7e-5}) {
      const double d = 1e-3 * gap;
      const double slope = (law.at(-gap + d, 0, 700).value - law.at(-gap - d, 0, 700).value) / (2 * d);
      EXPECT_NEAR(law.at(-gap, 0, 700).by_penetration, slope, 1e-4 * std::abs(slope));
    }
    const double pressed = (law.at(0, 2.1e6, 700).value - law.at(0, 1.9e6, 700).value) / 2e5;
    EXPECT_NEAR(law.at(0, 2e6, 700).by_pressure, pressed, 1e-2 * std::abs(pressed));
  }
}

TEST(HeatTransfer, AcrossAGapFollowsTheTableAndStaysConstantBeyondIt) {
  const HeatTransferLaw law(monograph_spec());
  EXPECT_DOUBLE_EQ(at(law, 3e-5, 0), 0.5 * (2300 + 350));
  EXPECT_DOUBLE_EQ(at(law, 5e-4, 0), 300);
  EXPECT_DOUBLE_EQ(at(law, -1e-6, 1e7), 2300) << "exponent zero: no influence of the pressure";
}

TEST(HeatTransfer, ThroughGasStartsAtTheConductanceOfAGapOfZero) {
  const HeatTransferLaw law(gas_spec(0, {}));  // h_o = h_co
  EXPECT_DOUBLE_EQ(at(law, 0, 0), 5000);
  EXPECT_DOUBLE_EQ(at(law, 2e-4, 0), 0.06 / (2e-4 + 0.06 / 5000)) << "3.50";
}

TEST(HeatTransfer, OfTheClosedInterfaceAddsSpotsToGas) {
  const HeatTransferLaw law(gas_spec(0.95));
  EXPECT_DOUBLE_EQ(at(law, 1e-4, 0), 0.06 / (1e-4 + 0.06 / 1200));
  EXPECT_DOUBLE_EQ(at(law, -1e-9, 3e7), 1200 + 5000 * std::pow(0.1, 0.95));
}

TEST(HeatTransfer, OfALawThatJumpsOrLacksDataIsRefused) {
  EXPECT_THROW(HeatTransferLaw{gas_spec(0)}, InputError) << "5000 when closed, 1200 at a gap of zero";
  HeatTransferSpec jump = monograph_spec();
  jump.contact_law = contact_law(PowerContact{2000});
  EXPECT_THROW(HeatTransferLaw{jump}, InputError);
  EXPECT_THROW(HeatTransferLaw{gas_spec(0.95, 1200, 0.06, {})}, InputError) << "no hardness";
  EXPECT_THROW(HeatTransferLaw{gas_spec(0.95, 1200, 0)}, InputError) << "no gas";
  HeatTransferSpec bright = monograph_spec();
  bright.slave_emissivity = 1.5;
  EXPECT_THROW(HeatTransferLaw{bright}, InputError);
}

SpotsContact spots() {
  return {.asperities = {.roughness = 2e-6,
                         .slope = 0.2,
                         .conductivity = Table({300, 900}, {40, 25}),
                         .hardness_coefficient = 6.27e9,
                         .hardness_exponent = -0.229},
          .hardness = 2.5e9};
}

HeatTransferSpec spots_spec() {
  return law_spec(contact_law(spots()), gap_law(GasGap{.conductivity = 0.03, .temperature_jump = 1.3e-9}));
}

// Tables of the gap and of the pressure at two temperatures, which meet at contact at both.
HeatTransferSpec family_spec() {
  HeatTransferSpec s = law_spec(contact_law(TableContact{}), table_gap({}));
  s.families = {{400, Table({0, 1e7, 1e8}, {1000, 2000, 4000}), Table({0, 5e-5, 1e-4}, {1000, 400, 300})},
                {800, Table({0, 2e7, 1e8}, {1600, 3000, 5000}), Table({0, 4e-5, 1e-4}, {1600, 500, 450})}};
  return s;
}

TEST(HeatTransfer, WithFactorsHasTheDerivativeInTemperature) {
  HeatTransferSpec spec = family_spec();
  spec.conductance_factor = 0.4;
  spec.gap_factor = 1.7;
  const HeatTransferLaw law(spec);
  for (const double gap : {2e-5, 8e-5}) {
    const double warmed = (law.at(-gap, 0, 601).value - law.at(-gap, 0, 599).value) / 2;
    EXPECT_GT(warmed, 0.1);
    EXPECT_NEAR(law.at(-gap, 0, 600).by_temperature, warmed, 1e-4 * warmed);
  }
}

std::vector<HeatTransferSpec> smooth_laws() {
  std::vector<HeatTransferSpec> laws{monograph_spec(), gas_spec(0.95), gas_spec(0.5), spots_spec(),
                                     family_spec()};
  for (HeatTransferSpec& law : laws) {
    law.smooth = true;
    law.transition_gap = 5e-6;
    law.transition_pressure = 2e5;
  }
  return laws;
}

TEST(HeatTransfer, ThroughSpotsAndGasIsTheSumOfBothAndGoesOnAcrossTheGap) {
  const Asperities a = spots().asperities;
  const HeatTransferLaw law(spots_spec());
  const double gas = 0.03 / (a.separation(1e7 / 2.5e9).value + 1.3e-9 * 500);
  EXPECT_DOUBLE_EQ(at(law, -1e-9, 1e7, 500), a.spots(1e7, 500).value + gas) << "3.46";
  const double lost = a.separation(0).value;
  EXPECT_DOUBLE_EQ(at(law, 0, 0, 500), 0.03 / (lost + 1.3e-9 * 500));
  EXPECT_DOUBLE_EQ(at(law, 1e-4, 0, 500), 0.03 / (1e-4 + lost + 1.3e-9 * 500)) << "3.50 with its h_o";
  EXPECT_NEAR(at(law, 1e-12, 0, 500), at(law, -1e-15, 1e-3, 500), 1e-6 * at(law, 0, 0, 500));
}

TEST(HeatTransfer, OfTablesThatChangeWithTheTemperatureIsLinearBetweenThem) {
  const HeatTransferLaw law(family_spec());
  EXPECT_TRUE(law.of_temperature());
  EXPECT_DOUBLE_EQ(at(law, -1e-9, 1e7, 400), 2000);
  EXPECT_DOUBLE_EQ(at(law, -1e-9, 1e7, 800), 2300);
  EXPECT_DOUBLE_EQ(at(law, -1e-9, 1e7, 500), 2075);
  EXPECT_DOUBLE_EQ(at(law, 4e-5, 0, 300), 520) << "the coldest table below its temperature";
  EXPECT_DOUBLE_EQ(at(law, 4e-5, 0, 2000), 500);
}

TEST(HeatTransfer, HasTheDerivativesThatDifferencesShow) {
  std::vector<HeatTransferSpec> laws = smooth_laws();
  for (const HeatTransferSpec& smooth : smooth_laws()) {
    laws.push_back(smooth);
    laws.back().smooth = false;
    laws.back().transition_gap.reset();
    laws.back().transition_pressure.reset();
  }
  for (const HeatTransferSpec& spec : laws) {
    const HeatTransferLaw law(spec);
    for (double temperature : {420.0, 610.0})
      for (double x : {0.13, 0.6, 3.0, 7.3}) {
        const double p = x * 2e5, g = x * 5e-6, dp = 1e-4 * p, dg = 1e-4 * g, dt = 0.1;
        const auto close = [](double derivative, double difference, double size) {
          // Central differences of steps of 1e-4: 1e-8 of the value, and rounding of 1e-12.
          EXPECT_NEAR(derivative, difference, 1e-6 * std::abs(difference) + 1e-11 * size);
        };
        const Conductance pressed = law.at(1e-9, p, temperature), parted = law.at(-g, 0, temperature);
        close(pressed.by_pressure,
              (at(law, -1e-9, p + dp, temperature) - at(law, -1e-9, p - dp, temperature)) / (2 * dp),
              pressed.value / dp);
        close(parted.by_penetration,
              (at(law, g - dg, 0, temperature) - at(law, g + dg, 0, temperature)) / (2 * dg),
              parted.value / dg);
        close(pressed.by_temperature,
              (at(law, -1e-9, p, temperature + dt) - at(law, -1e-9, p, temperature - dt)) / (2 * dt),
              pressed.value / dt);
        close(parted.by_temperature,
              (at(law, g, 0, temperature + dt) - at(law, g, 0, temperature - dt)) / (2 * dt),
              parted.value / dt);
      }
  }
}

TEST(HeatTransfer, ThatIsSmoothHasASlopeThatDoesNotJumpFromContactToGap) {
  for (const HeatTransferSpec& spec : smooth_laws()) {
    const HeatTransferLaw law(spec);
    HeatTransferSpec plain = spec;
    plain.smooth = false;
    plain.transition_gap.reset();
    plain.transition_pressure.reset();
    const HeatTransferLaw rough(plain);
    const double penalty = 1e13, h = at(law, 0, 0, 500);
    // Of the gap, through t_N = −ε_N g, on both sides of contact and of both ends of the transitions.
    const auto slope = [&](double g) {
      const Conductance c = law.at(-g, std::max(0.0, -penalty * g), 500);
      return -c.by_penetration - penalty * c.by_pressure;
    };
    // Steps of 1e-6 of the transitions change slopes by about as much of h over their widths.
    const double gap = *spec.transition_gap, pressed = -*spec.transition_pressure / penalty;
    EXPECT_NEAR(slope(-1e-6 * -pressed), 0, 1e-4 * h / -pressed);
    EXPECT_NEAR(slope(1e-6 * gap), 0, 1e-4 * h / gap);
    EXPECT_NEAR(slope(gap * (1 - 1e-6)), slope(gap * (1 + 1e-6)), 1e-4 * h / gap);
    EXPECT_NEAR(slope(pressed * (1 - 1e-6)), slope(pressed * (1 + 1e-6)), 1e-4 * h / -pressed);
    // Beyond the transitions it is the law itself.
    EXPECT_EQ(at(law, 1.01 * gap, 0, 500), at(rough, 1.01 * gap, 0, 500));
    EXPECT_EQ(at(law, -1e-9, 1.01 * *spec.transition_pressure, 500),
              at(rough, -1e-9, 1.01 * *spec.transition_pressure, 500));
    EXPECT_DOUBLE_EQ(h, at(rough, 0, 0, 500));
  }
}

TEST(HeatTransfer, ThroughBothSidesAddsTheirResistances) {
  HeatTransferSpec spec;
  spec.contact_law = contact_law(PowerContact{2300});
  for (const double share : {0.5, 0.2}) {
    spec.slave_resistance = share;
    const HeatTransferLaw law(spec);
    const double resistance = law.slave_resistance(1e6, 500);
    EXPECT_EQ(resistance, share);
    const OneSided sides = HeatTransferLaw::one_sided(2300, resistance);
    EXPECT_DOUBLE_EQ(1 / sides.slave + 1 / sides.master, 1 / 2300.0);
    EXPECT_DOUBLE_EQ(1 / sides.slave, share / 2300);
    EXPECT_DOUBLE_EQ(HeatTransferLaw::slave_share(resistance), sides.slave / (sides.slave + sides.master));
    EXPECT_EQ(HeatTransferLaw::slave_share(resistance, false), 1) << "a master that takes no heat";
  }
}

/// h_1 and h_2 of 3.45 as laws of their own, at 300 and 900 K.
SidedContact two_sides() {
  SidedContact law;
  law.sides = {{300, Table({0, 1e7}, {1000, 5000}), Table({0, 1e7}, {4000, 8000})},
               {900, Table({0, 1e7}, {2000, 9000}), Table({0, 1e7}, {3000, 4000})}};
  return law;
}

TEST(HeatTransfer, OfTwoSidesHasTheConductanceOfBothAndTheirShareAtEveryPressureAndTemperature) {
  HeatTransferSpec spec = law_spec(contact_law(two_sides()), table_gap({}));
  spec.families = {{300, {}, Table({0, 1e-4}, {800, 100})}, {900, {}, Table({0, 1e-4}, {1200, 200})}};
  const HeatTransferLaw law(spec);
  EXPECT_TRUE(law.of_temperature());
  for (const double pressure : {0.0, 2e6, 9e6})
    for (const double temperature : {300.0, 450.0, 880.0}) {
      const double warmth = (temperature - 300) / 600, pressed = pressure / 1e7;
      const double cold_one = std::lerp(1000, 5000, pressed), cold_two = std::lerp(4000, 8000, pressed);
      const double hot_one = std::lerp(2000, 9000, pressed), hot_two = std::lerp(3000, 4000, pressed);
      const Conductance h = law.at(0, pressure, temperature);
      EXPECT_NEAR(h.value,
                  std::lerp(1 / (1 / cold_one + 1 / cold_two), 1 / (1 / hot_one + 1 / hot_two), warmth),
                  1e-9 * h.value);
      const double share = law.slave_resistance(pressure, temperature);
      EXPECT_NEAR(share, std::lerp(cold_two / (cold_one + cold_two), hot_two / (hot_one + hot_two), warmth),
                  1e-12);
      if (temperature > 300) continue;
      const OneSided sides = HeatTransferLaw::one_sided(h.value, share);
      EXPECT_NEAR(sides.slave, cold_one, 1e-9 * cold_one);
      EXPECT_NEAR(sides.master, cold_two, 1e-9 * cold_two);
    }
  const double p = 3e6, t = 500, dp = 10, dt = 1e-3;
  const Conductance h = law.at(0, p, t);
  EXPECT_NEAR(h.by_pressure, (law.at(0, p + dp, t).value - law.at(0, p - dp, t).value) / (2 * dp),
              1e-6 * h.by_pressure);
  EXPECT_NEAR(h.by_temperature, (law.at(0, p, t + dt).value - law.at(0, p, t - dt).value) / (2 * dt),
              1e-6 * std::abs(h.by_temperature));
  const std::shared_ptr<const ContactLaw> ready = spec.contact_law->ready(false, {}, {});
  const double mixed = (ready->at(p + dp, t).by_temperature - ready->at(p - dp, t).by_temperature) / (2 * dp);
  EXPECT_NEAR(ready->at(p, t).mixed, mixed, 1e-6 * std::abs(mixed));
  spec.contact_law = spec.contact_law->swapped();
  EXPECT_NEAR(HeatTransferLaw(spec).slave_resistance(p, t), 1 - law.slave_resistance(p, t), 1e-12);
}

std::string refusal(const HeatTransferSpec& spec) {
  try {
    const HeatTransferLaw law(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(HeatTransfer, OfTwoSidesSaysWhatIsWrong) {
  const auto of = [](SidedContact law) {
    HeatTransferSpec spec;
    spec.contact_law = contact_law(std::move(law));
    return spec;
  };
  EXPECT_NE(refusal(of({})).find("needs the conductances of both sides"), std::string::npos);
  SidedContact cold_last = two_sides();
  std::swap(cold_last.sides[0], cold_last.sides[1]);
  EXPECT_NE(refusal(of(cold_last)).find("do not increase"), std::string::npos);
  SidedContact without = two_sides();
  without.sides[1].temperature.reset();
  EXPECT_NE(refusal(of(without)).find("has no temperature"), std::string::npos);
  HeatTransferSpec both = of(two_sides());
  both.slave_resistance = 0.5;
  EXPECT_NE(refusal(both).find("'slave_resistance' with a law that has both sides"), std::string::npos);
}

TEST(HeatTransfer, SaysWhatALawLacks) {
  HeatTransferSpec s = spots_spec();
  SpotsContact wrong = spots();
  wrong.asperities.slope = 0;
  s.contact_law = contact_law(wrong);
  EXPECT_NE(refusal(s).find("slope of the asperities"), std::string::npos);
  wrong = spots();
  wrong.hardness.reset();
  s.contact_law = contact_law(wrong);
  EXPECT_NE(refusal(s).find("the gas between spots needs the hardness"), std::string::npos);
  s = spots_spec();
  s.gap_law = gap_law(GasGap{.conductivity = 0.03, .open_conductance = 1000});
  EXPECT_NE(refusal(s).find("follows from their roughness"), std::string::npos);
  s = family_spec();
  s.families[1].gap_table = Table({0, 1e-4}, {1500, 300});
  EXPECT_NE(refusal(s).find("at 800 K"), std::string::npos) << refusal(s);
  s = family_spec();
  std::swap(s.families[0], s.families[1]);
  EXPECT_NE(refusal(s).find("do not increase"), std::string::npos);
  s = family_spec();
  s.gap_law = table_gap(Table(1000.0));
  EXPECT_NE(refusal(s).find("given both"), std::string::npos);
  s = family_spec();
  s.gap_law = gap_law(ConstantGap{});
  EXPECT_NE(refusal(s).find("which needs gap_law"), std::string::npos);
  s = monograph_spec();
  s.gap_law = table_gap({});
  EXPECT_NE(refusal(s).find("needs 'gap_conductance'"), std::string::npos);
  s = monograph_spec();
  s.gap_law = table_gap(Table({0, 1e-6, 2e-6}, {2300, 100, 50}));
  s.smooth = true;
  s.transition_gap = 1.5e-6;
  EXPECT_EQ(refusal(s), "") << "falls all the way";
  s.gap_law = table_gap(Table({0, 1e-6, 2e-6}, {2300, 100, 500}));
  EXPECT_NE(refusal(s).find("bends too much"), std::string::npos);
}

TEST(HeatTransfer, RadiatesBetweenParallelGreySurfaces) {
  HeatTransferSpec s = monograph_spec();
  s.slave_emissivity = 0.3;
  s.master_emissivity = 0.8;
  EXPECT_DOUBLE_EQ(HeatTransferLaw(s).radiation_factor(), k_stefan_boltzmann / (1 / 0.3 + 1 / 0.8 - 1));
  EXPECT_EQ(HeatTransferLaw(monograph_spec()).radiation_factor(), 0);
}

TEST(Radiation, BetweenUnlikeAreasIsThatOfConcentricSurfacesFromBothSides) {
  HeatTransferSpec from_one = monograph_spec(), from_two = monograph_spec();
  from_one.slave_emissivity = from_two.master_emissivity = 0.8;
  from_one.master_emissivity = from_two.slave_emissivity = 0.3;
  const HeatTransferLaw one(from_one), two(from_two);
  for (const double ratio : {0.3, 0.9, 1.0, 1.7, 4.0}) {
    // Per area of the inner surface, the smaller one.
    const double inner = std::min(1.0, ratio), share = inner / std::max(1.0, ratio),
                 closed_form = ratio >= 1 ? 1 / (1 / 0.8 + share * (1 / 0.3 - 1))
                                          : 1 / (1 / 0.3 + share * (1 / 0.8 - 1));
    EXPECT_NEAR(one.radiation_factor(ratio), inner * closed_form * k_stefan_boltzmann,
                1e-12 * k_stefan_boltzmann)
        << ratio;
    EXPECT_NEAR(one.radiation_factor(ratio), ratio * two.radiation_factor(1 / ratio),
                1e-12 * k_stefan_boltzmann)
        << ratio;
    if (ratio == 1) continue;  // where it has a bend
    const double d = 1e-6,
                 slope = (one.radiation_factor(ratio + d) - one.radiation_factor(ratio - d)) / (2 * d);
    EXPECT_NEAR(one.radiation_by_area(ratio), slope, 1e-6 * k_stefan_boltzmann) << ratio;
  }
}

}  // namespace
}  // namespace solidus::contact
