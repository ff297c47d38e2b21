/// The tangent of mixed elements: the solver's direction is that of the forces with the pressure eliminated,
/// it is symmetric, and Newton's method converges as it should.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/mixed_solver.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::Stabilisation;
using mesh::Shape;

/// Half solid at 350 K, with moduli and expansion that vary with temperature.
material::Material mushy() {
  material::Material m = test::plastic_material();
  m.young_modulus = Table({300, 500}, {2e11, 1.5e11});
  m.poisson_ratio = Table({300, 500}, {0.3, 0.35});
  m.expansion = Table({300, 500}, {4e-5, 5e-5});
  m.liquid_viscosity = 1e10;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(340, 360),
                             .volume_change = -0.01,
                             .solidification = true});
  return m;
}

struct Setting {
  AnalysisKind kind;
  Mapping mapping;
  bool plastic;  ///< else elastic, Poisson's ratio 0.49
};

std::string name(const Setting& s) {
  const char* kinds[] = {"PlaneStrain", "Axisymmetric", "Solid"};
  return std::string(kinds[static_cast<int>(s.kind)]) +
         (s.mapping == Mapping::isentropic ? "Isentropic" : "Isothermal") + (s.plastic ? "Mushy" : "Elastic");
}

/// A mixed block in the middle of a step, without supports.
struct Mixed {
  mesh::Mesh mesh;
  int components;
  std::vector<material::Material> materials;
  std::vector<double> temperature, u;
  algebra::GhostExchange ghosts;
  std::vector<std::unique_ptr<mechanics::BlockKernel>> blocks;
  mechanics::BlockHistory history;
  std::unique_ptr<mechanics::PressureEquation> pressure;
  std::unique_ptr<algebra::BlockMatrix> matrix;
  std::unique_ptr<mechanics::MixedSolver> solver;

  Mixed(const Setting& s, Stabilisation stabilisation, bool direct = true)
      : mesh(test::make_mesh({.shape = s.kind == AnalysisKind::solid ? Shape::tet4 : Shape::tri3,
                              .cells = {3, 3, 2},
                              .distortion = 0.15,
                              .map =
                                  [](const mesh::Point& x) {
                                    return mesh::Point{x[0] + 0.3, x[1], x[2]};
                                  }})),
        components(displacement_components(s.kind)),
        materials{s.plastic ? mushy() : test::elastic_material(2e11, 0.49, 1e-5)},
        temperature(mesh.x.size(), 350.0),
        ghosts(mesh) {
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      for (int i = 0; i < components; ++i) u.push_back(1e-3 * std::sin(1.3 * number(node, i)));
    for (const mesh::Block& block : mesh.blocks)
      blocks.push_back(
          mechanics::make_mixed_kernel(mesh, block, s.kind, materials[0], s.mapping, stabilisation));
    const bool algebraic = stabilisation == Stabilisation::algebraic;
    pressure = std::make_unique<mechanics::PressureEquation>(
        mesh, components, materials, blocks,
        algebraic ? std::vector<std::array<double, 3>>{{0, -7e4, 0}} : std::vector<std::array<double, 3>>{},
        direct);
    algebra::NodeGraph graph(mesh);
    for (const auto& block : mesh.blocks) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    matrix = std::make_unique<algebra::BlockMatrix>(mesh, components, std::move(graph));
    std::vector<char> fixed(u.size(), 0);
    for (Index node = 0; node < mesh.n_nodes(); ++node)  // what a rigid body can do
      if (mesh.x[static_cast<std::size_t>(node)][1] < 1e-9)
        for (int i = 0; i < components; ++i) fixed[static_cast<std::size_t>(node * components + i)] = 1;
    matrix->set_fixed(fixed);
    for (const auto& block : blocks) block->bind(*matrix);
    solver = std::make_unique<mechanics::MixedSolver>(
        mesh, *matrix, *pressure, ghosts,
        mechanics::MixedSolverOptions{.direct = direct, .relative_tolerance = 1e-11});
    history = blocks[0]->initial_history();
    mechanics::NodalPhases nodal(mesh, materials, temperature);
    const mechanics::PhaseFields phases = nodal.evaluate(0, temperature, {});
    blocks[0]->prepare({temperature, temperature, temperature, phases, std::vector<double>(u.size(), 0.0),
                        &history, &history, &history, 0.5, 0.5});
    pressure->begin({});
  }
  double number(Index node, int i) const {
    return static_cast<double>(mesh.input_node[static_cast<std::size_t>(node)] * components + i);
  }
  std::size_t n_owned() const { return static_cast<std::size_t>(mesh.n_owned_nodes * components); }

  std::vector<double> forces(const std::vector<double>& x) {
    EXPECT_TRUE(pressure->solve(x));
    std::vector<double> f(x.size(), 0.0);
    for (const auto& block : blocks) block->add_forces(x, f);
    f.resize(n_owned());
    for (std::size_t i = 0; i < f.size(); ++i)
      if (matrix->fixed()[i]) f[i] = 0;
    return f;
  }
  /// K⁻¹ b at u.
  std::vector<double> solve(const std::vector<double>& b) {
    forces(u);
    matrix->set_zero();
    for (const auto& block : blocks) block->add_tangent(u, *matrix);
    solver->assemble();
    std::vector<double> x(n_owned());
    const algebra::LinearReport report = solver->solve(*matrix, b, x, 0);
    EXPECT_TRUE(report.converged) << report.reason;
    return x;
  }
  /// Forces of different size at every free degree of freedom.
  std::vector<double> load(double frequency) const {
    std::vector<double> b(n_owned(), 0.0);
    for (Index node = 0; node < mesh.n_owned_nodes; ++node)
      for (int i = 0; i < components; ++i) {
        const auto at = static_cast<std::size_t>(node * components + i);
        if (!matrix->fixed()[at]) b[at] = 1e5 * std::sin(frequency * number(node, i));
      }
    return b;
  }
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return algebra::global_sum(sum);
}

class MixedTangent : public ::testing::TestWithParam<Setting> {};

TEST_P(MixedTangent, TheDirectionIsThatInWhichTheForcesMoveByTheLoad) {
  for (const Stabilisation stabilisation : {Stabilisation::orthogonal, Stabilisation::algebraic}) {
    Mixed m(GetParam(), stabilisation);
    const std::vector<double> b = m.load(2.1), d = m.solve(b);
    std::vector<double> direction(m.u.size(), 0.0);
    std::copy(d.begin(), d.end(), direction.begin());
    m.ghosts.update(direction, m.components);
    const auto moved = [&](double step) {
      std::vector<double> x = m.u;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * direction[i];
      return m.forces(x);
    };
    // Truncation falls with the square of the step, rounding is 1e-16 of forces 1e5 times as large over it.
    const double step = 0.02;
    const std::vector<double> plus = moved(step), minus = moved(-step);
    double error = 0;
    for (std::size_t i = 0; i < b.size(); ++i) error += std::pow((plus[i] - minus[i]) / (2 * step) - b[i], 2);
    EXPECT_LT(std::sqrt(algebra::global_sum(error)), 1e-5 * std::sqrt(dot(b, b)));
  }
}

TEST_P(MixedTangent, IsSymmetric) {
  Mixed m(GetParam(), Stabilisation::orthogonal);
  const std::vector<double> b = m.load(2.1), c = m.load(0.7);
  const std::vector<double> of_b = m.solve(b), of_c = m.solve(c);
  EXPECT_NEAR(dot(of_b, c), dot(of_c, b), 1e-7 * std::sqrt(dot(of_b, of_b) * dot(c, c)));
}

TEST_P(MixedTangent, TheBlockTriangularPreconditionerFindsTheSameDirection) {
  Mixed direct(GetParam(), Stabilisation::orthogonal), split(GetParam(), Stabilisation::orthogonal, false);
  const std::vector<double> b = direct.load(2.1);
  const std::vector<double> exact = direct.solve(b);
  std::vector<double> found = split.solve(b);
  for (std::size_t i = 0; i < found.size(); ++i) found[i] -= exact[i];
  EXPECT_LT(std::sqrt(dot(found, found)), 1e-6 * std::sqrt(dot(exact, exact)));
}

INSTANTIATE_TEST_SUITE_P(EveryKind, MixedTangent,
                         ::testing::Values(Setting{AnalysisKind::plane_strain, Mapping::isothermal, false},
                                           Setting{AnalysisKind::plane_strain, Mapping::isothermal, true},
                                           Setting{AnalysisKind::axisymmetric, Mapping::isothermal, true},
                                           Setting{AnalysisKind::solid, Mapping::isothermal, true},
                                           Setting{AnalysisKind::plane_strain, Mapping::isentropic, true},
                                           Setting{AnalysisKind::axisymmetric, Mapping::isentropic, true},
                                           Setting{AnalysisKind::solid, Mapping::isentropic, true}),
                         [](const auto& test) { return name(test.param); });

}  // namespace
}  // namespace solidus
