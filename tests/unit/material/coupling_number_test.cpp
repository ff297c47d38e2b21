/// Coupling numbers against the thick-walled cylinder of monograph 7.1, and the ratios between them.
#include "material/derivatives/coupling_number.hpp"

#include <gtest/gtest.h>

#include "sample_material.hpp"

namespace solidus::material {
namespace {

/// Tables 7.1 and 7.2.
Material steel(double expansion_factor) {
  constexpr auto k_on = Extrapolation::linear;
  Material m;
  m.density = 7800;
  m.specific_heat_at = SpecificHeatAt::constant_strain;  // 2.49c
  m.specific_heat = Table({273, 673}, {340, 390}, k_on);
  m.young_modulus = Table({273, 673}, {221.9e9, 183.9e9}, k_on);
  m.poisson_ratio = 0.3;
  m.expansion = Table({273, 673}, {expansion_factor * 1.19e-5, expansion_factor * 1.39e-5}, k_on);
  m.expansion_reference = 293;
  return m;
}

// Computed by the program of its own, tests/verification/reference/threshold.csv.
TEST(CouplingNumber, OfTheThickCylinderIsThatOfTheReference) {
  const CouplingNumber n = coupling_number(steel(1), 593);
  EXPECT_NEAR(n.uniaxial, 0.04002332, 1e-8);
  EXPECT_NEAR(n.plane, 0.056032648, 1e-9);
  EXPECT_NEAR(coupling_number(steel(6), 593).plane, 36 * 0.056032648, 1e-7);
  EXPECT_LT(coupling_number(steel(4.22), 593).plane, 1);  // the threshold on the expansion is 4.2245
  EXPECT_GT(coupling_number(steel(4.23), 593).plane, 1);
}

TEST(CouplingNumber, StandsInTheRatiosOfPoissonsNumber) {
  const Material m = sample_material();
  for (const double t : {320.0, 600.0, 870.0}) {
    const double nu = m.poisson_ratio.value(t);
    const CouplingNumber n = coupling_number(m, t);
    EXPECT_NEAR(n.plane / n.uniaxial, 2 * (1 - nu), 1e-12);
    EXPECT_NEAR(n.bound / n.uniaxial, 3 * (1 - nu) / (1 + nu), 1e-12);
  }
}

// C_p − C_v = β²Θ/k of thermodynamics, per volume.
TEST(CouplingNumber, IsBoundedByTheCapacitiesAtConstantPressureAndVolume) {
  Material m = steel(1);
  m.expansion = 1.2e-5;
  const double bulk = m.young_modulus.value(400) / (3 * (1 - 2 * 0.3)),
               capacity = 7800 * m.specific_heat.value(400);
  const double difference = 9 * 1.2e-5 * 1.2e-5 * bulk * 400;
  EXPECT_NEAR(coupling_number(m, 400).bound, difference / capacity, 1e-12);
  m.specific_heat_at = SpecificHeatAt::constant_pressure;
  EXPECT_NEAR(coupling_number(m, 400).bound, capacity / (capacity - difference) - 1, 1e-12);
}

TEST(CouplingNumber, OfAMeltKnowsNoShear) {
  const CouplingNumber n = coupling_number(sample_material(), 940);
  EXPECT_EQ(n.uniaxial, n.bound);
  EXPECT_EQ(n.plane, n.bound);
}

TEST(StrongestCoupling, IsAtTheHotEndWhereNothingElseWeighsMore) {
  EXPECT_EQ(strongest_coupling(steel(1), 293, 593), 593);
  EXPECT_EQ(strongest_coupling(steel(1), 400, 400), 400);
}

TEST(StrongestCoupling, IsFoundAtAPointOfATable) {
  Material m = steel(1);
  m.young_modulus = Table({300, 500, 501, 700}, {1e11, 3e11, 1e11, 1e11});
  EXPECT_NEAR(strongest_coupling(m, 300, 700), 500, 1e-9);
}

}  // namespace
}  // namespace solidus::material
