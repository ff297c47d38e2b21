/// Feeding with heat alone in whole runs: a riser that pipes, a cavity behind a neck, halved elements, shots
/// and stages, restart, two processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_folder.hpp"
#include "restarted_run.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::Columns;
using solidus::testing::read_csv;
using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("feeding");

/// The rows of feeding.csv, each of which must balance.
Columns balanced(const fs::path& folder) {
  Columns table = read_csv(folder / "feeding.csv");
  for (const double defect : table.at("balance_defect[1]")) EXPECT_LT(std::abs(defect), 1e-8);
  return table;
}

Columns hot_spots(const std::string& name, const std::string& size) {
  const auto run = solidus::testing::run("cases/hot_spots", "feeding/" + name,
                                         {"mesh.constant=[{name=\"size\",value=" + size + "}]"});
  EXPECT_TRUE(run.finished) << run.reason;
  return balanced(k_here.root() / name);
}

// The riser is open and pipes; the thick place behind the neck is cut off and gets a cavity at its top. With
// half the elements both volumes change by less than 5 %.
TEST(FeedingOfHotSpots, PipesInTheRiserAndLeavesACavityBehindTheNeck) {
  const Columns coarse = hot_spots("coarse", "3"), fine = hot_spots("fine", "1.5");
  for (const char* hole : {"pipe[m3]", "cavity[m3]"}) {
    const double a = coarse.at(hole).back(), b = fine.at(hole).back();
    EXPECT_GT(b, 0) << hole;
    EXPECT_NEAR(a, b, 0.05 * b) << hole;
  }
  // 5.71 dm² of AlSi7Mg: 4.5 % of freezing, and 66 K of melt.
  const double taken = fine.at("pipe[m3]").back() + fine.at("cavity[m3]").back() +
                       fine.at("pores[m3]").back() + fine.at("sink[m3]").back() + fine.at("gas[m3]").back();
  EXPECT_NEAR(taken, fine.at("melt_contraction[m3]").back() + fine.at("freezing_contraction[m3]").back(),
              1e-9 * taken);
  const std::string summary = solidus::testing::read_text(k_here.root() / "fine" / "summary.json");
  for (const char* name : {"pipe_1_depth", "pipe_1_left", "cavity_1_volume", "feeding_defect"})
    EXPECT_THAT(summary, HasSubstr(name));
}

const std::string k_plate = R"(title = "A plate with a riser"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
upper = ["20 mm", "40 mm"]
lower_divisions = [16, 8]
upper_divisions = [8, 16]
[[body]]
name = "plate"
group = "lower"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
[[body]]
name = "riser"
group = "upper"
role = "riser"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
[[contact]]
name = "neck"
slave = "upper_bottom"
master = "lower_top"
penalty = "1e13 N/m3"
[contact.heat]
conductance = "1e5 W/m2/K"
gap_law = "constant"
[[thermal_condition]]
name = "mould"
group = "lower_x_max"
kind = "film"
coefficient = "400 W/m2/K"
ambient = "100 degC"
[[thermal_condition]]
name = "bottom"
group = "lower_y_min"
kind = "film"
coefficient = "400 W/m2/K"
ambient = "100 degC"
[[thermal_condition]]
name = "mould_of_riser"
group = "upper_x_max"
kind = "film"
coefficient = "150 W/m2/K"
ambient = "100 degC"
)";

// A die-casting that leaves its die, and the next one: each has a balance of its own, and stages go on with
// it.
TEST(FeedingOfShots, StartsAnewWithEveryCasting) {
  const std::string text = R"(title = "Shots"
stage = [
  { name = "solidify", duration = "20 s", step = "1 s" },
  { name = "cool",     duration = "20 s", step = "2 s" },
  { name = "spray",    duration = "4 s",  step = "2 s" },
]
[[cycle]]
name = "shots"
stages = ["solidify", "cool", "spray"]
repeat = 2
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "50 mm"]
upper = ["20 mm", "10 mm"]
lower_divisions = [4, 12]
upper_divisions = [4, 6]
[time]
[[body]]
name = "die"
group = "lower"
material = "steel_mould"
initial_temperature = "150 degC"
[[body]]
name = "casting"
group = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
stages = ["solidify", "cool"]
[[thermal_condition]]
name = "channels"
group = "lower_y_min"
kind = "film"
coefficient = "600 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
penalty = "1e13 N/m3"
[contact.heat]
conductance = "4000 W/m2/K"
gap_law = "constant"
)";
  ASSERT_TRUE(k_here.run("shots", text).finished);
  const Columns table = balanced(k_here.root() / "shots");
  const std::vector<double>&time = table.at("time[s]"), &pipe = table.at("pipe[m3]");
  double first = 0, second = 0, between = 1;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] <= 44) first = pipe[i];
    if (time[i] == 45) between = pipe[i];
    second = pipe[i];
  }
  EXPECT_GT(first, 1e-6);
  EXPECT_LT(between, 0.5 * first);
  EXPECT_NEAR(second, first, 0.02 * first);
}

TEST(FeedingRestart, GoesOnWithTheSameBits) {
  k_here.expect_exact_restart("plate", k_plate + "[time]\nend = \"60 s\"\nstep = \"1 s\"\nadaptive = true\n",
                              12);
  EXPECT_EQ(solidus::testing::read_text(k_here.root() / "plate_whole" / "feeding.csv"),
            solidus::testing::read_text(k_here.root() / "plate_parts" / "feeding.csv"));
  balanced(k_here.root() / "plate_whole");
}

using FeedingProcesses = solidus::testing::RestartedRun;

TEST_F(FeedingProcesses, BalanceAndAgree) {
  const std::string options = "--heat-only --set body.part.material='\"aluminium_alsi7mg\"'";
  ASSERT_EQ(run("one", options).code, 0);
  ASSERT_EQ(run("two", options, 2).code, 0);
  const Columns one = balanced(root() / "one"), two = balanced(root() / "two");
  for (const char* column : {"pipe[m3]", "sink[m3]", "cavity[m3]", "pores[m3]", "outside[m3]"}) {
    const double all = one.at("freezing_contraction[m3]").back();
    EXPECT_NEAR(one.at(column).back(), two.at(column).back(), 1e-6 * all) << column;
  }
}

TEST(FeedingKeys, ComplainAboutAGroupThatIsNone) {
  const std::string text = k_plate + "[time]\nend = \"2 s\"\nstep = \"1 s\"\n[feeding]\nvented = [\"tap\"]\n";
  EXPECT_THAT(k_here.refusal("tap", text), HasSubstr("feeding.vented: the mesh has no group 'tap'"));
}

// Without the section nothing else changes, and there is neither table nor field.
TEST(FeedingKeys, TurnItOff) {
  ASSERT_TRUE(
      k_here.run("off", k_plate + "[time]\nend = \"5 s\"\nstep = \"1 s\"\n[feeding]\nfollow = false\n")
          .finished);
  EXPECT_FALSE(fs::exists(k_here.root() / "off" / "feeding.csv"));
  ASSERT_TRUE(k_here.run("on", k_plate + "[time]\nend = \"5 s\"\nstep = \"1 s\"\n").finished);
  EXPECT_EQ(solidus::testing::read_text(k_here.root() / "off" / "history.csv"),
            solidus::testing::read_text(k_here.root() / "on" / "history.csv"));
}

}  // namespace
