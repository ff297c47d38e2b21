/// Wear, fatigue and soldering of a die that deforms, through whole runs of shots.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::CaseRun;
using solidus::testing::Columns;
using solidus::testing::read_text;

const solidus::testing::CaseFolder k_here("die_limits");

/// A casting that a piston presses on a die, once it is solid, while it shrinks along it: the die, the master
/// of the contact, wears by it.
const std::string k_shots = R"(title = "A die that wears"
stage = [
  { name = "pour",     duration = "2 s",  step = "0.5 s" },
  { name = "solidify", duration = "10 s", step = "2 s" },
  { name = "press",    duration = "6 s",  step = "2 s" },
  { name = "spray",    duration = "6 s",  step = "1 s" },
]
[[cycle]]
name = "shots"
stages = ["pour", "solidify", "press", "spray"]
repeat = 3
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "50 mm"]
upper = ["20 mm", "5 mm"]
lower_divisions = [4, 8]
upper_divisions = [4, 2]
[time]
[[body]]
name = "die"
group = "lower"
material = "h13_tool_steel"
initial_temperature = "200 degC"
[[body]]
name = "casting"
group = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "640 degC"
stages = ["pour", "solidify", "press"]
[[thermal_condition]]
name = "channels"
group = "lower_y_min"
kind = "film"
coefficient = "600 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "spray"
group = "lower_top"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "25 degC"
stages = "spray"
[[mechanical_condition]]
name = "ground"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "axis"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "axis_of_casting"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "piston"
group = "upper_y_max"
kind = "pressure"
pressure = "5 MPa"
stages = "press"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "4000 W/m2/K"
gap_law = "constant"
[contact.friction]
coefficient = 0.2
tangential_penalty_factor = 0.1
[contact.wear]
archard = 1e-4
hardness = "1 GPa"
master_share = 1
[[die_life]]
body = "lower"
worn_depth = "0.1 mm"
soldering_temperature = "300 degC"
law = "table"
cycles = { of = "strain", argument_unit = "1", unit = "1", points = [[0.0005, 1e6], [0.01, 1e3]] }
[[probe]]
name = "worn"
kind = "maximum"
field = "wear_depth"
group = "lower_top"
unit = "um"
[[probe]]
name = "last_wear"
kind = "maximum"
field = "shot_wear"
group = "lower_top"
unit = "um"
[[probe]]
name = "last_range"
kind = "maximum"
field = "shot_strain_range"
group = "lower_top"
unit = "%"
)";

/// A number of summary.json.
double summary(const std::string& name, const std::string& key) {
  const std::string text = read_text(k_here.root() / name / "summary.json");
  const std::size_t found = text.find("\"" + key + "\":");
  return found == std::string::npos ? NAN : std::strtod(text.c_str() + found + key.size() + 3, nullptr);
}

/// Rows of the history at which the pour, the press or the spray (`of` = 0, 1, 2) of the shot `shot` ended.
std::size_t row(std::size_t shot, std::size_t of) {
  const std::vector<std::size_t> steps = {4, 12, 18};
  return (shot - 1) * 18 + steps[of];
}

TEST(DieLimits, AShotWearsWhatTheFieldOfWearAddsInIt) {
  const CaseRun r = k_here.run("wear", k_shots);
  ASSERT_TRUE(r.finished) << r.reason;
  const Columns& h = r.history;
  const std::vector<double>&worn = h.at("worn[um]"), &last = h.at("last_wear[um]");
  ASSERT_EQ(worn.size(), 1u + 3 * 18);
  // The die keeps its wear, each shot adds some.
  EXPECT_GT(worn[row(1, 1)], 1e-6);
  EXPECT_EQ(worn[row(1, 1)], worn[row(1, 2)]);
  EXPECT_GT(worn[row(2, 1)], 1.5 * worn[row(1, 1)]);
  // All is worn at the same place, the outer edge, so that the largest depths can be subtracted.
  const double second = worn[row(2, 2)] - worn[row(1, 2)], third = worn[row(3, 2)] - worn[row(2, 2)];
  EXPECT_NEAR(last[row(1, 2)], worn[row(1, 2)], 1e-9 * worn[row(1, 2)]);
  EXPECT_NEAR(last[row(3, 2)], std::max(second, third), 1e-6 * third);
  // Within a shot that has not worn as much yet, the shot before it counts.
  EXPECT_NEAR(last[row(2, 0)], worn[row(1, 2)], 1e-6 * worn[row(1, 2)]);
  const double depth = summary("wear", "shot_wear_max[m]"), life = summary("wear", "shots_until_worn_min");
  EXPECT_NEAR(1e6 * depth, last.back(), 1e-9 * last.back());
  EXPECT_NEAR(life, 1e-4 / depth, 1e-9 * life);
  EXPECT_GT(summary("wear", "soldering_time_max[s]"), 0.5);
  EXPECT_LT(summary("wear", "soldering_time_max[s]"), 24);  // a shot
}

// The strain of a die that deforms is followed through whole shots, and that of the last one counts while the
// present one is milder.
TEST(DieLimits, TheStrainRangeOfADeformingDieIsThatOfTheLastWholeShot) {
  const CaseRun r = k_here.run("strain", k_shots);
  ASSERT_TRUE(r.finished) << r.reason;
  const std::vector<double>& range = r.history.at("last_range[%]");
  EXPECT_GT(range[row(1, 2)], 0.01);
  EXPECT_LT(range[row(1, 2)], 1);
  EXPECT_EQ(range[row(2, 0) - 3], range[row(1, 2)]);
}

TEST(DieLimits, ARunGoesOnWithTheSameBits) {
  k_here.expect_exact_restart("restart", k_shots, 18 + 7);
}

TEST(DieLimits, WhatCannotBeFollowedIsRefused) {
  const auto without = [](const std::string& from, const std::string& to) {
    std::string text = k_shots;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::string no_wear = k_here.refusal(
      "no_wear", without("[contact.wear]\narchard = 1e-4\nhardness = \"1 GPa\"\nmaster_share = 1\n", ""));
  EXPECT_NE(no_wear.find("no contact wears this body"), std::string::npos) << no_wear;
  const std::string slave = k_here.refusal("slave", without("master_share = 1", "master_share = 0"));
  EXPECT_NE(slave.find("no contact wears this body"), std::string::npos) << slave;
}

}  // namespace
