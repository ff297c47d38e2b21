#include "material/tensile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "material/hardening.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {
namespace {

Flow plain() {
  Flow flow;
  flow.flow_stress = Table({300, 900}, {60e6, 20e6});
  return flow;
}

TEST(Tensile, TheStressIsTheFlowStressWithItsHardening) {
  Flow flow = plain();
  EXPECT_DOUBLE_EQ(tensile_stress(flow, 0.1, 600), 40e6);
  flow.isotropic = IsotropicHardening::linear;
  flow.hardening[LinearHardening::modulus] = 500e6;
  EXPECT_DOUBLE_EQ(tensile_stress(flow, 0.1, 600), 90e6);
  flow.isotropic = IsotropicHardening::saturation;
  set_hardening(flow,
                {{"saturation_stress", 140e6}, {"saturation_rate", 10.0}, {"hardening_modulus", 500e6}});
  EXPECT_NEAR(tensile_stress(flow, 0.1, 600), 40e6 + 100e6 * (1 - std::exp(-1)) + 50e6, 1e-6);
  flow.isotropic = IsotropicHardening::power;
  set_hardening(flow, {{"reference_strain", 0.01}, {"hardening_exponent", 0.3}});
  EXPECT_NEAR(tensile_stress(flow, 0.1, 600), 40e6 * std::pow(11, 0.3), 1e-6);
  flow.isotropic = IsotropicHardening::table;
  flow.curves = FlowCurves({0, 0.2}, {300, 900}, {60e6, 100e6, 20e6, 20e6});
  EXPECT_NEAR(tensile_stress(flow, 0.1, 600), 50e6, 1e-6);
}

TEST(Tensile, TheBackStressAddsToIt) {
  Flow flow = plain();
  flow.kinematic = KinematicHardening::linear;
  flow.kinematic_modulus = 1e9;
  EXPECT_DOUBLE_EQ(tensile_stress(flow, 0.01, 600), 50e6);
  flow.kinematic = KinematicHardening::armstrong_frederick;
  flow.recall[0] = 50;
  EXPECT_NEAR(tensile_stress(flow, 0.01, 600), 40e6 + 20e6 * (1 - std::exp(-0.5)), 1e-6);
  EXPECT_NEAR(tensile_stress(flow, 10, 600), 60e6, 1e-6) << "saturated";
}

TEST(Tensile, TheOverstressFlowsAtTheRate) {
  Flow flow = plain();
  EXPECT_EQ(tensile_overstress(flow, 1e-3, 600), 0);
  flow.rate[Perzyna::viscosity] = 1e9;
  EXPECT_NEAR(tensile_overstress(flow, 1e-3, 600), 1.5e6, 1e-6) << "n = 1: 3/2 eta times the rate";
  flow.rate[Perzyna::exponent] = 5;
  flow.rate[Perzyna::drag_stress] = 10e6;
  const double phi = std::sqrt(2.0 / 3) * tensile_overstress(flow, 1e-3, 600);
  const double gamma_rate = phi / 1e9 * std::pow(phi / 10e6, 4);
  EXPECT_NEAR(std::sqrt(2.0 / 3) * gamma_rate, 1e-3, 1e-15);
}

}  // namespace
}  // namespace solidus::material
