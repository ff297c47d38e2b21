/// Sleeves that burn in whole runs: the case cases/riser_sleeve, the first law, restart, a new sleeve in
/// every shot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "case_folder.hpp"

namespace {

using solidus::testing::CaseRun;

const solidus::testing::CaseFolder k_here("sleeves");

const std::string k_title = "title = \"A casting on a slab that burns\"\n";

/// A block that burns next to a casting; insulated outside.
const std::string k_block = R"([analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "10 mm"]
lower_divisions = [4, 4]
upper = ["40 mm", "20 mm"]
upper_divisions = [4, 4]
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "lower"
role = "sleeve"
material = "insulating_sleeve"
initial_temperature = "20 degC"
@stages@
[[thermal_condition]]
name = "burning"
group = "lower"
kind = "exothermic"
heat = "200 MJ/m3"
ignition = "400 degC"
duration = "20 s"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "1000 W/m2/K"
contact_law = "power"
exponent = 0
gap_law = "constant"
)";

/// The heat of 40 x 10 mm, a metre deep [J].
constexpr double k_heat = 200e6 * 0.04 * 0.01;

/// @param stages  a line for the body that burns, or nothing
std::string block(const std::string& stages) {
  std::string text = k_block;
  return text.replace(text.find("@stages@"), 8, stages);
}

TEST(Sleeves, BringAllOfTheirHeatIntoTheFirstLaw) {
  const CaseRun run =
      k_here.run("block", k_title + block("") + "[time]\nend = \"600 s\"\nstep = \"1 s\"\nadaptive = true\n");
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(run.history.at("heat_in[J]").back(), k_heat,
              1e-9 * k_heat);  // nothing else crosses the boundary
  EXPECT_NEAR(run.history.at("stored_heat[J]").back(), k_heat, 1e-8 * k_heat);
}

TEST(Sleeves, GoOnBurningAfterARestart) {
  k_here.expect_exact_restart("restart", k_title + block("") + "[time]\nend = \"120 s\"\nstep = \"2 s\"\n",
                              12);
}

TEST(Sleeves, AreNewInEveryShot) {
  const std::string shots = R"(title = "Two slabs, one after the other"
stage = [
  { name = "pour", duration = "200 s", step = "2 s" },
  { name = "eject", duration = "4 s", step = "2 s" },
]
[[cycle]]
name = "shots"
stages = ["pour", "eject"]
repeat = 2
)";
  // The metal stays, and is hot enough for the second one too.
  const CaseRun run = k_here.run("shots", shots + block("stages = \"pour\""));
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(run.history.at("heat_in[J]").back(), 2 * k_heat, 1e-9 * k_heat);
}

TEST(Sleeves, LetARiserLiveLongerThanSandDoes) {
  double froze[3] = {0, 0, 0};
  const char* files[] = {"cases/riser_sleeve/sand.toml", "cases/riser_sleeve/insulating.toml",
                         "cases/riser_sleeve"};
  for (int k = 0; k < 3; ++k) {
    const CaseRun run = solidus::testing::run(files[k], "riser_sleeve_" + std::to_string(k));
    ASSERT_TRUE(run.finished) << run.reason;
    froze[k] = run.history.at("time[s]").back();
  }
  EXPECT_GT(froze[1], 1.1 * froze[0]);
  EXPECT_GT(froze[2], 1.02 * froze[1]);
}

}  // namespace
