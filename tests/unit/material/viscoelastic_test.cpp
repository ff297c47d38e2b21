#include "material/viscoelastic.hpp"
#include "dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace solidus::material {
namespace {

using Ad = test::Dual<double, 6>;

PointProperties<double> point(double solid_fraction, double viscosity) {
  return {60e9, 10e9, -0.01, solid_fraction, viscosity};
}

Sym<double> random_tensor(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Sym<double> a;
  for (int i = 0; i < 6; ++i) a[i] = uniform(random);
  return a;
}

TEST(Viscoelastic, TangentIsTheDerivativeOfTheStressFromMeltToSolid) {
  std::mt19937 random(3);
  for (const double f : {0.0, 1e-12, 1e-6, 0.3, 0.999, 1 - 1e-12, 1.0})
    for (const double eta : {1e-3, 1.0, 1e6, 1e13, 1e16})
      for (const double dt : {1e-6, 1.0, 1e3}) {
        const auto p = point(f, eta);
        const Sym<double> strain = random_tensor(random, 1e-2), viscous = dev(random_tensor(random, 1e-2));
        PointProperties<Ad> p_ad{Ad(p.bulk), Ad(p.shear), Ad(p.thermal_strain), Ad(f), Ad(eta)};
        Sym<Ad> strain_ad;
        Viscoelastic::State<Ad> old_ad;
        for (int i = 0; i < 6; ++i) {
          strain_ad[i] = Ad(strain[i], 6, i);
          old_ad.viscous_strain[i] = Ad(viscous[i]);
        }
        const auto r = Viscoelastic::update(p, {viscous}, strain, dt);
        const auto r_ad = Viscoelastic::update(p_ad, old_ad, strain_ad, dt);
        const auto tangent = Sym4<double>::isotropic(r.bulk, r.twice_shear);
        for (int a = 0; a < 6; ++a) {
          // the same operations: rounding of the stress itself (1e17 Pa for the stiffest melt), fused or not
          ASSERT_NEAR(r.stress[a], r_ad.stress[a].value(),
                      1e-9 * p.bulk * 1e-2 + 1e-14 * std::abs(r.stress[a]));
          for (int b = 0; b < 6; ++b) {
            // AD differentiates by tensor components; a shear component is half the engineering strain
            const auto j = static_cast<std::size_t>(b);
            const double exact = r_ad.stress[a].derivatives()[j] * (b < 3 ? 1.0 : 0.5);
            ASSERT_NEAR(tangent[a][j], exact, 1e-9 * (r.bulk + r.twice_shear))
                << "f " << f << " eta " << eta << " dt " << dt << " entry " << a << b;
          }
        }
      }
}

TEST(Viscoelastic, SolidIsElasticAndKeepsItsViscousStrain) {
  std::mt19937 random(4);
  const Sym<double> strain = random_tensor(random, 1e-3), viscous = dev(random_tensor(random, 1e-3));
  const auto p = point(1.0, 1e6);
  const auto r = Viscoelastic::update(p, {viscous}, strain, 0.5);
  const Sym<double> expected = 2 * p.shear * (dev(strain) - viscous) +
                               p.bulk * (trace(strain) - p.thermal_strain) * Sym<double>::identity();
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(r.stress[i], expected[i], 1e-14 * p.bulk);
    EXPECT_EQ(r.state.viscous_strain[i], viscous[i]);
  }
  EXPECT_EQ(r.twice_shear, 2 * p.shear);
  EXPECT_EQ(r.dissipation, 0);
}

TEST(Viscoelastic, LiquidIsNewtonianWithTwiceTheShearViscosityAndDissipatesAllShearWork) {
  std::mt19937 random(5);
  const Sym<double> viscous = dev(random_tensor(random, 1e-3)), increment = random_tensor(random, 1e-4);
  const double dt = 0.5, eta = 1e4;
  const auto p = point(0.0, eta);
  const auto r = Viscoelastic::update(p, {viscous}, viscous + increment, dt);
  const Sym<double> rate = (1 / dt) * dev(increment), s = dev(r.stress);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(s[i], eta * rate[i], 1e-13 * p.bulk);  // the pressure sets the rounding
    EXPECT_NEAR(r.state.viscous_strain[i], viscous[i] + dt * rate[i], 1e-17);
  }
  EXPECT_NEAR(r.dissipation / (eta * dot(rate, rate)), 1, 1e-12);
}

TEST(Viscoelastic, RelaxesAsAMaxwellElementAtFirstOrderInTheStep) {
  const double f = 0.4, eta = 1e9, end = 0.2;
  const auto p = point(f, eta);
  Sym<double> strain;
  strain[3] = 1e-3;
  // s decays as exp(−t/τ) from 2 (G/f) ε with τ = η f/(2 G λ)
  const double tau = eta * f / (2 * p.shear * (1 - f));
  const double exact = 2 * p.shear / f * 1e-3 * std::exp(-end / tau);
  double previous = 0;
  for (int steps = 100; steps <= 800; steps *= 2) {
    Viscoelastic::State<double> state{};
    double s = 0;
    for (int i = 0; i < steps; ++i) {
      const auto r = Viscoelastic::update(p, state, strain, end / steps);
      state = r.state;
      s = r.stress[3];
    }
    const double error = std::abs(s / exact - 1);
    if (steps > 100) {
      EXPECT_NEAR(previous / error, 2,
                  0.35);  // first order; the second-order part is a third of 1/steps·(T/τ)²
    }
    previous = error;
  }
  EXPECT_LT(previous, 0.1);
}

TEST(Viscoelastic, WorkIsStoredOrDissipatedAndTheStepLosesOnlyWhatBackwardEulerLoses) {
  std::mt19937 random(6);
  const auto p = point(0.5, 1e8);
  const double dt = 1e-3;
  Viscoelastic::State<double> state{};
  Sym<double> strain, s_old;
  for (int step = 0; step < 50; ++step) {
    const Sym<double> increment = dev(random_tensor(random, 1e-5));
    strain += increment;
    const auto r = Viscoelastic::update(p, state, strain, dt);
    const Sym<double> s = dev(r.stress), ds = s - s_old;
    const double compliance = p.solid_fraction / (4 * p.shear);
    const double work = dot(s, increment), stored = compliance * (dot(s, s) - dot(s_old, s_old));
    // s_{n+1} : Δε^e = Δ(stored) + ½ compliance-weighted square of the stress increment
    EXPECT_NEAR(work, stored + compliance * dot(ds, ds) + dt * r.dissipation,
                1e-12 * dot(s, s) / p.shear + 1e-12);
    EXPECT_GE(r.dissipation, 0);
    state = r.state;
    s_old = s;
  }
}

TEST(Viscoelastic, LanesAnswerAsNumbersDo) {
  std::mt19937 random(7);
  const Sym<double> strain = random_tensor(random, 1e-3), viscous = dev(random_tensor(random, 1e-3));
  PointProperties<Lane> p{Lane(60e9), Lane(10e9), Lane(-0.01), {}, {}};
  Sym<Lane> strains;
  Viscoelastic::State<Lane> old{};
  for (int i = 0; i < 6; ++i) {
    strains[i] = Lane(strain[i]);
    old.viscous_strain[i] = Lane(viscous[i]);
  }
  for (int i = 0; i < k_lanes; ++i) {
    p.solid_fraction.set(i, i / 7.0);
    p.viscosity.set(i, std::pow(10.0, 2 * i));
  }
  const auto r = Viscoelastic::update(p, old, strains, 0.1);
  for (int i = 0; i < k_lanes; ++i) {
    const auto ri = Viscoelastic::update(point(p.solid_fraction[i], p.viscosity[i]), {viscous}, strain, 0.1);
    for (int a = 0; a < 6; ++a) EXPECT_NEAR(r.stress[a][i], ri.stress[a], 1e-6);  // of 1e8 Pa
    EXPECT_DOUBLE_EQ(r.twice_shear[i], ri.twice_shear);
  }
}

}  // namespace
}  // namespace solidus::material
