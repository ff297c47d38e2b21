/// The isentropic return mapping: its tangent, its limit cases, adiabatic closed forms.
#include "material/derivatives/isentropic.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "laws_on_duals.hpp"
#include "material/free_energy.hpp"
#include "material/time_integration.hpp"
#include "thermal_cases.hpp"

namespace solidus::material::test {
namespace {

struct Update {
  Isentropic::Properties<double> properties;
  Isentropic::Response<double> response;
};

/// A step from a committed state at rest strain to another strain.
Update step(const Isentropic& law, double temperature, const Viscoplastic::State<double>& state,
            const Sym<double>& old_strain, const Sym<double>& strain, double dt) {
  auto p = law.properties_at(temperature, k_start_temperature);
  p.entropy = law.entropy(p, old_strain, state);
  return {p, law.update(p, state, strain, dt)};
}

/// The same properties as constants of automatic differentiation.
Isentropic::Properties<Ad> constants(const Isentropic& law, const Isentropic::Properties<double>& p) {
  auto r = law.properties_at(Ad(p.temperature), Ad(k_start_temperature));
  r.entropy = Ad(p.entropy);
  return r;
}

struct Count {
  int elastic = 0, plastic = 0;
  double largest_change = 0;
};

void check_tangents(LiquidModel liquid) {
  Random random(21);
  Count count;
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const double n : {1.0, 3.0, 8.0})
        for (const double eta : {0.0, 1e3, 1e7, 1e12}) {
          const Material m = varying_material({isotropic, kinematic, eta, n, liquid});
          const Isentropic law(m);
          for (const double temperature : {420.0, 730.0, 880 + 5e-11, 905.0, 930 - 5e-11, 945.0})
            for (const double size : {2e-4, 2e-3, 3e-2}) {
              const auto state = random_state(random);
              const auto old_strain = random_tensor(random, 1e-4), strain = random_tensor(random, size);
              const double dt = decades(random, -2, 2);
              const auto [p, r] = step(law, temperature, state, old_strain, strain, dt);
              ASSERT_EQ(r.status, Status::converged);
              ASSERT_LE(std::abs(r.entropy_defect), 1e-10 * p.capacity.value);

              Sym<Ad> strain_ad;
              for (int i = 0; i < 6; ++i) strain_ad[i] = Ad(strain[i], 6, i);
              const auto exact = law.update(constants(law, p), convert<Ad>(state), strain_ad, dt);
              const auto c = full_tangent(r);
              double error = 0, asymmetry = 0, size_c = 0;
              for (int a = 0; a < 6; ++a)
                for (int b = 0; b < 6; ++b) {
                  const auto j = static_cast<std::size_t>(b);
                  const double ad = exact.stress[a].derivatives()[j] * (b < 3 ? 1.0 : 0.5);
                  error = std::max(error, std::abs(c[a][j] - ad));
                  asymmetry = std::max(asymmetry, std::abs(c[a][j] - c[b][static_cast<std::size_t>(a)]));
                  size_c = std::max(size_c, std::abs(ad));
                }
              ASSERT_LT(error, 1e-9 * size_c) << "isotropic " << static_cast<int>(isotropic) << " kinematic "
                                              << static_cast<int>(kinematic) << " n " << n << " eta " << eta
                                              << " T " << temperature << " strain " << size;
              if (law.symmetric()) {
                ASSERT_LT(asymmetry, 1e-15 * size_c);
              }
              ++(r.flow_increment > 0 ? count.plastic : count.elastic);
              count.largest_change = std::max(count.largest_change, std::abs(r.temperature - temperature));
            }
        }
  EXPECT_GT(count.elastic, 300);
  EXPECT_GT(count.plastic, 500);
  EXPECT_GT(count.largest_change, 10);  // the temperature moves
}

TEST(IsentropicTangent, IsTheDerivativeOfTheStressAndSymmetricWithAMaxwellLiquid) {
  check_tangents(LiquidModel::maxwell);
}
TEST(IsentropicTangent, IsTheDerivativeOfTheStressAndSymmetricWithAModifiedShearModulus) {
  check_tangents(LiquidModel::modified_shear);
}
TEST(IsentropicTangent, IsTheDerivativeOfTheStressAndSymmetricInTheDegeneratedModel) {
  check_tangents(LiquidModel::degenerated);
}

/// S^E of a state at fixed f_S and e^pc, less its sensible part, by differences of Ψ: independent of the law.
double frozen_entropy(const Material& m, const Viscoplastic::State<double>& state, const Sym<double>& strain,
                      double theta, double frozen_at) {
  Material solid = m;  // elastic properties without phase changes; fraction and straining by hand
  solid.phase_changes.clear();
  const double f = m.solid_fraction(frozen_at);
  double straining = 0;
  for (const auto& change : m.phase_changes)
    straining += change.volume_change *
                 (change.fraction.value(frozen_at) - change.fraction.value(k_start_temperature));
  const Sym<double> e = dev(strain) - state.viscous_strain - state.plastic_strain;
  const auto at = [&](const auto& t) {
    using T = std::remove_cvref_t<decltype(t)>;
    const auto p = properties_at(solid, t, T(k_start_temperature));
    const T spring = f > 0 ? T(p.shear * T(1.0 / f)) : T(0.0);
    const T tr(trace(strain));
    return T(volumetric_energy(m, p.bulk, T(p.thermal_strain + T(straining)), tr) + spring * T(dot(e, e)) +
             hardening_potential<T>(*m.flow, flow_properties_at(*m.flow, t), T(state.hardening),
                                    T(dot(state.back_strain, state.back_strain))));
  };
  return -at(Jet<double>::variable(theta)).d;
}

TEST(Isentropic, ElasticEntropyOfTheFreeEnergyKeepsItsValue) {
  // through the free energy and the tables themselves, where the step stays between their points
  Random random(4);
  int checked = 0, plastic = 0;
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const double temperature : {420.0, 730.0, 911.0, 975.0}) {
        const Material m = varying_material({isotropic, kinematic, 1e7, 3});
        const Isentropic law(m);
        auto state = random_state(random);
        if (temperature > 930) state.viscous_strain = -1.0 * state.plastic_strain;  // a liquid at rest
        Sym<double> old_strain = Sym<double>::identity() * 1e-4;
        if (temperature < 930) old_strain += random_tensor(random, 1e-4);
        const auto strain = random_tensor(random, 2e-3);
        const auto [p, r] = step(law, temperature, state, old_strain, strain, 1.0);
        ASSERT_EQ(r.status, Status::converged);
        ASSERT_LT(std::abs(r.temperature - temperature), 10);
        const double before = frozen_entropy(m, state, old_strain, temperature, temperature);
        const double after = frozen_entropy(m, r.state, strain, r.temperature, temperature) +
                             sensible_heat(m, temperature, r.temperature).entropy;
        const double c = m.density * m.specific_heat.value(temperature);
        EXPECT_NEAR(after, before, 1e-10 * c) << temperature;
        ++checked;
        plastic += r.flow_increment > 0;
      }
  EXPECT_EQ(checked, 60);
  EXPECT_GT(plastic, 20);
}

TEST(Isentropic, TheTwoStepMethodStartsFromItsStateAndKeepsTheEntropyOfTheCommittedOne) {
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear, 1e7, 3});
  const Isentropic law(m);
  Random random(12);
  const auto before = random_state(random);
  auto now = before;
  now.plastic_strain += dev(random_tensor(random, 1e-4));
  now.hardening += 1e-4;
  const auto old_strain = random_tensor(random, 1e-4), strain = random_tensor(random, 3e-3);
  const TimeStep step = TimeStep::two_step(0.5, 0.7);
  auto p = law.properties_at(650.0, k_start_temperature);
  p.entropy = law.entropy(p, old_strain, now);
  const auto r = law.update(p, start_state(step, now, before), strain, step.dt);
  EXPECT_GT(r.flow_increment, 0);
  const double after =
      frozen_entropy(m, r.state, strain, r.temperature, 650) + sensible_heat(m, 650.0, r.temperature).entropy;
  EXPECT_NEAR(after, frozen_entropy(m, now, old_strain, 650, 650), 1e-10 * p.capacity.value);
}

TEST(Isentropic, KelvinEffectOfElasticStrainingIsMinusThreeAlphaKThetaTraceOverC) {
  Material m = flow_material({});
  m.phase_changes.clear();
  m.flow.reset();  // works without plastic data
  m.specific_heat = 480;
  m.young_modulus = 210e9;
  m.poisson_ratio = 0.3;
  m.expansion = 1.2e-5;
  const double theta = 300, tr = 1e-5, k = 210e9 / 1.2;
  for (const auto measured : {SpecificHeatAt::constant_strain, SpecificHeatAt::constant_pressure}) {
    m.specific_heat_at = measured;
    const Isentropic law(m);
    // C at constant strain: C_p − 9 α² k Θ
    const double less = measured == SpecificHeatAt::constant_pressure ? 9 * 1.2e-5 * 1.2e-5 * k * theta : 0,
                 c = 480 * m.density - less;
    const auto [p, r] = step(law, theta, {}, {}, {{tr, 0, 0, 0, 0, 0}}, 1.0);
    const double expected = -3 * 1.2e-5 * k * theta * tr / c;
    EXPECT_NEAR(r.temperature - theta, expected, 1e-4 * std::abs(expected));
    // the adiabatic bulk modulus: K_S = K (1 + 9 α² K Θ/C)
    const auto tangent = full_tangent(r);
    const double adiabatic = (tangent[0][0] + tangent[0][1] + tangent[0][2]) / 3;
    EXPECT_NEAR(adiabatic / k - 1, 9 * 1.2e-5 * 1.2e-5 * k * theta / c, 1e-6);
  }
}

TEST(Isentropic, PlasticShearHeatsByItsDissipationAndNotByTheMappingWhereNothingStores) {
  // no hardening, constant moduli: the isentropic step leaves the temperature, D_mech = √⅔ σ_0 γ̇ heats
  Material m = flow_material({});
  m.phase_changes.clear();
  m.specific_heat = 480;
  m.young_modulus = 210e9;
  m.poisson_ratio = 0.3;
  m.flow->flow_stress = 250e6;
  const Isentropic law(m);
  const double c = 480 * m.density, dt = 0.1, shear_rate = 0.02;
  double theta = 300, heated = 0, plastic_strain = 0;
  Viscoplastic::State<double> state{};
  Sym<double> strain{};
  for (int i = 0; i < 100; ++i) {
    const Sym<double> old = strain;
    strain[3] += 0.5 * shear_rate * dt;
    auto p = law.properties_at(theta, 300.0);
    p.entropy = law.entropy(p, old, state);
    const auto r = law.update(p, state, strain, dt);
    EXPECT_NEAR(r.temperature, theta, 1e-9);
    EXPECT_NEAR(r.dissipation * dt, std::sqrt(2.0 / 3) * 250e6 * r.flow_increment, 1e-6);
    heated += r.dissipation * dt / c;
    theta = r.temperature + r.dissipation * dt / c;
    plastic_strain = r.state.hardening;
    state = r.state;
  }
  // γ = 0.2 in all; ε_p = (γ − τ_y/G)/√3
  const double tau = 250e6 / std::numbers::sqrt3, g = 210e9 / 2.6;
  EXPECT_NEAR(plastic_strain, (0.2 - tau / g) / std::numbers::sqrt3, 1e-12);
  EXPECT_NEAR(heated, 250e6 * plastic_strain / c, 1e-9 * heated);
}

TEST(Isentropic, StoredEnergyOfHardeningCoolsWhereItsStressFallsWithTemperature) {
  // Θ ΔS = −Θ K_Θ: with H falling, hardening raises the entropy at fixed Θ, so Θ̄ falls
  Material m = flow_material({IsotropicHardening::linear});
  m.phase_changes.clear();
  m.specific_heat = 480;
  m.young_modulus = 210e9;
  m.poisson_ratio = 0.3;
  m.expansion = 0.0;
  m.flow->flow_stress = 100e6;
  m.flow->hardening[LinearHardening::modulus] = Table({300, 1300}, {10e9, 0});
  const Isentropic law(m);
  const double theta = 400, shear = 0.1;
  const auto [p, r] = step(law, theta, {}, {}, {{0, 0, 0, 0.5 * shear, 0, 0}}, 1.0);
  const double xi = r.state.hardening, stored = 0.5 * 10e6 * xi * xi;  // −K_Θ
  EXPECT_NEAR(r.temperature, theta * std::exp(-stored / (480 * m.density)), 1e-9);
  EXPECT_LT(r.temperature, theta);
}

TEST(Isentropic, LiquidIsPurelyViscousAndFlowsNoPlasticStrain) {
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear, 1e6});
  const Isentropic law(m);
  const double dt = 0.3, theta = 950;
  Random random(2);
  const auto state = random_state(random);
  const auto strain = random_tensor(random, 1e-2);
  const auto [p, r] = step(law, theta, state, random_tensor(random, 1e-4), strain, dt);
  EXPECT_EQ(r.flow_increment, 0);  // 4.111b
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(r.state.plastic_strain[i], state.plastic_strain[i]);  // 4.112
    EXPECT_EQ(r.state.back_strain[i], state.back_strain[i]);
    const double e = dev(strain)[i] - state.plastic_strain[i];
    EXPECT_NEAR(r.state.viscous_strain[i], e, 1e-15);  // 4.113
    const double s = m.liquid_viscosity.value(theta) / dt * (e - state.viscous_strain[i]);
    EXPECT_NEAR(dev(r.stress)[i], s, 1e-12 * norm(dev(r.stress)));  // 4.114c with η(Θ_n)
  }
  EXPECT_EQ(r.state.hardening, state.hardening);
}

TEST(Isentropic, MushyWithoutPlasticityIsTheMaxwellElementWithTheSolidFractionOfTheStart) {
  Material m = varying_material({});
  m.flow->flow_stress = 1e12;
  const Isentropic law(m);
  const double dt = 0.3, theta = 900;
  Random random(2);
  const auto state = random_state(random);
  const auto strain = random_tensor(random, 1e-3);
  const auto [p, r] = step(law, theta, state, {}, strain, dt);
  const auto at = law.at_temperature(p, r.temperature);
  const double f = m.solid_fraction(theta), g = at.elastic.shear.v, eta = m.liquid_viscosity.value(theta);
  const double tau = eta * f / (2 * g * (1 - f));  // 4.118
  for (int i = 0; i < 6; ++i) {
    const double e = dev(strain)[i] - state.plastic_strain[i] - state.viscous_strain[i];
    EXPECT_NEAR(r.state.viscous_strain[i] - state.viscous_strain[i], dt / (tau + dt) * e, 1e-15);  // 4.117
    EXPECT_NEAR(dev(r.stress)[i], tau / (tau + dt) * 2 * g / f * e, 1e-12 * norm(dev(r.stress)));  // 4.121
  }
}

TEST(Isentropic, SolidKeepsItsViscousStrain) {
  const Material m = varying_material({IsotropicHardening::power});
  const Isentropic law(m);
  Random random(6);
  const auto state = random_state(random);
  const auto strain = random_tensor(random, 1e-2);
  const auto [p, r] = step(law, 500, state, {}, strain, 1.0);
  const double g = law.at_temperature(p, r.temperature).elastic.shear.v;
  EXPECT_GT(r.flow_increment, 0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(r.state.viscous_strain[i], state.viscous_strain[i]);  // 4.123
    const double e = dev(strain)[i] - r.state.plastic_strain[i] - state.viscous_strain[i];
    EXPECT_NEAR(dev(r.stress)[i], 2 * g * e, 1e-11 * norm(dev(r.stress)));  // 4.124
  }
}

TEST(Isentropic, AStepWithoutStrainLeavesASolidAsItIs) {
  const Material m = varying_material({IsotropicHardening::saturation, KinematicHardening::linear, 1e6, 3});
  const Isentropic law(m);
  const Sym<double> strain{{1e-4, 2e-4, -1e-4, 1e-4, 0, 0}};
  const auto [p, r] = step(law, 500, {}, strain, strain, 1.0);
  EXPECT_EQ(r.temperature, 500);
  EXPECT_EQ(r.entropy_defect, 0);
}

TEST(Isentropic, AnUnreachableEntropyIsOutsideTheRange) {
  const Material m = varying_material({IsotropicHardening::linear});
  const Isentropic law(m);
  auto p = law.properties_at(500.0, 300.0);
  for (const double entropy : {1e8, -1e8, std::nan("")}) {
    p.entropy = entropy;
    EXPECT_EQ(law.update(p, Isentropic::State<double>{}, Sym<double>{}, 1.0).status, Status::outside_range);
  }
  EXPECT_GE(p.lowest, 250);
  EXPECT_LE(p.highest, 1000);
}

/// A modulus that falls to a half within 40 K: lines of it end 40 K and more from Θ_n, and what is pulled and
/// let go may be warmer than that.
TEST(Isentropic, WhereTheLinesEndTheUpdateIsTheIsothermalOne) {
  Material m = varying_material({IsotropicHardening::linear, KinematicHardening::linear, 1e6, 3});
  for (const bool warmer : {true, false}) {
    m.young_modulus = warmer ? Table({300, 480, 560, 1500}, {2e11, 2e11, 5e10, 5e10})
                             : Table({300, 480, 560, 1500}, {5e10, 5e10, 2e11, 2e11});
    const Isentropic law(m);
    auto p = law.properties_at(520.0, k_start_temperature);
    const double free = law.at_temperature(p, p.temperature).elastic.thermal_strain.v / 3;
    const Sym<double> strain{{free + 1e-4, free - 2e-4, free + 3e-4, 5e-3, 0, 1e-4}};
    const double end = warmer ? p.highest : p.lowest;
    EXPECT_LT(std::abs(end - p.temperature), 60);
    p.entropy = (warmer ? 0.15 : -0.15) * p.capacity.value;  // of 78 K
    const auto r = law.update(p, {}, strain, 1.0);
    ASSERT_EQ(r.status, Status::converged);
    EXPECT_EQ(r.temperature, end);
    EXPECT_GT(r.flow_increment, 0);
    EXPECT_EQ(r.entropy_defect < 0, warmer);

    p.entropy += r.entropy_defect;  // that of this temperature
    const auto same = law.update(p, {}, strain, 1.0);
    ASSERT_EQ(same.status, Status::converged);
    EXPECT_NEAR(same.temperature, end, 1e-6);
    EXPECT_LT(norm(Sym<double>(r.stress - same.stress)), 1e-6 * norm(same.stress));
    const Viscoplastic::Response<double>& isothermal = same;
    const auto c = full_tangent(r), expected = full_tangent(isothermal);
    for (int a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < 6; ++b) EXPECT_NEAR(c[a][b], expected[a][b], 1e-6 * expected[0][0]);
  }
}

TEST(Isentropic, AHardeningModulusThatIsAllButGoneLeavesItsRange) {
  Material m = varying_material({IsotropicHardening::linear, KinematicHardening::linear});
  m.flow->hardening[LinearHardening::modulus] = m.flow->kinematic_modulus = Table({300, 700}, {4e8, 0});
  const Isentropic law(m);
  const Sym<double> strain{{-4e-4, -4e-4, -4e-4, 5e-4, 0, 0}};
  for (const double below : {1e-12, 1e-6, 0.1}) {
    const auto [p, r] = step(law, 700 - below, {}, {}, strain, 1.0);
    EXPECT_EQ(r.status, Status::converged);
    EXPECT_GT(r.temperature, p.temperature) << "pressed together";
    // E 1e-2 (1 - 1/4) over the slope of 1e6 Pa/K: hundreds of kelvins, where the modulus alone leaves
    // `below`.
    EXPECT_GT(p.highest - p.temperature, 100);
  }
}

TEST(Isentropic, MeltingASolidUnderStressStaysInRange) {
  // the elastic strain of a solid in a spring G/f_S that is 1e9 times stiffer
  const Material m = varying_material({});
  const Isentropic law(m);
  const Sym<double> strain{{1e-3, -1e-3, 0, 5e-4, 0, 0}};
  for (const double theta : {905.0, 929.0, 930 - 5e-8, 930 - 5e-11, 931.0}) {
    const auto [p, r] = step(law, theta, {}, strain, strain, 1.0);
    EXPECT_EQ(r.status, Status::converged);
    EXPECT_NEAR(r.temperature, theta, 1);
  }
}

TEST(Isentropic, LanesAnswerAsNumbersDo) {
  Random random(8);
  for (const auto isotropic : k_isotropic)
    for (const double n : {1.0, 3.0}) {
      const Material m = varying_material({isotropic, KinematicHardening::linear, 1e7, n});
      const Isentropic law(m);
      Lane theta;
      Viscoplastic::State<double> states[k_lanes];
      Sym<double> olds[k_lanes], strains[k_lanes];
      Viscoplastic::State<Lane> state{};
      Sym<Lane> old, strain;
      for (int l = 0; l < k_lanes; ++l) {
        theta.set(l, 420 + 75 * l);
        states[l] = random_state(random);
        olds[l] = random_tensor(random, 1e-4);
        strains[l] = random_tensor(random, 4e-3);
        for (int i = 0; i < 6; ++i) {
          state.viscous_strain[i].set(l, states[l].viscous_strain[i]);
          state.plastic_strain[i].set(l, states[l].plastic_strain[i]);
          state.back_strain[i].set(l, states[l].back_strain[i]);
          old[i].set(l, olds[l][i]);
          strain[i].set(l, strains[l][i]);
        }
        state.hardening.set(l, states[l].hardening);
      }
      auto p = law.properties_at(theta, Lane(k_start_temperature));
      p.entropy = law.entropy(p, old, state);
      const auto r = law.update(p, state, strain, 0.5);
      for (int l = 0; l < k_lanes; ++l) {
        const auto [q, one] = step(law, theta[l], states[l], olds[l], strains[l], 0.5);
        EXPECT_NEAR(r.temperature[l], one.temperature, 1e-8);
        for (int i = 0; i < 6; ++i)
          EXPECT_NEAR(r.stress[i][l], one.stress[i], 1e-9 * norm(one.stress)) << l << ' ' << i;
      }
    }
}

}  // namespace
}  // namespace solidus::material::test
