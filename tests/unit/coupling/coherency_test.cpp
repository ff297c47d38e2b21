/// Which nodes count as casting: those that no element with melt in it has.
#include "coupling/coherency.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

/// A plate whose wall at x = 0 is in contact, with a solid fraction that falls by 0.1 a metre from there.
struct Plate {
  mesh::Mesh mesh;
  std::vector<material::Material> materials{freezes(0.5)};
  coupling::Coherency coherency;

  Plate(mesh::Shape shape, int cells, double size)
      : mesh([&] {
          mesh::RawMesh raw = test::make_raw({.shape = shape, .cells = {cells, 2, 1}, .size = {size, 1, 1}});
          mesh::validate_and_orient(raw, "lattice");
          return mesh::distribute(raw, {"body"}, {"left"});
        }()),
        coherency(mesh, materials, linear::ActiveSet(mesh, {})) {}
  /// Coherency of the wall where the isotherm of the coherency fraction lies at a depth, with a least
  /// thickness of the shell.
  std::vector<double> of_wall(double depth, double thickness) {
    const std::vector<std::string> wall{"left"};
    coherency.set_shells(wall, std::vector<double>{thickness});
    // Linear from 800 K (solid) to 900 K (melt): half solid at 850 K, at x = depth.
    std::vector<double> temperature, of_wall;
    for (const mesh::Point& x : mesh.x) temperature.push_back(850 + 10 * (x[0] - depth));
    const std::vector<double> of_nodes = coherency.at(nullptr, {}, temperature);
    for (std::size_t i = 0; i < mesh.x.size(); ++i)
      if (mesh.x[i][0] == 0) of_wall.push_back(of_nodes[i]);
    return of_wall;
  }
};

TEST(Coherency, OfAWallIsTheDepthOfTheIsothermOverTheLeastThicknessOfAShell) {
  using mesh::Shape;
  for (const Shape shape :
       {Shape::quad4, Shape::tri3, Shape::hex8, Shape::tet4, Shape::tri6, Shape::quad8, Shape::tet10})
    for (const int cells : {8, 16, 40}) {
      Plate plate(shape, cells, 4);
      const std::string what = std::string(mesh::name(shape)) + ", " + std::to_string(cells) + " elements";
      // Elements of at most half a metre at the wall are coherent; the shell is thinner than asked for. From
      // a node in the middle of an edge no line between two nodes may run straight to the isotherm.
      for (const double depth : {0.7, 1.1, 1.9})
        for (const double c : plate.of_wall(depth, 2)) {
          EXPECT_GE(c, depth / 2 - 1e-12) << what;
          EXPECT_LE(c, depth / 2 * (mesh::order(shape) == 1 ? 1 + 1e-12 : 1.03)) << what;
        }
      // It is as thick, or no thickness is asked for: the elements decide.
      const std::vector<double> thick = plate.of_wall(2.1, 2), any = plate.of_wall(0.7, 0);
      for (const double c : thick) EXPECT_GE(c, 1) << what;
      for (const double c : any) EXPECT_GE(c, 1) << what;
    }
}

TEST(Coherency, OfAWallBehindWhichAllIsSolidOrMeltIsThatOfItsElements) {
  Plate plate(mesh::Shape::quad4, 8, 4);
  for (const double c : plate.of_wall(9, 2)) EXPECT_GT(c, 1);
  for (const double c : plate.of_wall(-1, 2)) EXPECT_LT(c, 1);
}

}  // namespace
}  // namespace solidus
