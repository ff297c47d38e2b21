#include "contact/heat_transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/types.hpp"

namespace solidus::contact {
namespace {

using GapLaw = HeatTransferSpec::GapLaw;

HeatTransferSpec monograph_spec() {
  // Table 7.9 in SI: N/(mm s °C) = 1000 W/(m² K), mm = 1e-3 m.
  HeatTransferSpec s;
  s.conductance = 2300;
  s.gap_law = GapLaw::table;
  s.gap_table = Table({0, 6e-5, 1e-4}, {2300, 350, 300});
  return s;
}

HeatTransferSpec gas_spec(double exponent) {
  HeatTransferSpec s;
  s.conductance = 5000;
  s.exponent = exponent;
  s.hardness = 3e8;
  s.gap_law = GapLaw::gas;
  s.open_conductance = 1200;
  s.gas_conductivity = 0.06;
  return s;
}

TEST(HeatTransfer, IsContinuousWhereContactIsLost) {
  std::vector<HeatTransferSpec> laws{monograph_spec(), gas_spec(0.95), gas_spec(0.5)};
  HeatTransferSpec pressure_with_table = monograph_spec();
  pressure_with_table.exponent = 0.95;
  pressure_with_table.hardness = 3e8;
  laws.push_back(pressure_with_table);
  HeatTransferSpec constant;
  constant.conductance = 2300;
  laws.push_back(constant);
  for (const HeatTransferSpec& spec : laws) {
    const HeatTransferLaw law(spec);
    const double at_zero = law.conductance(0, 0);
    // 1 nm of gap changes the steepest table by 1e-4; pressures of 1e-6 Pa conduct (3e-15)^0.5 h_co.
    EXPECT_NEAR(law.conductance(1e-9, 0), at_zero, 1e-4 * at_zero);
    EXPECT_NEAR(law.conductance(1e-12, 0), at_zero, 1e-7 * at_zero);
    EXPECT_NEAR(law.conductance(-1e-15, 1e-6), at_zero, 1e-6 * at_zero);
  }
}

TEST(HeatTransfer, AcrossAGapFollowsTheTableAndStaysConstantBeyondIt) {
  const HeatTransferLaw law(monograph_spec());
  EXPECT_DOUBLE_EQ(law.conductance(3e-5, 0), 0.5 * (2300 + 350));
  EXPECT_DOUBLE_EQ(law.conductance(5e-4, 0), 300);
  EXPECT_DOUBLE_EQ(law.conductance(-1e-6, 1e7), 2300) << "exponent zero: no influence of the pressure";
}

TEST(HeatTransfer, ThroughGasStartsAtTheConductanceOfAGapOfZero) {
  HeatTransferSpec s = gas_spec(0);
  s.open_conductance.reset();  // h_o = h_co
  const HeatTransferLaw law(s);
  EXPECT_DOUBLE_EQ(law.open(0), 5000);
  EXPECT_DOUBLE_EQ(law.open(2e-4), 0.06 / (2e-4 + 0.06 / 5000)) << "3.50";
}

TEST(HeatTransfer, OfTheClosedInterfaceAddsSpotsToGas) {
  const HeatTransferLaw law(gas_spec(0.95));
  EXPECT_DOUBLE_EQ(law.open(1e-4), 0.06 / (1e-4 + 0.06 / 1200));
  EXPECT_DOUBLE_EQ(law.closed(3e7), 1200 + 5000 * std::pow(0.1, 0.95));
}

TEST(HeatTransfer, OfALawThatJumpsOrLacksDataIsRefused) {
  EXPECT_THROW(HeatTransferLaw{gas_spec(0)}, InputError) << "5000 when closed, 1200 at a gap of zero";
  HeatTransferSpec jump = monograph_spec();
  jump.conductance = 2000;
  EXPECT_THROW(HeatTransferLaw{jump}, InputError);
  HeatTransferSpec no_hardness = gas_spec(0.95);
  no_hardness.hardness.reset();
  EXPECT_THROW(HeatTransferLaw{no_hardness}, InputError);
  HeatTransferSpec no_gas = gas_spec(0.95);
  no_gas.gas_conductivity = 0;
  EXPECT_THROW(HeatTransferLaw{no_gas}, InputError);
  HeatTransferSpec bright = monograph_spec();
  bright.slave_emissivity = 1.5;
  EXPECT_THROW(HeatTransferLaw{bright}, InputError);
}

TEST(HeatTransfer, RadiatesBetweenParallelGreySurfaces) {
  HeatTransferSpec s = monograph_spec();
  s.slave_emissivity = 0.3;
  s.master_emissivity = 0.8;
  EXPECT_DOUBLE_EQ(HeatTransferLaw(s).radiation_factor(), k_stefan_boltzmann / (1 / 0.3 + 1 / 0.8 - 1));
  EXPECT_EQ(HeatTransferLaw(monograph_spec()).radiation_factor(), 0);
}

}  // namespace
}  // namespace solidus::contact
