#include "material/elasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dual.hpp"
#include "sample_material.hpp"
#include "structural_state.hpp"

namespace solidus::material {
namespace {

using Ad = test::Dual<double, 1>;
Ad variable(double x) {
  return {x, 1, 0};
}
double slope(const Ad& x) {
  return x.derivatives()[0];
}

constexpr double k_initial = 943.15;
/// Solid, during the solid transformation, mushy, near both ends of the mushy zone, liquid.
const double k_temperatures[] = {420, 650, 730, 880.001, 905, 929.999, 940};

void expect_near_relative(double a, double b, double tolerance) {
  EXPECT_NEAR(a, b, tolerance * std::max(std::abs(a), std::abs(b)));
}

TEST(Elasticity, ModuliAndThermalStrainFollowTheirFormulas) {
  const Material m = sample_material();
  const double t = 905, young = m.young_modulus.value(t), poisson = m.poisson_ratio.value(t);
  const auto p = properties_at(m, t, k_initial);
  EXPECT_DOUBLE_EQ(9 * p.bulk * p.shear / (3 * p.bulk + p.shear), young);
  EXPECT_DOUBLE_EQ((3 * p.bulk - 2 * p.shear) / (2 * (3 * p.bulk + p.shear)), poisson);
  EXPECT_DOUBLE_EQ(p.solid_fraction, 0.5);
  EXPECT_DOUBLE_EQ(p.viscosity, m.liquid_viscosity.value(t));
  const double thermal =
      3 * (m.expansion.value(t) * (t - 293.15) - m.expansion.value(k_initial) * (k_initial - 293.15));
  EXPECT_NEAR(p.thermal_strain, thermal - 0.05 * 0.5, 1e-15);  // half of the shrinkage on freezing
}

TEST(Elasticity, TheStrainAtTheInitialTemperatureIsZeroAndFreezingShrinks) {
  const Material m = sample_material();
  // to the rounding of two products of order 0.01 (a fused multiply-add rounds one of them only)
  EXPECT_NEAR(properties_at(m, k_initial, k_initial).thermal_strain, 0, 1e-17);
  Material rigid = m;
  rigid.expansion = Table(0.0);
  EXPECT_DOUBLE_EQ(properties_at(rigid, 800.0, k_initial).thermal_strain, -0.05);
  EXPECT_DOUBLE_EQ(properties_at(rigid, 300.0, k_initial).thermal_strain,
                   -0.04);  // the solid change expands by 1 %
}

TEST(Elasticity, AMaterialWithoutSolidificationIsSolid) {
  Material m = sample_material();
  m.phase_changes.clear();
  m.liquid_viscosity = Table();
  const auto p = properties_at(m, 2000.0, 300.0);
  EXPECT_EQ(p.solid_fraction, 1);
  EXPECT_GT(p.viscosity, 0);
  EXPECT_EQ(derivatives_at(m, 2000.0, 300.0).solid_fraction, 0);
}

TEST(Elasticity, DerivativesAndCurvaturesAgreeWithAutomaticDifferentiation) {
  const Material m = sample_material();
  for (const double t : k_temperatures) {
    const auto p = properties_at(m, variable(t), Ad(k_initial));
    const auto d = derivatives_at(m, variable(t), Ad(k_initial));
    const auto c = curvatures_at(m, t);
    expect_near_relative(d.bulk.value(), slope(p.bulk), 1e-13);
    expect_near_relative(d.shear.value(), slope(p.shear), 1e-13);
    expect_near_relative(d.thermal_strain.value(), slope(p.thermal_strain), 1e-13);
    expect_near_relative(d.solid_fraction.value(), slope(p.solid_fraction), 1e-13);
    expect_near_relative(c.bulk, slope(d.bulk), 1e-13);
    expect_near_relative(c.shear, slope(d.shear), 1e-13);
    expect_near_relative(c.thermal_strain, slope(d.thermal_strain), 1e-13);
    EXPECT_EQ(p.bulk.value(), properties_at(m, t, k_initial).bulk);
  }
}

/// Ψ = W + M + R by 2.49 with Ḡ = G/f_S, at any number type.
template <class T>
T free_energy(const Material& m, const T& temperature, double strain_trace, double deviator_norm_squared) {
  const auto p = properties_at(m, temperature, T(k_initial));
  const T w = 0.5 * p.bulk * strain_trace * strain_trace + p.shear / p.solid_fraction * deviator_norm_squared;
  return w - 0.5 * p.bulk * strain_trace * strain_trace +
         volumetric_energy(m, p.bulk, p.thermal_strain, strain_trace);
}

TEST(StructuralState, EntropyEnergyAndCapacityAreDerivativesOfTheFreeEnergyAtFixedElasticStrain) {
  Material m = sample_material();
  const double tr = -3e-3, e2 = 4e-6;  // tr ε^E, dev ε^E : dev ε^E
  for (const auto measured : {SpecificHeatAt::constant_pressure, SpecificHeatAt::constant_strain})
    for (const double t : k_temperatures) {
      m.specific_heat_at = measured;
      if (properties_at(m, t, k_initial).solid_fraction == 0) continue;  // 2.50 has no elastic deviator there
      const Ad psi = free_energy(m, variable(t), tr, e2);
      const auto p = properties_at(m, variable(t), Ad(k_initial));
      const auto d = derivatives_at(m, variable(t), Ad(k_initial));
      const Ad stiffness = Ad(2.0) * p.shear / p.solid_fraction;
      const Ad s2 = stiffness * stiffness * e2;
      const auto state = structural_state<Ad>(m, p, d, variable(t), Ad(tr), s2);
      expect_near_relative(state.entropy.value(), -slope(psi), 1e-11);
      expect_near_relative(state.internal_energy.value(), psi.value() - t * slope(psi), 1e-11);
      const double capacity =
          structural_capacity(m, properties_at(m, t, k_initial), derivatives_at(m, t, k_initial),
                              curvatures_at(m, t), t, tr, s2.value());
      expect_near_relative(capacity, t * slope(state.entropy), 1e-10);
      expect_near_relative(capacity, slope(state.internal_energy), 1e-9);  // dE = Θ dS at fixed strain
    }
}

TEST(StructuralState, StaysFiniteInTheLiquid) {
  const Material m = sample_material();
  const double t = 940;
  const auto p = properties_at(m, t, k_initial);
  const auto d = derivatives_at(m, t, k_initial);
  const auto state = structural_state(m, p, d, t, 1e-3, 1e12);
  EXPECT_TRUE(std::isfinite(state.entropy) && std::isfinite(state.internal_energy));
  EXPECT_TRUE(std::isfinite(structural_capacity(m, p, d, curvatures_at(m, t), t, 1e-3, 1e12)));
  EXPECT_EQ(structural_state(m, p, d, t, 1e-3, 1e12).entropy,
            structural_state(m, p, d, t, 1e-3, 0.0).entropy);
}

TEST(StructuralState, OfAFreelyExpandingSolidIsNothingWhereTheSpecificHeatIsThatAtConstantPressure) {
  Material m = sample_material();
  m.phase_changes.clear();
  m.young_modulus = Table(70e9);
  m.poisson_ratio = Table(0.3);
  m.expansion = Table(2e-5);
  const double t = 500, strain = 3 * 2e-5 * (500 - 300), k = 70e9 / 1.2;
  const auto state = [&] {
    return structural_state(m, properties_at(m, t, 300.0), derivatives_at(m, t, 300.0), t, strain, 0.0);
  };
  EXPECT_NEAR(state().entropy, 0, 1e-13 * k * 6e-5 * strain);
  EXPECT_NEAR(state().internal_energy, 0, 1e-13 * k * 6e-5 * strain * t);
  m.specific_heat_at = SpecificHeatAt::constant_strain;
  expect_near_relative(state().entropy, k * 6e-5 * strain, 1e-13);  // 3 α k e^θ
}

TEST(Elasticity, LanesAnswerAsNumbersDo) {
  const Material m = sample_material();
  Lane t;
  for (int i = 0; i < k_lanes; ++i) t.set(i, 400 + 77.7 * i);
  const auto p = properties_at(m, t, Lane(k_initial));
  const auto d = derivatives_at(m, t, Lane(k_initial));
  const auto c = curvatures_at(m, t);
  const auto state = structural_state(m, p, d, t, Lane(1e-3), Lane(1e12));
  const Lane capacity = structural_capacity(m, p, d, c, t, Lane(1e-3), Lane(1e12));
  for (int i = 0; i < k_lanes; ++i) {
    const auto pi = properties_at(m, t[i], k_initial);
    const auto di = derivatives_at(m, t[i], k_initial);
    const auto ci = curvatures_at(m, t[i]);
    EXPECT_DOUBLE_EQ(p.bulk[i], pi.bulk);
    EXPECT_DOUBLE_EQ(p.shear[i], pi.shear);
    EXPECT_NEAR(p.thermal_strain[i], pi.thermal_strain, 1e-17);
    EXPECT_DOUBLE_EQ(p.solid_fraction[i], pi.solid_fraction);
    EXPECT_DOUBLE_EQ(p.viscosity[i], pi.viscosity);
    EXPECT_DOUBLE_EQ(d.bulk[i], di.bulk);
    EXPECT_DOUBLE_EQ(c.shear[i], ci.shear);
    const auto si = structural_state(m, pi, di, t[i], 1e-3, 1e12);
    expect_near_relative(state.entropy[i], si.entropy, 1e-13);
    expect_near_relative(state.internal_energy[i], si.internal_energy, 1e-13);
    expect_near_relative(capacity[i], structural_capacity(m, pi, di, ci, t[i], 1e-3, 1e12), 1e-13);
  }
}

}  // namespace
}  // namespace solidus::material
