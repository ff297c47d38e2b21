/// Stopping and going on: the same bits, and checkpoints that are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "restarted_run.hpp"

namespace {

namespace fs = std::filesystem;
using namespace solidus::testing;
using ::testing::HasSubstr;

using Restart = RestartedRun;

/// Of displacements alone: the saddle of mixed triangles does not come through this contact by iteration.
const std::string k_multigrid =
    "--set mechanics.solver='\"multigrid\"' --set mechanics.simplices='\"displacement\"'";

TEST_F(Restart, GoesOnWithTheSameBits) {
  expect_the_same("", 1);
}

TEST_F(Restart, GoesOnWithTheSameBitsWhereStepsGrow) {
  expect_the_same("--set time.adaptive=true --set output.checkpoint_every=2", 1);
}

// Rates of creep are part of what a step is measured by.
TEST_F(Restart, GoesOnWithTheSameBitsWhereStepsFollowTheErrorOfStress) {
  expect_the_same(
      "--set time.adaptive=true --set output.checkpoint_every=2 --set time.stress_error=1e-4"
      " --set body.part.material='\"aluminium_alsi7mg\"'",
      1);
}

TEST_F(Restart, GoesOnWithTheSameBitsWithMultigrid) {
  expect_the_same(k_multigrid, 1);
}

TEST_F(Restart, GoesOnWithTheSameBitsOfATwoStepMethodAndPlasticHistory) {
  expect_the_same(
      "--set mechanics.integration='\"bdf2\"' --set time.step='\"0.5 s\"'"
      " --set body.part.material='\"aluminium_99_7_plastic\"'",
      1);
}

// The last batch of eight elements has lanes to spare in both bodies.
TEST_F(Restart, GoesOnWithTheSameBitsWhateverTheNumberOfElements) {
  expect_the_same(
      "--set mesh.cylinder_in_mould.element_size='\"3.3 mm\"' --set mechanics.simplices='\"mixed\"'", 1);
  SetUp();
  expect_the_same(
      "--set mesh.element='\"quad4\"' --set mesh.cylinder_in_mould.element_size='\"3.3 mm\"'"
      " --set body.part.material='\"aluminium_99_7_plastic\"'",
      1);
}

// Velocities, accelerations, forces and stresses of t_n are part of the state.
TEST_F(Restart, GoesOnWithTheSameBitsWithInertia) {
  expect_the_same("--set dynamics.method='\"generalised_alpha\"'", 1);
}

TEST_F(Restart, GoesOnWithTheSameBitsWithInertiaInBackwardEuler) {
  expect_the_same("--set dynamics.method='\"backward_euler\"' --set dynamics.mass='\"lumped\"'", 1);
}

// From the eutectic temperature on: how much of a node is solid is in its heat content alone.
TEST_F(Restart, GoesOnWithTheSameBitsInTheMiddleOfAnIsothermalChange) {
  for (const char* rule : {"closed", "open"})
    expect_the_same(std::string("--set body.part.material='\"aluminium_alsi7mg\"'"
                                " --set body.part.initial_temperature='\"577 degC\"'"
                                " --set heat.integration='\"") +
                        rule + "\"'",
                    1);
}

// MUMPS on several processes adds in the order in which messages come: two runs never have the same bits.
TEST_F(Restart, GoesOnWithTheSameBitsOnTwoProcesses) {
  expect_the_same(k_multigrid, 2);
}

TEST_F(Restart, OnAnotherNumberOfProcessesAgreesToTheSolversTolerance) {
  const std::string strict = " --set heat.tolerance=1e-9";
  ASSERT_EQ(run("whole", strict).code, 0);
  ASSERT_EQ(run("moved", "--set time.end='\"5 s\"'" + strict).code, 0);
  const Outcome rest = run("moved", "--restart" + strict, 2);
  ASSERT_EQ(rest.code, 0) << rest.output;
  std::istringstream whole(text(root() / "whole/history.csv")), moved(text(root() / "moved/history.csv"));
  std::string a, b;
  for (std::string line; std::getline(whole, line);) a = line;
  for (std::string line; std::getline(moved, line);) b = line;
  std::istringstream cells_a(a), cells_b(b);
  for (int i = 0; i < 4; ++i) {  // the time and three temperatures, in degC
    std::getline(cells_a, a, ',');
    std::getline(cells_b, b, ',');
    EXPECT_NEAR(std::stod(a), std::stod(b), 1e-6);
  }
}

TEST_F(Restart, WithoutCheckpointIsTheUsersMistake) {
  const Outcome outcome = run("none", "--restart");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("there is no checkpoint to continue from"));
  EXPECT_FALSE(fs::exists(root() / "none"));
}

TEST_F(Restart, RefusesTheCheckpointOfAnotherCaseAndLeavesItsResults) {
  ASSERT_EQ(run("other").code, 0);
  const std::string before = text(root() / "other/history.csv");
  const Outcome outcome = run("other", "--restart --set mesh.cylinder_in_mould.element_size='\"5 mm\"'");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("of another case: its mesh is"));
  EXPECT_EQ(text(root() / "other/history.csv"), before);
}

TEST_F(Restart, RefusesACheckpointWithoutTheMotionThatInertiaNeeds) {
  ASSERT_EQ(run("still").code, 0);
  const Outcome outcome = run("still", "--restart --set dynamics.method='\"trapezoidal\"'");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("of another case: its analysis is"));
}

TEST_F(Restart, FallsBackToThePreviousCheckpointWhenTheLatestIsDamaged) {
  ASSERT_EQ(run("damaged").code, 0);
  fs::resize_file(root() / "damaged/checkpoint/state.h5", 1000);
  const Outcome outcome = run("damaged", "--restart");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("continuing from"));
}

TEST_F(Restart, APhysicsThatCannotGoOnLeavesACheckpointAndAdvice) {
  const Outcome outcome = run("stuck", "--set mechanics.max_iterations=1");
  EXPECT_EQ(outcome.code, 2);
  for (const char* phrase :
       {"could not go on", "equations: mechanics: no convergence in 1 iterations", "where: node ",
        "tried: 21 steps", "state.h5", "mechanics.max_iterations (now 1)"})
    EXPECT_THAT(outcome.output, HasSubstr(phrase));
  const Outcome rest = run("stuck", "--restart");  // the change that was advised
  EXPECT_EQ(rest.code, 0) << rest.output;
}

TEST_F(Restart, RefusesTheCheckpointOfOtherTemperaturesOrAnotherMeshOfTheSameSize) {
  ASSERT_EQ(run("other", "--set time.end='\"5 s\"'").code, 0);
  const Outcome hotter = run("other", "--restart --set body.part.initial_temperature='\"690 degC\"'");
  EXPECT_EQ(hotter.code, 1);
  EXPECT_THAT(hotter.output, HasSubstr("its initial temperature is"));
  const Outcome taller = run("other", "--restart --set mesh.cylinder_in_mould.interface_ratio=1.2");
  EXPECT_EQ(taller.code, 1);
  EXPECT_THAT(taller.output, HasSubstr("its mesh is"));
}

TEST_F(Restart, EqualRunsLeaveEqualCheckpoints) {
  ASSERT_EQ(run("one").code, 0);
  ASSERT_EQ(run("two").code, 0);
  EXPECT_TRUE(text(root() / "one/checkpoint/state.h5") == text(root() / "two/checkpoint/state.h5"));
}

// One flipped bit anywhere: the file is not taken, the one before is.
TEST_F(Restart, NoFlippedBitOfACheckpointIsAccepted) {
  ASSERT_EQ(run("whole").code, 0);
  ASSERT_EQ(run("longer", "--set time.end='\"11 s\"'").code, 0);
  const fs::path state = root() / "whole/checkpoint/state.h5",
                 previous = root() / "whole/checkpoint/previous.h5";
  const std::string good = text(state), before = text(previous);
  unsigned place = 12345;
  for (int i = 0; i < from_environment("SOLIDUS_FLIPPED_RUNS", 6); ++i) {
    place = place * 1664525u + 1013904223u;
    std::string bad = good;
    const std::size_t at = place % bad.size();
    bad[at] = static_cast<char>(bad[at] ^ (1 << (i % 8)));
    std::ofstream(state, std::ios::binary) << bad;
    std::ofstream(previous, std::ios::binary) << before;
    const Outcome outcome = run("whole", "--restart --set time.end='\"11 s\"'");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("is damaged")) << at;
    EXPECT_THAT(outcome.output, HasSubstr("continuing from")) << at;
    EXPECT_EQ(text(root() / "whole/history.csv"), text(root() / "longer/history.csv")) << at;
  }
}

}  // namespace
