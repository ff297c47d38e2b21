/// Stages and cycles: their keys, their times, and the conditions of each stage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/stage_input.hpp"
#include "setup/admissible.hpp"
#include "setup/heat_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/time_input.hpp"
#include "small_case.hpp"

namespace solidus::cases {
namespace {

using test::refusal;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A bar with stages.
/// @param time keys of [time]
CaseSpec spec(const std::string& more, const std::string& time = "") {
  CaseSpec result = case_keys().read(parse_document(R"(title = "A bar"
[analysis]
kind = "plane_strain"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [1, 1]
[[body]]
name = "bar"
material = "a"
initial_temperature = "600 K"
[time]
)" + time + "\n" + more,
                                                    "case.toml"));
  resolve_stages(result);
  return result;
}

std::string error(const std::string& more, const std::string& time = "") {
  try {
    return refusal(spec(more, time));
  } catch (const InputError& e) {
    return e.what();
  }
}

const std::string k_stages = R"([[stage]]
name = "heat"
duration = "4 s"
step = "2 s"
[[stage]]
name = "press"
duration = "1 s"
steps = 4
[[stage]]
name = "lift"
duration = "0.5 s"
step = "0.5 s"
[[stage]]
name = "cool"
duration = "10 s"
step = "1 s"
)";
const std::string k_cycle = R"([[cycle]]
name = "strokes"
stages = ["press", "lift"]
repeat = 3
)";

std::string condition(const std::string& more) {
  return "[[mechanical_condition]]\nname = \"tool\"\ngroup = \"y_max\"\nkind = \"displacement\"\n" + more;
}

TEST(Stages, FollowEachOtherAndCyclesComeRound) {
  const CaseSpec s = spec(k_stages + k_cycle);
  std::vector<std::string> names;
  std::vector<int> numbers, cycles;
  std::vector<double> starts;
  for (const StageRun& run : stage_runs(s)) {
    names.push_back(run.stage->name);
    numbers.push_back(run.number);
    cycles.push_back(run.cycle);
    starts.push_back(run.start);
  }
  EXPECT_THAT(names, ElementsAre("heat", "press", "lift", "press", "lift", "press", "lift", "cool"));
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 2, 3, 2, 3, 4));
  EXPECT_THAT(cycles, ElementsAre(0, 1, 1, 2, 2, 3, 3, 0));
  EXPECT_THAT(starts, ElementsAre(0, 4, 5, 5.5, 6.5, 7, 8, 8.5));
  EXPECT_EQ(s.time.end, 18.5);
  EXPECT_EQ(refusal(s), "");
}

TEST(Stages, StepsAreThoseOfTheStageOrOfTheCase) {
  const CaseSpec s = spec(k_stages + "[[stage]]\nname = \"rest\"\nduration = \"6 s\"\n", "step = \"3 s\"");
  const coupling::TimeOptions t = setup::time_options(s);
  ASSERT_EQ(t.stages.size(), 5u);
  EXPECT_EQ(t.stages[0].step.step, 2);
  EXPECT_EQ(t.stages[1].step.step, 0.25);
  EXPECT_EQ(t.stages[4].step.step, 3);
  EXPECT_EQ(t.stages[4].end, 21.5);
  EXPECT_EQ(t.end, 21.5);
}

TEST(Stages, MistakesAreNamed) {
  EXPECT_THAT(error(k_stages, "end = \"1 s\""), HasSubstr("'end' is given, but the case has stages"));
  EXPECT_THAT(error(k_stages, "steady = true"), HasSubstr("a steady analysis has no stages"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nduration = \"0 s\"\nsteps = 1\n"), HasSubstr("duration"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nduration = \"1 s\"\n"), HasSubstr("'a' has no time step"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nduration = \"1 s\"\nstep = \"1 s\"\nsteps = 1\n"),
              HasSubstr("both 'step' and 'steps'"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nduration = \"1 s\"\nstep = \"2 s\"\n"),
              HasSubstr("not longer"));
  EXPECT_THAT(error(k_stages, "min_step = \"0.3 s\""),
              HasSubstr("the step of the stage 'press', 0.25 s, is below"));
  EXPECT_THAT(error(k_stages + "[[stage]]\nname = \"cool\"\nduration = \"1 s\"\nsteps = 1\n"),
              HasSubstr("used by two [[stage]]"));
  EXPECT_THAT(error(k_cycle, "end = \"1 s\"\nstep = \"1 s\""), HasSubstr("no [[stage]]"));
}

TEST(Stages, CyclesAreStagesInARow) {
  const auto cycle = [](const std::string& stages) {
    return k_stages + "[[cycle]]\nname = \"c\"\nrepeat = 2\nstages = " + stages + "\n";
  };
  EXPECT_THAT(error(cycle("[\"press\", \"lft\"]")), HasSubstr("did you mean 'lift'"));
  EXPECT_THAT(error(cycle("[\"lift\", \"press\"]")), HasSubstr("the stage 'press' follows 'lift'"));
  EXPECT_THAT(error(cycle("[\"heat\", \"lift\"]")), HasSubstr("the stage 'lift' follows 'heat'"));
  EXPECT_THAT(error(cycle("[]")), HasSubstr("has no stages"));
  EXPECT_THAT(
      error(cycle("\"press\"") + "[[cycle]]\nname = \"d\"\nrepeat = 2\nstages = [\"press\", \"lift\"]\n"),
      HasSubstr("belongs to two cycles"));
}

TEST(Stages, ConditionsNameOnlyStagesThatThereAre) {
  const std::string held = condition("uy = \"0 mm\"\n");
  EXPECT_THAT(error(k_stages + held + "stages = [\"press\", \"sldie\"]\n"),
              HasSubstr("unknown stage 'sldie'"));
  EXPECT_EQ(error(k_stages + held + "stages = \"press\"\n"), "");
  const std::string plain = "end = \"1 s\"\nstep = \"1 s\"";
  EXPECT_THAT(error(held + "relative = true\n", plain), HasSubstr("the case has no stages"));
  EXPECT_THAT(error(held + "time = \"stage\"\n", plain), HasSubstr("the case has no stages"));
  EXPECT_THAT(error(held + "stages = [\"a\"]\n", plain), HasSubstr("unknown stage 'a'"));
}

TEST(Stages, ConditionsHoldInTheirStagesOnTheirClock) {
  const CaseSpec s =
      spec(k_stages + k_cycle +
           condition("uy = { of = \"time\", points = [[\"0 s\", \"0 mm\"], [\"1 s\", \"-2 mm\"]] }\n"
                     "stages = [\"press\"]\ntime = \"stage\"\nrelative = true\n") +
           "[[thermal_condition]]\nname = \"air\"\ngroup = \"y_max\"\nkind = \"film\"\ncoefficient = \"10 "
           "W/m2/K\"\n"
           "ambient = { of = \"time\", points = [[\"8 s\", \"0 degC\"], [\"18 s\", \"10 degC\"]] }\nstages = "
           "\"cool\"\n");
  const std::vector<StageRun> runs = stage_runs(s);
  EXPECT_TRUE(setup::mechanical_conditions(s, &runs[0]).displacements.empty());
  const mechanics::MechanicalConditions press =
      setup::mechanical_conditions(s, &runs[3]);  // the second time, 5.5 s to 6.5 s
  ASSERT_EQ(press.displacements.size(), 1u);
  EXPECT_TRUE(press.displacements[0].relative);
  EXPECT_EQ(press.displacements[0].value.value(5.5), 0);
  EXPECT_NEAR(press.displacements[0].value.value(6), -1e-3, 1e-18);
  EXPECT_EQ(press.displacements[0].value.value(6.5), -2e-3);
  EXPECT_TRUE(setup::thermal_conditions(s, &runs[3]).films.empty());
  const heat::ThermalConditions cool = setup::thermal_conditions(s, &runs[7]);
  ASSERT_EQ(cool.films.size(), 1u);
  EXPECT_NEAR(cool.films[0].ambient.value(13), 278.15, 1e-9);  // the time of the run
}

TEST(Stages, AClockEndsExactlyWithItsStage) {
  // 0.1 + 0.2 > 0.3 in binary: a table that may not be left must not be left by rounding.
  const TimeFunction f(Table({0, 0.2}, {0, 1}, Extrapolation::linear), 0.1, 0.2);
  EXPECT_EQ(f.value(0.1 + 0.2), 1);
  EXPECT_EQ(f.value(0.1), 0);
}

TEST(Stages, ASupportThatIsPutOnLaterIsNotAdmissible) {
  const auto violations = [](const std::string& more) {
    return setup::admissibility(spec(k_stages + condition("uy = \"0 mm\"\n" + more))).violations;
  };
  EXPECT_THAT(violations(""), ElementsAre());
  EXPECT_THAT(violations("stages = [\"heat\", \"press\"]\n"), ElementsAre());
  EXPECT_THAT(violations("stages = \"press\"\n"),
              ElementsAre("the support 'tool' is put on in a later stage"));
  EXPECT_THAT(violations("stages = \"press\"\nrelative = true\n"), ElementsAre());
}

TEST(Stages, ACheckpointOfOtherStagesIsRefused) {
  const CaseSpec s = spec(k_stages + k_cycle);
  const auto refused = [&](int number, const std::string& name, double start, double time) {
    try {
      check_stage_of_checkpoint(s, {number, name, start, {}}, time);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(4, "press", 5.5, 6), "");
  EXPECT_EQ(refused(4, "press", 5.5, 6.5), "");  // at its end
  EXPECT_EQ(refused(5, "lift", 6.5, 6.5), "");   // at its start, where its first step did not go through
  EXPECT_THAT(refused(4, "slide", 5.5, 6), HasSubstr("'slide'"));
  EXPECT_THAT(refused(3, "press", 5.5, 6), HasSubstr("stage 3 of the run"));
  EXPECT_THAT(refused(4, "press", 5, 6), HasSubstr("the case has stage 4 of the run, 'press' from 5.5 s on"));
  EXPECT_THAT(refused(0, "", 0, 6), HasSubstr("a run without stages"));
  EXPECT_THAT(refused(44, "press", 1000, 1001), HasSubstr("the case has no stage, for it ends at"));
}

}  // namespace
}  // namespace solidus::cases
