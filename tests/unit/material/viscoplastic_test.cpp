/// Properties of the viscoplastic law: its equations, its limits, its dissipation.
#include "material/viscoplastic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../../laws/hardening_parameter.hpp"
#include "flow_cases.hpp"
#include "material/return_mapping.hpp"
#include "material/time_integration.hpp"

namespace solidus::material::test {
namespace {

constexpr double k_eps = std::numeric_limits<double>::epsilon();
const double k_root = std::sqrt(2.0 / 3);

template <class Check>
void for_random_updates(Check check) {
  Random random(31);
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const auto liquid : k_liquid)
        for (const double n : {1.0, 4.0})
          for (const double eta : {0.0, 1e3, 1e8}) {
            const Material m = flow_material({isotropic, kinematic, eta, n, liquid});
            const Viscoplastic law(m);
            for (const double temperature : {400.0, 890.0, 905.0, 925.0, 950.0})
              for (const double size : {1e-4, 1e-2, 0.5}) {
                auto p = law.properties_at(temperature, 300.0);
                p.elastic.bulk = 0;  // its pressure would set the rounding of the deviator
                const double dt = decades(random, -3, 2);
                const auto start = random_state(random);
                const Sym<double> strain = random_tensor(random, size);
                check(law, p, start, strain, dt, law.update(p, start, strain, dt));
              }
          }
}

TEST(Viscoplastic, ReturnsAStateThatSatisfiesItsEquations) {
  int flowing = 0, mushy = 0;
  for_random_updates([&](const Viscoplastic& law, const auto& p, const auto& start, const auto& strain,
                         double dt, const auto& r) {
    ASSERT_EQ(r.status, Status::converged);
    const auto sh = law.shear(p.elastic, dt);
    const double w = sh.strength, m = sh.flow_share, gamma = r.flow_increment;
    const Sym<double> free = dev(strain) - start.plastic_strain - start.viscous_strain;
    const double stress =
        sh.twice_shear * norm(free) + p.flow.kinematic_modulus * norm(start.back_strain) + p.flow.flow_stress;
    const double phi = yield_function(law, p, w, r.stress, r.state);
    if (gamma > 0) {  // 4.142
      ++flowing;
      if (p.elastic.solid_fraction < 1) ++mushy;
      const double d = p.flow.rate[Perzyna::drag_stress];
      const double x = d * std::pow(p.flow.rate[Perzyna::viscosity] * gamma / (m * dt * d),
                                    1 / p.flow.rate[Perzyna::exponent]);
      ASSERT_NEAR(phi, x, 20 * k_eps * stress + 1e-12 * x);
    } else if (m > 0) {
      ASSERT_LE(phi, 4 * k_eps * stress);  // 2.112
    } else {
      ASSERT_EQ(gamma, 0);
    }
    const Sym<double> flow = r.state.plastic_strain - start.plastic_strain;
    const double small = 4 * k_eps * (norm(strain) + norm(start.back_strain) + 1e-3);
    ASSERT_NEAR(norm(flow), gamma, small);
    ASSERT_NEAR(trace(r.state.plastic_strain), 0, small);
    ASSERT_NEAR(r.state.hardening - start.hardening, w * k_root * gamma, small);  // 4.144c
    const double b = w * k_root * p.flow.recall[0];
    for (int i = 0; i < 6; ++i) {
      ASSERT_NEAR(r.state.back_strain[i] * (1 + b * gamma), start.back_strain[i] - w * gamma * r.direction[i],
                  small * (1 + b * gamma));
      // 4.146a; the spring, the dashpot and flow share the strain (4.145)
      ASSERT_NEAR(dev(r.stress)[i], sh.twice_shear * (free[i] - flow[i]), 8 * k_eps * stress);
      const double viscous =
          sh.viscous_share > 0 ? dt * (1 - p.elastic.solid_fraction) / p.elastic.viscosity * dev(r.stress)[i]
                               : 0;
      ASSERT_NEAR(r.state.viscous_strain[i] - start.viscous_strain[i], viscous, 2 * small);
    }
  });
  EXPECT_GT(flowing, 1000);
  EXPECT_GT(mushy, 500);
}

TEST(Viscoplastic, WorkOfPlasticFlowIsDissipatedOrStoredAndNothingIsGained) {
  for_random_updates([](const Viscoplastic& law, const auto& p, const auto& start, const auto&, double dt,
                        const auto& r) {
    const Flow& flow = *law.material().flow;
    const double k = hardening_stress(flow.isotropic, flow.curves, p.flow, r.state.hardening).stress;
    const Sym<double> q = -2.0 / 3 * p.flow.kinematic_modulus * r.state.back_strain;
    // 2.58: D_plas = s : ε̇^vp − K_ξ ξ̇ + q : ζ̇
    const double stored =
        (k * (r.state.hardening - start.hardening) - dot(q, r.state.back_strain - start.back_strain)) / dt;
    const double size = r.plastic_power + std::abs(stored) + p.flow.flow_stress * r.flow_increment / dt;
    ASSERT_NEAR(r.plastic_dissipation, r.plastic_power - stored,
                1e-12 * size + 1e-15 * (norm(r.stress) + p.flow.kinematic_modulus * 1e-3) / dt);
    ASSERT_GE(r.plastic_dissipation, 0);
    ASSERT_GE(r.viscous_dissipation, 0);
    ASSERT_EQ(r.dissipation, r.viscous_dissipation + r.plastic_dissipation);  // 2.113
  });
}

TEST(Viscoplastic, RateIndependentFlowDoesNotDependOnStepOrExponent) {
  Random random(32);
  const Material one = flow_material({IsotropicHardening::saturation, KinematicHardening::linear, 0, 1});
  const Material eight = flow_material({IsotropicHardening::saturation, KinematicHardening::linear, 0, 8});
  const Viscoplastic law(one), other(eight);
  const auto p = law.properties_at(500.0, 300.0), p_other = other.properties_at(500.0, 300.0);
  for (int i = 0; i < 100; ++i) {
    const auto start = random_state(random);
    const Sym<double> strain = random_tensor(random, 1e-2);
    const auto r = law.update(p, start, strain, 1e-3), r_other = other.update(p_other, start, strain, 1e3);
    for (int c = 0; c < 6; ++c) ASSERT_NEAR(r.stress[c], r_other.stress[c], 1e-14 * p.elastic.bulk);
    ASSERT_EQ(r_other.plastic_dissipation > 0, r.flow_increment > 0);
  }
}

TEST(Viscoplastic, SmallViscosityConvergesToTheRateIndependentAnswerInFirstOrder) {
  Random random(33);
  const auto start = random_state(random);
  const Sym<double> strain = random_tensor(random, 1e-2);
  const auto shear_stress = [&](double eta) {
    const Material m = flow_material({IsotropicHardening::saturation, KinematicHardening::linear, eta, 1});
    const Viscoplastic law(m);
    return law.update(law.properties_at(500.0, 300.0), start, strain, 1.0).stress[3];
  };
  const double limit = shear_stress(0);
  double previous = std::abs(shear_stress(1e7) - limit);
  for (const double eta : {1e6, 1e5, 1e4}) {
    const double error = std::abs(shear_stress(eta) - limit);
    EXPECT_NEAR(previous / error, 10, 0.1);
    previous = error;
  }
}

TEST(Viscoplastic, WithoutFlowIsTheViscoelasticLaw) {
  Random random(34);
  Material m = flow_material({});
  m.flow.reset();
  const Viscoplastic law(m);
  for (const double temperature : {400.0, 880 + 5e-11, 905.0, 930 - 5e-11, 950.0}) {
    const auto p = law.properties_at(temperature, 300.0);
    const auto start = random_state(random);
    const Sym<double> strain = random_tensor(random, 1e-3);
    const auto r = law.update(p, start, strain, 0.1);
    const auto expected = Viscoelastic(m).update(p.elastic, Viscoelastic::State<double>{start.viscous_strain},
                                                 strain - start.plastic_strain, 0.1);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(r.stress[i], expected.stress[i], 4 * k_eps * p.elastic.bulk * 1e-2);
      EXPECT_NEAR(r.state.viscous_strain[i], expected.state.viscous_strain[i], 1e-18);
    }
    EXPECT_NEAR(r.twice_shear, expected.twice_shear, 2 * k_eps * expected.twice_shear);
    EXPECT_NEAR(r.dissipation, expected.dissipation, 1e-13 * expected.dissipation);
    EXPECT_EQ(r.flow_increment, 0);
  }
}

TEST(Viscoplastic, SolidKeepsItsViscousStrainAndLiquidItsPlasticHistoryExactly) {
  Random random(35);
  const Material m = flow_material({IsotropicHardening::linear, KinematicHardening::linear});
  const Viscoplastic law(m);
  const auto start = random_state(random);
  const Sym<double> strain = random_tensor(random, 1e-2);
  const auto solid = law.update(law.properties_at(400.0, 300.0), start, strain, 0.1);
  EXPECT_GT(solid.flow_increment, 0);
  EXPECT_EQ(solid.state.viscous_strain.c, start.viscous_strain.c);
  EXPECT_EQ(solid.viscous_dissipation, 0);
  const auto liquid = law.update(law.properties_at(950.0, 300.0), start, strain, 0.1);  // 4.112
  EXPECT_EQ(liquid.state.plastic_strain.c, start.plastic_strain.c);
  EXPECT_EQ(liquid.state.back_strain.c, start.back_strain.c);
  EXPECT_EQ(liquid.state.hardening, start.hardening);
  EXPECT_EQ(liquid.plastic_dissipation, 0);
}

TEST(Viscoplastic, MixedLanesAnswerAsNumbersDo) {
  Random random(36);
  // solid elastic, plastic far and near, almost solid, mushy, almost liquid, liquid, cold
  const double temperatures[] = {400, 500, 600, 880 + 5e-11, 905, 930 - 5e-11, 950, 250};
  const double sizes[] = {1e-5, 0.1, 1e-3, 1e-2, 1e-2, 1e-2, 1e-2, 1e-3};
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const auto liquid : k_liquid)
        for (const double n : {1.0, 5.0})
          for (const double eta : {0.0, 1e6}) {
            const Material m = flow_material({isotropic, kinematic, eta, n, liquid});
            const Viscoplastic law(m);
            Lane theta;
            Sym<Lane> strain;
            Viscoplastic::State<Lane> start{};
            for (int l = 0; l < k_lanes; ++l) {
              const auto s = random_state(random);
              const Sym<double> e = random_tensor(random, sizes[l]);
              theta.set(l, temperatures[l]);
              for (int i = 0; i < 6; ++i) {
                strain[i].set(l, e[i]);
                start.viscous_strain[i].set(l, l == 0 ? 0 : s.viscous_strain[i]);
                start.plastic_strain[i].set(l, l == 0 ? 0 : s.plastic_strain[i]);
                start.back_strain[i].set(l, l == 0 ? 0 : s.back_strain[i]);
              }
              start.hardening.set(l, s.hardening);
            }
            const auto p = law.properties_at(theta, Lane(300.0));
            const auto r = law.update(p, start, strain, 0.1);
            ASSERT_EQ(r.status, Status::converged);
            ASSERT_EQ(r.flow_increment[0], 0);
            ASSERT_GT(r.flow_increment[1], 0);
            for (int l = 0; l < k_lanes; ++l) {
              const auto lane = [l](const Sym<Lane>& a) {
                Sym<double> one;
                for (int i = 0; i < 6; ++i) one[i] = a[i][l];
                return one;
              };
              const auto p_l = law.properties_at(temperatures[l], 300.0);
              const auto r_l = law.update(p_l,
                                          {lane(start.viscous_strain), lane(start.plastic_strain),
                                           lane(start.back_strain), start.hardening[l]},
                                          lane(strain), 0.1);
              // Near the surface a relative overstress of 1e-3 costs three digits of γ.
              const double stress = 1e-12 * (p_l.elastic.bulk * sizes[l] + p_l.flow.flow_stress);
              const double small = 1e-12 * (sizes[l] + 1e-3);
              const double stiffness = 1e-10 * (p_l.elastic.bulk + p_l.elastic.shear);
              const auto c = full_tangent(r);
              const auto c_l = full_tangent(r_l);
              for (int i = 0; i < 6; ++i) {
                ASSERT_NEAR(r.stress[i][l], r_l.stress[i], stress) << l;
                ASSERT_NEAR(r.state.plastic_strain[i][l], r_l.state.plastic_strain[i], small) << l;
                ASSERT_NEAR(r.state.back_strain[i][l], r_l.state.back_strain[i], small) << l;
                ASSERT_NEAR(r.state.viscous_strain[i][l], r_l.state.viscous_strain[i], small) << l;
                for (std::size_t j = 0; j < 6; ++j) ASSERT_NEAR(c[i][j][l], c_l[i][j], stiffness) << l;
              }
              ASSERT_NEAR(r.dissipation[l], r_l.dissipation, 1e-9 * r_l.dissipation + stress) << l;
            }
          }
}

TEST(Viscoplastic, ExactlyOnTheYieldSurfaceIsElastic) {
  const Material m = flow_material({});
  const Viscoplastic law(m);
  auto p = law.properties_at(400.0, 300.0);
  Sym<double> strain;
  strain[3] = 1e-3;
  const double radius = return_mapping::smooth_norm(2 * p.elastic.shear * strain);
  p.flow.flow_stress = radius / return_mapping::k_root_two_thirds;
  while (return_mapping::k_root_two_thirds * p.flow.flow_stress < radius)
    p.flow.flow_stress = std::nextafter(p.flow.flow_stress, 1e300);
  EXPECT_EQ(law.update(p, {}, strain, 0.1).flow_increment, 0);
  p.flow.flow_stress *= 1 - 1e-15;  // a few units in the last place outside
  const auto r = law.update(p, {}, strain, 0.1);
  EXPECT_GT(r.flow_increment, 0);
  EXPECT_LT(r.flow_increment, 1e-16);
  EXPECT_EQ(r.status, Status::converged);
}

TEST(Viscoplastic, WithoutStressStrengthOrStiffnessTheAnswerIsFinite) {
  const auto finite = [](const Viscoplastic::Response<double>& r) {
    EXPECT_EQ(r.status, Status::converged);
    for (int i = 0; i < 6; ++i)
      if (!std::isfinite(r.stress[i] + r.left[i] + r.right[i] + r.state.plastic_strain[i])) return false;
    return std::isfinite(r.twice_shear + r.dissipation + r.flow_increment);
  };
  for (const auto isotropic : k_isotropic)
    for (const auto kinematic : k_kinematic)
      for (const auto liquid : k_liquid)
        for (const double n : {1.0, 5.0})
          for (const double eta : {0.0, 1e6})
            for (const double temperature : {400.0, 905.0, 950.0}) {
              const Material m = flow_material({isotropic, kinematic, eta, n, liquid});
              const Viscoplastic law(m);
              auto p = law.properties_at(temperature, 300.0);
              EXPECT_TRUE(finite(law.update(p, {}, Sym<double>{}, 0.1)));
              p.flow.flow_stress = 0;
              EXPECT_TRUE(finite(law.update(p, {}, Sym<double>{}, 0.1)));
              Sym<double> strain;
              strain[4] = 1e-2;
              EXPECT_TRUE(finite(law.update(p, {}, strain, 0.1)));
              (liquid == LiquidModel::maxwell ? p.elastic.viscosity : p.elastic.shear) = 0;  // 2Ĝ = 0
              EXPECT_TRUE(finite(law.update(p, {}, strain, 0.1)));
              p.flow.kinematic_modulus = 0;
              if (isotropic == IsotropicHardening::linear) p.flow.hardening[LinearHardening::modulus] = 0;
              if (isotropic == IsotropicHardening::saturation)
                p.flow.hardening[material::test::hardening_parameter(isotropic, "hardening_modulus")] = 0;
              EXPECT_TRUE(finite(law.update(p, {}, strain, 0.1)));
            }
}

TEST(Viscoplastic, ReportsATrialStressThatIsNoNumber) {
  const Material m = flow_material({});
  const Viscoplastic law(m);
  const auto p = law.properties_at(400.0, 300.0);
  Sym<double> strain;
  strain[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(law.update(p, {}, strain, 0.1).status, Status::outside_range);
  strain[3] = 1e200;
  EXPECT_EQ(law.update(p, {}, strain, 0.1).status, Status::outside_range);
}

TEST(Viscoplastic, DissipatesInEveryStepOfTheTwoStepMethodToo) {
  Random random(37);
  for (const auto kinematic : k_kinematic) {
    const Material m = flow_material({IsotropicHardening::saturation, kinematic, 1e7, 3.0});
    const Viscoplastic law(m);
    Viscoplastic::State<double> now{}, before{};
    Sym<double> strain;
    double dt_before = 0.1;
    for (int i = 0; i < 500; ++i) {
      strain += random_tensor(random, 1e-3);
      const double dt = dt_before * uniform(random, 0.5, 2);
      const auto step = i == 0 ? TimeStep::backward_euler(dt) : TimeStep::two_step(dt, dt_before);
      const auto start = start_state(step, now, before);
      ASSERT_GE(start.hardening, now.hardening);  // extrapolated
      const auto r = law.update(law.properties_at(uniform(random, 400, 928), 300.0), start, strain, step.dt);
      ASSERT_EQ(r.status, Status::converged);
      ASSERT_GE(r.viscous_dissipation, 0);
      ASSERT_GE(r.plastic_dissipation, 0);
      ASSERT_NEAR(trace(r.state.plastic_strain), 0, 1e-14);
      before = now;
      now = r.state;
      dt_before = dt;
    }
  }
}

}  // namespace
}  // namespace solidus::material::test
