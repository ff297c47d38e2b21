/// The mechanical phase against closed forms.
#include <gtest/gtest.h>

#include "body.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

/// The component of the displacement of the node nearest to a place, the same on every process.
double displacement_at(const Body& body, const Solved& solved, const mesh::Point& place, int component) {
  double value = -1e300;
  for (Index node = 0; node < body.mesh.n_owned_nodes; ++node) {
    const mesh::Point& x = body.mesh.x[static_cast<std::size_t>(node)];
    if (std::hypot(x[0] - place[0], x[1] - place[1], x[2] - place[2]) < 1e-9)
      value = solved.u(body, node, component);
  }
  return algebra::global_max(value);
}

constexpr double k_inner = 0.1, k_outer = 0.2, k_pressure = 2e8;

/// Lamé: a tube of radii a, b under inner pressure p without axial strain,
/// u = p a² (1 + ν)/(E (b² − a²)) [(1 − 2ν) r + b²/r].
double lame(double young, double poisson, double r) {
  const double a2 = k_inner * k_inner, b2 = k_outer * k_outer;
  return k_pressure * a2 * (1 + poisson) / (young * (b2 - a2)) * ((1 - 2 * poisson) * r + b2 / r);
}

/// An axisymmetric strip through the wall: left is the inner surface.
double tube_displacement(Shape shape, int n, double poisson, bool b_bar) {
  Lattice lattice{.shape = shape, .cells = {n, 1, 1}, .size = {k_outer - k_inner, 0.1 / n, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_inner, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(2e11, poisson));
  body.options.b_bar = b_bar;
  body.hold("bottom", 1);
  body.hold("top", 1);
  body.conditions.pressures.push_back({"left", k_pressure});
  const Solved solved(body);
  return displacement_at(body, solved, {k_inner, 0, 0}, 0);
}

double rate(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(Tube, DisplacementConvergesAtSecondOrderToLame) {
  for (Shape shape : {Shape::tri3, Shape::quad4}) {
    const double exact = lame(2e11, 0.3, k_inner);
    const double coarse = std::abs(tube_displacement(shape, 16, 0.3, true) - exact);
    const double fine = std::abs(tube_displacement(shape, 32, 0.3, true) - exact);
    EXPECT_LT(fine, 2e-3 * exact) << mesh::name(shape);
    EXPECT_GT(rate(coarse, fine), 1.8) << mesh::name(shape);
    EXPECT_LT(rate(coarse, fine), 2.2) << mesh::name(shape);
  }
}

TEST(Tube, QuadraticShapesConvergeAtThirdOrderOrBetter) {
  for (Shape shape : {Shape::tri6, Shape::quad8}) {
    const double exact = lame(2e11, 0.3, k_inner);
    const double coarse = std::abs(tube_displacement(shape, 8, 0.3, true) - exact);
    const double fine = std::abs(tube_displacement(shape, 16, 0.3, true) - exact);
    EXPECT_LT(fine, 1e-4 * exact) << mesh::name(shape);
    EXPECT_GT(rate(coarse, fine), 2.7) << mesh::name(shape);
    EXPECT_LT(rate(coarse, fine), 4.5) << mesh::name(shape);
  }
}

TEST(Tube, BBarDoesNotLockNearIncompressibility) {
  const double exact = lame(2e11, 0.4999, k_inner);
  EXPECT_NEAR(tube_displacement(Shape::quad4, 16, 0.4999, true), exact, 0.01 * exact);
  EXPECT_LT(tube_displacement(Shape::quad4, 16, 0.4999, false), 0.7 * exact);  // what it is there for
}

/// Cook's tapered panel in plane strain: upward displacement of the upper right corner under a shear of 6.25
/// MPa.
double cook(Shape shape, int n, bool b_bar) {
  Lattice lattice{.shape = shape, .cells = {n, n, 1}};
  lattice.map = [](const mesh::Point& x) {
    return mesh::Point{0.048 * x[0], 0.044 * x[0] + x[1] * (0.044 - 0.028 * x[0]), 0};
  };
  Body body(lattice, AnalysisKind::plane_strain, test::elastic_material(240.565e6, 0.4999));
  body.options.b_bar = b_bar;
  body.hold("left", 0);
  body.hold("left", 1);
  body.conditions.tractions.push_back({"right", {Table(0.0), Table(6.25e6), Table(0.0)}});
  const Solved solved(body);
  return displacement_at(body, solved, {0.048, 0.060, 0}, 1);
}

TEST(CookPanel, BBarDoesNotLockNearIncompressibility) {
  const double reference = cook(Shape::quad8, 32, true);  // quadratic, fine: an independent element
  EXPECT_NEAR(cook(Shape::quad4, 32, true), reference, 0.015 * reference);
  EXPECT_LT(cook(Shape::quad4, 32, false), 0.8 * reference);
}

TEST(CookPanel, IsTheSameOnAnyNumberOfProcesses) {
  // The number of a run on one process; the direct solver leaves about 1e-11.
  EXPECT_NEAR(cook(Shape::quad4, 16, true), 0.00788863017387753, 1e-9 * 0.0079);
}

Body bar(Shape shape, AnalysisKind kind) {
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 500}, {2e11, 1.6e11});
  m.expansion = Table({300, 500}, {1.0e-5, 1.4e-5});
  m.expansion_reference = 293.15;
  Lattice lattice{.shape = shape, .cells = {2, 3, 2}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1};
  Body body(lattice, kind, m);
  body.temperature.assign(body.mesh.x.size(), 400.0);
  body.hold("bottom", 1);
  return body;
}
/// 2.51 at 400 K from 300 K: α(400) (400 − Θ_ref) − α(300) (300 − Θ_ref).
constexpr double k_free_strain = 1.2e-5 * (400 - 293.15) - 1.0e-5 * (300 - 293.15);

TEST(ThermalBar, FreeExpansionIsStressFree) {
  for (Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
    Body body = bar(shape, AnalysisKind::axisymmetric);
    const Solved solved(body);
    for (const auto& fields : solved.phase->element_fields())
      for (std::size_t e = 0; e < fields.stress.size(); ++e) {
        for (double s : fields.stress[e]) EXPECT_NEAR(s, 0, 1e-9 * 1.8e11 * k_free_strain);
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_NEAR(fields.strain[e][i], k_free_strain, 1e-9 * k_free_strain);
      }
  }
}

TEST(ThermalBar, ClampedBarCarriesTheClosedFormStress) {
  Body body = bar(Shape::hex8, AnalysisKind::solid);
  body.hold("top", 1);
  body.hold("left", 0);
  body.hold("back", 2);
  const Solved solved(body);
  const double sigma = -1.8e11 * k_free_strain;  // E(400 K)
  for (const auto& fields : solved.phase->element_fields())
    for (const auto& stress : fields.stress) {
      EXPECT_NEAR(stress[1], sigma, 1e-9 * std::abs(sigma));
      EXPECT_NEAR(stress[0], 0, 1e-9 * std::abs(sigma));
      EXPECT_NEAR(stress[2], 0, 1e-9 * std::abs(sigma));
    }
}

TEST(MaxwellRelaxation, EqualsTheClosedFormOfBackwardEuler) {
  material::Material m = test::elastic_material(2e11, 0.3);
  m.phase_changes.push_back(
      {.name = "freezing", .fraction = material::PhaseFraction::linear(390, 410), .solidification = true});
  m.liquid_viscosity = 5e10;
  const double shear = 2e11 / 2.6, f_s = 0.5, lambda = 0.5, eta = 5e10, dt = 0.2, gamma = 1e-3;
  for (bool b_bar : {false, true}) {
    Body body({.shape = Shape::quad4, .cells = {3, 3, 1}, .distortion = 0.15}, AnalysisKind::plane_strain, m);
    body.options.b_bar = b_bar;
    body.temperature.assign(body.mesh.x.size(), 400.0);
    body.hold_boundary([&](const mesh::Point& x) { return mesh::Point{gamma * x[1], gamma * x[0], 0}; });
    Solved solved(body);
    solved.state = solved.phase->initial_state();
    double dissipation = 0, internal = 0;
    for (int n = 1; n <= 6; ++n) {
      solved.step(body, n * dt, dt);
      const double first = gamma / (f_s / (2 * shear) + dt * lambda / eta);
      const double exact = first / std::pow(1 + dt * lambda * 2 * shear / (eta * f_s), n - 1);
      for (const auto& fields : solved.phase->element_fields())
        for (const auto& stress : fields.stress) EXPECT_NEAR(stress[3], exact, 1e-9 * exact);
      // the element is of unit volume: D = λ/η s:s with s:s = 2 σ_xy²
      EXPECT_NEAR(solved.report.work.dissipation, dt * lambda / eta * 2 * exact * exact,
                  1e-8 * dt * lambda / eta * 2 * exact * exact);
      dissipation += solved.report.work.dissipation;
      internal += solved.report.work.internal_work;
    }
    EXPECT_GT(internal, dissipation);  // some is still stored
  }
}

}  // namespace
}  // namespace solidus
