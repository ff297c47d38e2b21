/// Loads and supports that vary over place and time, and a stress at the start, against closed forms.
///
/// A long ring a ≤ r ≤ b that turns with ω, without axial strain (Timoshenko and Goodier, Theory of
/// Elasticity, §32, with the constants of plane strain):
///
///   u = A r + B/r − ρω² r³/(8 (λ + 2μ)),   k = ρω² (2λ + 3μ)/(4 (λ + 2μ)),
///   2μ B = k a² b²,   2 (λ + μ) A = k (a² + b²)
///
/// A thin disc without a hole: u(b) = ρω² (1 − ν) b³/(4E), up to (thickness/b)².
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "body.hpp"
#include "mesh/block_geometry.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

constexpr double k_young = 2e11, k_poisson = 0.3;
constexpr double k_mu = k_young / (2 * (1 + k_poisson)),
                 k_lambda = k_young * k_poisson / ((1 + k_poisson) * (1 - 2 * k_poisson));
constexpr double k_density = 7800;  // of test::elastic_material [kg/m³]

/// A function of place and time as a test writes it.
class Written final : public PlaceLaw {
 public:
  explicit Written(std::function<double(const Position&, double)> f) : f_(std::move(f)) {}
  void values(std::span<const Position> x, double time, std::span<double> values) const override {
    for (std::size_t i = 0; i < x.size(); ++i) values[i] = f_(x[i], time);
  }

 private:
  std::function<double(const Position&, double)> f_;
};

PlaceFunction written(std::function<double(const Position&, double)> f) {
  return PlaceFunction(std::make_shared<Written>(std::move(f)));
}

/// ‖u_h − u‖/‖u‖ in L2 over the body.
double relative_error(const Body& body, const std::vector<double>& displacement,
                      const std::function<mesh::Point(const mesh::Point&)>& exact) {
  const auto components = static_cast<std::size_t>(displacement_components(body.kind));
  double error = 0, size = 0;
  for (const mesh::ElementBlock& block : body.mesh.blocks) {
    const mesh::BlockGeometry g(body.mesh, block, body.kind, mesh::gauss_rule(block.shape, 5));
    for (Index e = 0; e < block.n_counted; ++e)
      for (int q = 0; q < g.n_points; ++q) {
        mesh::Point x{}, u{};
        for (int a = 0; a < g.n_nodes; ++a) {
          const double n = g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
          const auto node = static_cast<std::size_t>(block.element(e)[a]);
          for (std::size_t i = 0; i < 3; ++i) x[i] += n * body.mesh.x[node][i];
          for (std::size_t i = 0; i < components; ++i) u[i] += n * displacement[node * components + i];
        }
        const mesh::Point u_exact = exact(x);
        const double w = g.weight_at(e / k_lanes, q)[static_cast<int>(e % k_lanes)];
        for (std::size_t i = 0; i < components; ++i) {
          error += w * (u[i] - u_exact[i]) * (u[i] - u_exact[i]);
          size += w * u_exact[i] * u_exact[i];
        }
      }
  }
  return std::sqrt(parallel::global_sum(error) / parallel::global_sum(size));
}

/// The order p of errors that fall like h^p when h is halved.
double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

constexpr double k_a = 0.1, k_b = 0.2, k_omega = 500;  // [m], [rad/s]

double turning_ring(double r) {
  const double f = k_density * k_omega * k_omega,
               k = f * (2 * k_lambda + 3 * k_mu) / (4 * (k_lambda + 2 * k_mu));
  const double a = k * (k_a * k_a + k_b * k_b) / (2 * (k_lambda + k_mu)),
               b = k * k_a * k_a * k_b * k_b / (2 * k_mu);
  return a * r + b / r - f * r * r * r / (8 * (k_lambda + 2 * k_mu));
}

void turn(Body& body) {
  mechanics::BodyForce force{"body", {0.0, 0.0, 0.0}, true};
  force.value[0] = written([](const Position& x, double) { return k_omega * k_omega * x[0]; });
  body.conditions.body_forces.push_back(std::move(force));
}

Body ring(Shape shape, int n) {
  Lattice lattice{.shape = shape, .cells = {n, 1, 1}, .size = {k_b - k_a, (k_b - k_a) / n, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + k_a, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(k_young, k_poisson));
  body.hold("bottom", 1);
  body.hold("top", 1);
  turn(body);
  return body;
}

double ring_error(const Body& body) {
  const Solved solved(body);
  return relative_error(body, solved.state.displacement, [](const mesh::Point& x) {
    return mesh::Point{turning_ring(x[0]), 0, 0};
  });
}

TEST(PlacedLoads, ATurningRingConvergesToTheClosedFormAtTheOrderOfItsElements) {
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8}) {
    const double coarse = ring_error(ring(shape, 8)), fine = ring_error(ring(shape, 16));
    EXPECT_NEAR(order(coarse, fine), mesh::order(shape) + 1, 0.1) << mesh::name(shape);
  }
}

// Mixed triangles have the force in their sub-scales too, which without it would take it for a gradient of
// the pressure that is not resolved.
TEST(PlacedLoads, ATurningRingOfMixedTrianglesConverges) {
  for (const auto stabilisation :
       {mechanics::Stabilisation::algebraic, mechanics::Stabilisation::orthogonal}) {
    const auto error = [&](int n) {
      Body body = ring(Shape::tri3, n);
      body.options.simplices = mechanics::Simplices::mixed;
      body.options.stabilisation = stabilisation;
      return ring_error(body);
    };
    const double coarse = error(8), fine = error(16);
    EXPECT_GT(order(coarse, fine), 1.7);
    EXPECT_LT(fine, 2e-3);
  }
}

TEST(PlacedLoads, ATurningDiscWidensAsInPlaneStress) {
  constexpr double k_thickness = 0.004;
  const Lattice lattice{.shape = Shape::quad8, .cells = {20, 1, 1}, .size = {k_b, k_thickness, 1}};
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(k_young, k_poisson));
  body.hold("bottom", 1);  // the plane of symmetry
  turn(body);
  const Solved solved(body);
  const double exact = k_density * k_omega * k_omega * (1 - k_poisson) * k_b * k_b * k_b / (4 * k_young);
  double rim = 0;
  for (Index node = 0; node < body.mesh.n_owned_nodes; ++node)
    if (body.mesh.x[static_cast<std::size_t>(node)][0] > k_b - 1e-9)
      rim = std::max(rim, solved.u(body, node, 0));
  EXPECT_NEAR(parallel::global_max(rim) / exact, 1, 2e-3);
}

// The traction of pure bending, σ_x = c y on both ends, and the displacement that belongs to it, in plane
// strain: u = −κ… with E' = E/(1 − ν²), ν' = ν/(1 − ν): u_x = c x y/E', u_y = −c (x² + ν' y²)/(2E').
TEST(PlacedLoads, TractionsByFormulaBendQuadraticElementsExactly) {
  constexpr double k_c = 1e9, k_length = 0.2, k_height = 0.1;
  const double plane = k_young / (1 - k_poisson * k_poisson), ratio = k_poisson / (1 - k_poisson);
  for (Shape shape : {Shape::tri6, Shape::quad8}) {
    Lattice lattice{.shape = shape, .cells = {4, 2, 1}, .size = {k_length, k_height, 1}};
    lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0], x[1] - 0.5 * k_height, 0}; };
    Body body(lattice, AnalysisKind::plane_strain, test::elastic_material(k_young, k_poisson));
    body.options.b_bar = false;
    // The left end is where it is displaced to by formula, the right end is pulled by formula, in half of the
    // time: the load grows with time.
    body.conditions.displacements.push_back(
        {"left", 0, written([](const Position&, double) { return 0.0; })});
    body.conditions.displacements.push_back({"left", 1, written([&](const Position& x, double t) {
                                               return -t * k_c * ratio * x[1] * x[1] / (2 * plane);
                                             })});
    body.conditions.tractions.push_back(
        {"right", {written([](const Position& x, double t) { return t * k_c * x[1]; }), 0.0, 0.0}});
    const Solved solved(body);
    const double error = relative_error(body, solved.state.displacement, [&](const mesh::Point& x) {
      return mesh::Point{k_c * x[0] * x[1] / plane, -k_c * (x[0] * x[0] + ratio * x[1] * x[1]) / (2 * plane),
                         0};
    });
    EXPECT_LT(error, 1e-9) << mesh::name(shape);
    // What the loads and the supports have done is what the body holds.
    const auto& work = solved.report.work;
    EXPECT_NEAR(work.external_work + work.support_work, work.internal_work, 1e-9 * work.internal_work);
  }
}

// A pressure that rises with depth, p = c (h − y), on the side of a block between smooth walls, and the same
// as a force in its volume: what pushes to the right is ½ c h² a metre.
TEST(PlacedLoads, ThePressureOfALiquidAndAForceInTheVolumeHaveTheirResultants) {
  constexpr double k_c = 7e4, k_height = 0.3, k_width = 0.2;
  for (Shape shape : {Shape::tri3, Shape::quad4, Shape::quad8, Shape::tri6}) {
    const Lattice lattice{
        .shape = shape, .cells = {3, 3, 1}, .size = {k_width, k_height, 1}, .distortion = 0.1};
    for (const bool in_volume : {false, true}) {
      Body body(lattice, AnalysisKind::plane_strain, test::elastic_material(k_young, k_poisson));
      body.hold("right", 0);
      body.hold("bottom", 1);
      const PlaceFunction depth = written([](const Position& x, double) { return k_c * (k_height - x[1]); });
      if (in_volume)
        body.conditions.body_forces.push_back({"body", {depth, 0.0, 0.0}});
      else
        body.conditions.pressures.push_back({"left", depth});
      const Solved solved(body);
      double reaction = 0;
      for (Index node = 0; node < body.mesh.n_owned_nodes; ++node)
        reaction += solved.report.reactions[static_cast<std::size_t>(2 * node)];
      const double whole = 0.5 * k_c * k_height * k_height * (in_volume ? k_width : 1);
      EXPECT_NEAR(parallel::global_sum(reaction), -whole, 1e-9 * whole) << mesh::name(shape);
    }
  }
}

struct Start {
  Shape shape;
  AnalysisKind kind;
  bool mixed = false;
};

class InitialStress : public ::testing::TestWithParam<Start> {
 protected:
  static Body body() {
    const Start start = GetParam();
    Lattice lattice{.shape = start.shape, .cells = {3, 2, 2}, .size = {0.3, 0.2, 0.2}, .distortion = 0.1};
    if (start.kind == AnalysisKind::axisymmetric)
      lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.1, x[1], 0}; };
    Body body(lattice, start.kind, test::elastic_material(k_young, k_poisson));
    body.options.simplices = start.mixed ? mechanics::Simplices::mixed : mechanics::Simplices::displacement;
    body.options.linear_tolerance = 1e-13;
    for (const mesh::ElementBlock& block : body.mesh.blocks) {
      std::vector<double>& stress = body.options.initial_stress.emplace_back();
      for (Index e = 0; e < block.size(); ++e) stress.insert(stress.end(), k_stress.begin(), k_stress.end());
    }
    return body;
  }
  /// About an axis σ_r = σ_hoop, so that a uniform stress is one of equilibrium.
  static constexpr std::array<double, 6> k_stress{5e7, -3e7, 5e7, 0, 0, 0};
};

TEST_P(InitialStress, AHeldBodyKeepsIt) {
  Body body = this->body();
  body.hold_boundary([](const mesh::Point&) { return mesh::Point{}; });
  const Solved solved(body);
  for (double u : solved.state.displacement) EXPECT_LT(std::abs(u), 1e-12);
  for (const auto& block : test::element_fields(solved))
    for (const auto& stress : block.stress)
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(stress[k], k_stress[k], 1e-5 * 5e7);
}

TEST_P(InitialStress, AFreeBodyLetsGoOfItByHookesLaw) {
  Body body = this->body();
  const bool solid = body.kind == AnalysisKind::solid, ring = body.kind == AnalysisKind::axisymmetric;
  if (!ring) body.hold("left", 0);
  body.hold("bottom", 1);
  if (solid) body.hold("back", 2);
  const Solved solved(body);
  // What is strained by −C⁻¹ σ_0 is free; in plane strain the stress along z stays, with what it makes.
  const auto [x, y, z, xy, yz, xz] = k_stress;
  const double plane = body.kind == AnalysisKind::plane_strain ? 0.0 : 1.0;
  const double e = 1 / k_young;
  std::array<double, 3> strain{-e * (x - k_poisson * (y + z)), -e * (y - k_poisson * (x + z)),
                               -e * (z - k_poisson * (x + y))};
  if (plane == 0) {
    strain[0] = -e * (1 + k_poisson) * ((1 - k_poisson) * x - k_poisson * y);
    strain[1] = -e * (1 + k_poisson) * ((1 - k_poisson) * y - k_poisson * x);
  }
  const int n = displacement_components(body.kind);
  for (Index node = 0; node < body.mesh.n_nodes(); ++node)
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(solved.u(body, node, i),
                  strain[static_cast<std::size_t>(i)] *
                      body.mesh.x[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)],
                  1e-11);
  for (const auto& block : test::element_fields(solved))
    for (const auto& stress : block.stress)
      for (const std::size_t k : {0U, 1U, 3U}) EXPECT_LT(std::abs(stress[k]), 1e3);
  // Nothing from outside has done any work on it.
  EXPECT_LT(std::abs(solved.report.work.internal_work), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Elements, InitialStress,
    ::testing::Values(Start{Shape::tri3, AnalysisKind::plane_strain},
                      Start{Shape::tri3, AnalysisKind::plane_strain, true},
                      Start{Shape::quad4, AnalysisKind::plane_strain},
                      Start{Shape::quad8, AnalysisKind::axisymmetric},
                      Start{Shape::tri3, AnalysisKind::axisymmetric, true},
                      Start{Shape::tri6, AnalysisKind::axisymmetric}, Start{Shape::tet4, AnalysisKind::solid},
                      Start{Shape::tet4, AnalysisKind::solid, true}, Start{Shape::hex8, AnalysisKind::solid},
                      Start{Shape::tet10, AnalysisKind::solid}, Start{Shape::hex20, AnalysisKind::solid}));

}  // namespace
}  // namespace solidus
