/// The tangent of mixed elements: the solver's direction is the one along which forces and volume residuals
/// move by the load, the tangent is symmetric, and both solvers agree.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/solver/balance.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "plastic_material.hpp"
#include "weight.hpp"

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
  std::vector<double> temperature, x;  ///< x: displacements, then pressures in their unit
  std::vector<double> at_rest;         ///< displacements at t_n, to which the kernels keep a reference
  parallel::GhostExchange ghosts;
  std::vector<std::unique_ptr<mechanics::BlockKernel>> blocks;
  mechanics::BlockHistory history;
  std::unique_ptr<mechanics::NodalPressure> pressure;
  std::unique_ptr<linear::BlockMatrix> matrix;
  std::unique_ptr<mechanics::SaddleSolver> solver;
  mechanics::BodyBalance balance;

  Mixed(const Setting& s, Stabilisation stabilisation, bool direct = true)
      : mesh(test::make_mesh({.shape = s.kind == AnalysisKind::solid ? Shape::tet4 : Shape::tri3,
                              .cells = {3, 3, 2},
                              .distortion = 0.15,
                              .map =
                                  [](const mesh::Point& p) {
                                    return mesh::Point{p[0] + 0.3, p[1], p[2]};
                                  }})),
        components(displacement_components(s.kind)),
        materials{s.plastic ? mushy() : test::elastic_material(2e11, 0.49, 1e-5)},
        temperature(mesh.x.size(), 350.0),
        ghosts(mesh),
        balance(mesh, linear::ActiveSet(mesh), components) {
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      for (int i = 0; i < components; ++i) x.push_back(1e-3 * std::sin(1.3 * number(node, i)));
    for (const mesh::ElementBlock& block : mesh.blocks)
      blocks.push_back(
          mechanics::make_mixed_kernel(mesh, block, s.kind, materials[0], s.mapping, stabilisation));
    pressure = std::make_unique<mechanics::NodalPressure>(
        mesh, mechanics::body_fields(mesh, materials, mechanics::mixed_blocks(blocks)), blocks,
        stabilisation == Stabilisation::orthogonal);
    test::set_weight(mesh, *pressure, {0, -7e4, 0});
    linear::NodeGraph graph(mesh);
    for (const auto& block : mesh.blocks) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    matrix = std::make_unique<linear::BlockMatrix>(mesh, components, std::move(graph));
    at_rest.assign(x.size(), 0.0);
    std::vector<char> fixed(x.size(), 0);
    for (Index node = 0; node < mesh.n_nodes(); ++node)  // what a rigid body can do
      if (mesh.x[static_cast<std::size_t>(node)][1] < 1e-9)
        for (int i = 0; i < components; ++i) fixed[static_cast<std::size_t>(node * components + i)] = 1;
    matrix->set_fixed(fixed);
    for (const auto& block : blocks) block->bind(*matrix);
    solver = std::make_unique<mechanics::SaddleSolver>(
        mesh, *matrix, *pressure, ghosts,
        mechanics::SaddleSolverOptions{
            .kind = direct ? linear::SolverKind::direct : linear::SolverKind::multigrid,
            .relative_tolerance = 1e-11});
    history = blocks[0]->initial_history();
    mechanics::NodalPhases nodal(mesh, materials, temperature);
    blocks[0]->prepare({.temperature = temperature,
                        .pass_temperature = temperature,
                        .initial_temperature = temperature,
                        .old_displacement = at_rest,
                        .held_displacement = at_rest,
                        .held_history = &history,
                        .old_history = &history,
                        .start_history = &history,
                        .dt = 0.5,
                        .effective = 0.5,
                        .phases = nodal.evaluate(0, {temperature, {}}, {})});
    pressure->begin();
    // Pressures of the size of the stress.
    for (Index node = 0; node < mesh.n_nodes(); ++node) x.push_back(1e-3 * std::cos(0.9 * number(node, 0)));
  }
  double number(Index node, int i) const {
    return static_cast<double>(mesh.input_node[static_cast<std::size_t>(node)] * components + i);
  }
  std::size_t n_local_u() const { return mesh.x.size() * static_cast<std::size_t>(components); }
  std::size_t n_owned_u() const { return static_cast<std::size_t>(mesh.n_owned_nodes * components); }
  std::size_t n_owned() const { return n_owned_u() + static_cast<std::size_t>(mesh.n_owned_nodes); }

  /// Forces and volume residuals in the monotone form, on owned nodes.
  std::vector<double> residual(const std::vector<double>& at) {
    const std::span<const double> u = std::span(at).first(n_local_u());
    std::vector<double> f(u.size(), 0.0), r(n_owned());
    pressure->set(std::span(at).subspan(u.size()));
    for (const auto& block : blocks) block->add_forces(u, f);
    for (std::size_t i = 0; i < n_owned_u(); ++i) r[i] = matrix->fixed()[i] ? 0.0 : f[i];
    pressure->residual(std::span(r).subspan(n_owned_u()), balance);
    return r;
  }
  /// K⁻¹ b at x.
  std::vector<double> solve(const std::vector<double>& b) {
    residual(x);
    // The second tangent at one iterate is the consistent one: the directions of flow are known by then.
    for (int i = 0; i < 2; ++i) {
      matrix->set_zero();
      for (const auto& block : blocks) block->add_tangent(std::span(x).first(n_local_u()), *matrix);
    }
    solver->assemble();
    std::vector<double> d(n_owned());
    const linear::LinearReport report = solver->solve(*matrix, b, d, 0);
    EXPECT_TRUE(report.converged) << report.reason;
    return d;
  }
  /// The direction on local nodes.
  std::vector<double> spread(const std::vector<double>& d) const {
    std::vector<double> local(x.size());
    const std::span<double> u = std::span(local).first(n_local_u()),
                            p = std::span(local).subspan(n_local_u());
    std::copy_n(d.begin(), n_owned_u(), u.begin());
    std::copy(d.begin() + static_cast<std::ptrdiff_t>(n_owned_u()), d.end(), p.begin());
    ghosts.update(u, components);
    ghosts.update(p, 1);
    return local;
  }
  /// Forces of different size at every free degree of freedom, and volume residuals.
  std::vector<double> load(double frequency) const {
    std::vector<double> b(n_owned(), 0.0);
    for (Index node = 0; node < mesh.n_owned_nodes; ++node) {
      for (int i = 0; i < components; ++i) {
        const auto at = static_cast<std::size_t>(node * components + i);
        if (!matrix->fixed()[at]) b[at] = 1e5 * std::sin(frequency * number(node, i));
      }
      b[n_owned_u() + static_cast<std::size_t>(node)] = 1e5 * std::cos(frequency * number(node, 0));
    }
    return b;
  }
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

class MixedTangent : public ::testing::TestWithParam<Setting> {};

TEST_P(MixedTangent, TheDirectionIsThatInWhichTheForcesMoveByTheLoad) {
  for (const Stabilisation stabilisation : {Stabilisation::orthogonal, Stabilisation::algebraic}) {
    Mixed m(GetParam(), stabilisation);
    const std::vector<double> b = m.load(2.1), d = m.solve(b);
    const std::vector<double> direction = m.spread(d);
    const auto moved = [&](double step) {
      std::vector<double> at = m.x;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += step * direction[i];
      return m.residual(at);
    };
    // Truncation falls with the square of the step, rounding is 1e-16 of forces 1e5 times as large over it.
    const double step = 0.02;
    const std::vector<double> plus = moved(step), minus = moved(-step);
    double error = 0;
    for (std::size_t i = 0; i < b.size(); ++i) error += std::pow((plus[i] - minus[i]) / (2 * step) - b[i], 2);
    EXPECT_LT(std::sqrt(parallel::global_sum(error)), 1e-5 * std::sqrt(dot(b, b)));
  }
}

TEST_P(MixedTangent, IsSymmetric) {
  Mixed m(GetParam(), Stabilisation::orthogonal);
  const std::vector<double> b = m.load(2.1), c = m.load(0.7);
  const std::vector<double> of_b = m.solve(b), of_c = m.solve(c);
  // The pressures' rows of the monotone form are those of the symmetric one with the other sign.
  const auto product = [&](const std::vector<double>& d, const std::vector<double>& of) {
    double sum = 0;
    for (std::size_t i = 0; i < d.size(); ++i) sum += (i < m.n_owned_u() ? 1 : -1) * d[i] * of[i];
    return parallel::global_sum(sum);
  };
  EXPECT_NEAR(product(of_b, c), product(of_c, b), 1e-7 * std::sqrt(dot(of_b, of_b) * dot(c, c)));
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
