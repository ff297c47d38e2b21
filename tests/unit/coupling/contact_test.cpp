/// Contact through the steps of a scheme: history, energy, graphs that change, restart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/contact_bodies.hpp"
#include "../contact/friction_laws.hpp"
#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/isothermal_split.hpp"
#include "coupling/passes.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

using mesh::Shape;

/// Mechanics alone with one contact pair, stepped by a scheme.
struct Rubbed {
  std::vector<material::Material> materials;
  contact::ContactPair pair;
  mechanics::MechanicalPhase phase;
  coupling::Phases phases;
  coupling::IsothermalSplit scheme;
  coupling::State state;

  Rubbed(const mesh::Mesh& mesh, AnalysisKind kind, const contact::ContactParameters& spec,
         const mechanics::MechanicalConditions& conditions, mechanics::MechanicsOptions options)
      : materials{test::elastic(70e9, 0.3), test::elastic(70e9, 0.3)},
        pair(mesh, kind, spec, std::vector<double>{70e9, 70e9}),
        phase(mesh, kind, materials, std::vector<double>(mesh.x.size(), 300.0), conditions,
              for_pair(std::move(options), pair), {&pair.mechanics()}),
        phases{.mechanics = &phase,
               .contacts = {&pair},
               .temperature = std::vector<double>(mesh.x.size(), 300.0),
               .ambient_temperature = {}},
        scheme(phases) {
    state.mechanics = phase.initial_state();
    state.contacts = {pair.history().initial()};
  }
  Rubbed(const Rubbed&) = delete;

  coupling::StepEffort step(double dt) {
    coupling::State trial = state;
    const double time = state.time + dt;
    const coupling::StepEffort effort = scheme.advance(state, trial, time, dt);
    trial.time = time;
    state = std::move(trial);
    return effort;
  }

 private:
  static mechanics::MechanicsOptions for_pair(mechanics::MechanicsOptions options,
                                              const contact::ContactPair& pair) {
    options.symmetric = pair.forces().symmetric();
    return options;
  }
};

/// The lower block stands; the upper one is pressed by 20 MPa and pulled along at 20 mm/s.
mechanics::MechanicalConditions pulled() {
  mechanics::MechanicalConditions c;
  c.displacements.push_back({"lower_y_min", 0, 0.0});
  c.displacements.push_back({"lower_y_min", 1, 0.0});
  c.displacements.push_back({"upper_y_max", 0, Table({0, 10}, {0, 0.2})});
  c.pressures.push_back({"upper_y_max", Table({0, 1}, {0, 20e6})});
  c.plane_faces = {{"upper_y_max"}};
  return c;
}

contact::ContactParameters rubbing() {
  contact::ContactParameters s = test::interface();
  s.formulation = contact::Formulation::large_sliding;
  s.search_distance = 0.02;
  s.penalty = 1e13;
  s.penalty_is_factor = false;
  s.friction = contact::friction_spec({0.2, 0.05}, 1e6);
  return s;
}

TEST(ContactInDynamics, QuotientKeepsTheEnergyOfAnImpactThatThePenaltyDoesNot) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-5);
  mechanics::MechanicalConditions c;
  c.displacements.push_back({"lower_y_min", 0, 0.0});
  c.displacements.push_back({"lower_y_min", 1, 0.0});
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.dynamics = mechanics::DynamicsOptions{.motion = mechanics::Motion::trapezoidal(),
                                                .initial_velocity = {{0, 0, 0}, {0, -2, 0}}};
  const auto drift = [&](contact::NormalKind kind) {
    contact::ContactParameters s = test::interface();
    s.normal = kind;
    Rubbed run(mesh, AnalysisKind::plane_strain, s, c, options);
    // ½ ρ v² of the upper block, 0.3 m × 0.2 m.
    const double thrown = 0.5 * 7800 * 0.3 * 0.2 * 4;
    const double start = contact::sums(run.pair.view(), {}).energy;
    double energy = 0, largest = 0, pressed = 0;
    for (int k = 0; k < 250; ++k) {
      const mechanics::MechanicalState old = run.state.mechanics;
      const mechanics::MechanicalPass pass{
          .time = run.state.time + 2e-6, .dt = 2e-6, .temperature = run.phases.temperature};
      coupling::begin_contacts(run.phases, run.state.contacts, old, pass);
      const mechanics::MechanicalReport report = run.phase.solve(old, run.state.mechanics, pass);
      run.pair.update(run.state.mechanics.displacement);
      run.state.contacts = coupling::contact_states(run.phases);
      run.state.time = pass.time;
      energy += report.work.kinetic + report.work.internal_work;
      const contact::ContactSums sums = contact::sums(run.pair.view(), {});
      pressed = std::max(pressed, sums.force);
      largest = std::max(largest, std::abs(energy + sums.energy - start));
    }
    EXPECT_GT(pressed, 0);
    EXPECT_EQ(contact::sums(run.pair.view(), {}).closed_points, 0) << "it has bounced off";
    return largest / thrown;
  };
  // Newton's iteration ends at 1e-12 of the forces.
  EXPECT_LT(drift(contact::NormalKind::energy_conserving), 1e-8);
  EXPECT_GT(drift(contact::NormalKind::penalty), 1e-4);
}

TEST(ContactWork, IsWhatTheForcesInTheBalanceDoWhereBodiesSlideAcrossFaces) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  Rubbed run(mesh, AnalysisKind::plane_strain, rubbing(), pulled(), test::strict_mechanics());
  double dissipated = 0;
  for (int k = 0; k < 4; ++k) {
    const mechanics::MechanicalState old = run.state.mechanics;
    const mechanics::MechanicalPass pass{
        .time = run.state.time + 1, .dt = 1, .temperature = run.phases.temperature};
    run.scheme.synchronise(run.state);
    coupling::ContactWork contact(run.phases);
    coupling::begin_contacts(run.phases, run.state.contacts, old, pass);
    const mechanics::MechanicalWork work = run.phase.solve(old, run.state.mechanics, pass).work;
    run.pair.update(run.state.mechanics.displacement);
    run.state.contacts = coupling::contact_states(run.phases);
    run.state.time = pass.time;
    contact.add();
    coupling::EnergyAudit audit;
    contact.book(audit);
    const double on_contact =
        work.external_work + work.support_work + work.residual_work - work.internal_work;
    EXPECT_NEAR(contact::work(run.pair.view(), 1), on_contact, 1e-9 * std::abs(work.support_work));
    EXPECT_NEAR(audit.contact + audit.friction + audit.numerical, on_contact,
                1e-9 * std::abs(work.support_work));
    EXPECT_GT(audit.friction, 0);
    dissipated += audit.friction;
  }
  const contact::ContactSums sums = contact::sums(run.pair.view(), {});
  EXPECT_NEAR(sums.dissipation, dissipated, 1e-12 * dissipated);
  // Of hardening friction a part of the work is stored: D = γ μ_0 t_N < γ μ t_N (3.58).
  EXPECT_LT(sums.dissipation, sums.work);
}

TEST(ContactWork, OfARigidPlaneIsItsForceTimesItsWay) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.1);
  contact::ContactParameters s = rubbing();
  s.master = "plane";
  s.rigid_master.emplace();
  s.rigid_master->point = {0, 0.1, 0};
  s.rigid_master->direction = {0, -1, 0};
  // Down by 0.1 mm, then along by 1 mm.
  s.rigid_master->motion.translation = {Table({1, 2}, {0, 1e-3}), Table({0, 1}, {0, -1e-4}), Table(0.0)};
  mechanics::MechanicalConditions c;
  for (const char* held : {"lower_y_min", "upper"})
    for (int i = 0; i < 2; ++i) c.displacements.push_back({held, i, 0.0});
  Rubbed run(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
  run.scheme.synchronise(run.state);
  double down = 0, along = 0;
  for (int k = 0; k < 8; ++k) {
    const coupling::StepEffort effort = run.step(0.25);
    const auto& force = effort.contacts[0].resultant;
    const double work = k < 4 ? 1e-4 / 4 * force[1] : -1e-3 / 4 * force[0];
    EXPECT_NEAR(effort.energy.work, work, 1e-9 * std::abs(work));
    (k < 4 ? down : along) += effort.energy.work;
  }
  EXPECT_GT(down, 0);
  EXPECT_GT(along, 0);
}

// Out of reach at first, or switched off: it does the same work in the step in which it meets the block.
TEST(ContactWork, OfARigidPlaneCountsWhatItMeetsWithinTheStep) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.1);
  for (const bool out_of_reach : {true, false}) {
    contact::ContactParameters s = rubbing();
    s.master = "plane";
    s.rigid_master.emplace();
    const double way = out_of_reach ? 0.03 : 1e-3;
    s.rigid_master->point = {0, 0.1 + way, 0};
    s.rigid_master->direction = {0, -1, 0};
    s.rigid_master->motion.translation[1] = Table({1, 2}, {0, -way - 1e-4});
    mechanics::MechanicalConditions c;
    for (const char* held : {"lower_y_min", "upper"})
      for (int i = 0; i < 2; ++i) c.displacements.push_back({held, i, 0.0});
    Rubbed run(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
    run.pair.activate(out_of_reach);
    run.scheme.synchronise(run.state);
    run.step(1);
    run.pair.activate(true);
    run.scheme.synchronise(run.state);
    const coupling::StepEffort effort = run.step(1);
    const double work = (way + 1e-4) * effort.contacts[0].resultant[1];
    EXPECT_GT(work, 0);
    EXPECT_NEAR(effort.energy.work, work, 1e-9 * work) << out_of_reach;
  }
}

/// Work of the balance of forces on contact in a step with inertia, and the work that the pair reports [J].
struct WorkOnContact {
  double balance = 0, pair = 0;
};
WorkOnContact dynamic_step(Rubbed& run, double dt) {
  const mechanics::MechanicalState old = run.state.mechanics;
  mechanics::MechanicalPass pass{
      .time = run.state.time + dt, .dt = dt, .temperature = run.phases.temperature};
  coupling::begin_contacts(run.phases, run.state.contacts, old, pass);
  mechanics::MechanicalWork work;
  for (int turn = 1;; ++turn) {
    mechanics::MechanicalState next;
    work = run.phase.solve(old, next, pass).work;
    run.state.mechanics = std::move(next);
    run.pair.update(run.state.mechanics.displacement);
    if (coupling::penetrations_small(run.phases, turn)) break;
    pass.start = run.state.mechanics.displacement;
  }
  run.state.contacts = coupling::contact_states(run.phases);
  run.state.time = pass.time;
  return {work.external_work + work.support_work + work.residual_work - work.internal_work - work.kinetic -
              work.numerical,
          contact::work(run.pair.view(), run.phase.work_share())};
}

const mechanics::Motion k_means[] = {mechanics::Motion::trapezoidal(),
                                     mechanics::Motion::generalised_alpha(0.6)};

// Penetrations after one solve, which no further one follows, 5 and 20 times as large as allowed.
TEST(AugmentedLagrangian, AcceptsAfterSixtyTurnsWhatIsTenTimesTooLargeAndSaysSo) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  contact::ContactParameters s = rubbing();
  s.normal = contact::NormalKind::augmented_lagrangian;
  const auto check = [&](double tolerance, const auto& look) {
    s.penetration_tolerance = tolerance;
    mechanics::MechanicalConditions c;
    for (int i = 0; i < 2; ++i) c.displacements.push_back({"lower_y_min", i, 0.0});
    c.displacements.push_back({"upper_y_max", 0, 0.0});
    c.displacements.push_back({"upper_y_max", 1, -1e-5});
    Rubbed run(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
    const mechanics::MechanicalState old = run.state.mechanics;
    const mechanics::MechanicalPass pass{.time = 1, .dt = 1, .temperature = run.phases.temperature};
    coupling::begin_contacts(run.phases, run.state.contacts, old, pass);
    mechanics::MechanicalState next;
    run.phase.solve(old, next, pass);
    run.pair.update(next.displacement);
    look(run);
  };
  double excess = 0;
  check(1e-6, [&](const Rubbed& run) { excess = run.pair.excess(); });
  ASSERT_GT(excess, 0);
  logging::clear_warnings();
  check(1e-6 * excess / 5, [](Rubbed& run) {
    EXPECT_FALSE(coupling::penetrations_small(run.phases, 59));
    EXPECT_TRUE(logging::warnings().empty());
    EXPECT_TRUE(coupling::penetrations_small(run.phases, 60));
  });
  ASSERT_EQ(logging::warnings().size(), 1);
  EXPECT_THAT(logging::warnings()[0], ::testing::HasSubstr("by less than 10 times"));
  logging::clear_warnings();
  check(1e-6 * excess / 20, [](Rubbed& run) {
    EXPECT_FALSE(coupling::penetrations_small(run.phases, 60));
    EXPECT_FALSE(coupling::penetrations_small(run.phases, 199));
  });
  EXPECT_TRUE(logging::warnings().empty());
}

/// Pressed blocks after a solve without multipliers, far above their tolerance.
struct PressedBlocks {
  mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  std::optional<Rubbed> run;
  mechanics::MechanicalState old, next;  ///< at t_n and in equilibrium
  mechanics::MechanicalPass pass;

  PressedBlocks() {
    contact::ContactParameters s = rubbing();
    s.normal = contact::NormalKind::augmented_lagrangian;
    s.penetration_tolerance = 1e-12;
    mechanics::MechanicalConditions c;
    for (int i = 0; i < 2; ++i) c.displacements.push_back({"lower_y_min", i, 0.0});
    c.displacements.push_back({"upper_y_max", 0, 0.0});
    c.displacements.push_back({"upper_y_max", 1, -1e-5});
    run.emplace(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
    old = run->state.mechanics;
    pass = {.time = 1, .dt = 1, .temperature = run->phases.temperature};
    coupling::begin_contacts(run->phases, run->state.contacts, old, pass);
    run->phase.solve(old, next, pass);
    run->pair.update(next.displacement);
  }
  double largest(double contact::ContactPointState::*field) const {
    double found = 0;
    for (const contact::ContactPointState& point : run->pair.state().points)
      found = std::max(found, point.*field);
    return found;
  }
};

TEST(AugmentedLagrangian, FollowsPointsAfterSixtyTurnsAndMeansBefore) {
  for (const int turn : {59, 60}) {
    PressedBlocks blocks;
    Rubbed& run = *blocks.run;
    const std::vector<contact::ContactPointState> before = run.pair.state().points;
    ASSERT_FALSE(coupling::penetrations_small(run.phases, turn));
    run.pair.update(blocks.next.displacement);
    double off = 0;
    for (std::size_t p = 0; p < before.size(); ++p) {
      const contact::ContactPointState& now = run.pair.state().points[p];
      if (before[p].status == contact::PointStatus::open) continue;
      off = std::max(off, std::abs(now.multiplier - std::max(0.0, 1e13 * before[p].penetration)));
    }
    const double pressure = 1e13 * blocks.largest(&contact::ContactPointState::penetration);
    ASSERT_GT(pressure, 0);
    if (turn < 60)
      EXPECT_GT(off, 1e-3 * pressure) << "penetrations are not linear from node to node";
    else
      EXPECT_LT(off, 1e-9 * pressure);
  }
}

// A step that ends with turns left over is better than the penalty, or it is cut.
TEST(AugmentedLagrangian, IsTakenAsItIsAfterTwoHundredTurnsUnlessThePenaltyIsBetter) {
  PressedBlocks blocks;
  Rubbed& run = *blocks.run;
  ASSERT_FALSE(coupling::penetrations_small(run.phases, 60));
  blocks.pass.start = blocks.next.displacement;
  run.phase.solve(blocks.old, blocks.next, blocks.pass);
  run.pair.update(blocks.next.displacement);
  EXPECT_LT(run.pair.share_of_penalty(), 1);
  logging::clear_warnings();
  EXPECT_FALSE(coupling::penetrations_small(run.phases, 199));
  run.phase.solve(blocks.old, blocks.next, blocks.pass);
  run.pair.update(blocks.next.displacement);
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 200));
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 60, 140)) << "passes share their turns";
  ASSERT_EQ(logging::warnings().size(), 1);
  EXPECT_THAT(logging::warnings()[0], ::testing::HasSubstr("% of the largest contact pressure"));

  // Apart, with the pressures of multipliers that know nothing of it.
  const double lift = 0.8 * blocks.largest(&contact::ContactPointState::pressure) / 1e13;
  std::vector<double> apart = blocks.next.displacement;
  for (const mesh::ElementBlock& block : blocks.mesh.blocks) {
    if (blocks.mesh.bodies[static_cast<std::size_t>(block.body)].name != "upper") continue;
    std::vector<char> moved(blocks.mesh.x.size(), 0);
    for (const Index node : block.nodes) moved[static_cast<std::size_t>(node)] = 1;
    for (std::size_t i = 0; i < moved.size(); ++i)
      if (moved[i] != 0) apart[2 * i + 1] += lift;
  }
  run.pair.update(apart);
  ASSERT_GT(run.pair.share_of_penalty(), 1);
  EXPECT_THROW(coupling::penetrations_small(run.phases, 200), StepRejected);
}

TEST(ContactWork, OfTheAugmentedLagrangianHasTheTractionsOfTheStart) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  contact::ContactParameters s = rubbing();
  s.normal = contact::NormalKind::augmented_lagrangian;
  s.penetration_tolerance = 1e-5;
  for (const mechanics::Motion& motion : k_means) {
    mechanics::MechanicsOptions options = test::strict_mechanics();
    options.dynamics = mechanics::DynamicsOptions{.motion = motion, .initial_velocity = {}};
    Rubbed run(mesh, AnalysisKind::plane_strain, s, pulled(), options);
    run.scheme.synchronise(run.state);
    double largest = 0;
    for (int k = 0; k < 6; ++k) {
      const WorkOnContact work = dynamic_step(run, 0.05);
      largest = std::max(largest, std::abs(work.balance));
      EXPECT_NEAR(work.pair, work.balance, 1e-8 * largest) << k;
    }
  }
}

// The mean of the forces at both ends of the first step without contact still holds half of the last ones.
TEST(ContactWork, OfContactThatIsSwitchedOffIsThatOfItsLastForces) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  for (const mechanics::Motion& motion : k_means) {
    mechanics::MechanicsOptions options = test::strict_mechanics();
    options.dynamics = mechanics::DynamicsOptions{.motion = motion, .initial_velocity = {}};
    Rubbed run(mesh, AnalysisKind::plane_strain, rubbing(), pulled(), options);
    run.scheme.synchronise(run.state);
    for (int k = 0; k < 4; ++k) dynamic_step(run, 0.05);
    run.pair.activate(false);
    run.scheme.synchronise(run.state);
    const WorkOnContact first = dynamic_step(run, 0.05);
    EXPECT_GT(std::abs(first.balance), 1);
    EXPECT_NEAR(first.pair, first.balance, 1e-8 * std::abs(first.balance));
    const WorkOnContact second = dynamic_step(run, 0.05);
    EXPECT_EQ(second.pair, 0);
    EXPECT_NEAR(second.balance, 0, 1e-8 * std::abs(first.balance));
  }
}

TEST(LargeSliding, GivesMatricesNewPlacesInTheMiddleOfARun) {
  const mesh::Mesh mesh =
      test::distribute_blocks(test::raw_blocks({{0.3, 0.1}, {0.3, 0.2}, {20, 2}, {16, 2}, 0}, Shape::quad4));
  contact::ContactParameters s = rubbing();
  s.friction = contact::friction_spec({0.2});
  mechanics::MechanicalConditions c = pulled();
  Rubbed run(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
  run.step(1);
  const int pattern = run.phase.matrix().pattern();
  // 100 mm at once, over a face of the master of the same length and two of the slave.
  run.step(5);
  EXPECT_GT(run.phase.matrix().pattern(), pattern);
  const contact::ContactSums sums = contact::sums(run.pair.view(), {});
  EXPECT_NEAR(sums.resultant[1], 20e6 * 0.3, 1e-9 * sums.force);
  EXPECT_NEAR(sums.friction, 0.2 * sums.force, 1e-9 * sums.force);
}

TEST(ContactHistory, LeavesAStepThatIsTakenAgainTheSameBits) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  const auto make = [&] {
    return std::make_unique<Rubbed>(mesh, AnalysisKind::plane_strain, rubbing(), pulled(),
                                    test::strict_mechanics());
  };
  const auto whole = make(), rest = make();
  whole->scheme.synchronise(whole->state);
  for (int k = 0; k < 3; ++k) whole->step(1);
  // A checkpoint: the run goes on from the state alone, whoever takes the steps.
  const coupling::State saved = whole->state;
  whole->scheme.forget();
  whole->step(1);
  whole->step(1);

  rest->state = saved;
  rest->scheme.synchronise(saved);
  rest->scheme.forget();
  // A step that is thrown away leaves no trace.
  coupling::State thrown_away = saved;
  rest->scheme.advance(saved, thrown_away, saved.time + 2, 2);
  rest->scheme.synchronise(saved);
  rest->scheme.forget();
  rest->step(1);
  rest->step(1);

  // MUMPS on several processes adds up in the order in which messages come.
  const int n_processes = processes::count();
  const double rounding = n_processes == 1 ? 0.0 : 1e-9;
  double largest = 0;
  for (const double u : whole->state.mechanics.displacement) largest = std::max(largest, std::abs(u));
  for (std::size_t i = 0; i < whole->state.mechanics.displacement.size(); ++i)
    ASSERT_NEAR(whole->state.mechanics.displacement[i], rest->state.mechanics.displacement[i],
                rounding * largest);
  const auto &a = whole->state.contacts[0].points, &b = rest->state.contacts[0].points;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    EXPECT_NEAR(a[p].traction[0], b[p].traction[0], rounding * 20e6);
    EXPECT_NEAR(a[p].internal_variable, b[p].internal_variable, rounding * 1e6);
    EXPECT_NEAR(a[p].slip, b[p].slip, rounding);
    EXPECT_EQ(a[p].status, b[p].status);
  }
}

TEST(AugmentedLagrangian, LeavesNoPenetrationWhereThePenaltyDoes) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  mechanics::MechanicalConditions c = test::symmetric_supports(2);
  c.pressures.push_back({"upper_y_max", 1e8});
  contact::ContactParameters s = test::interface();
  s.penalty = 1;  // a soft one: the penetration is as large as the strain of an element
  for (const auto formulation : {contact::Formulation::small_sliding, contact::Formulation::large_sliding}) {
    s.formulation = formulation;
    s.normal = contact::NormalKind::augmented_lagrangian;
    s.penetration_tolerance = 1e-8;
    Rubbed run(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
    const coupling::StepEffort effort = run.step(1);
    EXPECT_GE(effort.mechanics.iterations, 2);
    const contact::ContactNodalFields fields = contact::nodal_fields(run.pair.view(), {});
    const bool fixed = formulation == contact::Formulation::small_sliding;
    for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
      // Gauss points that do not know where the master's faces end see the mean, not every point, closed;
      // they leave the pressure an error of quadrature.
      EXPECT_LE(std::abs(fields.opening[i]), fixed ? 1e-8 * 0.06 : 1e-6 * 0.06);
      EXPECT_NEAR(fields.pressure[i], 1e8, (fixed ? 1e-7 : 1e-2) * 1e8);
    }
    // The next step starts from the multipliers and has nothing to do.
    EXPECT_LE(run.step(1).mechanics.iterations, 2);
  }
}

// A scheme that takes one Newton iteration in every pass: multipliers that grew from iterates out of
// equilibrium, or that began anew in every pass, would go round.
TEST(AugmentedLagrangian, SettlesInPassesOfOneIterationAsInPassesToEquilibrium) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  mechanics::MechanicalConditions c = test::symmetric_supports(2);
  c.pressures.push_back({"upper_y_max", 1e8});
  contact::ContactParameters s = test::interface();
  s.penalty = 1;
  s.normal = contact::NormalKind::augmented_lagrangian;
  s.penetration_tolerance = 1e-8;
  Rubbed whole(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
  whole.step(1);
  Rubbed single(mesh, AnalysisKind::plane_strain, s, c, test::strict_mechanics());
  coupling::State trial = single.state;
  mechanics::MechanicalPass pass{.time = 1, .dt = 1, .temperature = single.phases.temperature};
  pass.newton_steps = 1;
  int iterations = 0;
  const auto take = [&] {
    coupling::StepEffort effort;
    const std::vector<contact::ContactState> before = trial.contacts;
    const bool solved =
        coupling::mechanical_pass(single.phases, single.state, trial, pass, effort, before).newton.converged;
    iterations = effort.mechanics.iterations;
    pass.iterate = &trial.mechanics;
    return solved;
  };
  bool solved = take();
  for (int passes = 1; passes < 10 && !solved; ++passes) solved = take();
  EXPECT_TRUE(solved);
  EXPECT_GE(iterations, 2) << "of the turns in which the multipliers grew";
  EXPECT_TRUE(take());
  EXPECT_LE(iterations, 1) << "what was found is the start of the next pass";
  EXPECT_LE(single.pair.excess(), 1);
  for (std::size_t i = 0; i < trial.contacts[0].points.size(); ++i)
    EXPECT_NEAR(trial.contacts[0].points[i].multiplier, whole.state.contacts[0].points[i].multiplier, 1e3);
  for (std::size_t i = 0; i < trial.mechanics.displacement.size(); ++i)
    EXPECT_NEAR(trial.mechanics.displacement[i], whole.state.mechanics.displacement[i], 1e-8 * 0.06);
}

}  // namespace
}  // namespace solidus
