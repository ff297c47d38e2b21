/// The mass matrix against integrals of polynomials over the body.
#include "mechanics/loads/inertia.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lattice.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

using mechanics::MassKind;
using mechanics::MassMatrix;
using mesh::Shape;

constexpr double k_density = 2700;
constexpr Shape k_shapes[] = {Shape::tri3, Shape::tri6,  Shape::quad4, Shape::quad8,
                              Shape::tet4, Shape::tet10, Shape::hex8,  Shape::hex20};

/// A box from (1, 0, 0) m to (3, 1, 0.5) m; distorted inside, so that nothing is exact by symmetry.
mesh::Mesh box(Shape shape) {
  return test::make_mesh({.shape = shape,
                          .cells = {3, 2, 2},
                          .size = {2, 1, 0.5},
                          .distortion = 0.1,
                          .map = [](const mesh::Point& x) {
                            return mesh::Point{x[0] + 1, x[1], x[2]};
                          }});
}

std::vector<AnalysisKind> kinds(Shape shape) {
  if (mesh::dimension(shape) == 3) return {AnalysisKind::solid};
  return {AnalysisKind::plane_strain, AnalysisKind::axisymmetric};
}

/// ∫ x^n dV of the box.
double moment(Shape shape, AnalysisKind kind, int n) {
  const bool around = kind == AnalysisKind::axisymmetric;
  const double power = n + (around ? 2 : 1);
  const double along = (std::pow(3.0, power) - 1) / power;
  if (around) return 2 * std::numbers::pi * along;
  return mesh::dimension(shape) == 3 ? 0.5 * along : along;
}

/// aᵀ M b for fields of one component.
double form(const mesh::Mesh& mesh, const MassMatrix& mass, const std::vector<double>& a,
            const std::vector<double>& b) {
  std::vector<double> y(static_cast<std::size_t>(mesh.n_owned_nodes));
  mass.multiply(b, 1, y);
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += a[i] * y[i];
  return parallel::global_sum(sum);
}

struct Fields {
  std::vector<double> one, x;
  explicit Fields(const mesh::Mesh& mesh) : one(mesh.x.size(), 1.0) {
    for (const mesh::Point& p : mesh.x) x.push_back(p[0]);
  }
};

TEST(ConsistentMass, HasTheTotalAndTheMomentsOfTheBodyInEveryShapeAndKind) {
  for (const Shape shape : k_shapes)
    for (const AnalysisKind kind : kinds(shape)) {
      const mesh::Mesh mesh = box(shape);
      const MassMatrix mass(mesh, kind, std::vector{k_density}, MassKind::consistent);
      const Fields f(mesh);
      const double tolerance = 1e-12 * k_density * moment(shape, kind, 2);  // rounding
      EXPECT_NEAR(form(mesh, mass, f.one, f.one), k_density * moment(shape, kind, 0), tolerance);
      EXPECT_NEAR(form(mesh, mass, f.one, f.x), k_density * moment(shape, kind, 1), tolerance);
      EXPECT_NEAR(form(mesh, mass, f.x, f.x), k_density * moment(shape, kind, 2), tolerance)
          << mesh::name(shape) << " " << static_cast<int>(kind);
    }
}

TEST(LumpedMass, HasTheTotalOfTheBodyInPositiveParts) {
  for (const Shape shape : k_shapes)
    for (const AnalysisKind kind : kinds(shape)) {
      const mesh::Mesh mesh = box(shape);
      const MassMatrix mass(mesh, kind, std::vector{k_density}, MassKind::lumped);
      const Fields f(mesh);
      EXPECT_NEAR(form(mesh, mass, f.one, f.one), k_density * moment(shape, kind, 0),
                  1e-12 * k_density * moment(shape, kind, 2))
          << mesh::name(shape);
      std::vector<double> parts(static_cast<std::size_t>(mesh.n_owned_nodes));
      mass.multiply(f.one, 1, parts);
      for (const double m : parts) EXPECT_GT(m, 0) << mesh::name(shape);
    }
}

// Row sums are ∫ ρ N, which linear fields integrate exactly; diagonal scaling does not.
TEST(LumpedMass, OfLinearShapesHasTheFirstMomentToo) {
  for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::tet4, Shape::hex8})
    for (const AnalysisKind kind : kinds(shape)) {
      const mesh::Mesh mesh = box(shape);
      const MassMatrix mass(mesh, kind, std::vector{k_density}, MassKind::lumped);
      const Fields f(mesh);
      EXPECT_NEAR(form(mesh, mass, f.one, f.x), k_density * moment(shape, kind, 1),
                  1e-12 * k_density * moment(shape, kind, 2))
          << mesh::name(shape);
    }
}

TEST(MassMatrix, AddsToATangentWhatItMultipliesWith) {
  for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
    const mesh::Mesh mesh = box(Shape::tri6);
    MassMatrix mass(mesh, AnalysisKind::plane_strain, std::vector{k_density}, kind);
    linear::NodeGraph graph(mesh);
    for (const mesh::ElementBlock& block : mesh.blocks)
      graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    linear::BlockMatrix tangent(mesh, 2, std::move(graph));
    mass.bind(tangent);
    tangent.set_zero();
    mass.add_to(tangent, 3.0);
    std::vector<double> x;
    for (const mesh::Point& p : mesh.x) x.insert(x.end(), {p[0], std::sin(5 * p[1])});
    std::vector<double> direct(static_cast<std::size_t>(2 * mesh.n_owned_nodes)), by_tangent(direct.size());
    mass.multiply(x, 2, direct);
    tangent.multiply(x, by_tangent);
    for (std::size_t i = 0; i < direct.size(); ++i)
      EXPECT_NEAR(by_tangent[i], 3.0 * direct[i], 1e-12 * k_density) << i;
  }
}

}  // namespace
}  // namespace solidus
