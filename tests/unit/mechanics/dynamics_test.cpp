/// Bodies with inertia against closed solutions: an oscillator of one element, free fall, and where the
/// energy of every step goes.
#include <gtest/gtest.h>

#include <numbers>

#include "body.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus {
namespace {

using mechanics::DynamicsOptions;
using mechanics::MassKind;
using mechanics::MechanicalState;
using mechanics::MechanicalWork;
using mechanics::Motion;
using mesh::Shape;
using test::Body;

const std::pair<const char*, Motion> k_methods[] = {{"backward Euler", Motion::backward_euler()},
                                                    {"Newmark", Motion::newmark(0.6, 0.3025)},
                                                    {"trapezoidal", Motion::trapezoidal()},
                                                    {"generalised-α", Motion::generalised_alpha(0.8)}};

/// A body that is driven through equal steps, with what they report.
struct March {
  std::unique_ptr<mechanics::MechanicalPhase> phase;
  MechanicalState state;
  std::vector<MechanicalWork> steps;
  std::vector<double> reactions;  ///< of the last step

  March(const Body& body, double end, int n_steps) : phase(body.phase()), state(phase->initial_state()) {
    for (int n = 1; n <= n_steps; ++n) {
      const MechanicalState old = state;
      mechanics::MechanicalReport report =
          phase->solve(old, state, body.temperature, end * n / n_steps, end / n_steps);
      steps.push_back(report.work);
      reactions = std::move(report.reactions);
    }
  }
};

/// The largest of a component over all nodes.
double largest(const std::vector<double>& field, int components, int component) {
  double value = -1e300;
  for (std::size_t i = static_cast<std::size_t>(component); i < field.size();
       i += static_cast<std::size_t>(components))
    value = std::max(value, field[i]);
  return parallel::global_max(value);
}

constexpr double k_young = 2e11, k_density = 7800, k_length = 0.1, k_speed = 3;

/// One quad in uniaxial strain without lateral effect, its left side held, thrown to the right: two nodes
/// that move alike, M u'' + (E/h) A u = 0 with M = ρ h A/3, lumped ρ h A/2.
Body oscillator(const Motion& motion, MassKind mass) {
  Body body({.shape = Shape::quad4, .cells = {1, 1, 1}, .size = {k_length, k_length, 1}},
            AnalysisKind::plane_strain, test::elastic_material(k_young, 0.0));
  body.hold("left", 0);
  for (const char* side : {"bottom", "top"}) body.hold(side, 1);
  body.options.dynamics = DynamicsOptions{mass, motion, {{k_speed, 0, 0}}};
  return body;
}
double frequency(MassKind mass) {
  return std::sqrt((mass == MassKind::lumped ? 2 : 3) * k_young / k_density) / k_length;
}

/// Displacement of the free nodes with its sign: the one of the largest magnitude. Held nodes are at zero.
double moving(const std::vector<double>& field) {
  std::vector<double> turned = field;
  for (double& v : turned) v = -v;
  const double up = largest(field, 2, 0), down = largest(turned, 2, 0);
  return up > down ? up : -down;
}

TEST(Motion, HasItsOrderOnAnOscillatorOfOneElement) {
  for (const MassKind mass : {MassKind::consistent, MassKind::lumped})
    for (const auto& [name, motion] : k_methods) {
      const double omega = frequency(mass), end = 5 / omega;
      std::vector<double> errors;
      for (const int n : {100, 200, 400}) {
        const March run(oscillator(motion, mass), end, n);
        errors.push_back(std::abs(moving(run.state.displacement) - k_speed / omega * std::sin(5.0)) +
                         std::abs(moving(run.state.velocity) - k_speed * std::cos(5.0)) / omega);
      }
      const bool second = motion.gamma == 0.5 || motion.alpha_f > 0;
      for (std::size_t i = 1; i < errors.size(); ++i)
        EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), second ? 2 : 1, 0.1) << name << " " << i;
      EXPECT_LT(errors.back() * omega / k_speed, second ? 1e-3 : 0.1) << name;
    }
}

TEST(Motion, StartsWithTheAccelerationOfItsLoads) {
  Body body = oscillator(Motion::newmark(0.6, 0.3025), MassKind::consistent);
  body.conditions.pressures.push_back({"right", 1e6});
  const MechanicalState state = body.phase()->initial_state();
  EXPECT_NEAR(moving(state.acceleration), -1e6 * k_length / (k_density * k_length * k_length / 3),
              1e-10 * 1e6 * 3 / (k_density * k_length));
  EXPECT_NEAR(moving(state.velocity), k_speed, 1e-15);
}

TEST(FreeFall, IsExactInEveryShapeKindAndMassWithSecondOrderMethods) {
  constexpr double k_gravity = 9.81, k_end = 0.1;
  for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8, Shape::tet4, Shape::tet10,
                            Shape::hex8, Shape::hex20})
    for (const MassKind mass : {MassKind::consistent, MassKind::lumped})
      for (const Motion& motion : {Motion::trapezoidal(), Motion::generalised_alpha(0.5)}) {
        const bool solid = mesh::dimension(shape) == 3;
        Body body({.shape = shape, .cells = {2, 2, 1}, .size = {1, 1, 1}, .distortion = 0.1},
                  solid ? AnalysisKind::solid : AnalysisKind::axisymmetric,
                  test::elastic_material(k_young, 0.3));
        body.conditions.gravity = {0, -k_gravity, 0};
        body.options.dynamics = DynamicsOptions{mass, motion, {{0, 1, 0}}};
        const March run(body, k_end, 4);
        const int n = displacement_components(body.kind);
        // Rounding of a stiff body: ε u times stiffness over inertia.
        EXPECT_NEAR(largest(run.state.displacement, n, 1), k_end - 0.5 * k_gravity * k_end * k_end, 1e-10)
            << mesh::name(shape);
        EXPECT_NEAR(largest(run.state.velocity, n, 1), 1 - k_gravity * k_end, 1e-8) << mesh::name(shape);
        EXPECT_NEAR(largest(run.state.acceleration, n, 1), -k_gravity, 1e-5) << mesh::name(shape);
      }
}

/// A cantilever in two dimensions, clamped on the left, thrown, loaded at once and pulled by its end.
Body cantilever(const Motion& motion, MassKind mass, bool driven) {
  Body body({.shape = Shape::tri3, .cells = {8, 3, 1}, .size = {0.4, 0.1, 1}, .distortion = 0.1},
            AnalysisKind::plane_strain, test::elastic_material(k_young, 0.3));
  body.hold("left", 0);
  body.hold("left", 1);
  body.options.dynamics = DynamicsOptions{mass, motion, {{1, 4, 0}}};
  if (!driven) return body;
  body.conditions.pressures.push_back({"top", Table({0, 2e-4, 4e-4}, {3e7, -2e7, 1e7})});
  body.conditions.gravity = {0, -9.81, 0};
  body.hold("right", 0, Table({0, 1e-4, 5e-4}, {0, 3e-4, -1e-4}));
  return body;
}
constexpr double k_end = 5e-4;  // [s], some periods of the lowest mode along the bar

/// Strain energy of linear triangles, whose stress is constant.
double strain_energy(const Body& body, const mechanics::MechanicalState& state) {
  const test::ElementFields fields = test::element_fields(body.mesh, state).front();
  const mesh::ElementBlock& block = body.mesh.blocks.front();
  const mesh::BlockGeometry g(body.mesh, block, body.kind, mesh::stiffness_rule(block.shape));
  double energy = 0;
  for (Index e = 0; e < block.n_counted; ++e) {
    const auto& s = fields.stress[static_cast<std::size_t>(e)];
    const auto& strain = fields.strain[static_cast<std::size_t>(e)];
    double density = 0;
    for (std::size_t i = 0; i < 6; ++i) density += (i < 3 ? 0.5 : 1.0) * s[i] * strain[i];
    energy += density * g.weight_at(e / k_lanes, 0)[e % k_lanes];
  }
  return parallel::global_sum(energy);
}

double kinetic_energy(const Body& body, const MechanicalState& state) {
  const mechanics::MassMatrix mass(body.mesh, body.kind, std::vector{k_density}, body.options.dynamics->mass);
  std::vector<double> momentum(static_cast<std::size_t>(body.mesh.n_owned_nodes * 2));
  mass.multiply(state.velocity, 2, momentum);
  double energy = 0;
  for (std::size_t i = 0; i < momentum.size(); ++i) energy += 0.5 * momentum[i] * state.velocity[i];
  return parallel::global_sum(energy);
}

TEST(TrapezoidalRule, KeepsTheEnergyOfALinearElasticBodyToRoundOff) {
  const Body body = cantilever(Motion::trapezoidal(), MassKind::consistent, false);
  const auto phase = body.phase();
  MechanicalState state = phase->initial_state();
  const double start = kinetic_energy(body, state);
  double most_strained = 0;
  for (int n = 1; n <= 200; ++n) {
    const MechanicalState old = state;
    phase->solve(old, state, body.temperature, n * k_end / 200, k_end / 200);
    const double strained = strain_energy(body, state);
    most_strained = std::max(most_strained, strained);
    EXPECT_NEAR((kinetic_energy(body, state) + strained) / start, 1, 1e-9) << n;  // criterion 1e-11 a step
  }
  EXPECT_GT(most_strained, 0.1 * start);
}

TEST(EnergyOfAStep, ClosesWithEveryMethodMassLoadAndMovingSupport) {
  for (const MassKind mass : {MassKind::consistent, MassKind::lumped})
    for (const auto& [name, motion] : k_methods) {
      const Body body = cantilever(motion, mass, true);
      const March run(body, k_end, 50);
      double scale = 0;
      for (const MechanicalWork& w : run.steps) scale = std::max(scale, std::abs(w.kinetic));
      for (const MechanicalWork& w : run.steps)
        EXPECT_NEAR(w.internal_work + w.kinetic + w.numerical, w.external_work + w.support_work, 1e-8 * scale)
            << name;
      double kinetic = 0;
      for (const MechanicalWork& w : run.steps) kinetic += w.kinetic;
      EXPECT_NEAR(kinetic,
                  kinetic_energy(body, run.state) - kinetic_energy(body, body.phase()->initial_state()),
                  1e-11 * std::abs(kinetic) + 1e-9 * scale)
          << name;
    }
}

/// The energy that the method dissipates in the whole run, over the energy at its start.
double dissipated(const Motion& motion, int n_steps) {
  const Body body = cantilever(motion, MassKind::consistent, false);
  const March run(body, k_end, n_steps);
  double sum = 0;
  for (const MechanicalWork& w : run.steps) sum += w.numerical;
  return sum / kinetic_energy(body, body.phase()->initial_state());
}

TEST(NumericalDissipation, IsTheIntegratorsLoss) {
  const int n = 100;
  EXPECT_GT(dissipated(Motion::backward_euler(), n), 0.1);
  EXPECT_GT(dissipated(Motion::generalised_alpha(0.5), n), 1e-3);
  EXPECT_LT(dissipated(Motion::generalised_alpha(0.5), n), 0.2);
  EXPECT_NEAR(dissipated(Motion::trapezoidal(), n), 0, 1e-12);
  EXPECT_NEAR(dissipated(Motion::generalised_alpha(1), n), 0, 1e-9);
}

// ½ Δv·M Δv by hand, from the velocities of the states.
TEST(NumericalDissipation, OfBackwardEulerIsThatOfTheChangesOfVelocity) {
  const Body body = cantilever(Motion::backward_euler(), MassKind::lumped, true);
  const auto phase = body.phase();
  MechanicalState old = phase->initial_state();
  for (int n = 1; n <= 10; ++n) {
    MechanicalState state = old;
    const MechanicalWork work = phase->solve(old, state, body.temperature, n * k_end / 50, k_end / 50).work;
    MechanicalState change = state;
    for (std::size_t i = 0; i < change.velocity.size(); ++i) change.velocity[i] -= old.velocity[i];
    const double expected = kinetic_energy(body, change);
    EXPECT_NEAR(work.numerical, expected, 1e-9 * expected) << n;
    old = state;
  }
}

TEST(Inertia, IsAmongTheForcesOfTheCriterion) {
  // Thrown and unloaded, all forces are inertia: the criterion must not fall back to a millionth of stresses.
  Body body = cantilever(Motion::trapezoidal(), MassKind::consistent, false);
  body.options.newton.tolerance = 1e-3;
  const auto phase = body.phase();
  const MechanicalState old = phase->initial_state();
  MechanicalState state = old;
  const auto report = phase->solve(old, state, body.temperature, k_end / 50, k_end / 50);
  EXPECT_EQ(report.newton.iterations, 1);
  ASSERT_EQ(report.newton.residuals.size(), 2u);
  EXPECT_LT(report.newton.residuals[0], 2);  // of forces that are as large as it is
  EXPECT_LT(report.newton.residuals[1], 1e-9);
}

/// Mush that nothing feeds between rigid walls, f_S = 0.8, pressed by a lid of constant speed; all nodes are
/// prescribed and nearly without mass.
March pressed_mush(const Shape shape, const Motion& motion) {
  material::Material metal = test::elastic_material(7e10, 0.33);
  metal.density = 1e-3;
  metal.liquid_viscosity = {};
  metal.phase_changes.push_back(
      {.name = "freezing", .fraction = material::PhaseFraction::linear(800, 900), .solidification = true});
  const bool solid = shape == Shape::tet4;
  Body body({.shape = shape, .cells = {1, 1, 1}, .size = {k_length, k_length, k_length}},
            solid ? AnalysisKind::solid : AnalysisKind::plane_strain, metal);
  body.initial_temperature.assign(body.mesh.x.size(), 820.0);
  body.temperature = body.initial_temperature;
  for (const char* side : {"left", "right"}) body.hold(side, 0);
  body.hold("bottom", 1);
  body.hold("top", 1, Table({0.0, 1.0}, {0.0, -1e-3 * k_length}));
  if (solid)
    for (const char* side : {"back", "front"}) body.hold(side, 2);
  body.options.dynamics = DynamicsOptions{MassKind::lumped, motion, {}};
  return {body, 4e-3, 4};
}

// The bulk viscosity of mush (liquid_flow.hpp) is a force like others: with every integrator the lid is
// pressed with k ε + ζ ε̇ and the deviator of the Maxwell element, and the energy of every step closes.
TEST(Mush, ResistsCompactionWithEveryMethod) {
  for (const Shape shape : {Shape::tri3, Shape::tet4}) {
    const auto force = [](const March& run) {
      double squares = 0;
      for (const double f : run.reactions) squares += f * f;
      return std::sqrt(parallel::global_sum(squares));
    };
    const March reference = pressed_mush(shape, Motion::backward_euler());
    constexpr double k_bulk = 7e10 / (3 * (1 - 2 * 0.33));
    const double area = shape == Shape::tet4 ? k_length * k_length : k_length;
    EXPECT_GT(force(reference), 2 * k_bulk * 4e-6 * area) << "the viscous part is the larger one";
    for (const auto& [name, motion] : k_methods) {
      const March run = pressed_mush(shape, motion);
      EXPECT_NEAR(force(run), force(reference), 1e-6 * force(reference)) << name;
      for (const MechanicalWork& w : run.steps)
        EXPECT_NEAR(w.internal_work + w.kinetic + w.numerical, w.external_work + w.support_work,
                    1e-8 * std::abs(w.support_work))
            << name;
    }
  }
}

}  // namespace
}  // namespace solidus
