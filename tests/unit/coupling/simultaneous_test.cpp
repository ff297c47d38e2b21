/// The simultaneous scheme: its tangent against differences of both residuals, its convergence, what it asks
/// of its phases, and that a run continued from a state goes the same way.
#include "coupling/simultaneous.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../mechanics/plastic_material.hpp"
#include "coupled_tangent.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

using coupling::SimultaneousOptions;
using mechanics::StructuralForm;
using mesh::Shape;
using test::noise;

constexpr double k_start = 420;  // [K]

/// Everything varies with temperature, conductivity and heat capacity too.
material::Material varying(material::Material m) {
  m.conductivity = Table({300, 600}, {45, 30});
  m.specific_heat = Table({300, 600}, {450, 560});
  m.young_modulus = Table({300, 600}, {2.1e11, 1.5e11});
  m.poisson_ratio = Table({300, 600}, {0.27, 0.35});
  m.expansion = Table({300, 600}, {1.1e-5, 1.6e-5});
  m.expansion_reference = 293;
  return m;
}

/// Phases of one body by the simultaneous scheme.
struct Model {
  test::Body body;
  std::optional<mechanics::StructuralHeat> structural;
  std::optional<heat::ThermalPhase> heat;
  std::unique_ptr<mechanics::MechanicalPhase> mechanics;
  coupling::Phases phases;
  coupling::State state;

  Model(Shape shape, AnalysisKind kind, const material::Material& material, StructuralForm form,
        heat::HeatIntegration rule = heat::HeatIntegration::closed, heat::ThermalConditions thermal = {},
        const std::function<void(test::Body&)>& adjust = {}, double distortion = 0.15)
      : body({.shape = shape,
              .cells = {3, 2, 2},
              .size = {0.03, 0.02, 0.02},
              .distortion = distortion,
              .map =
                  [](const mesh::Point& x) {
                    return mesh::Point{x[0] + 0.05, x[1], x[2]};
                  }},
             kind, material) {
    body.options.mapping = mechanics::Mapping::simultaneous;
    std::fill(body.initial_temperature.begin(), body.initial_temperature.end(), k_start);
    if (adjust) adjust(body);
    mechanics = body.phase();
    structural.emplace(*mechanics, form, rule == heat::HeatIntegration::closed);
    heat::HeatOptions options;
    options.integration = rule;
    options.tolerance = 1e-11;
    heat.emplace(body.mesh, kind, body.materials, std::move(thermal), options,
                 std::vector<linear::Contribution*>{&*structural});
    phases.heat = &*heat;
    phases.mechanics = mechanics.get();
    phases.structural = &*structural;
    state.heat = heat->states().initial(std::vector<double>{k_start});
    state.mechanics = mechanics->initial_state();
  }
};

/// Numbers for the unknowns of the mechanical phase: displacements, and pressures in their unit.
std::vector<double> unknowns(Model& m, double seed, double size) {
  std::vector<double> x = noise(m.body.mesh, m.mechanics->bodies().components, seed, size);
  if (m.mechanics->bodies().pressure != nullptr) {
    const std::vector<double> p =
        noise(m.body.mesh, m.mechanics->bodies().pressure->fields().n_fields, 0.9 * seed, size);
    x.insert(x.end(), p.begin(), p.end());
  }
  return x;
}

/// The errors of A d against central differences, in parts of ‖A d‖ of each field.
double tangent_error(Model& m, double strain) {
  m.structural->leave_tangent();
  coupling::CoupledNewton newton(m.phases, linear::CoupledSolverKind::direct);
  heat::ThermalIteration& thermal = newton.thermal();
  constexpr double k_dt = 0.5;
  mechanics::MechanicalPass pass{.time = k_dt, .dt = k_dt, .temperature = m.state.heat.temperature};
  thermal.begin(m.state.heat, k_dt, LoadWindow::backward_euler(0, k_dt));
  pass.iterate_temperature = thermal.state().temperature;
  m.mechanics->equations().begin(m.state.mechanics, pass);

  // Some state: a jump from the start.
  const mesh::Mesh& mesh = m.body.mesh;
  const std::vector<double> u = unknowns(m, 1.3, strain * 0.01);
  std::vector<double> warmer = noise(mesh, 1, 0.7, 30);
  newton.evaluate(m.state.mechanics, pass, std::vector<double>(u.size(), 0.0));
  newton.assemble(m.state.mechanics, std::vector<double>(u.size(), 0.0), 0);
  thermal.equations().set_direction(warmer, {});
  thermal.equations().move(1.0);
  newton.evaluate(m.state.mechanics, pass, u);
  linear::CoupledMatrix& a = newton.assemble(m.state.mechanics, u, 0);

  constexpr double k_h = 1e-5;  // error h² of the differences, rounding 1e-16/h: 1e-10 of either
  const auto error = test::tangent_errors(newton, a, m.state.mechanics, pass, u,
                                          unknowns(m, 2.1, strain * 0.01), noise(mesh, 1, 1.9, 20), k_h);
  return std::hypot(error.force, error.heat, error.volume);
}

struct Case {
  Shape shape;
  AnalysisKind kind;
};
const Case k_cases[] = {
    {Shape::tri3, AnalysisKind::plane_strain},  {Shape::tri6, AnalysisKind::plane_strain},
    {Shape::quad4, AnalysisKind::plane_strain}, {Shape::quad8, AnalysisKind::plane_strain},
    {Shape::tri3, AnalysisKind::axisymmetric},  {Shape::tri6, AnalysisKind::axisymmetric},
    {Shape::quad4, AnalysisKind::axisymmetric}, {Shape::quad8, AnalysisKind::axisymmetric},
    {Shape::tet4, AnalysisKind::solid},         {Shape::tet10, AnalysisKind::solid},
    {Shape::hex8, AnalysisKind::solid},         {Shape::hex20, AnalysisKind::solid}};

TEST(CoupledTangent, IsTheDerivativeOfBothResidualsInEveryShapeAndKind) {
  using Kinematic = material::KinematicHardening;
  const material::Material elastic = varying(test::elastic_material(2e11, 0.3));
  const material::Material plastic = varying(test::plastic_material());
  const material::Material recalled = varying(test::plastic_material(Kinematic::armstrong_frederick));
  for (const Case& c : k_cases)
    for (const auto form : {StructuralForm::energy, StructuralForm::entropy})
      for (const material::Material* m : {&elastic, &plastic, &recalled}) {
        Model model(c.shape, c.kind, *m, form);
        EXPECT_LT(tangent_error(model, 2e-3), 1e-6)
            << "shape " << static_cast<int>(c.shape) << " kind " << static_cast<int>(c.kind) << " form "
            << static_cast<int>(form) << " material "
            << (m == &elastic   ? 0
                : m == &plastic ? 1
                                : 2);
      }
}

material::Material mushy() {
  material::Material melt = varying(test::plastic_material());
  melt.liquid_viscosity = 1e9;
  melt.phase_changes.push_back({.name = "freezing",
                                .fraction = material::PhaseFraction::linear(380, 440),
                                .latent_heat = 3e4,
                                .volume_change = -0.01,
                                .solidification = true});
  return melt;
}

TEST(CoupledTangent, IsTheDerivativeOfMixedElementsWithEverySubscaleAndLaw) {
  using Kinematic = material::KinematicHardening;
  using mechanics::Stabilisation;
  material::Material chosen = mushy();
  chosen.liquid_viscosity = Table();
  const material::Material materials[] = {varying(test::elastic_material(2e11, 0.3)),
                                          varying(test::plastic_material(Kinematic::armstrong_frederick)),
                                          mushy(), chosen};
  const Case cases[] = {{Shape::tri3, AnalysisKind::plane_strain},
                        {Shape::tri3, AnalysisKind::axisymmetric},
                        {Shape::tet4, AnalysisKind::solid}};
  for (const Case& c : cases)
    for (const auto form : {StructuralForm::energy, StructuralForm::entropy})
      for (const auto stabilisation : {Stabilisation::orthogonal, Stabilisation::algebraic})
        for (std::size_t i = 0; i < std::size(materials); ++i) {
          Model model(c.shape, c.kind, materials[i], form, heat::HeatIntegration::closed, {},
                      [&](test::Body& body) {
                        body.options.simplices = mechanics::Simplices::mixed;
                        body.options.stabilisation = stabilisation;
                        body.conditions.gravity = {0, -9.81, 0};
                      });
          ASSERT_NE(model.mechanics->bodies().pressure, nullptr);
          EXPECT_LT(tangent_error(model, 2e-3), 1e-6)
              << "shape " << static_cast<int>(c.shape) << " kind " << static_cast<int>(c.kind) << " form "
              << static_cast<int>(form) << " sub-scales " << static_cast<int>(stabilisation) << " material "
              << i;
        }
}

TEST(CoupledTangent, IsTheDerivativeWithTheOpenRuleAndWithAMushyZone) {
  const material::Material melt = mushy();
  for (const auto form : {StructuralForm::energy, StructuralForm::entropy})
    for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
      for (const auto& m : {varying(test::plastic_material()), melt}) {
        Model model(Shape::quad4, AnalysisKind::plane_strain, m, form, rule);
        EXPECT_LT(tangent_error(model, 2e-3), 1e-6);
      }
}

/// Chilled on one side and pulled. Triangles and tetrahedra are mixed, as their material flows.
Model pulled(StructuralForm form, double pull = 1e-4, Shape shape = Shape::quad4,
             mechanics::Stabilisation stabilisation = mechanics::Stabilisation::automatic) {
  heat::ThermalConditions thermal;
  thermal.films.push_back({"chill", "top", {20000.0}, 300.0});
  const bool solid = mesh::dimension(shape) == 3;
  return Model(shape, solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
               varying(test::plastic_material()), form, heat::HeatIntegration::closed, thermal,
               [pull, solid, stabilisation](test::Body& body) {
                 body.options.stabilisation = stabilisation;
                 for (int i = 0; i < (solid ? 3 : 2); ++i) body.hold("left", i);
                 body.hold("right", 0, Table({0, 1}, {0, pull}));
               });
}

/// Parameters of the tests below: with and without a nodal pressure, with sub-scales that are in the factors
/// and with others that are not.
struct Elements {
  Shape shape;
  mechanics::Stabilisation stabilisation = mechanics::Stabilisation::automatic;
};
const Elements k_elements[] = {
    {Shape::quad4}, {Shape::tri3}, {Shape::tri3, mechanics::Stabilisation::orthogonal}, {Shape::tet4}};

TEST(SimultaneousScheme, ConvergesQuadratically) {
  for (const Elements& e : k_elements)
    for (const auto form : {StructuralForm::energy, StructuralForm::entropy}) {
      Model m = pulled(form, 1e-4, e.shape, e.stabilisation);
      coupling::SimultaneousScheme scheme(m.phases);
      coupling::State trial = m.state;
      scheme.advance(m.state, trial, 1.0, 1.0);
      const auto& r = scheme.report().residuals;
      ASSERT_GE(r.size(), 4U);
      EXPECT_EQ(scheme.report().shortest_step, 1.0);
      // The last step that is not cut off by rounding.
      constexpr double k_rounding = 1e-11;
      std::size_t last = r.size() - 1;
      while (last > 2 && r[last].heat < k_rounding) --last;
      const double exponent =
          std::log(r[last].heat / r[last - 1].heat) / std::log(r[last - 1].heat / r[last - 2].heat);
      std::string all = std::string(mesh::name(e.shape)) + ": ";
      for (const auto& x : r)
        all += std::to_string(std::log10(x.force)) + " " + std::to_string(std::log10(x.heat)) + "; ";
      EXPECT_GT(exponent, 1.7) << all;
    }
}

void expect_the_same_way_with_a_field_split(const Elements& e) {
  Model a = pulled(StructuralForm::energy, 1e-4, e.shape, e.stabilisation),
        b = pulled(StructuralForm::energy, 1e-4, e.shape, e.stabilisation);
  coupling::SimultaneousScheme direct(a.phases, {.solver = linear::CoupledSolverKind::direct});
  coupling::SimultaneousScheme split(b.phases, {.solver = linear::CoupledSolverKind::field_split});
  coupling::State of_direct = a.state, of_split = b.state;
  for (int n = 1; n <= 3; ++n) {
    coupling::State trial = of_direct;
    direct.advance(of_direct, trial, 0.3 * n, 0.3);
    std::swap(of_direct, trial);
    trial = of_split;
    const coupling::StepEffort effort = split.advance(of_split, trial, 0.3 * n, 0.3);
    EXPECT_GT(effort.mechanics.linear_iterations, effort.mechanics.iterations);
    std::swap(of_split, trial);
  }
  // Newton's criteria are 1e-11.
  for (std::size_t i = 0; i < of_direct.heat.temperature.size(); ++i)
    EXPECT_NEAR(of_direct.heat.temperature[i], of_split.heat.temperature[i], 1e-6);
  for (std::size_t i = 0; i < of_direct.mechanics.displacement.size(); ++i)
    EXPECT_NEAR(of_direct.mechanics.displacement[i], of_split.mechanics.displacement[i], 1e-12);
  for (std::size_t i = 0; i < of_direct.mechanics.pressure.size(); ++i)
    EXPECT_NEAR(of_direct.mechanics.pressure[i], of_split.mechanics.pressure[i], 100);  // [Pa], of 1e9
}

TEST(SimultaneousScheme, GoesTheSameWayFromAStateWithAFieldSplit) {
  for (const Elements& e : k_elements) {
    SCOPED_TRACE(mesh::name(e.shape));
    expect_the_same_way_with_a_field_split(e);
  }
}

int processes() {
  const int n = processes::count();
  return n;
}

/// Bit by bit, or to the rounding of a direct solution.
void expect_the_same(const std::vector<double>& a, const std::vector<double>& b, bool exact) {
  if (exact) {
    EXPECT_EQ(a, b);
    return;
  }
  ASSERT_EQ(a.size(), b.size());
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    size = std::max(size, std::abs(a[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  EXPECT_LE(difference, 1e-12 * size);
}

TEST(SimultaneousScheme, ContinuesFromAStateBitByBit) {
  for (const auto integration :
       {SimultaneousOptions::Integration::backward_euler, SimultaneousOptions::Integration::sdirk2})
    for (const auto& [shape, solver] : {std::pair{Shape::quad4, linear::CoupledSolverKind::direct},
                                        {Shape::quad4, linear::CoupledSolverKind::field_split},
                                        {Shape::tri3, linear::CoupledSolverKind::direct},
                                        {Shape::tet4, linear::CoupledSolverKind::field_split}}) {
      Model a = pulled(StructuralForm::energy, 1e-4, shape), b = pulled(StructuralForm::energy, 1e-4, shape);
      coupling::SimultaneousScheme whole(a.phases, {integration, solver}),
          rest(b.phases, {integration, solver});
      coupling::State state = a.state, trial = a.state;
      for (int n = 1; n <= 2; ++n) {
        whole.advance(state, trial, 0.3 * n, 0.3);
        std::swap(state, trial);
      }
      whole.forget();
      coupling::State continued = state, next = state;
      rest.synchronise(continued);
      whole.advance(state, trial, 0.9, 0.3);
      rest.advance(continued, next, 0.9, 0.3);
      // MUMPS on several processes adds in the order in which messages come.
      const bool exact = processes() == 1;
      expect_the_same(trial.heat.temperature, next.heat.temperature, exact);
      expect_the_same(trial.heat.enthalpy, next.heat.enthalpy, exact);
      expect_the_same(trial.mechanics.displacement, next.mechanics.displacement, exact);
      expect_the_same(trial.mechanics.pressure, next.mechanics.pressure, exact);
    }
}

// A face that stays plane ties its displacements together, whatever process they are of.
TEST(SimultaneousScheme, KeepsAFacePlaneWithAPressure) {
  for (const Shape shape : {Shape::tri3, Shape::tet4})
    for (const auto solver : {linear::CoupledSolverKind::automatic, linear::CoupledSolverKind::field_split}) {
      SCOPED_TRACE(mesh::name(shape));
      const auto kind = shape == Shape::tet4 ? AnalysisKind::solid : AnalysisKind::plane_strain;
      heat::ThermalConditions thermal;
      thermal.films.push_back({"chill", "top", {20000.0}, 300.0});
      // Flat faces: the lattice is not distorted.
      Model m(
          shape, kind, varying(test::plastic_material()), StructuralForm::energy,
          heat::HeatIntegration::closed, thermal,
          [&](test::Body& body) {
            for (int i = 0; i < displacement_components(kind); ++i) body.hold("left", i);
            body.conditions.plane_faces.push_back({"right"});
          },
          0.0);
      coupling::SimultaneousScheme scheme(m.phases, {.solver = solver});
      coupling::State trial = m.state;
      const coupling::StepEffort effort = scheme.advance(m.state, trial, 1.0, 1.0);
      EXPECT_LT(effort.mechanics.iterations, 10);
      EXPECT_LT(std::abs(effort.energy.defect()), 1e-8 * effort.energy.heat_exchanged);
      double least = 1, most = -1;
      const auto nc = static_cast<std::size_t>(m.mechanics->bodies().components);
      for (const Index node : m.body.mesh.surfaces.at("right").nodes) {
        const double u = trial.mechanics.displacement[static_cast<std::size_t>(node) * nc];
        least = std::min(least, u);
        most = std::max(most, u);
      }
      EXPECT_LT(parallel::global_max(most), 0);  // it cools
      EXPECT_LE(parallel::global_max(most) - parallel::global_min(least), 1e-18);
    }
}

TEST(SimultaneousScheme, RejectsAStepThatDoesNotGoThroughAndLeavesTheStateAlone) {
  Model m = pulled(StructuralForm::energy, 1e100);  // outside the range of any law
  coupling::SimultaneousScheme scheme(m.phases);
  coupling::State trial = m.state;
  const coupling::State before = m.state;
  EXPECT_THROW(scheme.advance(m.state, trial, 1.0, 1.0), StepRejected);
  EXPECT_EQ(m.state.heat.temperature, before.heat.temperature);
  EXPECT_EQ(m.state.mechanics.displacement, before.mechanics.displacement);
}

TEST(SimultaneousScheme, RefusesPhasesThatWereBuiltForASplitNotThoseThatExchangeNothing) {
  Model m = pulled(StructuralForm::energy);
  coupling::Phases phases = m.phases;
  phases.structural = nullptr;
  EXPECT_NO_THROW(coupling::SimultaneousScheme{phases});
  m.body.options.mapping = mechanics::Mapping::isothermal;
  const auto isothermal = m.body.phase();
  phases = m.phases;
  phases.mechanics = isothermal.get();
  EXPECT_THROW(coupling::SimultaneousScheme{phases}, std::invalid_argument);
}

}  // namespace
}  // namespace solidus
