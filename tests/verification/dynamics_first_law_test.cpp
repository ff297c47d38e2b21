/// The first law with inertia: in every step internal and kinetic energy and what the integrator dissipates
/// against heat and work; and that the heat of a vibrating body is not the integrator's.
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::Mapping;
using mechanics::MassKind;
using mechanics::Motion;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::CoupledRun;

const std::pair<const char*, Motion> k_methods[] = {{"backward Euler", Motion::backward_euler()},
                                                    {"Newmark", Motion::newmark(0.6, 0.3025)},
                                                    {"trapezoidal", Motion::trapezoidal()},
                                                    {"generalised-alpha", Motion::generalised_alpha(0.8)}};

/// A thrown bar in plane strain, clamped on the left, whose constants vary with temperature.
Coupled bar(const Motion& motion, bool plastic) {
  Coupled c;
  c.mesh = test::make_mesh(
      {.shape = mesh::Shape::quad4, .cells = {8, 3, 1}, .size = {0.4, 0.1, 1}, .distortion = 0.1});
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 900}, {2e11, 1.2e11});
  m.expansion = Table({300, 900}, {1.1e-5, 1.5e-5});
  if (plastic) {
    m.flow.emplace();
    m.flow->flow_stress = Table({300, 900}, {3e8, 1e8});
    m.flow->rate[material::Perzyna::viscosity] = 0.0;
  }
  c.materials = {m};
  c.start = {700};
  c.hold("left", 0);
  c.hold("left", 1);
  c.dynamics = DynamicsOptions{MassKind::consistent, motion, {{10, 5, 0}}};
  c.form = StructuralForm::energy;
  return c;
}
constexpr double k_end = 5e-4;  // [s], some periods along the bar

/// Loaded, driven at its end, chilled.
Coupled driven(const Motion& motion, bool plastic) {
  Coupled c = bar(motion, plastic);
  c.mechanical.pressures.push_back({"top", Table({0, 2e-4, 4e-4}, {3e7, -2e7, 1e7})});
  c.mechanical.gravity = {0, -9.81, 0};
  c.hold("right", 0, Table({0, 1e-4, 5e-4}, {0, 3e-4, -1e-4}));
  c.thermal.films.push_back({"chill", "bottom", {1e6}, 300.0});
  return c;
}

/// Sum of the energies exchanged: heat, and kinetic energy back and forth [J].
double exchanged(const CoupledRun& run) {
  double kinetic = 0;
  for (const auto& step : run.steps) kinetic += std::abs(step.kinetic);
  return run.exchanged() + kinetic;
}

TEST(FirstLaw, ClosesWithInertiaForEveryIntegratorAndSplit) {
  auto out = verification::table("dynamics_first_law", "method,split,law,defect[energy exchanged]");
  for (const auto& [name, motion] : k_methods)
    for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic})
      for (const bool plastic : {false, true}) {
        Coupled c = driven(motion, plastic);
        c.mapping = mapping;
        const CoupledRun run = verification::march(c, k_end, 50);
        // The criteria: 1e-12 of the heat, 1e-11 of the forces.
        EXPECT_LT(run.worst_defect(), 1e-8 * exchanged(run)) << name << (plastic ? " plastic" : "");
        EXPECT_LT(std::abs(run.defect()), 1e-8 * exchanged(run)) << name << (plastic ? " plastic" : "");
        out << name << "," << (mapping == Mapping::isothermal ? "isothermal" : "isentropic") << ","
            << (plastic ? "plastic" : "elastic") << "," << run.worst_defect() / exchanged(run) << "\n";
      }
}

/// Over the kinetic energy at the start of an insulated, free bar: heat that is left after the run, and what
/// the integrator says it dissipated.
struct Losses {
  double heat = 0, numerical = 0;
};
Losses losses(const Motion& motion, int n_steps) {
  Coupled c = bar(motion, false);
  c.mapping = Mapping::isentropic;
  const CoupledRun run = verification::march(c, k_end, n_steps);
  const double start = 0.5 * 7800 * 0.4 * 0.1 * (10 * 10 + 5 * 5);  // clamped nodes less
  Losses sum;
  for (const auto& step : run.steps) {
    sum.heat += (step.stored_heat + step.structural + step.kinetic) / start;
    sum.numerical += step.numerical / start;
  }
  return sum;
}

TEST(VibratingBody, KeepsItsEnergyWithTheTrapezoidalRule) {
  for (const int n : {50, 200}) {
    const Losses l = losses(Motion::trapezoidal(), n);
    EXPECT_NEAR(l.numerical, 0, 1e-10);
    EXPECT_NEAR(l.heat, 0, 1e-8);  // of all energies together
  }
}

/// Warmth without motion: of the enthalpies alone.
double warmth(const Motion& motion, int n_steps) {
  Coupled c = bar(motion, false);
  c.materials[0].expansion = 0.0;  // no thermoelastic heat: what warms is work that is not stored
  c.materials[0].young_modulus = 2e11;
  c.mapping = Mapping::isentropic;
  const CoupledRun run = verification::march(c, k_end, n_steps);
  double heat = 0;
  for (const auto& step : run.steps) heat += step.stored_heat;
  return heat / (0.5 * 7800 * 0.4 * 0.1 * 125);
}

// Work at σ_{n+1} would warm an elastic body by ½ Δε:C:Δε in every step; backward Euler's does.
TEST(VibratingBody, IsNotWarmedByItsIntegrator) {
  for (const Motion& motion :
       {Motion::newmark(0.6, 0.3025), Motion::trapezoidal(), Motion::generalised_alpha(0.8)})
    EXPECT_NEAR(warmth(motion, 100), 0, 1e-9);
  EXPECT_GT(warmth(Motion::backward_euler(), 100), 0.05);
}

}  // namespace
}  // namespace solidus
