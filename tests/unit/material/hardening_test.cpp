#include "material/hardening.hpp"

#include <gtest/gtest.h>

#include "dual.hpp"
#include "flow_cases.hpp"

namespace solidus::material::test {
namespace {

using Ad = test::Dual<double, 2>;  // by ξ and Θ

constexpr double k_strains[] = {0, 1e-9, 1e-4, 3e-3, 0.02, 0.3};

TEST(Hardening, StressIsTheDerivativeOfTheStoredEnergyAndTheSlopeThatOfTheStress) {
  for (const auto kind : k_isotropic) {
    const Material m = flow_material({kind});
    for (const double theta : {400.0, 700.0, 1000.0})
      for (const double xi : k_strains) {
        const Ad xi_ad(xi, 2, 0);
        const auto p = flow_properties_at(*m.flow, Ad(theta, 2, 1));
        const Ad energy = hardening_energy<Ad>(kind, m.flow->curves, p, xi_ad);
        const auto k = hardening_stress<Ad>(kind, m.flow->curves, p, xi_ad);
        EXPECT_NEAR(energy.derivatives()[0], k.stress.value(), 1e-6);  // of 1e8 Pa
        EXPECT_NEAR(k.stress.derivatives()[0], k.slope.value(), 1e-14 * k.slope.value());
      }
  }
}

TEST(Hardening, EnergyIsTheIntegralOfTheStress) {
  // Simpson's rule in steps of 1e-3; the table's kinks fall on its points.
  for (const auto kind : k_isotropic) {
    const Material m = flow_material({kind});
    const auto p = flow_properties_at(*m.flow, 500.0);
    const auto stress = [&](double xi) { return hardening_stress(kind, m.flow->curves, p, xi).stress; };
    double integral = 0;
    for (int i = 0; i < 100; ++i) {
      const double from = 1e-3 * i;
      integral += 1e-3 / 6 * (stress(from) + 4 * stress(from + 5e-4) + stress(from + 1e-3));
    }
    const double start =
        kind == IsotropicHardening::power ? 1e-3 : 1e-6;  // the power law's first steps curve
    EXPECT_NEAR(hardening_energy(kind, m.flow->curves, p, 0.1), integral, start * (integral + 1));
    EXPECT_EQ(hardening_energy(kind, m.flow->curves, p, 0.0), 0);
    EXPECT_EQ(stress(0), 0);
  }
}

TEST(Hardening, JetsCarryTheTemperatureDerivativesOfTheEnergy) {
  for (const auto kind : k_isotropic) {
    const Material m = flow_material({kind});
    for (const double xi : k_strains) {
      const double theta = 500;
      const auto p = flow_properties_at(*m.flow, Jet<double>::variable(theta));
      const auto jet = hardening_energy<Jet<double>>(kind, m.flow->curves, p, xi);
      const auto p_ad = flow_properties_at(*m.flow, Ad(theta, 2, 1));
      const Ad ad = hardening_energy<Ad>(kind, m.flow->curves, p_ad, Ad(xi));
      const double size = 1e8 * xi + 1e-300;
      EXPECT_NEAR(jet.v, ad.value(), 1e-9 * size + 1e-7);  // cancellation of ε_0 σ_0 = 1e5 at small ξ
      EXPECT_NEAR(jet.d, ad.derivatives()[1], 1e-12 * size + 1e-9);
    }
  }
}

TEST(Hardening, LanesAnswerAsNumbersDo) {
  for (const auto kind : k_isotropic) {
    const Material m = flow_material({kind});
    Lane theta, xi;
    for (int i = 0; i < k_lanes; ++i) {
      theta.set(i, 280 + 90 * i);
      xi.set(i, 0.008 * i);
    }
    const auto p = flow_properties_at(*m.flow, theta);
    const auto k = hardening_stress(kind, m.flow->curves, p, xi);
    const Lane energy = hardening_energy(kind, m.flow->curves, p, xi);
    for (int i = 0; i < k_lanes; ++i) {
      const auto p_i = flow_properties_at(*m.flow, theta[i]);
      const auto k_i = hardening_stress(kind, m.flow->curves, p_i, xi[i]);
      EXPECT_NEAR(k.stress[i], k_i.stress, 1e-6);
      EXPECT_NEAR(k.slope[i], k_i.slope, 1e-13 * k_i.slope);
      EXPECT_NEAR(energy[i], hardening_energy(kind, m.flow->curves, p_i, xi[i]), 1e-8);
    }
  }
}

TEST(Hardening, IsWhatTheMonographsFormulaSays) {
  // 2.60 at 300 K: (σ_∞ − σ_0)(1 − exp(−δ ξ)), and H ξ in addition
  const Material m = flow_material({IsotropicHardening::saturation});
  const auto p = flow_properties_at(*m.flow, 300.0);
  const auto k = hardening_stress(IsotropicHardening::saturation, m.flow->curves, p, 0.02);
  EXPECT_NEAR(k.stress, 100e6 * (1 - std::exp(-1.0)) + 20e6, 1e-6);
}

}  // namespace
}  // namespace solidus::material::test
