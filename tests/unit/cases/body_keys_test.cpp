/// Bodies that only conduct heat and bodies that leave: their keys and what they mean for each stage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "setup/body_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/mechanics_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using test::refusal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string k_stages = R"([[stage]]
name = "pour"
duration = "1 s"
[[stage]]
name = "cool"
duration = "4 s"
[[stage]]
name = "air"
duration = "4 s"
)";

/// A part and a sand box.
/// @param sand     keys of the sand
/// @param physics  of the analysis
CaseSpec spec(const std::string& sand, const std::string& more = k_stages,
              const std::string& physics = "thermomechanical") {
  CaseSpec result = case_keys().read(parse_document(R"(title = "A part"
[analysis]
kind = "plane_strain"
physics = ")" + physics + R"("
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["10 mm", "10 mm"]
upper = ["10 mm", "10 mm"]
lower_divisions = [1, 1]
upper_divisions = [1, 1]
[time]
step = "1 s"
[[body]]
name = "part"
group = "upper"
material = "a"
initial_temperature = "900 K"
[[body]]
name = "sand"
group = "lower"
material = "b"
initial_temperature = "300 K"
)" + sand + "\n" + more,
                                                    "case.toml"));
  resolve_stages(result);
  return result;
}

std::string error(const std::string& sand, const std::string& more = k_stages,
                  const std::string& physics = "thermomechanical") {
  try {
    return refusal(spec(sand, more, physics));
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Bodies, ThatOnlyConductTakeNoPartInMechanics) {
  const CaseSpec s = spec("physics = \"heat\"", "[[stage]]\nname = \"all\"\nduration = \"9 s\"\n");
  EXPECT_THAT(refusal(s), IsEmpty());
  EXPECT_THAT(setup::mechanical_conditions(s, nullptr).absent_bodies, ElementsAre("lower"));
  EXPECT_THAT(setup::thermal_conditions(s, nullptr).absent_bodies, IsEmpty());
}

TEST(Bodies, ThatLeaveAreAbsentFromTheStageOnInWhichTheyAreNot) {
  const CaseSpec s = spec("stages = [\"pour\", \"cool\"]");
  EXPECT_THAT(refusal(s), IsEmpty());
  const std::vector<StageRun> runs = stage_runs(s);
  EXPECT_THAT(setup::thermal_conditions(s, &runs[1]).absent_bodies, IsEmpty());
  EXPECT_THAT(setup::thermal_conditions(s, &runs[2]).absent_bodies, ElementsAre("lower"));
  EXPECT_THAT(setup::mechanical_conditions(s, &runs[1]).absent_bodies, IsEmpty());
  EXPECT_THAT(setup::mechanical_conditions(s, &runs[2]).absent_bodies, ElementsAre("lower"));
}

TEST(Bodies, ThatComeBackAreNew) {
  const CaseSpec s = spec("stages = [\"pour\", \"air\"]");
  EXPECT_THAT(refusal(s), IsEmpty());
  const std::vector<StageRun> runs = stage_runs(s);
  EXPECT_THAT(setup::new_bodies(s, runs, 0), ElementsAre(0, 0));
  EXPECT_THAT(setup::new_bodies(s, runs, 1), ElementsAre(0, 0));
  EXPECT_THAT(setup::new_bodies(s, runs, 2), ElementsAre(0, 1));
  EXPECT_TRUE(runs[2].pours);
  EXPECT_EQ(runs[2].shot, 0);
  EXPECT_THAT(error("stages = [\"cool\", \"air\"]"), IsEmpty());
  EXPECT_THAT(error("stages = \"shake-out\""), HasSubstr("unknown stage 'shake-out'"));
}

TEST(Bodies, ThatLeaveInACycleMakeItsRoundsShots) {
  const std::string cycle =
      k_stages + "[[cycle]]\nname = \"all\"\nstages = [\"pour\", \"cool\"]\nrepeat = 2\n";
  const CaseSpec s = spec("stages = \"pour\"", cycle);
  EXPECT_THAT(refusal(s), IsEmpty());
  std::vector<int> shots;
  std::vector<bool> pours, begins, ends;
  for (const StageRun& run : stage_runs(s)) {
    shots.push_back(run.shot);
    pours.push_back(run.pours);
    begins.push_back(run.begins_shot);
    ends.push_back(run.ends_shot);
  }
  EXPECT_THAT(shots, ElementsAre(1, 1, 2, 2, 0));
  EXPECT_THAT(pours, ElementsAre(false, false, true, false, false));
  EXPECT_THAT(begins, ElementsAre(true, false, true, false, false));
  EXPECT_THAT(ends, ElementsAre(false, true, false, true, false));
  EXPECT_THAT(staying_bodies(s), ElementsAre(1, 0));
  EXPECT_EQ(stage_runs(spec("", cycle)).front().shot, 0);
}

TEST(Bodies, ThePeriodicStateOfACycleIsItsOwnEnd) {
  const auto refused = [](const std::string& keys,
                          const std::string& stages = "[\"pour\", \"cool\", \"air\"]",
                          const std::string& sand = "", const std::string& physics = "heat") {
    return error(sand, k_stages + "[[cycle]]\nname = \"all\"\nrepeat = 9\nstages = " + stages + "\n" + keys,
                 physics);
  };
  EXPECT_THAT(refused("periodic = \"1 K\"\n"), IsEmpty());
  EXPECT_THAT(refused("periodic = \"1 K\"\nsearch = \"repetition\"\n"), IsEmpty());
  EXPECT_THAT(refused("search = \"repetition\"\n"), HasSubstr("'search' means nothing without 'periodic'"));
  EXPECT_THAT(refused("periodic = \"0 K\"\n"), HasSubstr("periodic"));
  EXPECT_THAT(refused("periodic = \"1 K\"\nsearch = \"newton\"\n"), HasSubstr("anderson, repetition"));
  EXPECT_THAT(refused("periodic = \"1 K\"\n", "[\"pour\", \"cool\"]"), HasSubstr("but 'air' comes after it"));
  EXPECT_THAT(refused("periodic = \"1 K\"\n", "[\"pour\", \"cool\", \"air\"]", "", "mechanics"),
              HasSubstr("in an analysis without heat"));
}

TEST(Bodies, ThatOnlyConductNeedAnAnalysisThatCouples) {
  EXPECT_THAT(error("physics = \"heat\"", k_stages, "heat"),
              HasSubstr("does not couple heat with mechanics"));
  EXPECT_THAT(error("physics = \"heat\"\ninitial_velocity = [\"1 m/s\", \"0 m/s\"]"),
              HasSubstr("cannot have a velocity"));
  EXPECT_THAT(error("physics = \"sand\""), HasSubstr("all, heat"));
}

TEST(Bodies, LeaveSomethingBehind) {
  CaseSpec s = spec("physics = \"heat\"");
  s.bodies[0].stages = {"pour"};
  EXPECT_THAT(refusal(s), IsEmpty());  // a die that only conducts waits for its next casting
  s.bodies[1].stages = {"pour"};
  EXPECT_THAT(refusal(s), HasSubstr("nothing is left in the stage 'cool'"));
  s.bodies[0].physics = BodySpec::ActivePhysics::heat;
  EXPECT_THAT(refusal(s), HasSubstr("no body deforms"));
}

TEST(Bodies, LeaveInQuasiStaticsOnly) {
  EXPECT_THAT(error("stages = \"pour\"", k_stages + "[dynamics]\n"), HasSubstr("the analysis has inertia"));
}

}  // namespace
}  // namespace solidus::cases
