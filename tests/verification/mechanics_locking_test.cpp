/// Near-incompressibility: how much of the displacement is left when ν approaches 1/2, with the constant
/// volumetric modes (B-bar, 6.2) and without.
///
///   Tube: one layer through a thick wall under inner pressure, against Lamé.
///   Cook's panel: plane strain, 48 × 44 mm tapered to 16 mm, held left, sheared right; the corner C rises.
///
///                 ┌ C        Cook, R. D. (1974), Improved two-dimensional finite element, ASCE J. Struct.
///            ╱‾‾‾‾│ ↑ τ      Div. 100, 1851–1863, in its near-incompressible form. No closed form:
///       ╱‾‾       │          the reference is a fine mesh of 8-node quads.
///     ▒│        ╱
///     ▒│   ╱
///     ▒│╱
#include <gtest/gtest.h>

#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

constexpr double k_inner = 0.1, k_outer = 0.2, k_young = 2e11, k_pressure = 2e8;

struct Choice {
  Shape shape;
  bool b_bar;
};
const std::vector<Choice> k_choices{{Shape::quad4, true}, {Shape::quad4, false}, {Shape::tri3, false},
                                    {Shape::tri6, false}, {Shape::quad8, false}, {Shape::quad8, true}};

/// u(a) over Lamé's.
double tube(Choice choice, int n, double poisson) {
  Lattice lattice{.shape = choice.shape, .cells = {n, 1, 1}, .size = {k_outer - k_inner, 0.1 / n, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_inner, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(k_young, poisson));
  body.options.b_bar = choice.b_bar;
  body.options.simplices = mechanics::Simplices::displacement;  // mixed ones: simplex_cook_test.cpp
  body.hold("bottom", 1);
  body.hold("top", 1);
  body.conditions.pressures.push_back({"left", k_pressure});
  const Solved solved(body);
  const double a2 = k_inner * k_inner, b2 = k_outer * k_outer;
  const double lame =
      k_pressure * a2 * (1 + poisson) / (k_young * (b2 - a2)) * ((1 - 2 * poisson) * k_inner + b2 / k_inner);
  return verification::displacement_at(body, solved, {k_inner, 0, 0}, 0) / lame;
}

/// The rise of the corner [m].
double cook(Choice choice, int n, double poisson) {
  Lattice lattice{.shape = choice.shape, .cells = {n, n, 1}};
  lattice.map = [](const mesh::Point& x) {
    return mesh::Point{0.048 * x[0], 0.044 * x[0] + x[1] * (0.044 - 0.028 * x[0]), 0};
  };
  Body body(lattice, AnalysisKind::plane_strain, test::elastic_material(240.565e6, poisson));
  body.options.b_bar = choice.b_bar;
  body.options.simplices = mechanics::Simplices::displacement;  // mixed ones: simplex_cook_test.cpp
  body.hold("left", 0);
  body.hold("left", 1);
  body.conditions.tractions.push_back({"right", {Table(0.0), Table(6.25e6), Table(0.0)}});
  const Solved solved(body);
  return verification::displacement_at(body, solved, {0.048, 0.060, 0}, 1);
}

using Curves = std::vector<std::vector<double>>;                           ///< [choice][ν]
const std::vector<double> k_gaps{0.2, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};  ///< 1/2 − ν

Curves curves(const std::string& name, const std::function<double(Choice, double)>& displacement) {
  Curves all(k_choices.size());
  auto out = verification::table(
      name, "-log10(0.5 - nu),exact,quad4_with_B-bar,quad4_without,tri3,tri6,quad8_without,quad8_with_B-bar");
  for (const double gap : k_gaps) {
    out << -std::log10(gap) << ",1";
    for (std::size_t c = 0; c < k_choices.size(); ++c) {
      all[c].push_back(displacement(k_choices[c], 0.5 - gap));
      out << "," << all[c].back();
    }
    out << "\n";
  }
  return all;
}

TEST(Tube, KeepsItsDisplacementNearIncompressibilityWithBBarAndLocksWithout) {
  const Curves c = curves("mechanics_locking_tube",
                          [](Choice choice, double poisson) { return tube(choice, 16, poisson); });
  for (std::size_t i = 0; i < k_gaps.size(); ++i) {
    EXPECT_NEAR(c[0][i], 1, 1e-3) << k_gaps[i];  // the error of 16 cells, whatever ν
    EXPECT_NEAR(c[3][i], 1, 1e-3) << k_gaps[i];
    EXPECT_NEAR(c[5][i], 1, 1e-5) << k_gaps[i];
  }
  EXPECT_LT(c[1].back(), 0.02);          // what B-bar is there for
  EXPECT_NEAR(c[4].back(), 0.96, 0.02);  // fully integrated quadratic quads begin to lock
}

TEST(CookPanel, KeepsItsDisplacementNearIncompressibilityWithBBarAndLocksWithout) {
  std::map<double, double> reference;
  for (const double gap : k_gaps) reference[0.5 - gap] = cook({Shape::quad8, true}, 32, 0.5 - gap);
  const Curves c = curves("mechanics_locking_cook", [&](Choice choice, double poisson) {
    return cook(choice, 16, poisson) / reference.at(poisson);
  });
  for (std::size_t i = 0; i < k_gaps.size(); ++i) {
    EXPECT_NEAR(c[0][i], 1, 0.03) << k_gaps[i];
    EXPECT_NEAR(c[5][i], 1, 0.01) << k_gaps[i];
  }
  EXPECT_LT(c[1].back(), 0.5);
  EXPECT_LT(c[2].back(), 0.5);
}

TEST(CookPanel, IsTheSameOnAnyNumberOfProcesses) {
  // The number of a run on one process; the direct solver leaves about 1e-11.
  EXPECT_NEAR(cook({Shape::quad4, true}, 16, 0.4999), 0.00788863017387753, 1e-9 * 0.0079);
}

}  // namespace
}  // namespace solidus
