/// Augmentations of the Lagrangian: when they end, and what they follow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "coupling/contact_states.hpp"
#include "coupling/passes.hpp"
#include "rubbed.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Rubbed;
using test::rubbing;

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
  check(1e-6, [&](const Rubbed& run) { excess = run.pair.parts().augmentations.excess(); });
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
  /// Solves again, from the solution of now.
  void solve() {
    const std::vector<double> start = next.displacement;  // solve() writes where this is read from
    pass.start = start;
    run->phase.solve(old, next, pass);
    pass.start = {};
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

/// Leaves the blocks as they are, but for the upper one, which moves by `lift`.
std::vector<double> moved(const PressedBlocks& blocks, double lift) {
  std::vector<double> u = blocks.next.displacement;
  for (const mesh::ElementBlock& block : blocks.mesh.blocks) {
    if (blocks.mesh.bodies[static_cast<std::size_t>(block.body)].name != "upper") continue;
    std::vector<char> of_block(blocks.mesh.x.size(), 0);
    for (const Index node : block.nodes) of_block[static_cast<std::size_t>(node)] = 1;
    for (std::size_t i = 0; i < of_block.size(); ++i)
      if (of_block[i] != 0) u[2 * i + 1] += lift;
  }
  return u;
}

// A step that ends before its augmentations have converged is better than the penalty, or it is cut.
TEST(AugmentedLagrangian, IsTakenAsItIsAfterTwoHundredTurnsUnlessTheDefaultPenaltyIsBetter) {
  PressedBlocks blocks;
  Rubbed& run = *blocks.run;
  ASSERT_FALSE(coupling::penetrations_small(run.phases, 60));
  blocks.solve();
  EXPECT_LT(run.pair.parts().augmentations.pressure_error(), 0.1);
  logging::clear_warnings();
  EXPECT_FALSE(coupling::penetrations_small(run.phases, 199));
  blocks.solve();
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 200));
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 60, 140)) << "passes share their augmentations";
  ASSERT_EQ(logging::warnings().size(), 1);
  EXPECT_THAT(logging::warnings()[0], ::testing::HasSubstr("% of the mean contact pressure"));

  // Apart, with the pressures of multipliers that know nothing of it.
  run.pair.update(moved(blocks, 0.8 * blocks.largest(&contact::ContactPointState::pressure) / 1e13));
  ASSERT_GT(run.pair.parts().augmentations.pressure_error(), 0.1);
  EXPECT_THROW(coupling::penetrations_small(run.phases, 200), StepRejected);
}

TEST(AugmentedLagrangian, EndsAfterSixtyTurnsWhereShorterStepsHaveFailedAndSaysSo) {
  PressedBlocks blocks;
  Rubbed& run = *blocks.run;
  ASSERT_GT(run.pair.parts().augmentations.excess(), 10);
  run.pair.parts().augmentations.allow_early_end(true);
  logging::clear_warnings();
  EXPECT_FALSE(coupling::penetrations_small(run.phases, 59));
  blocks.solve();
  ASSERT_GT(run.pair.parts().augmentations.excess(), 10);
  EXPECT_EQ(run.pair.parts().augmentations.left_penetration(), 0);
  EXPECT_TRUE(logging::warnings().empty());
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 60));
  EXPECT_GT(run.pair.parts().augmentations.left_penetration(), 0);
  ASSERT_EQ(logging::warnings().size(), 1);
  EXPECT_THAT(logging::warnings()[0], ::testing::HasSubstr("end at their last equilibrium"));
  // A further pass of the step does not raise them again, and the next step begins again.
  const std::vector<contact::ContactState> now{run.pair.state()};
  coupling::begin_contacts(run.phases, run.state.contacts, blocks.old, blocks.pass, {}, now, true);
  run.pair.update(blocks.next.displacement);
  EXPECT_TRUE(coupling::penetrations_small(run.phases, 1));
  // A scheme that iterates gives its first pass the state at t_n.
  coupling::begin_contacts(run.phases, run.state.contacts, blocks.old, blocks.pass, {}, now);
  run.pair.update(blocks.next.displacement);
  EXPECT_EQ(run.pair.parts().augmentations.left_penetration(), 0);
  EXPECT_FALSE(coupling::penetrations_small(run.phases, 1));
}

TEST(AugmentedLagrangian, DoesNotEndEarlyWithPenetrationsThatBodiesWouldFeel) {
  PressedBlocks blocks;
  Rubbed& run = *blocks.run;
  run.pair.parts().augmentations.allow_early_end(true);
  const double face = run.pair.parts().geometry.face_size();
  run.pair.update(moved(blocks, -2e-3 * face));
  EXPECT_FALSE(coupling::penetrations_small(run.phases, 60));
  EXPECT_FALSE(coupling::restore_multipliers(run.phases));
}

TEST(AugmentedLagrangian, TakesBackATurnWithoutEquilibriumWhereShorterStepsHaveFailed) {
  for (const bool allowed : {false, true}) {
    PressedBlocks blocks;
    Rubbed& run = *blocks.run;
    run.pair.parts().augmentations.allow_early_end(allowed);
    const std::vector<contact::ContactPointState> before = run.pair.state().points;
    EXPECT_FALSE(coupling::restore_multipliers(run.phases)) << "there was no augmentation";
    ASSERT_FALSE(coupling::penetrations_small(run.phases, 1));
    ASSERT_EQ(coupling::restore_multipliers(run.phases), allowed);
    run.pair.update(blocks.next.displacement);
    if (!allowed) continue;
    for (std::size_t p = 0; p < before.size(); ++p) {
      EXPECT_EQ(run.pair.state().points[p].pressure, before[p].pressure);
      EXPECT_EQ(run.pair.state().points[p].multiplier, before[p].multiplier);
    }
    EXPECT_TRUE(coupling::penetrations_small(run.phases, 2));
    EXPECT_GT(run.pair.parts().augmentations.left_penetration(), 0);
    EXPECT_FALSE(coupling::restore_multipliers(run.phases)) << "once in a step";
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
// equilibrium, or that began again in every pass, would go round.
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
  EXPECT_GE(iterations, 2) << "of the augmentations in which the multipliers grew";
  EXPECT_TRUE(take());
  EXPECT_LE(iterations, 1) << "what was found is the start of the next pass";
  EXPECT_LE(single.pair.parts().augmentations.excess(), 1);
  for (std::size_t i = 0; i < trial.contacts[0].points.size(); ++i)
    EXPECT_NEAR(trial.contacts[0].points[i].multiplier, whole.state.contacts[0].points[i].multiplier, 1e3);
  for (std::size_t i = 0; i < trial.mechanics.displacement.size(); ++i)
    EXPECT_NEAR(trial.mechanics.displacement[i], whole.state.mechanics.displacement[i], 1e-8 * 0.06);
}

}  // namespace
}  // namespace solidus
