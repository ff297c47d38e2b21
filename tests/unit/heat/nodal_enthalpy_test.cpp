/// The enthalpy graph of a node: inverse, slope, plateaus, several materials at one node.
#include "heat/storage/nodal_enthalpy.hpp"

#include <gtest/gtest.h>

#include "block.hpp"

namespace solidus {
namespace {

/// Two triangles of different bodies that share two nodes.
mesh::Mesh two_bodies() {
  mesh::Mesh m;
  m.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  m.n_owned_nodes = 4;
  m.n_global_nodes = 4;
  m.global_node = {0, 1, 2, 3};
  m.input_node = {1, 2, 3, 4};
  m.bodies = {{"a"}, {"b"}};
  m.blocks = {{mesh::Shape::tri3, 0, {0, 1, 2}, {1}, 1}, {mesh::Shape::tri3, 1, {1, 3, 2}, {2}, 1}};
  return m;
}

/// Melts isothermally at 800 K with a capacity that varies; the other at 900 K, and both at 800 K too if
/// asked.
std::vector<material::Material> materials(bool together) {
  material::Material a = test::metal(0), b = test::metal(40);
  a.specific_heat = Table({300, 1200}, {800, 1400});
  a.phase_changes[0].fraction = material::PhaseFraction::linear(800, 800);
  if (together) b.phase_changes[0].fraction = material::PhaseFraction::linear(800, 800);
  return {a, b};
}

TEST(NodalEnthalpy, GivesTemperatureAndSlopeByOneLookUpAsByTwo) {
  for (const bool together : {false, true}) {
    const heat::NodalEnthalpy h(two_bodies(), AnalysisKind::plane_strain, materials(together));
    for (Index node = 0; node < 4; ++node) {
      const double cold = h.lower(node, 250), hot = h.upper(node, 1300);
      for (double share = 0; share <= 1; share += 1.0 / 512) {
        const double heat = cold + share * (hot - cold);
        const heat::NodalEnthalpy::Point point = h.point(node, heat);
        EXPECT_DOUBLE_EQ(point.temperature, h.temperature(node, heat));
        EXPECT_NEAR(point.slope, h.slope(node, heat), 1e-9 * h.slope(node, heat));
      }
    }
  }
}

TEST(NodalEnthalpy, IsInvertedExactlyAlsoWhereSeveralMaterialsMeet) {
  for (const bool together : {false, true}) {
    const heat::NodalEnthalpy h(two_bodies(), AnalysisKind::plane_strain, materials(together));
    EXPECT_TRUE(h.has_plateaus());
    for (Index node = 0; node < 4; ++node)
      for (double t = 150; t < 1600; t += 12.5) {
        EXPECT_NEAR(h.temperature(node, h.upper(node, t)), t, 1e-9);
        EXPECT_NEAR(h.temperature(node, h.lower(node, t)), t, 1e-9);
      }
  }
}

TEST(NodalEnthalpy, HasTheSlopeOfItsInverse) {
  const heat::NodalEnthalpy h(two_bodies(), AnalysisKind::plane_strain, materials(false));
  for (Index node = 0; node < 4; ++node) {
    const double low = h.lower(node, 200), high = h.upper(node, 1500), step = 1e-7 * (high - low);
    for (int i = 1; i < 500; ++i) {
      const double heat = low + (high - low) * (i + 0.37) / 501;
      const double difference =
          (h.temperature(node, heat + step) - h.temperature(node, heat - step)) / (2 * step);
      EXPECT_NEAR(h.slope(node, heat), difference, 1e-6 * h.slope(node, low));
    }
  }
}

TEST(NodalEnthalpy, HasAnEntropyWhoseSlopeInHeatIsOneOverTemperature) {
  const heat::NodalEnthalpy h(two_bodies(), AnalysisKind::plane_strain, materials(false));
  for (Index node = 0; node < 4; ++node) {
    const double low = h.lower(node, 200), high = h.upper(node, 1500), step = 1e-5 * (high - low);
    for (int i = 1; i < 500; ++i) {
      const double heat = low + (high - low) * (i + 0.37) / 501;
      const auto entropy = [&](double at) { return h.entropy(node, at, h.temperature(node, at)); };
      EXPECT_NEAR((entropy(heat + step) - entropy(heat - step)) / (2 * step) * h.temperature(node, heat), 1,
                  1e-5);
    }
  }
}

TEST(NodalEnthalpy, SharesAPlateauBetweenTheMaterialsThatMeltThere) {
  const heat::NodalEnthalpy h(two_bodies(), AnalysisKind::plane_strain, materials(true));
  const double low = h.lower(1, 800), high = h.upper(1, 800), third = low + (high - low) / 3;
  EXPECT_EQ(h.temperature(1, third), 800.0);
  EXPECT_EQ(h.slope(1, third), 0.0);
  EXPECT_NEAR(h.plateau_share(1, third, 800), 1.0 / 3, 1e-12);
  EXPECT_NEAR(h.solid_fraction(1, third, 800), 2.0 / 3, 1e-12);
  EXPECT_NEAR(h.latent(1, third, 800), (high - low) / 3, 1e-9 * high);
  EXPECT_NEAR(h.latent_capacity(1), high - low, 1e-9 * high);
  EXPECT_NEAR(h.volume(1, 0), 1.0 / 6, 1e-14);
  EXPECT_EQ(h.volume(0, 1), 0.0);
}

}  // namespace
}  // namespace solidus
