/// Bodies that collapse plastically, and their loads over those of the closed forms.
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
#pragma once

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "analytic/plastic_tube.hpp"
#include "plasticity_bodies.hpp"

namespace solidus::verification {

inline constexpr double k_bore = 0.1, k_rim = 0.2, k_tube_yield = 320e6;  // [m], [Pa]
inline constexpr double k_widening = 2e-3;                                // [m], at time 1
inline const double k_tube_collapse = analytic::PlasticTube{k_bore, k_rim, k_tube_yield, 0}.collapse();

/// A tube with its bore prescribed, and the area of the bore [m²].
struct Tube {
  test::Body body;
  double area;
};

inline material::Material tube_steel() {
  return plastic_material(220e9, 0.3, k_tube_yield);
}

/// One layer of n elements through the wall, axisymmetric.
inline Tube tube_layer(mesh::Shape shape, int n) {
  const double height = 0.1 / n;
  test::Lattice lattice{.shape = shape, .cells = {n, 1, 1}, .size = {k_rim - k_bore, height, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_bore, x[1], 0}; };
  Tube tube{test::Body(lattice, AnalysisKind::axisymmetric, tube_steel()),
            2 * std::numbers::pi * k_bore * height};
  tube.body.hold("bottom", 1);
  tube.body.hold("top", 1);
  tube.body.hold("left", 0, Table({0, 1}, {0, k_widening}));
  return tube;
}

/// A quarter of the ring, n elements through the wall and along the arc; in three dimensions one layer.
inline Tube tube_quarter(mesh::Shape shape, int n) {
  const bool solid = mesh::dimension(shape) == 3;
  const double thickness = solid ? 0.02 : 1;
  test::Lattice lattice{.shape = shape, .cells = {n, n, 1}, .size = {1, 1, thickness}};
  lattice.map = [](const mesh::Point& x) {
    const double r = k_bore + (k_rim - k_bore) * x[0], angle = std::numbers::pi / 2 * x[1];
    return mesh::Point{r * std::cos(angle), r * std::sin(angle), x[2]};
  };
  Tube tube{test::Body(lattice, solid ? AnalysisKind::solid : AnalysisKind::plane_strain, tube_steel()),
            std::numbers::pi / 2 * k_bore * thickness};
  test::Body& body = tube.body;
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
inline std::vector<double> widen(const Tube& tube, int n) {
  March march(tube.body);
  std::vector<double> pressure;
  for (int step = 1; step <= n; ++step) {
    EXPECT_TRUE(march.to(1.0 * step / n));
    pressure.push_back(march.report().work.support_work / (tube.area * k_widening / n) / k_tube_collapse);
  }
  return pressure;
}

inline constexpr double k_punch_depth = 0.06;  ///< over the half-width, at time 1

/// Half of the punch: a block of 6 × 4 half-widths, squares of a size, in three dimensions one layer.
inline test::Body punch(mesh::Shape shape, int per_half_width) {
  const bool solid = mesh::dimension(shape) == 3;
  test::Lattice lattice{.shape = shape,
                        .cells = {6 * per_half_width, 4 * per_half_width, 1},
                        .size = {6, 4, solid ? 1.0 / per_half_width : 1.0}};
  test::Body body(lattice, solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
                  plastic_material(1e5 * 3, 0.3, 300.0));
  body.hold("left", 0);
  body.hold("right", 0);
  body.hold("bottom", 1);
  if (solid) {
    body.hold("back", 2);
    body.hold("front", 2);
  }
  for (const Index node : body.mesh.surfaces.at("top").nodes) {
    const auto at = static_cast<std::size_t>(node);
    if (body.mesh.x[at][0] > 1 + 1e-9) continue;
    body.hold("node " + std::to_string(body.mesh.input_node[at]), 1, Table({0, 1}, {0, -k_punch_depth}));
  }
  return body;
}

/// The load per length over (2 + π) k times the half-width, after each of n steps. The edge of the punch is
/// between two nodes: half an element counts to the width.
inline std::vector<double> press(const test::Body& body, int per_half_width, int n) {
  March march(body);
  std::vector<double> load;
  const mesh::Shape shape = body.mesh.blocks[0].shape;
  const double width = 1 + 0.5 / per_half_width / mesh::order(shape);
  const double length = mesh::dimension(shape) == 3 ? 1.0 / per_half_width : 1.0;
  for (int step = 1; step <= n; ++step) {
    EXPECT_TRUE(march.to(1.0 * step / n));
    const double force = march.report().work.support_work / (k_punch_depth / n) / length;
    load.push_back(force / (width * (2 + std::numbers::pi) * 300 / std::sqrt(3.0)));
  }
  return load;
}

}  // namespace solidus::verification
