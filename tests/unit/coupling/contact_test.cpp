/// Contact through the steps of a scheme: history, energy, graphs that change, restart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/passes.hpp"
#include "parallel/parallel.hpp"
#include "rubbed.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::pulled;
using test::Rubbed;
using test::rubbing;

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
          contact::work(run.pair.view(), run.phase.bodies().work_share())};
}

const mechanics::Motion k_means[] = {mechanics::Motion::trapezoidal(),
                                     mechanics::Motion::generalised_alpha(0.6)};

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
  const int pattern = run.phase.system().matrix().pattern();
  // 100 mm at once, over a face of the master of the same length and two of the slave.
  run.step(5);
  EXPECT_GT(run.phase.system().matrix().pattern(), pattern);
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

}  // namespace
}  // namespace solidus
