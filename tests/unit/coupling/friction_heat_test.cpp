/// Heat of friction in the simultaneous scheme: its tangent against differences of both residuals, and its
/// convergence. Two blocks that press and slide, some points sticking, with an interface that has a heat
/// capacity, friction that hardens and softens with temperature, and a conductance that follows everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "../contact/bodies.hpp"
#include "../mechanics/body.hpp"
#include "algebra/parallel.hpp"
#include "coupling/simultaneous.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using mesh::Shape;

constexpr double k_start = 500;  // [K]

struct Case {
  const char* name;
  Shape shape = Shape::quad4;
  Formulation formulation = Formulation::small_sliding;
  bool smoothing = false, nodal = true;
  double heat_capacity = 0;
  contact::InternalVariable variable = contact::InternalVariable::normal_work;
  bool mu_of_temperature = true;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

contact::ContactSpec interface_of(const Case& c) {
  contact::ContactSpec s;
  s.name = "interface";
  s.slave = "upper_bottom";
  s.master = "lower_top";
  s.penalty = 1e13;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.formulation = c.formulation;
  s.integration = c.formulation == Formulation::large_sliding ? contact::IntegrationRule::gauss
                                                              : contact::IntegrationRule::segments;
  s.smoothing = c.smoothing;
  s.nodal_heat = c.nodal;
  s.interface_heat_capacity = c.heat_capacity;
  s.friction = contact::FrictionSpec{};
  s.friction->internal_variable = c.variable;
  const bool slip = c.variable == contact::InternalVariable::slip;
  s.friction->coefficient.unit = slip ? 1e-4 : 1e3;
  if (c.mu_of_temperature)
    s.friction->coefficient.terms = {Table({300, 900}, {0.3, 0.15}), Table({300, 900}, {0.1, 0.02})};
  else
    s.friction->coefficient.terms = {Table(0.25)};
  s.friction->tangential_penalty = 2e12;
  contact::HeatTransferSpec h;
  h.conductance = 3e4;
  h.exponent = 0.95;
  h.hardness = 1e9;
  h.gap_law = contact::HeatTransferSpec::GapLaw::gas;
  h.open_conductance = 2e3;
  h.gas_conductivity = 0.05;
  s.heat = h;
  return s;
}

material::Material metal(bool alone) {
  if (!alone) return test::elastic_material(2e11, 0.3, 1.2e-5);
  material::Material m = test::elastic_material(2e11, 0.3);
  m.specific_heat = 1e-3;
  return m;
}

/// Phases of both blocks.
struct Blocks {
  mesh::Mesh mesh;
  AnalysisKind kind;
  std::vector<material::Material> materials;
  std::unique_ptr<contact::ContactPair> pair;
  std::unique_ptr<mechanics::MechanicalPhase> mechanics;
  std::optional<mechanics::StructuralHeat> structural;
  std::optional<heat::ThermalPhase> heat;
  coupling::Phases phases;
  coupling::State state;

  /// @param supported  and moved, of metal that expands; else both are free, and neither expansion nor heat
  ///                   capacity stands beside what contact does
  Blocks(const Case& c, bool supported)
      : mesh(test::two_blocks(c.shape)),
        kind(mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid),
        materials(2, metal(!supported)) {
    pair = std::make_unique<contact::ContactPair>(mesh, kind, interface_of(c));
    mechanics::MechanicsOptions options = test::strict();
    options.mapping = mechanics::Mapping::simultaneous;
    options.symmetric = false;
    mechanics::Conditions conditions;
    const int up = mesh.dimension - 1;
    const std::string last = mesh.dimension == 2 ? "y" : "z";
    if (supported) {
      for (int i = 0; i <= up; ++i) conditions.displacements.push_back({"lower_" + last + "_min", i, 0.0});
      const std::string top = "upper_" + last + "_max";
      conditions.displacements.push_back({top, 0, Table({0, 1}, {0, 3e-4})});
      if (up == 2) conditions.displacements.push_back({top, 1, 0.0});
      conditions.displacements.push_back({top, up, Table({0, 1}, {0, -4e-5})});
    }
    const std::vector<double> initial(mesh.x.size(), k_start);
    mechanics =
        std::make_unique<mechanics::MechanicalPhase>(mesh, kind, materials, initial, conditions, options,
                                                     std::vector<algebra::Contribution*>{&pair->mechanics()});
    structural.emplace(*mechanics, mechanics::StructuralForm::energy, true);
    structural->leave_tangent();
    heat::HeatOptions of_heat;
    of_heat.tolerance = 1e-11;
    of_heat.symmetric = false;
    heat.emplace(mesh, kind, materials, heat::Conditions{}, of_heat,
                 std::vector<algebra::Contribution*>{pair->heat(), &*structural});
    phases.heat = &*heat;
    phases.mechanics = mechanics.get();
    phases.structural = &*structural;
    phases.contacts = {pair.get()};
    state.heat = heat->initial_state(std::vector<double>{k_start, k_start});
    state.mechanics = mechanics->initial_state();
    state.contacts = {pair->initial_state()};
  }

  std::vector<double> noise(int components, double seed) const {
    std::vector<double> values;
    for (const GlobalIndex node : mesh.input_node)
      for (int i = 0; i < components; ++i)
        values.push_back(std::sin(seed * static_cast<double>(node * components + i + 1)));
    return values;
  }
};

double norm(std::span<const double> a) {
  double s = 0;
  for (const double x : a) s += x * x;
  return std::sqrt(algebra::global_sum(s));
}

class FrictionalHeat : public ::testing::TestWithParam<Case> {};

TEST_P(FrictionalHeat, HasTheTangentThatFiniteDifferencesShow) {
  Blocks b(GetParam(), false);
  coupling::CoupledNewton newton(b.phases, algebra::CoupledSolverKind::direct);
  heat::ThermalIteration& thermal = newton.thermal();
  const int nc = b.mechanics->components();
  constexpr double k_dt = 1e-3;
  mechanics::MechanicalPass pass{.time = k_dt, .dt = k_dt, .temperature = b.state.heat.temperature};
  thermal.begin(b.state.heat, k_dt, k_dt);
  pass.iterate_temperature = thermal.temperature();
  b.pair->begin(b.state.contacts[0], {.time = k_dt,
                                      .dt = k_dt,
                                      .displacement = b.state.mechanics.displacement,
                                      .temperature = b.state.heat.temperature,
                                      .simultaneous = true});
  b.mechanics->begin(b.state.mechanics, pass);

  // Pressed by 2 µm and less to the right, where it is open; the upper block slides from nothing on the left,
  // where points stick, to 15 µm.
  std::vector<double> u = test::nodal_field(b.mesh, nc, [&](const mesh::Point& x, bool upper) {
    std::vector<double> v(static_cast<std::size_t>(nc), 0.0);
    if (!upper) return v;
    v[0] = 5e-5 * x[0] * (nc == 3 ? 1 + x[1] : 1);
    v.back() = -2e-6 * (1 - 4 * x[0]);
    return v;
  });
  std::vector<double> warmer = b.noise(1, 0.7), shake = b.noise(nc, 1.3);
  for (double& t : warmer) t *= 40;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += 2e-7 * shake[i];
  newton.evaluate(b.state.mechanics, pass, u);
  newton.assemble(b.state.mechanics, u, 0);
  thermal.set_direction(warmer, {});
  thermal.move(1.0);
  newton.evaluate(b.state.mechanics, pass, u);
  const contact::ContactSums sums = b.pair->sums({});
  EXPECT_GT(sums.sticking_points, 0);
  EXPECT_GT(sums.closed_points, sums.sticking_points);
  EXPECT_LT(sums.closed_points, sums.points);
  algebra::CoupledMatrix& a = newton.assemble(b.state.mechanics, u, 0);

  // Displacement and temperature apart: neither hides behind the other.
  for (const bool moves : {true, false}) {
    std::vector<double> du = b.noise(nc, 2.1), dt = b.noise(1, 1.9);
    for (double& x : du) x *= moves ? 1e-7 : 0;
    for (double& x : dt) x *= moves ? 0 : 10;
    thermal.set_direction(dt, {});
    const auto n_owned = static_cast<std::size_t>(b.mesh.n_owned_nodes);
    std::vector<double> force(n_owned * static_cast<std::size_t>(nc)), heat(n_owned), part(force.size());
    a.displacement().multiply(du, force);
    a.multiply_force(dt, part);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += part[i];
    a.temperature().multiply(dt, heat);
    part.resize(n_owned);
    a.multiply_heat(du, part);
    for (std::size_t i = 0; i < heat.size(); ++i) heat[i] += part[i];

    constexpr double k_h = 4e-3;
    std::vector<double> force_error = force, heat_error = heat;
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> x = u;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += sign * k_h * du[i];
      thermal.move(sign * k_h);
      newton.evaluate(b.state.mechanics, pass, x);
      for (std::size_t i = 0; i < force.size(); ++i) force_error[i] -= sign * newton.force()[i] / (2 * k_h);
      for (std::size_t i = 0; i < heat.size(); ++i) heat_error[i] -= sign * thermal.residual()[i] / (2 * k_h);
    }
    thermal.move(0);
    // Places of 0.3 m round by 1e-16 of it, over steps of 4e-10 m: 1e-7 of the slopes; curvature is less.
    if (norm(force) > 0) {
      EXPECT_LT(norm(force_error), 2e-7 * norm(force)) << moves;
    }
    EXPECT_LT(norm(heat_error), 2e-7 * norm(heat)) << moves;
  }
}

TEST_P(FrictionalHeat, ConvergesQuadratically) {
  Blocks b(GetParam(), true);
  coupling::SimultaneousOptions options;
  options.solver = algebra::CoupledSolverKind::direct;
  coupling::SimultaneousScheme scheme(b.phases, options);
  scheme.synchronise(b.state);
  coupling::State now = b.state;
  constexpr double k_dt = 0.1;
  for (int n = 1; n <= 4; ++n) {
    coupling::State trial = now;
    trial.time = n * k_dt;
    const coupling::StepEffort effort = scheme.advance(now, trial, trial.time, k_dt);
    now = std::move(trial);
    EXPECT_LT(std::abs(effort.energy.defect()), 1e-8 * effort.energy.heat_exchanged) << "step " << n;
    if (n < 3) continue;  // the active set settles
    EXPECT_GT(effort.energy.frictional_heat, 0);
    const auto& residuals = scheme.report().residuals;
    ASSERT_LE(residuals.size(), 9U);
    // Of the last three that are above rounding: e_{k+1} <= C e_k² needs an order well above one.
    int quadratic = 0;
    for (std::size_t k = 2; k < residuals.size(); ++k) {
      const double e0 = residuals[k - 2].size(), e1 = residuals[k - 1].size(), e2 = residuals[k].size();
      if (e0 < 1e-1 && e2 > 1e-13 && std::log(e2 / e1) > 1.7 * std::log(e1 / e0)) ++quadratic;
      if (e1 < 1e-4 && e2 < 1e-9) ++quadratic;
    }
    EXPECT_GE(quadratic, 1) << "step " << n;
  }
}

using contact::InternalVariable;
INSTANTIATE_TEST_SUITE_P(
    Of, FrictionalHeat,
    ::testing::Values(
        Case{.name = "Quad4"}, Case{.name = "Quad4Consistent", .nodal = false},
        Case{.name = "Quad4Capacity", .heat_capacity = 5},
        Case{.name = "Quad4OfWork", .variable = InternalVariable::frictional_work},
        Case{.name = "Quad4OfSlip", .heat_capacity = 2, .variable = InternalVariable::slip},
        Case{.name = "Quad4Coulomb", .mu_of_temperature = false},
        Case{.name = "Tri6", .shape = Shape::tri6, .nodal = false},
        Case{.name = "Hex8", .shape = Shape::hex8},
        Case{.name = "Quad4Sliding", .formulation = Formulation::large_sliding},
        Case{.name = "Quad4SlidingSmooth",
             .formulation = Formulation::large_sliding,
             .smoothing = true,
             .nodal = false,
             .heat_capacity = 5},
        Case{.name = "Hex8Sliding", .shape = Shape::hex8, .formulation = Formulation::large_sliding}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace solidus
