/// Every state function against automatic differentiation of the free energy.
#include "material/free_energy.hpp"

#include <gtest/gtest.h>

#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

// Variables: ε^E (0–5), ξ (6), ζ (7–12), Θ (13).
using Number = Second<14>;
constexpr std::size_t k_xi = 6, k_zeta = 7, k_theta = 13;

/// The derivative by a symmetric tensor: a shear component stands for two.
Sym<double> by_tensor(const std::array<double, 14>& g, std::size_t first) {
  Sym<double> r;
  for (std::size_t i = 0; i < 6; ++i) r.c[i] = g[first + i] * (i < 3 ? 1.0 : 0.5);
  return r;
}

/// The largest difference of two tensors in parts of the second.
double difference(const Sym<double>& a, const Sym<double>& b) {
  double largest = 0, size = 1e-300;
  for (int i = 0; i < 6; ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return largest / size;
}
double difference(double a, double b) {
  return std::abs(a - b) / std::max(std::abs(b), 1e-300);
}

/// Rounding of the products of a handful of factors.
constexpr double k_tolerance = 1e-12;

void check(const Viscoplastic& law, const StateVariables<double>& state, double theta, bool liquid_spring) {
  StateVariables<Number> variables;
  for (std::size_t i = 0; i < 6; ++i) {
    variables.elastic_strain.c[i] = Number::variable(state.elastic_strain.c[i], i);
    variables.back_strain.c[i] = Number::variable(state.back_strain.c[i], k_zeta + i);
  }
  variables.hardening = Number::variable(state.hardening, k_xi);
  const FreeEnergy<Number> psi =
      free_energy(law, variables, Number::variable(theta, k_theta), Number(k_start_temperature));
  const Number mechanical = psi.without_latent(), total = psi.total();

  const auto f = forces(law, state, theta, k_start_temperature);
  EXPECT_LT(difference(f.value.stress, by_tensor(total.g, 0)), k_tolerance);
  EXPECT_NEAR(f.value.hardening, -total.g[k_xi], k_tolerance * std::abs(total.g[k_xi]));
  EXPECT_LT(difference(-1.0 * f.value.back_stress, by_tensor(total.g, k_zeta)), k_tolerance);

  const auto s = thermal_state(law, state, theta, k_start_temperature);
  EXPECT_LT(difference(s.entropy, -mechanical.g[k_theta]), k_tolerance);
  EXPECT_LT(difference(s.internal_energy, mechanical.v - theta * mechanical.g[k_theta]), k_tolerance);
  EXPECT_LT(difference(s.capacity, -theta * mechanical.h[k_theta][k_theta]), k_tolerance);
  EXPECT_LT(difference(s.latent_entropy, -psi.latent.g[k_theta]), k_tolerance);
  EXPECT_NEAR(s.latent_capacity, -theta * psi.latent.h[k_theta][k_theta], 1e-6);

  const auto h = structural_heating(law, state, theta, k_start_temperature);
  std::array<double, 14> entropy_slope;
  for (std::size_t i = 0; i < 14; ++i) entropy_slope[i] = -theta * mechanical.h[i][k_theta];
  EXPECT_LT(difference(h.strain, by_tensor(entropy_slope, 0)), k_tolerance);
  EXPECT_NEAR(h.hardening, entropy_slope[k_xi], k_tolerance * std::abs(entropy_slope[k_xi]));
  EXPECT_LT(difference(h.back_strain, by_tensor(entropy_slope, k_zeta)), k_tolerance);
  if (liquid_spring) {
    EXPECT_EQ(dev(f.value.stress)[3], 0);
  }
}

TEST(FreeEnergy, StressEntropyCapacityHeatingAndBackStressAreItsDerivatives) {
  Random random(3);
  for (const auto liquid : k_liquid)
    for (const auto isotropic : k_isotropic)
      for (const auto kinematic : k_kinematic)
        for (const double theta : k_phases) {
          const Material m = varying_material({isotropic, kinematic, 1e6, 3, liquid});
          const StateVariables<double> state{random_tensor(random, 3e-3), uniform(random, 0, 0.04),
                                             dev(random_tensor(random, 1e-2))};
          check(Viscoplastic(m), state, theta, liquid != LiquidModel::degenerated && theta > 930);
          ASSERT_FALSE(testing::Test::HasFailure())
              << "isotropic " << static_cast<int>(isotropic) << " kinematic " << static_cast<int>(kinematic)
              << " liquid " << static_cast<int>(liquid) << " T " << theta;
        }
}

TEST(FreeEnergy, LanesAnswerAsNumbersDo) {
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear});
  const Viscoplastic law(m);
  const Sym<double> strain{{1e-3, -2e-3, 3e-4, 5e-4, -1e-4, 2e-4}}, zeta{{1e-3, -1e-3, 0, 4e-4, 0, 1e-4}};
  Lane theta;
  for (int i = 0; i < k_lanes; ++i) theta.set(i, 420 + 77 * i);
  const auto packed = thermal_state<Lane>(law, {convert<Lane>(strain), Lane(0.01), convert<Lane>(zeta)},
                                          theta, Lane(k_start_temperature));
  for (int i = 0; i < k_lanes; ++i) {
    const auto one = thermal_state<double>(law, {strain, 0.01, zeta}, theta[i], k_start_temperature);
    EXPECT_NEAR(packed.entropy[i], one.entropy, 1e-12 * std::abs(one.entropy));
    EXPECT_NEAR(packed.internal_energy[i], one.internal_energy, 1e-12 * std::abs(one.internal_energy));
    EXPECT_NEAR(packed.capacity[i], one.capacity, 1e-12 * std::abs(one.capacity));
    EXPECT_NEAR(packed.latent_entropy[i], one.latent_entropy, 1e-12 * std::abs(one.latent_entropy));
  }
}

TEST(FreeEnergy, CapacityWithoutStrainIsTheSpecificHeatAtConstantStrain) {
  Material m = varying_material({IsotropicHardening::power});
  m.specific_heat_at = SpecificHeatAt::constant_strain;
  const auto s = thermal_state<double>(Viscoplastic(m), {}, 650, k_start_temperature);
  EXPECT_NEAR(s.capacity, m.density * m.specific_heat.value(650), 1e-9 * s.capacity);
}

/// ΔE of a solid that expands as it likes, k, α and c tables that bend: what calorimeters measure.
TEST(FreeEnergy, OfFreeExpansionIsTheIntegralOfTheSpecificHeatAtConstantPressure) {
  Material m = varying_material({IsotropicHardening::power});
  m.phase_changes.clear();
  const Viscoplastic law(m);
  const auto free_of_stress = [&](double theta) {
    const double e = properties_at(m, theta, k_start_temperature).thermal_strain / 3;
    return thermal_state<double>(law, {{{e, e, e, 0, 0, 0}}, 0, {}}, theta, k_start_temperature);
  };
  for (const double theta : {350.0, 500.0, 650.0, 870.0}) {
    const auto cold = free_of_stress(320), hot = free_of_stress(theta);
    const auto sensible = sensible_between(m, 320, theta);
    EXPECT_NEAR(hot.internal_energy - cold.internal_energy, sensible.heat, 1e-10 * sensible.heat);
    EXPECT_NEAR(hot.entropy - cold.entropy, sensible.entropy, 1e-10 * sensible.entropy);
    // C_p − C_v = 9 α² k Θ, α the slope of the expansion, at fixed strain
    const auto p = properties_at(m, theta, k_start_temperature);
    const auto d = derivatives_at(m, theta, k_start_temperature);
    const double c_p = m.density * m.specific_heat.value(theta);
    EXPECT_NEAR(c_p - hot.capacity, p.bulk * d.thermal_strain * d.thermal_strain * theta, 1e-9 * c_p);
  }
}

TEST(FreeEnergy, CapacityOfAStrainedSolidHoldsTheProductTermsOfThermalExpansion) {
  // k and α linear in Θ: C − C_v = Θ (2 k_Θ e^θ_Θ + k e^θ_ΘΘ) tr ε, e^θ_ΘΘ = 6 α_Θ
  Material m = flow_material({});
  m.phase_changes.clear();
  m.specific_heat = 600;
  m.specific_heat_at = SpecificHeatAt::constant_strain;
  m.young_modulus = Table({300, 900}, {200e9, 100e9});
  m.poisson_ratio = 0.25;
  m.expansion = Table({300, 900}, {1e-5, 2e-5});
  m.expansion_reference = 300;
  const double theta = 600, tr = 1e-3, bulk = 100e9, bulk_slope = -200e9 / 600 / 1.5 / 2;
  const double alpha = 1.5e-5, alpha_theta = 1e-5 / 600;
  const double e_theta = 3 * (alpha + alpha_theta * 300), e_theta_theta = 6 * alpha_theta;
  const auto s = thermal_state<double>(Viscoplastic(m), {{{tr, 0, 0, 0, 0, 0}}, 0, {}}, theta, 300);
  EXPECT_NEAR(s.capacity - m.density * 600, theta * (2 * bulk_slope * e_theta + bulk * e_theta_theta) * tr,
              1e-9 * m.density * 600);
}

TEST(FreeEnergy, InternalEnergyAndEntropyKeepGibbsRelationAtFixedState) {
  // dE = Θ dS where nothing but the temperature moves, by a central difference of second order
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear});
  const Viscoplastic law(m);
  const StateVariables<double> state{{{1e-3, -2e-3, 5e-4, 3e-4, 0, 0}}, 0.02, {{1e-3, -1e-3, 0, 0, 0, 0}}};
  const double theta = 500, step = 0.01;
  const auto a = thermal_state(law, state, theta - step, 300.0),
             b = thermal_state(law, state, theta + step, 300.0);
  EXPECT_NEAR((b.internal_energy - a.internal_energy) / (b.entropy - a.entropy), theta, 1e-4);
}

TEST(ThermalPotential, ConstantCapacityGivesTheClosedFormOfTheMonograph) {
  Material m = flow_material({});
  m.specific_heat = 600;
  const double c = 600 * m.density, theta = 750, from = 300;
  const double expected = c * ((theta - from) - theta * std::log(theta / from));  // remark 1 of 2.2.2
  EXPECT_NEAR(sensible_heat(m, from, theta).potential(theta), expected, 1e-12 * std::abs(expected));
}

/// −∫_a^b dΘ ∫_a^Θ C/Θ̂ dΘ̂ by midpoints.
template <class Capacity>
double double_integral(double a, double b, Capacity capacity) {
  const int n = 200000;
  const double step = (b - a) / n;
  double inner = 0, outer = 0;
  for (int i = 0; i < n; ++i) {
    const double theta = a + (i + 0.5) * step, part = capacity(theta) / theta * step;
    outer += (inner + 0.5 * part) * step;
    inner += part;
  }
  return -outer;
}

TEST(ThermalPotential, SensibleAndLatentPartsAreTheDoubleIntegralsOfTheirCapacities) {
  const Material m = varying_material({});
  const double from = 400, to = 1050;
  const auto sensible = [&](double t) { return m.density * m.specific_heat.value(t); };
  const auto latent = [&](double t) {
    double slope = 0;
    for (const auto& change : m.phase_changes)
      slope -= m.density * change.latent_heat * change.fraction.derivative(t);
    return slope;
  };
  // midpoints err at the bends of the tables by the square of a step of 3 mK, at jumps of L_Θ by a step
  const double a = double_integral(from, to, sensible), b = double_integral(from, to, latent);
  EXPECT_NEAR(sensible_heat(m, from, to).potential(to), a, 1e-8 * std::abs(a));
  EXPECT_NEAR(latent_heat(m, from, to).potential(to), b, 1e-4 * std::abs(b));
}

TEST(ThermalPotential, CoolingReleasesLatentHeatAndEntropyFalls) {
  const Material m = varying_material({});
  const auto frozen = latent_heat(m, 1000.0, 800.0);
  EXPECT_NEAR(frozen.heat, -m.density * 1e5, 1e-6 * m.density * 1e5);
  EXPECT_LT(frozen.entropy, -m.density * 1e5 / 930);
  EXPECT_GT(frozen.entropy, -m.density * 1e5 / 880);
  const auto back = latent_heat(m, 800.0, 1000.0);
  EXPECT_DOUBLE_EQ(back.entropy, -frozen.entropy);
}

TEST(ThermalPotential, AnIsothermalChangeStoresItsHeatOverItsTemperature) {
  Material m = flow_material({});
  m.phase_changes = {{"melting", PhaseFraction::linear(900, 900), 1e5, 0, true}};
  const double heat = m.density * 1e5;
  EXPECT_DOUBLE_EQ(latent_heat(m, 800.0, 1000.0).entropy, heat / 900);
  EXPECT_DOUBLE_EQ(latent_heat(m, 1000.0, 800.0).heat, -heat);
  EXPECT_DOUBLE_EQ(latent_heat(m, 800.0, 900.0).heat, heat);  // molten at its temperature
  EXPECT_EQ(latent_heat(m, 900.0, 1000.0).heat, 0);
  EXPECT_EQ(latent_heat(m, 300.0, 899.0).heat, 0);
}

TEST(HardeningHeat, IsThePartOfTheStateFunctionsThatHardeningAdds) {
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic) {
      const Material m = varying_material({isotropic, kinematic});
      const Viscoplastic law(m);
      const Sym<double> strain{{1e-3, -2e-3, 3e-4, 5e-4, 0, 0}}, zeta{{1e-2, -1e-2, 0, 4e-3, 0, 0}};
      const double theta = 550, xi = 0.02;
      const auto with = thermal_state<double>(law, {strain, xi, zeta}, theta, 300);
      const auto without = thermal_state<double>(law, {strain, 0, {}}, theta, 300);
      const auto k = hardening_state(*m.flow, xi, dot(zeta, zeta), theta);
      // the differences lose as many digits as sensible heat is larger than stored energy
      EXPECT_NEAR(k.entropy, with.entropy - without.entropy, 1e-14 * 4e6);
      EXPECT_NEAR(k.internal_energy, with.internal_energy - without.internal_energy, 1e-14 * 2e9);
      EXPECT_NEAR(k.capacity, with.capacity - without.capacity, 1e-14 * 4e6);
      EXPECT_NEAR(k.internal_energy - theta * k.entropy, k.free_energy, 1e-9 * std::abs(k.free_energy));
    }
}

}  // namespace
}  // namespace solidus::material::test
