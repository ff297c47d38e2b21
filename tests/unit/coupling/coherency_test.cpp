/// Which nodes count as casting: those that no element with melt in it has.
#include "coupling/coherency.hpp"

#include <gtest/gtest.h>

#include "../mechanics/lattice.hpp"
#include "numbers/table.hpp"

namespace solidus {
namespace {

material::Material freezes(double coherency) {
  material::Material m;
  m.young_modulus = Table(70e9);
  m.poisson_ratio = Table(0.3);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(800, 900), 4e5, 0, true}};
  m.casting.coherency_fraction = coherency;
  return m;
}

/// A strip of four quads along x, solid on the left of x = 2 and molten on the right.
struct Strip {
  mesh::Mesh mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {4, 1, 1}, .size = {4, 1, 1}});
  std::vector<material::Material> materials;
  coupling::Coherency coherency;

  explicit Strip(double of_coherency)
      : materials{freezes(of_coherency)}, coherency(mesh, materials, linear::ActiveSet(mesh, {})) {}
  std::vector<double> at(double border) const {
    std::vector<double> temperature;
    for (const mesh::Point& x : mesh.x) temperature.push_back(x[0] < border ? 700 : 1000);
    return coherency.at(nullptr, {}, temperature);
  }
};

TEST(Coherency, OfANodeIsThatOfTheLeastSolidOfItsElements) {
  const Strip strip(0.5);
  ASSERT_TRUE(strip.coherency.melts());
  // Nodes at x = 0 and 1 are solid: elements 0, 1, 2, 3 are solid by 1, 0.5, 0 and 0 in the mean.
  const std::vector<double> coherency = strip.at(1.5);
  for (std::size_t i = 0; i < strip.mesh.x.size(); ++i) {
    const double x = strip.mesh.x[i][0];
    EXPECT_DOUBLE_EQ(coherency[i], x < 0.5 ? 2.0 : x < 1.5 ? 1.0 : 0.0) << "at x = " << x;
  }
}

TEST(Coherency, OfASolidNodeBesideMeltIsThatOfTheMelt) {
  const Strip strip(0.9);
  const std::vector<double> coherency = strip.at(0.5);  // the column at x = 0 alone is solid
  for (std::size_t i = 0; i < strip.mesh.x.size(); ++i) {
    const double x = strip.mesh.x[i][0];
    EXPECT_NEAR(coherency[i], x < 0.5 ? 0.5 / 0.9 : 0.0, 1e-15) << "at x = " << x;
    EXPECT_LT(coherency[i], 1) << "at x = " << x;
  }
}

TEST(Coherency, OfSolidMetalIsOneOverTheFractionBitByBit) {
  const Strip strip(0.3);
  EXPECT_EQ(strip.at(9), strip.coherency.of_solid());
  for (const double of_solid : strip.coherency.of_solid()) EXPECT_EQ(of_solid, 1 / 0.3);
}

}  // namespace
}  // namespace solidus
