// Slips in the order and the times of stages: moulds that leave too soon or come too late, skins and bodies
// that are left alone, steps, and tables on another clock.
#include <string>
#include <vector>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The casting is shaken out: its mould leaves, a film and a grate take over.
std::string shaken_out(const std::string& casting) {
  std::string text = changed(casting, "end = \"10 min\"\n", "adaptive = true\n");
  text = changed(text, "[[body]]", R"([[stage]]
name = "pour"
duration = "10 s"
[[stage]]
name = "cool"
duration = "20 min"
[[stage]]
name = "air"
duration = "2 h"
[[body]])");
  text = changed(text, "initial_temperature = \"200 degC\"",
                 "initial_temperature = \"200 degC\"\nstages = [\"pour\", \"cool\"]");
  return text + R"([[thermal_condition]]
name = "free"
group = "upper_bottom"
kind = "film"
coefficient = "20 W/m2/K"
ambient = "20 degC"
stages = "air"
)";
}

/// The same as shots in a die.
std::string shots() {
  std::string text = shaken_out(k_casting);
  text = changed(text, "initial_temperature = \"200 degC\"\nstages = [\"pour\", \"cool\"]",
                 "initial_temperature = \"200 degC\"\nrole = \"die\"");
  text = changed(text, "initial_temperature = \"700 degC\"",
                 "initial_temperature = \"700 degC\"\nstages = [\"pour\", \"cool\"]");
  text = changed(text, "duration = \"2 h\"", "duration = \"20 s\"");
  text = changed(text, "group = \"upper_bottom\"\nkind", "group = \"lower_top\"\nkind");
  return changed(text, "[[body]]", R"([[cycle]]
name = "shots"
stages = ["pour", "cool", "air"]
repeat = 5
[[body]])");
}

using LeavingTest = FindingsTest;

TEST_F(LeavingTest, StagesInOrderGiveNoFinding) {
  EXPECT_THAT(said_of(shaken_out(k_casting)), IsEmpty());
  EXPECT_THAT(said_of(shots()), IsEmpty());
}

TEST_F(LeavingTest, SlipsOfShakingOutAreNamed) {
  const std::vector<Slip> slips = {
      {"duration = \"20 min\"", "duration = \"20 s\"", "the stage 'air' frees 'upper' of 'lower' 30 s after"},
      {"name = \"pour\"", "name = \"later\"", "names an unknown stage 'pour'"},
      {"stages = [\"pour\", \"cool\"]", "stages = [\"cool\"]",
       "'lower' comes when the stage 'cool' begins, at"},
      {"\"200 degC\"\nstages = [\"pour\", \"cool\"]", "\"200 degC\"\nstages = [\"pour\", \"cool\", \"air\"]",
       "'free' lies on the surface 'upper_bottom', which the contact 'interface' cools too"},
      {"duration = \"2 h\"", "duration = \"2 h\"\nmax_step = \"3 h\"",
       "a max_step of 10800 s limits nothing"},
      {"duration = \"20 min\"", "duration = \"20 min\"\nmin_step = \"50 s\"\nstep = \"100 s\"",
       "the first step of the stage 'cool' is 100 s"},
      {"duration = \"20 min\"", "duration = \"20 min\"\nmin_step = \"15 s\"\nstep = \"15 s\"",
       "steps of 15 s at least in the stage 'cool'"},
      {"coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "ambient = \"20 degC\"\ncoefficient = { of = \"time\", points = [[\"0 s\", \"200 W/m2/K\"], "
       "[\"1 min\", \"10 W/m2/K\"]] }\nstages",
       "the table of 'free' ends at 60 s, but its stage 'air' begins at 1210 s"},
      {"coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "ambient = \"20 degC\"\ntime = \"stage\"\ncoefficient = { of = \"time\", points = [[\"1210 s\", \"200 "
       "W/m2/K\"], [\"1300 s\", \"10 W/m2/K\"]] }\nstages",
       "the table of 'free' begins at 1210 s, as the stage 'air' does in the run"},
      {"coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "ambient = \"20 degC\"\ntime = \"stage\"\ncoefficient = { of = \"time\", points = [[\"0 h\", \"200 "
       "W/m2/K\"], [\"100 h\", \"10 W/m2/K\"]] }\nstages",
       "which sees next to nothing of it"},
      {"ambient = \"20 degC\"\nstages", "ambient = \"700 degC\"\nstages",
       "the surroundings of 'free' have 700 degC, above the solidus"},
  };
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(shaken_out(k_casting), slip.what, slip.with)), Contains(HasSubstr(slip.said)))
        << slip.with;
}

TEST_F(LeavingTest, AStageOfPouringThatComesLaterIsNamed) {
  std::string text = changed(shaken_out(k_casting), "name = \"pour\"", "name = \"x\"");
  text = changed(text, "name = \"cool\"", "name = \"pour\"");
  text = changed(text, "name = \"x\"", "name = \"cool\"");
  EXPECT_THAT(said_of(text), Contains(HasSubstr("the stage 'pour' begins at 10 s, but 'upper' is poured when "
                                                "'cool' begins, at 0 s")));
}

TEST_F(LeavingTest, AFreedSkinThatNothingCoolsIsNamed) {
  const std::string other_surface =
      changed(shaken_out(k_casting), "group = \"upper_bottom\"\nkind", "group = \"upper_y_max\"\nkind");
  EXPECT_THAT(said_of(other_surface),
              Contains(HasSubstr("100 % of the skin of 'upper' that contacts cooled")));
}

TEST_F(LeavingTest, StepsOfAStageAreCounted) {
  const std::string fixed = changed(shaken_out(k_casting), "adaptive = true\n", "");
  EXPECT_THAT(said_of(changed(fixed, "duration = \"2 h\"", "duration = \"2 h\"\nstep = \"1 ms\"")),
              Contains(HasSubstr("the stage 'air' of 7200 s takes 7.2e+06 steps")));
  EXPECT_THAT(said_of(changed(fixed, "duration = \"20 min\"", "duration = \"20 min\"\nsteps = 3")),
              Contains(HasSubstr("the steps of the stage 'cool' are 400 s")));
}

TEST_F(LeavingTest, ACastingThatNothingHoldsAfterwardsIsNamed) {
  const std::string text = shaken_out(deforming());
  EXPECT_THAT(said_of(text), Contains(HasSubstr("nothing holds the body 'upper' in the stage 'air'")));
  const std::string grate = text + R"([[mechanical_condition]]
name = "grate"
group = "upper_bottom"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
stages = "air"
)";
  EXPECT_THAT(said_of(grate),
              Contains(HasSubstr("the support 'grate' begins at 1210 s, in the stage 'air', and "
                                 "pulls 'upper_bottom' of 'upper'")));
  const std::vector<std::string> relative = said_of(grate + "relative = true\n");
  EXPECT_THAT(relative, Not(Contains(HasSubstr("nothing holds"))));
  EXPECT_THAT(relative, Not(Contains(HasSubstr("pulls"))));
}

TEST_F(LeavingTest, SlipsOfShotsAreNamed) {
  const std::vector<Slip> slips = {
      {"duration = \"20 min\"", "duration = \"15 s\"", "'upper' leaves 25 s after its pour"},
      {"role = \"die\"", "role = \"die\"\nstages = [\"pour\", \"cool\"]",
       "nothing is left in the stage 'air'"},
      {"stages = [\"pour\", \"cool\"]\n", "stages = [\"cool\"]\n",
       "the stage 'pour' begins at 0 s, but 'upper' is poured when 'cool' begins"},
      {"repeat = 5", "repeat = 2\nperiodic = \"1 K\"", "looks for its periodic state in 2 rounds at most"},
      {"coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "ambient = \"20 degC\"\ncoefficient = { of = \"time\", points = [[\"1210 s\", \"2000 W/m2/K\"], "
       "[\"1230 s\", \"10 W/m2/K\"]] }\nstages",
       "the table of 'free' ends at 1230 s, in the first of 5 rounds"},
      {"coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "coefficient = \"2 W/m2/K\"\nambient = \"20 degC\"\nstages",
       "the film 'free' has 2 W/m2/K, and nothing radiates there"},
  };
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(shots(), slip.what, slip.with)), Contains(HasSubstr(slip.said))) << slip.with;
}

TEST_F(LeavingTest, ADieThatComesBackNewIsNamed) {
  std::string text = changed(shots(), "role = \"die\"", "role = \"die\"\nstages = [\"pour\", \"air\"]");
  EXPECT_THAT(said_of(text), Contains(HasSubstr("the die 'lower' leaves, and comes back new at")));
}

}  // namespace
