/// Locking of plastic flow, which keeps its volume: the collapse loads of a tube and of a punch with the
/// constant volumetric mode (B-bar, 6.2) and without.
///
///   Hill's tube, the bore widened by two per cent:
///   one layer through the wall, or a quarter of the ring
///
///         │   ├──┬──┬──┤           ╭──╮
///         │ U→├──┴──┴──┤           U   ╲
///                                  └────┘
///
///   Prandtl's punch, smooth and rigid: p = (2 + π) k, k = σ_0/√3
///
///         ▓▓▓▓
///         ┌────────────┐
///         │            │▒
///         └────────────┘▒
///
/// After J. C. Nagtegaal, D. M. Parks, J. R. Rice, On numerically accurate finite element solutions in the
/// fully plastic range, Comput. Meth. Appl. Mech. Engng 4 (1974) 153–177.
#include <gtest/gtest.h>

#include <numbers>

#include "analytic/plastic_tube.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using verification::March;

constexpr double k_inner = 0.1, k_outer = 0.2, k_yield = 320e6;  // [m], [Pa]
const double k_collapse = analytic::PlasticTube{k_inner, k_outer, k_yield, 0}.collapse();

material::Material steel() {
  return verification::plastic_material(220e9, 0.3, k_yield);
}

constexpr double k_widening = 2e-3;  // [m], at time 1

/// A tube with its bore prescribed, and the area of the bore [m²].
struct Tube {
  Body body;
  double area;
};

Tube layer(Shape shape, int n, bool b_bar) {
  const double height = 0.1 / n;
  Lattice lattice{.shape = shape, .cells = {n, 1, 1}, .size = {k_outer - k_inner, height, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_inner, x[1], 0}; };
  Tube tube{Body(lattice, AnalysisKind::axisymmetric, steel()), 2 * std::numbers::pi * k_inner * height};
  tube.body.options.b_bar = b_bar;
  tube.body.hold("bottom", 1);
  tube.body.hold("top", 1);
  tube.body.hold("left", 0, Table({0, 1}, {0, k_widening}));
  return tube;
}

/// n elements through the wall and along the quarter.
Tube quarter(Shape shape, int n, bool b_bar) {
  const bool solid = mesh::dimension(shape) == 3;
  const double thickness = solid ? 0.02 : 1;
  Lattice lattice{.shape = shape, .cells = {n, n, 1}, .size = {1, 1, thickness}};
  lattice.map = [](const mesh::Point& x) {
    const double r = k_inner + (k_outer - k_inner) * x[0], angle = std::numbers::pi / 2 * x[1];
    return mesh::Point{r * std::cos(angle), r * std::sin(angle), x[2]};
  };
  Tube tube{Body(lattice, solid ? AnalysisKind::solid : AnalysisKind::plane_strain, steel()),
            std::numbers::pi / 2 * k_inner * thickness};
  Body& body = tube.body;
  body.options.b_bar = b_bar;
  body.hold("bottom", 1);
  body.hold("top", 0);
  if (solid) {
    body.hold("back", 2);
    body.hold("front", 2);
  }
  for (const Index node : body.mesh.surfaces.at("left").nodes) {
    const auto at = static_cast<std::size_t>(node);
    const std::string name = "node " + std::to_string(body.mesh.input_node[at]);
    const mesh::Point& x = body.mesh.x[at];
    for (std::size_t i = 0; i < 2; ++i)
      body.hold(name, static_cast<int>(i), Table({0, 1}, {0, k_widening * x[i] / std::hypot(x[0], x[1])}));
  }
  return tube;
}

/// The pressure on the bore after each of n equal steps, over that of collapse: by the work that the supports
/// do, of which only the bore moves.
std::vector<double> widen(const Tube& tube, int n) {
  March march(tube.body);
  std::vector<double> pressure;
  for (int step = 1; step <= n; ++step) {
    EXPECT_TRUE(march.to(1.0 * step / n));
    pressure.push_back(march.report().work.support_work / (tube.area * k_widening / n) / k_collapse);
  }
  return pressure;
}

struct Choice {
  const char* name;
  Tube tube;
  double low, high;  ///< pressure over that of collapse
};

// The mesh's own error is 0.2 %. Without B-bar the bore can still be widened, but against pressures that go
// on growing in proportion to the bulk modulus.
TEST(CollapseOfTheTube, IsAtThePressureOfTheClosedFormWithBBarAndAboveWithout) {
  std::vector<Choice> choices;
  choices.push_back({"quad4 B-bar, axisymmetric", layer(Shape::quad4, 10, true), 0.996, 1.004});
  choices.push_back({"quad4, axisymmetric", layer(Shape::quad4, 10, false), 1.01, 1.1});
  choices.push_back({"quad8, axisymmetric", layer(Shape::quad8, 10, true), 0.996, 1.004});
  choices.push_back({"quad4 B-bar, plane strain", quarter(Shape::quad4, 10, true), 0.996, 1.004});
  choices.push_back({"quad4, plane strain", quarter(Shape::quad4, 10, false), 1.007, 1.1});
  choices.push_back({"tri6, plane strain", quarter(Shape::tri6, 10, false), 0.996, 1.004});
  choices.push_back({"hex8 B-bar", quarter(Shape::hex8, 10, true), 0.996, 1.004});
  choices.push_back({"hex8", quarter(Shape::hex8, 10, false), 1.007, 1.1});
  choices.push_back({"tet4", quarter(Shape::tet4, 10, false), 1.01, 1.2});
  for (const Choice& choice : choices) {
    const double share = widen(choice.tube, 20).back();
    printf("%-28s %.4f\n", choice.name, share);
    EXPECT_GT(share, choice.low) << choice.name;
    EXPECT_LT(share, choice.high) << choice.name;
  }
}

/// Half of the punch: a block of 6 × 4 half-widths, squares of a size. The load per length over (2 + π) k
/// times the half-width, after each of n steps down to 6 % of it. The edge of the punch is between two nodes:
/// half an element counts to the width.
std::vector<double> punch(Shape shape, int per_half_width, bool b_bar, int n) {
  constexpr double k_depth = 0.06;
  Lattice lattice{.shape = shape, .cells = {6 * per_half_width, 4 * per_half_width, 1}, .size = {6, 4, 1}};
  Body body(lattice, AnalysisKind::plane_strain, verification::plastic_material(1e5 * 3, 0.3, 300.0));
  body.options.b_bar = b_bar;
  body.hold("left", 0);
  body.hold("right", 0);
  body.hold("bottom", 1);
  for (const Index node : body.mesh.surfaces.at("top").nodes) {
    const auto at = static_cast<std::size_t>(node);
    if (body.mesh.x[at][0] > 1 + 1e-9) continue;
    body.hold("node " + std::to_string(body.mesh.input_node[at]), 1, Table({0, 1}, {0, -k_depth}));
  }
  March march(body);
  std::vector<double> load;
  const double width = 1 + 0.5 / per_half_width / mesh::order(shape);
  for (int step = 1; step <= n; ++step) {
    EXPECT_TRUE(march.to(1.0 * step / n));
    const double force = march.report().work.support_work / (k_depth / n);
    load.push_back(force / (width * (2 + std::numbers::pi) * 300 / std::sqrt(3.0)));
  }
  return load;
}

TEST(PrandtlsPunch, CollapsesWithBBarAndSinksAgainstARisingLoadWithout) {
  constexpr int n = 20;
  const std::vector<double> with = punch(Shape::quad4, 6, true, n),
                            without = punch(Shape::quad4, 6, false, n);
  auto out = verification::table("plasticity_punch",
                                 "depth / half-width,exact_collapse,quad4_with_B-bar,quad4_without");
  for (std::size_t i = 0; i < n; ++i)
    out << 0.06 * static_cast<double>(i + 1) / n << ",1," << with[i] << "," << without[i] << "\n";
  printf("punch: with B-bar %.4f, without %.4f\n", with.back(), without.back());
  EXPECT_NEAR(with.back(), 1, 0.05);
  EXPECT_GT(without.back(), 1.1);
}

}  // namespace
}  // namespace solidus
