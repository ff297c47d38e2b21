/// Plastic materials in the mechanical phase: what the elements make of the law, failures, two-step method.
#include <gtest/gtest.h>

#include "material/viscoplastic.hpp"
#include "plastic_material.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using material::KinematicHardening;
using material::Viscoplastic;
using mechanics::TimeIntegration;
using mesh::Shape;
using test::Body;
using test::Solved;

struct Patch {
  Shape shape;
  AnalysisKind kind;
};

const Patch k_patches[] = {
    {Shape::tri3, AnalysisKind::plane_strain},  {Shape::tri6, AnalysisKind::axisymmetric},
    {Shape::quad4, AnalysisKind::axisymmetric}, {Shape::quad8, AnalysisKind::plane_strain},
    {Shape::tet4, AnalysisKind::solid},         {Shape::tet10, AnalysisKind::solid},
    {Shape::hex8, AnalysisKind::solid},         {Shape::hex20, AnalysisKind::solid}};

/// Prescribed on the whole boundary: u_i = Σ_j h_ij x_j.
mesh::Point displacement(AnalysisKind kind, const mesh::Point& x) {
  if (kind == AnalysisKind::axisymmetric) return {1e-3 * x[0], -6e-4 * x[1], 0};
  return {1e-3 * x[0] + 4e-4 * x[1], -2e-4 * x[0] + 7e-4 * x[1],
          kind == AnalysisKind::solid ? -9e-4 * x[2] : 0};
}
Sym<double> strain(AnalysisKind kind) {
  if (kind == AnalysisKind::axisymmetric) return {{1e-3, -6e-4, 1e-3, 0, 0, 0}};
  return {{1e-3, 7e-4, kind == AnalysisKind::solid ? -9e-4 : 0, 1e-4, 0, 0}};
}

Body patch(const Patch& p, const material::Material& material) {
  test::Lattice lattice{.shape = p.shape, .cells = {3, 3, 3}, .size = {1.0, 1.2, 0.8}, .distortion = 0.15};
  if (p.kind == AnalysisKind::axisymmetric)
    lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.5, x[1], 0}; };
  Body body(lattice, p.kind, material);
  body.temperature.assign(body.mesh.x.size(), 350.0);
  body.initial_temperature = body.temperature;
  body.hold_boundary([&](const mesh::Point& x) { return displacement(p.kind, x); });
  return body;
}

TEST(PlasticPatch, ALinearDisplacementGivesTheStressAndTheHistoryOfTheLawInEveryShape) {
  for (const auto kinematic : {KinematicHardening::linear, KinematicHardening::armstrong_frederick})
    for (const Patch& p : k_patches) {
      const Body body = patch(p, test::plastic_material(kinematic));
      const Solved solved(body);
      const Viscoplastic law(body.materials[0]);
      const auto properties = law.properties_at(350.0, 350.0);
      const auto exact = law.update(properties, Viscoplastic::State<double>{}, strain(p.kind), 1.0);
      ASSERT_GT(exact.state.hardening, 1e-4);
      const double q = -2.0 / 3 * properties.flow.kinematic_modulus;
      for (const auto& fields : test::element_fields(solved))
        for (std::size_t e = 0; e < fields.stress.size(); ++e) {
          // Newton's criterion of 1e-11 of the forces
          for (std::size_t i = 0; i < 6; ++i) {
            const auto c = static_cast<int>(i);
            EXPECT_NEAR(fields.stress[e][i], exact.stress[c], 1e-9 * 3e8);
            EXPECT_NEAR(fields.plastic_strain[e][i], exact.state.plastic_strain[c], 1e-9 * 1e-3);
            EXPECT_NEAR(fields.back_stress[e][i], q * exact.state.back_strain[c], 1e-8 * 1e7);
            EXPECT_EQ(fields.viscous_strain[e][i], 0.0);
          }
          EXPECT_NEAR(fields.equivalent_plastic_strain[e], exact.state.hardening, 1e-9 * 1e-3);
          EXPECT_NEAR(fields.dissipation[e], exact.dissipation, 1e-9 * exact.dissipation);
          // slow flow: Φ = 0 at √⅔ flow_stress; here the overstress η γ/Δt comes on top
          const Sym<double> back{fields.back_stress[e]};
          const double relative = norm(dev(Sym<double>{fields.stress[e]}) - back);
          EXPECT_NEAR(relative - std::sqrt(2.0 / 3) * fields.flow_stress[e], 1e9 * exact.flow_increment,
                      1e-7 * relative);
        }
    }
}

TEST(PlasticPhase, AnUnsymmetricTangentConvergesQuadratically) {
  const Body body = patch({Shape::quad4, AnalysisKind::plane_strain},
                          test::plastic_material(KinematicHardening::armstrong_frederick));
  const Solved solved(body);
  EXPECT_LE(solved.report.newton.iterations, 8);
}

TEST(PlasticPhase, WithoutHardeningPlasticWorkIsDissipationAndFlowStressTimesEquivalentStrain) {
  const Body body = patch({Shape::hex8, AnalysisKind::solid}, test::perfectly_plastic(5e7));
  const Solved solved(body);
  const auto& work = solved.report.work;
  double xi = 0;
  for (const auto& fields : test::element_fields(solved))
    if (!fields.equivalent_plastic_strain.empty()) xi = fields.equivalent_plastic_strain.front();
  xi = parallel::global_max(xi);
  const double volume = 1.0 * 1.2 * 0.8;
  EXPECT_NEAR(work.plastic_work, 5e7 * xi * volume, 1e-9 * work.plastic_work);
  EXPECT_NEAR(work.plastic_dissipation, work.plastic_work, 1e-12 * work.plastic_work);
  EXPECT_EQ(work.dissipation, work.plastic_dissipation);
  EXPECT_GE(work.least_dissipation, 0.0);
  EXPECT_GT(work.largest_dissipation, 0.0);
}

TEST(PlasticPhase, HardeningStoresPartOfThePlasticWork) {
  const Body body = patch({Shape::tet4, AnalysisKind::solid}, test::plastic_material());
  const Solved solved(body);
  EXPECT_GT(solved.report.work.plastic_dissipation, 0);
  EXPECT_GT(solved.report.work.plastic_work, 1.01 * solved.report.work.plastic_dissipation);
}

TEST(PlasticPhase, AStateOutsideTheLawIsRejectedWithItsElementAndInputs) {
  // A melt of 1e13 Pa s sheared by 1e92 in a second: no stress that squares to a number.
  material::Material m = test::plastic_material();
  m.liquid_viscosity = 1e13;
  m.phase_changes.push_back(
      {.name = "freezing", .fraction = material::PhaseFraction::linear(280, 290), .solidification = true});
  Body body({.shape = Shape::hex8, .cells = {2, 2, 2}}, AnalysisKind::solid, m);
  body.hold_boundary([](const mesh::Point& x) { return mesh::Point{1e92 * x[0], -1e92 * x[1], 0}; });
  const auto phase = body.phase();
  const auto old = phase->initial_state();
  mechanics::MechanicalState trial;
  try {
    phase->solve(old, trial, body.temperature, 1, 1);
    FAIL() << "no rejection";
  } catch (const StepRejected& rejected) {
    EXPECT_EQ(rejected.reason(), "mechanics: a constitutive law asks for a smaller step");
    for (const char* part : {"body 'body', element ", "temperature 300 K", "solid fraction 0", "strain (",
                             "equivalent plastic strain 0"})
      EXPECT_NE(rejected.where().find(part), std::string::npos) << rejected.where();
  }
}

TEST(PlasticPhase, TheLiquidModelsHaveKernelsOfTheirOwn) {
  // At half solid the modified modulus is half of G, the degenerated strength half of the flow stress.
  for (const auto model : {material::LiquidModel::modified_shear, material::LiquidModel::degenerated}) {
    material::Material m = test::perfectly_plastic(4e7);
    m.liquid_model = model;
    m.phase_changes.push_back(
        {.name = "freezing", .fraction = material::PhaseFraction::linear(340, 360), .solidification = true});
    const Body body = patch({Shape::quad4, AnalysisKind::plane_strain}, m);  // at 350 K
    const Solved solved(body);
    const double strength = model == material::LiquidModel::degenerated ? 0.5 : 1.0;
    for (const auto& fields : test::element_fields(solved))
      for (std::size_t e = 0; e < fields.stress.size(); ++e) {
        EXPECT_NEAR(fields.flow_stress[e], strength * 4e7, 1e-6 * 4e7);
        EXPECT_NEAR(fields.von_mises[e], strength * 4e7, 1e-6 * 4e7);
      }
  }
}

/// A cube pulled smoothly beyond its yield stress in one second, in steps whose sizes alternate.
struct Pull {
  Body body{{.shape = Shape::hex8, .cells = {1, 1, 1}}, AnalysisKind::solid, test::plastic_material()};

  explicit Pull(TimeIntegration integration) {
    body.materials[0].flow->rate[material::Perzyna::viscosity] = 4e10;  // flows from the start: a smooth path
    body.materials[0].flow->flow_stress = 1.0;
    body.options.integration = integration;
    body.hold("left", 0);
    body.hold("bottom", 1);
    body.hold("back", 2);
    std::vector<double> time, value;
    for (int i = 0; i <= 2000; ++i) {
      time.push_back(i / 2000.0);
      value.push_back(2e-3 * time.back() * time.back() * (3 - 2 * time.back()));
    }
    body.hold("right", 0, Table(time, value));
  }
  static double end_of(int step, int n, double unevenness) {
    const double whole = static_cast<double>(step) / n;
    return step % 2 == 1 ? whole + unevenness / n : whole;
  }
  double stress(int n, double unevenness) const {
    const auto phase = body.phase();
    mechanics::MechanicalState state = phase->initial_state();
    double time = 0;
    for (int i = 1; i <= n; ++i) {
      const double next = end_of(i, n, unevenness);
      const mechanics::MechanicalState old = state;
      phase->solve(old, state, body.temperature, next, next - time);
      time = next;
    }
    double stress = -1e300;
    for (const auto& fields : test::element_fields(phase->mesh(), state))
      for (const auto& s : fields.stress) stress = s[0];
    return parallel::global_max(stress);
  }
};

TEST(TwoStepMethod, IsOfSecondOrderWithEqualAndWithUnequalStepsAndBackwardEulerOfFirst) {
  const double exact = Pull(TimeIntegration::two_step).stress(1000, 0);
  for (const double unevenness : {0.0, 0.3}) {
    for (const auto& [integration, order] :
         {std::pair{TimeIntegration::backward_euler, 1.0}, {TimeIntegration::two_step, 2.0}}) {
      const Pull pull(integration);
      const double coarse = std::abs(pull.stress(20, unevenness) - exact),
                   fine = std::abs(pull.stress(40, unevenness) - exact);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.25) << unevenness;
    }
  }
}

TEST(TwoStepMethod, TheStateAloneCarriesItOn) {
  const Pull pull(TimeIntegration::two_step);
  const auto first = pull.body.phase();
  mechanics::MechanicalState state = first->initial_state(), old;
  EXPECT_EQ(state.dt_before, 0.0);
  for (int i = 1; i <= 3; ++i) {
    old = state;
    first->solve(old, state, pull.body.temperature, 0.1 * i, 0.1);
  }
  EXPECT_EQ(state.dt_before, 0.1);
  const auto second = pull.body.phase();  // knows nothing but the state
  mechanics::MechanicalState here, there;
  first->solve(state, here, pull.body.temperature, 0.45, 0.15);
  second->solve(state, there, pull.body.temperature, 0.45, 0.15);
  EXPECT_EQ(here.displacement, there.displacement);

  // Without the history before the last it is a backward Euler step.
  mechanics::MechanicalState forgotten = state;
  forgotten.dt_before = 0;
  second->solve(forgotten, there, pull.body.temperature, 0.45, 0.15);
  const Pull pull_by_euler(TimeIntegration::backward_euler);
  const auto euler = pull_by_euler.body.phase();
  mechanics::MechanicalState of_euler;
  euler->solve(state, of_euler, pull.body.temperature, 0.45, 0.15);
  EXPECT_EQ(there.displacement, of_euler.displacement);
  EXPECT_NE(there.displacement, here.displacement);
}

TEST(TwoStepMethod, AStepThatGrowsTooFastIsABackwardEulerStep) {
  const Pull two_step(TimeIntegration::two_step), euler(TimeIntegration::backward_euler);
  const auto a = two_step.body.phase(), b = euler.body.phase();
  mechanics::MechanicalState start = a->initial_state(), state = start, of_a, of_b;
  a->solve(start, state, two_step.body.temperature, 0.1, 0.1);
  a->solve(state, of_a, two_step.body.temperature, 0.4, 0.3);
  b->solve(state, of_b, two_step.body.temperature, 0.4, 0.3);
  EXPECT_EQ(of_a.displacement, of_b.displacement);
}

}  // namespace
}  // namespace solidus
