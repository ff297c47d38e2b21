/// Kirchhoff's potential of a material and of a node: integral, inverse, slopes.
#include <gtest/gtest.h>

#include "block.hpp"
#include "heat/conduction/nodal_potential.hpp"

namespace solidus {
namespace {

const std::vector<Table>& conductivities() {
  static const std::vector<Table> all{Table(80.0), Table({300, 600, 1200}, {200, 150, 60}),
                                      Table({300, 600, 1200}, {60, 150, 200}, Extrapolation::linear),
                                      Table({300, 899.9, 900.1, 1000}, {150, 140, 14, 14})};
  return all;
}

TEST(KirchhoffPotential, IsTheIntegralOfTheConductivityAndHasAnInverse) {
  for (const Table& k : conductivities()) {
    const heat::KirchhoffPotential u(k);
    EXPECT_EQ(u.constant(), k.constant());
    for (double t = 250; t < 1400; t += 13.7) {
      EXPECT_NEAR(u.value(t) - u.value(400.0), k.integral(400.0, t), 1e-9 * std::abs(u.value(t)) + 1e-9);
      EXPECT_DOUBLE_EQ(u.conductivity(t), k.value(t));
      EXPECT_NEAR(u.temperature(u.value(t)), t, 1e-9 * t);
    }
  }
}

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

TEST(NodalPotential, IsInvertedAlsoWhereSeveralMaterialsMeet) {
  const mesh::Mesh mesh = two_bodies();
  for (const Table& a : conductivities())
    for (const Table& b : conductivities()) {
      const std::vector<heat::KirchhoffPotential> potentials{heat::KirchhoffPotential(a),
                                                             heat::KirchhoffPotential(b)};
      const heat::NodalPotential v(mesh, potentials, linear::ActiveSet(mesh));
      EXPECT_EQ(v.identity(), a.constant() && b.constant());
      for (Index node = 0; node < 4; ++node)
        for (double t = 310; t < 1190; t += 21.3) {
          EXPECT_NEAR(v.temperature(node, v.value(node, t), 700.0), t, 1e-8);
          const double eps = 1e-4;
          EXPECT_NEAR((v.value(node, t + eps) - v.value(node, t - eps)) / (2 * eps), v.slope(node, t), 1e-5);
        }
    }
}

}  // namespace
}  // namespace solidus
