/// The three models of the liquid and the mushy zone (2.3.1).
#include <gtest/gtest.h>

#include "flow_cases.hpp"

namespace solidus::material::test {
namespace {

Sym<double> shear_strain(double size) {
  Sym<double> e;
  e[3] = size;
  return e;
}

TEST(LiquidModels, AreTheSameInTheSolid) {
  Random random(41);
  const auto start = random_state(random);
  const Sym<double> strain = random_tensor(random, 1e-2);
  Sym<double> stress[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Material m =
        flow_material({IsotropicHardening::saturation, KinematicHardening::linear, 1e6, 3.0, k_liquid[i]});
    const Viscoplastic law(m);
    stress[i] = law.update(law.properties_at(700.0, 300.0), start, strain, 0.1).stress;
  }
  EXPECT_EQ(stress[0].c, stress[1].c);
  EXPECT_EQ(stress[0].c, stress[2].c);
}

TEST(LiquidModels, MaxwellLiquidIsNewtonian) {  // 4.114c, 2.104
  const Material m = flow_material({.liquid = LiquidModel::maxwell, .liquid_viscosity = 1e4});
  const Viscoplastic law(m);
  const auto r = law.update(law.properties_at(950.0, 300.0), {}, shear_strain(1e-3), 0.1);
  EXPECT_NEAR(r.stress[3], 1e4 * 1e-3 / 0.1, 1e-10);
  EXPECT_NEAR(r.viscous_dissipation, 2 * 1e4 * 1e-2 * 1e-2, 1e-10);  // η ε̇ : ε̇, two shear entries
}

TEST(LiquidModels, ModifiedShearModulusIsTheSolidFractionTimesThatAtTheSolidus) {  // 2.77, 2.78
  const Material m = flow_material({.liquid = LiquidModel::modified_shear});
  const Viscoplastic law(m);
  const double at_solidus = properties_at(m, 880.0, 300.0).shear;
  const auto mushy = law.update(law.properties_at(920.0, 300.0), {}, shear_strain(1e-5), 0.1);
  EXPECT_NEAR(mushy.stress[3], 2 * 0.2 * at_solidus * 1e-5, 1e-6);
  EXPECT_EQ(mushy.dissipation, 0);  // elastic: the solid gets the deformation of the mushy zone back
  EXPECT_EQ(law.update(law.properties_at(950.0, 300.0), {}, shear_strain(1e-2), 0.1).stress[3], 0);
}

TEST(LiquidModels, DegeneratedRadiusAndBackStressShrinkWithTheSolidFraction) {  // 2.79
  const Material m =
      flow_material({.kinematic = KinematicHardening::linear, .liquid = LiquidModel::degenerated});
  const Viscoplastic law(m);
  for (const double temperature : {885.0, 905.0, 929.0}) {
    const auto p = law.properties_at(temperature, 300.0);
    const auto r = law.update(p, {}, shear_strain(1e-2), 0.1);
    const double f = p.elastic.solid_fraction;
    const Sym<double> q = -2.0 / 3 * p.flow.kinematic_modulus * r.state.back_strain;
    EXPECT_NEAR(norm(dev(r.stress) - f * q), f * std::sqrt(2.0 / 3) * p.flow.flow_stress, 1e-5);
  }
}

TEST(LiquidModels, DegeneratedLiquidIsNewtonianInTheViscoplasticStrain) {  // 2.80–2.83
  const double eta = 1e3, dt = 0.1;
  const Material m = flow_material(
      {.kinematic = KinematicHardening::linear, .viscosity = eta, .liquid = LiquidModel::degenerated});
  const Viscoplastic law(m);
  Viscoplastic::State<double> start{};
  start.back_strain[3] = 1e-3;  // what the solid left has no force in the melt
  const auto r = law.update(law.properties_at(950.0, 300.0), start, shear_strain(1e-3), dt);
  const double rounding = 1e-15 * 2 * law.properties_at(950.0, 300.0).elastic.shear * 1e-3;  // trial stress
  EXPECT_NEAR(r.stress[3], eta * r.state.plastic_strain[3] / dt, rounding);
  EXPECT_EQ(r.state.hardening, 0);
  EXPECT_EQ(r.state.back_strain[3], 1e-3);
  EXPECT_EQ(r.viscous_dissipation, 0);
  EXPECT_NEAR(r.plastic_dissipation, r.plastic_power, rounding * 2e-2);  // nothing is stored
  // At rest too the tangent is that of the viscous liquid.
  const auto rest = law.update(law.properties_at(950.0, 300.0), {}, Sym<double>{}, dt);
  const double stiff = 2 * law.properties_at(950.0, 300.0).elastic.shear;
  EXPECT_NEAR(rest.twice_shear, stiff * eta / (eta + dt * stiff), 1e-10 * stiff);
}

TEST(LiquidModels, RateIndependentFlowLimitsTheStressOfTheMushyZoneDownToTheLastSolid) {
  // A stiff liquid (η ε̇ above the yield stress): its stress jumps where f_S reaches zero, because no
  // overstress is allowed as long as something is solid. A rate-dependent flow has no jump.
  const double eta = 1e12;
  const auto stress = [&](double viscosity, double temperature) {
    const Material m = flow_material({.viscosity = viscosity, .liquid_viscosity = eta});
    const Viscoplastic law(m);
    return law.update(law.properties_at(temperature, 300.0), {}, shear_strain(1e-3), 1.0).stress[3];
  };
  const double liquid = eta * 1e-3, almost = 930 - 1e-10;
  EXPECT_NEAR(stress(0, 930), liquid, 1e-6 * liquid);
  EXPECT_NEAR(stress(0, almost), 60e6 / std::sqrt(3.0), 1);
  EXPECT_NEAR(stress(eta, almost), liquid, 1e-6 * liquid);
}

}  // namespace
}  // namespace solidus::material::test
