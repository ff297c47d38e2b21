/// Cook's panel of an incompressible material on stabilised triangles and tetrahedra: no locking, smooth
/// pressure.
///
///                 ┌ C        Plane strain, 48 × 44 mm tapered to 16 mm, held left, sheared right. No closed
///            ╱‾‾‾‾│ ↑ τ      form: the reference extrapolates fine meshes of quads with B-bar (Q1/P0).
///       ╱‾‾       │          R. D. Cook, Improved two-dimensional finite element, ASCE J. Struct. Div. 100
///     ▒│        ╱            (1974) 1851–1863.
///     ▒│   ╱
///     ▒│╱
#include <gtest/gtest.h>

#include "simplex_bodies.hpp"

namespace solidus {
namespace {

using test::Body;
using test::Lattice;
using test::Solved;
using verification::Element;

constexpr double k_poisson = 0.4999999;

struct Panel {
  double rise;       ///< of the corner C [m]
  double roughness;  ///< of the pressure
};

/// n × n cells; in three dimensions one layer as thick as a cell, held between two walls.
Body panel(const Element& element, int n) {
  const bool solid = mesh::dimension(element.shape) == 3;
  Lattice lattice{.shape = element.shape, .cells = {n, n, 1}, .size = {1, 1, 0.03 / n}};
  lattice.map = [](const mesh::Point& x) {
    return mesh::Point{0.048 * x[0], 0.044 * x[0] + x[1] * (0.044 - 0.028 * x[0]), x[2]};
  };
  Body body(lattice, solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
            test::elastic_material(240.565e6, k_poisson));
  element.choose(body.options);
  body.hold("left", 0);
  body.hold("left", 1);
  if (solid) {
    body.hold("front", 2);
    body.hold("back", 2);
  }
  body.conditions.tractions.push_back({"right", {Table(0.0), Table(6.25e6), Table(0.0)}});
  return body;
}

double rise(const Body& body, const Solved& solved) {
  return verification::displacement_at(body, solved, {0.048, 0.060, 0}, 1);
}

Panel solve(const Element& element, int n) {
  const Body body = panel(element, n);
  const Solved solved(body);
  return {rise(body, solved), verification::roughness(body, solved)};
}

const std::vector<Element> k_elements{verification::k_quad4,          verification::k_tri3,
                                      verification::k_tri3_algebraic, verification::k_tri3_locking,
                                      verification::k_tet4,           verification::k_tet4_algebraic,
                                      verification::k_tet4_locking};

/// Of a sequence whose differences fall by a factor (Aitken): the corner above the clamped side is singular,
/// so no order is known beforehand.
double limit(double first, double second, double third) {
  const double before = second - first, last = third - second;
  return third + last * last / (before - last);
}

TEST(IncompressibleCookPanel, RisesWithStabilisedSimplicesAsWithFineQuadsAndKeepsASmoothPressure) {
  const double reference = limit(solve(verification::k_quad4, 16).rise, solve(verification::k_quad4, 32).rise,
                                 solve(verification::k_quad4, 64).rise);
  const double quadratic = solve({"tri6", mesh::Shape::tri6}, 48).rise;
  printf("reference %.5f mm, tri6 %.5f mm\n", 1e3 * reference, 1e3 * quadratic);
  EXPECT_NEAR(quadratic, reference, 0.01 * reference);
  std::string header = "elements along a side,reference";
  for (const Element& element : k_elements) header += std::string(",") + element.name;
  auto out = verification::table("simplex_cook", header);
  std::map<std::string, std::vector<Panel>> panels;
  const std::vector<int> sides{4, 8, 16, 32};
  for (const int n : sides) {
    out << n << ",1";
    for (const Element& element : k_elements) {
      const Panel p = solve(element, n);
      panels[element.name].push_back(p);
      out << "," << p.rise / reference;
      printf("%2d %-18s rise %.4f, roughness %.4f\n", n, element.name, p.rise / reference, p.roughness);
    }
    out << "\n";
  }
  for (const Element& element : k_elements) {
    const std::vector<Panel>& of = panels[element.name];
    const double last = of[3].rise / reference;
    if (element.simplices == mechanics::Simplices::displacement) {
      EXPECT_LT(last, 0.3) << element.name;
      continue;
    }
    // Linear elements are some per cent too stiff in bending, and less by more than half with every halving.
    EXPECT_NEAR(last, 1, 0.035) << element.name;
    EXPECT_LT(of[3].rise, 1.005 * reference) << element.name;
    for (std::size_t i = 1; i < of.size(); ++i)
      EXPECT_LT(reference - of[i].rise, 0.55 * (reference - of[i - 1].rise)) << element.name;
    EXPECT_NEAR(limit(of[1].rise, of[2].rise, of[3].rise), reference, 0.01 * reference) << element.name;
    if (element.shape == mesh::Shape::quad4) {
      EXPECT_GT(of[3].roughness, 0.1);  // Q1/P0 is known for it
      continue;
    }
    EXPECT_LT(of[3].roughness, 0.01) << element.name;
    for (std::size_t i = 1; i < of.size(); ++i)
      EXPECT_LT(of[i].roughness, 0.85 * of[i - 1].roughness) << element.name;
  }
  EXPECT_GT(panels[verification::k_tri3_locking.name][3].roughness, 1);
}

}  // namespace
}  // namespace solidus
