#include "material/melt.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "material/elasticity.hpp"
#include "material/laws/perzyna.hpp"
#include "sample_material.hpp"

namespace solidus::material {
namespace {

using ::testing::HasSubstr;

/// Freezes, and leaves the viscosity of its melt open.
Material open_melt() {
  Material m = sample_material();
  m.liquid_viscosity = Table();
  return m;
}

TEST(MeltModulus, IsTenMetallostaticHeads) {
  const Material m = open_melt();
  const MeltModulus tall = melt_modulus(m, 9.81, 2.0, 0.01);
  EXPECT_EQ(tall.bound, MeltModulus::Bound::head);
  EXPECT_DOUBLE_EQ(tall.reference, m.density * 9.81 * 2.0);
  EXPECT_DOUBLE_EQ(tall.modulus, 10 * tall.reference);
  EXPECT_EQ(tall.extent, 2.0);
  EXPECT_THAT(measured_against(tall), HasSubstr("metallostatic head"));
}

TEST(MeltModulus, WithoutGravityIsTenTimesAKilopascal) {
  const MeltModulus melt = melt_modulus(open_melt(), 0, 0, 0.01);
  EXPECT_EQ(melt.bound, MeltModulus::Bound::weightless);
  EXPECT_DOUBLE_EQ(melt.modulus, 10 * 1e3);
  EXPECT_EQ(melt.extent, 0);
}

TEST(MeltModulus, ViscosityIsThatOfAHundredthOfTheTimeThatHeatTakesAcrossTheSection) {
  Material m = open_melt();
  m.conductivity = Table(80.0);
  m.specific_heat = Table(1000.0);
  const double diffusivity = 80 / (m.density * 1000);
  const MeltModulus thick = melt_modulus(m, 9.81, 2.0, 0.02), thin = melt_modulus(m, 9.81, 2.0, 0.01);
  EXPECT_DOUBLE_EQ(thick.time, 0.01 * 0.02 * 0.02 / diffusivity);
  EXPECT_DOUBLE_EQ(thick.time, 4 * thin.time);
  // Steps have one and the same melt but for those that the arithmetic cannot resolve.
  for (const double dt : {1e-3, 1e-2})
    EXPECT_DOUBLE_EQ(thick.viscosity(dt), thick.modulus * thick.time) << dt;
  EXPECT_DOUBLE_EQ(thick.viscosity(1e9), 1e-8 * thick.bulk * 1e9);
  EXPECT_DOUBLE_EQ(thick.viscosity(1e-9), 1e-2 * thick.bulk * 1e-9);
}

TEST(MeltModulus, IsNoMoreThanTheStrengthOfTheShell) {
  Material m = open_melt();
  m.flow.emplace();
  m.flow->rate[Perzyna::viscosity] = Table(1e9);
  m.flow->flow_stress = Table(1e5);
  const MeltModulus shell = melt_modulus(m, 9.81, 10.0, 0.01);
  EXPECT_EQ(shell.bound, MeltModulus::Bound::strength);
  EXPECT_DOUBLE_EQ(shell.modulus, 1e5);
  EXPECT_THAT(measured_against(shell), HasSubstr("strength of the shell"));
}

TEST(MeltModulus, IsNoLessThanTheArithmeticStands) {
  const Material m = open_melt();
  const MeltModulus flat = melt_modulus(m, 9.81, 1e-6, 0.01);
  EXPECT_EQ(flat.bound, MeltModulus::Bound::arithmetic);
  EXPECT_DOUBLE_EQ(flat.modulus, 1e-7 * flat.reference);
  EXPECT_THAT(measured_against(flat), HasSubstr("bulk modulus"));
}

TEST(MeltModulus, IsLeftToTheMaterialThatGivesAViscosityOrHasAnotherLiquidOrNone) {
  EXPECT_EQ(melt_modulus(sample_material(), 9.81, 1, 0.01).modulus, 0);
  Material other = open_melt();
  other.liquid_model = LiquidModel::modified_shear;
  EXPECT_FALSE(other.chooses_viscosity());
  EXPECT_EQ(melt_modulus(other, 9.81, 1, 0.01).modulus, 0);
  Material solid = open_melt();
  solid.phase_changes.clear();
  EXPECT_EQ(melt_modulus(solid, 9.81, 1, 0.01).modulus, 0);
}

TEST(MeltModulus, WhoeverForgetsToSetTheViscosityGetsNoNumber) {
  const Material m = open_melt();
  EXPECT_TRUE(std::isnan(properties_at(m, m.solidification()->fraction.liquidus() + 1, 300.0).viscosity));
}

}  // namespace
}  // namespace solidus::material
