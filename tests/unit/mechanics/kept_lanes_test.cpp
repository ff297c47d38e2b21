// Stored part of a point's history: the members of the law's state that the material can change.
#include <gtest/gtest.h>

#include "mechanics/elements/law_parts.hpp"
#include "plastic_material.hpp"

namespace solidus::test {
namespace {

using material::KinematicHardening;
using material::Material;
using mechanics::kept_lanes;

std::size_t viscoplastic_lanes(const Material& m) {
  return kept_lanes(material::Viscoplastic(m)).size();
}

Material melting(Material m) {
  material::PhaseChange change{"solidification", material::PhaseFraction::linear(800, 850)};
  change.solidification = true;
  m.phase_changes.push_back(change);
  m.liquid_viscosity = 1e3;
  return m;
}

TEST(KeptLanes, PlasticFlowHasSixStrainsAndTheirEquivalent) {
  EXPECT_EQ(viscoplastic_lanes(perfectly_plastic(1e8)), 7U);
}

TEST(KeptLanes, KinematicHardeningHasTheBackStrainBesides) {
  EXPECT_EQ(viscoplastic_lanes(plastic_material(KinematicHardening::linear)), 14U);
  EXPECT_EQ(viscoplastic_lanes(plastic_material(KinematicHardening::none)), 8U);
}

// The flow stress of plastic_material() falls with temperature: its lanes above hold S^I.
TEST(KeptLanes, ThermalSofteningHasItsEntropyAndATaylorQuinneyFactorTheColdWork) {
  Material m = perfectly_plastic(1e8);
  m.flow->flow_stress = Table({300, 500}, {1e8, 5e7});
  EXPECT_EQ(viscoplastic_lanes(m), 8U);
  m.flow->heat_share = 0.9;
  EXPECT_EQ(viscoplastic_lanes(m), 9U);
}

TEST(KeptLanes, AMeltHasTheViscousStrainBesides) {
  EXPECT_EQ(viscoplastic_lanes(melting(plastic_material())), 20U);
  EXPECT_EQ(kept_lanes(material::Viscoelastic(melting(elastic_material(2e11, 0.3, 1e-5)))).size(), 6U);
}

TEST(KeptLanes, ABlockThatTakesPartHasAHistory) {
  EXPECT_EQ(kept_lanes(material::Viscoelastic(elastic_material(2e11, 0.3, 1e-5))).size(), 1U);
}

// Members that are not stored start every step from zero: the law must not read them.
TEST(KeptLanes, TheLawDoesNotReadWhatIsNotKept) {
  const Material m = plastic_material(KinematicHardening::none);
  const material::Viscoplastic law(m);
  const auto p = law.properties_at(400.0, 300.0);
  Sym<double> strain;
  strain[0] = 2e-3;
  strain[3] = 1e-3;
  const auto first = law.update(p, material::Viscoplastic::State<double>{}, strain, 1.0);
  auto start = first.state;
  start.back_strain = start.viscous_strain = Sym<double>{};
  strain[0] = 4e-3;
  const auto all = law.update(p, first.state, strain, 1.0), kept = law.update(p, start, strain, 1.0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(all.stress[i], kept.stress[i]);
    EXPECT_EQ(all.state.plastic_strain[i], kept.state.plastic_strain[i]);
  }
  EXPECT_GT(all.state.hardening, first.state.hardening);
  EXPECT_EQ(all.state.hardening, kept.state.hardening);
  EXPECT_EQ(all.dissipation, kept.dissipation);
}

}  // namespace
}  // namespace solidus::test
