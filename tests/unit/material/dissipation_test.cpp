/// The second law and the frozen entropy in random materials, states and increments.
#include "dissipation.hpp"

#include <gtest/gtest.h>

#include "material/derivatives/isentropic.hpp"
#include "material/hardening_heat.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

Table falling(Random& random, double cold) {
  const double hot = cold * uniform(random, 0.05, 0.7);
  return Table({300, uniform(random, 400, 800), 1100}, {cold, 0.5 * (cold + hot), hot});
}
Table any_way(Random& random, double cold) {
  return Table({300, uniform(random, 400, 800), 1100},
               {cold, cold * uniform(random, 0.7, 1.5), cold * uniform(random, 0.7, 1.5)});
}

Material random_material(Random& random) {
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  FlowCase c;
  c.isotropic = k_isotropic[pick(5)];
  c.kinematic = k_kinematic[pick(3)];
  c.liquid = k_liquid[pick(3)];
  c.viscosity = pick(3) == 0 ? 0 : decades(random, -3, 12);
  c.exponent = pick(2) == 0 ? 1 : uniform(random, 0.3, 12);
  if (pick(3) == 0) c.heat_share = uniform(random, 0, 1);
  c.liquid_viscosity = decades(random, 0, 13);
  Material m = varying_material(c);
  const double solidus = uniform(random, 700, 1000), width = pick(4) == 0 ? 0 : uniform(random, 1, 120);
  m.phase_changes[0] = {"solidification", PhaseFraction::linear(solidus, solidus + width), 2e5,
                        uniform(random, -0.06, 0.03), true};
  m.density = uniform(random, 2500, 9000);
  m.specific_heat = any_way(random, uniform(random, 500, 1000));
  m.young_modulus = falling(random, decades(random, 9.5, 11.5));
  // the bulk modulus falls: where it rises fast enough, a compressed state has no positive capacity
  const double poisson = uniform(random, 0, 0.33);
  m.poisson_ratio = Table({300, 1100}, {poisson, poisson + uniform(random, 0, 0.04)});
  m.expansion = any_way(random, uniform(random, 0.5e-5, 3e-5));
  // C_p − C_v = 9 α² k Θ is a tenth of a metal's capacity at most; these numbers know nothing of each other
  const double bulk = m.young_modulus.max_value() / (3 * (1 - 2 * m.poisson_ratio.max_value()));
  const double alpha = 3 * m.expansion.max_value();  // with the slope of a mean coefficient
  const bool possible = 9 * alpha * alpha * bulk * 1100 < 0.3 * m.density * m.specific_heat.min_value();
  m.specific_heat_at = possible ? SpecificHeatAt::constant_pressure : SpecificHeatAt::constant_strain;
  Flow& f = *m.flow;
  if (c.isotropic != IsotropicHardening::table) f.flow_stress = falling(random, decades(random, 6, 9));
  const double young = m.young_modulus.max_value();
  const Table saturation({300, 1100}, {f.flow_stress.value(300) * uniform(random, 1, 3),
                                       f.flow_stress.value(1100) * uniform(random, 1, 3)});
  const Table rate = any_way(random, decades(random, 0, 3));
  set_hardening(f, {{"hardening_modulus", falling(random, young * decades(random, -4, -1))},
                    {"saturation_stress", saturation},
                    {"saturation_rate", rate},
                    {"reference_strain", Table({300, 1000}, {1e-3, 2e-3})},
                    {"hardening_exponent", Table({300, 1000}, {0.25, 0.15})}});
  if (c.kinematic != KinematicHardening::none)
    f.kinematic_modulus = falling(random, young * decades(random, -4, -1));
  return m;
}

/// A state is admissible where its heat capacity is positive; much stored energy whose modulus bends in
/// temperature may make it negative. Less hardening is better then.
double admissible_hardening(const Material& m, double theta, double zeta_squared, double xi) {
  const double c_v = m.density * m.specific_heat.value(theta);
  while (hardening_state(*m.flow, xi, zeta_squared, theta).capacity < -0.5 * c_v) xi *= 0.1;
  return xi;
}

/// Eight random points and what they do.
struct Points {
  Lane theta;
  Viscoplastic::State<Lane> state{};
  Sym<Lane> old_strain, strain;
};

Points random_points(Random& random, const Material& m) {
  Points points;
  const PhaseFraction& f = m.solidification()->fraction;
  for (int l = 0; l < k_lanes; ++l) {
    const bool near = uniform(random, 0, 1) < 0.3;
    const double theta =
        near ? uniform(random, f.solidus() - 1, f.liquidus() + 1) : uniform(random, 300, 1100);
    points.theta.set(l, theta);
    const double size = decades(random, -5, -2.3), inelastic = decades(random, -4, -1);
    const auto v = dev(random_tensor(random, inelastic)), p = dev(random_tensor(random, inelastic)),
               z = dev(random_tensor(random, decades(random, -5, -2)));
    const auto elastic = random_tensor(random, 2e-4 * std::max(m.solid_fraction(theta), 1e-3)),
               increment = random_tensor(random, size);
    for (int i = 0; i < 6; ++i) {
      points.state.viscous_strain[i].set(l, v[i]);
      points.state.plastic_strain[i].set(l, p[i]);
      points.state.back_strain[i].set(l, z[i]);
      points.old_strain[i].set(l, v[i] + p[i] + elastic[i]);
      points.strain[i].set(l, v[i] + p[i] + elastic[i] + increment[i]);
    }
    points.state.hardening.set(l, admissible_hardening(m, theta, dot(z, z), decades(random, -6, 0)));
  }
  return points;
}

TEST(SecondLaw, DissipationIsPositiveAndTheElasticEntropyKeepsItsValueInAMillionIncrements) {
  Random random(2026);
  constexpr int k_materials = 250, k_packs = 500;
  static_assert(k_materials * k_packs * k_lanes == 1000000);
  int plastic = 0, mushy = 0, liquid = 0, warmer = 0;
  double worst_entropy = 0, largest_change = 0;
  for (int i = 0; i < k_materials; ++i) {
    const Material m = random_material(random);
    const Viscoplastic law(m);
    const Isentropic isentropic(m);
    for (int j = 0; j < k_packs; ++j) {
      const Points at = random_points(random, m);
      const double dt = decades(random, -4, 3);

      const auto properties = law.properties_at(at.theta, Lane(900.0));
      const auto r = law.update(properties, at.state, at.strain, dt);
      ASSERT_EQ(r.status, Status::converged) << i << ' ' << j;
      ASSERT_TRUE(all(r.viscous_dissipation >= Lane(0.0)));
      ASSERT_TRUE(all(r.plastic_dissipation >= Lane(0.0)));
      ASSERT_TRUE(all(r.dissipation >= Lane(0.0)));
      ASSERT_TRUE(all(entropy_production(law, properties, r, at.theta, dt) >= r.dissipation / at.theta));

      auto lines = isentropic.properties_at(at.theta, Lane(900.0));
      lines.entropy = isentropic.entropy(lines, at.old_strain, at.state);
      const auto s = isentropic.update(lines, at.state, at.strain, dt);
      ASSERT_EQ(s.status, Status::converged) << i << ' ' << j;
      ASSERT_TRUE(all(s.dissipation >= Lane(0.0)));
      const Lane defect = abs(s.entropy_defect) / lines.capacity.value,
                 change = abs(s.temperature - at.theta);
      for (int l = 0; l < k_lanes; ++l) {
        worst_entropy = std::max(worst_entropy, defect[l]);
        largest_change = std::max(largest_change, change[l]);
        plastic += s.flow_increment[l] > 0;
        const double f = lines.solid_fraction[l];
        mushy += f > 0 && f < 1;
        liquid += f == 0;
        warmer += s.temperature[l] > at.theta[l];
      }
    }
  }
  EXPECT_LE(worst_entropy, 1e-10);
  EXPECT_GT(plastic, 100000);
  EXPECT_GT(mushy, 50000);
  EXPECT_GT(liquid, 50000);
  EXPECT_GT(warmer, 300000);
  EXPECT_LT(warmer, 700000);
  EXPECT_GT(largest_change, 5);
  RecordProperty("worst_entropy", std::to_string(worst_entropy));
}

TEST(ThermalDissipation, IsPositiveForSofteningAndFollowsItsFormula) {
  Flow flow;
  flow.flow_stress = Table({300, 900}, {120e6, 60e6});
  const double expected = 0.02 / 0.5 * std::sqrt(2.0 / 3) * 1e5 * 500;  // dσ_0/dΘ = −0.1 MPa/K
  EXPECT_NEAR(thermal_dissipation(flow, 500.0, 0.02, 1.0, 0.5), expected, 1e-9 * expected);
  EXPECT_NEAR(thermal_dissipation(flow, 500.0, 0.02, 0.25, 0.5), 0.25 * expected, 1e-9 * expected);
  EXPECT_EQ(thermal_dissipation(flow, 500.0, 0.0, 1.0, 0.5), 0);
}

TEST(ThermalDissipation, IsTheTemperatureTimesTheDerivativeOfTheYieldFunctionAtFixedForces) {
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear});
  const Viscoplastic law(m);
  const double theta = 500, step = 1e-3, gamma = 0.01, dt = 2;
  const Sym<double> stress{{300e6, -1e8, 0, 2e7, 0, 0}}, q{{1e7, -1e7, 0, 0, 0, 0}};
  const auto phi = [&](double t) {  // forces s, q and K_ξ held
    return norm(dev(stress) + -1.0 * q) - std::sqrt(2.0 / 3) * (m.flow->flow_stress.value(t) + 5e7);
  };
  const double slope = (phi(theta + step) - phi(theta - step)) / (2 * step);
  const double d = thermal_dissipation(*m.flow, theta, gamma, 1.0, dt);
  EXPECT_NEAR(d, theta * gamma / dt * slope, 1e-6 * d);
}

}  // namespace
}  // namespace solidus::material::test
