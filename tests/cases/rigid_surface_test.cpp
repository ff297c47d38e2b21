/// Rigid surfaces in whole runs: a cylinder pressed into a block against Hertz, a turning cylinder.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "case_folder.hpp"

namespace {

namespace fs = std::filesystem;
using solidus::testing::CaseRun;

/// An elastic block under a cylinder of 100 mm, which is pressed by 0.02 mm.
const std::string k_press = R"(title = "A rigid cylinder on a block"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
origin = ["-10 mm", "0 mm"]
divisions = [160, 80]
[time]
end = "1 s"
step = "0.25 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "20 degC"
[mechanics]
solver = "direct"  # which keeps symmetry to rounding
[[mechanical_condition]]
name = "ground"
group = "y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[rigid_surface]]
name = "tool"
shape = "cylinder"
point = ["0 mm", "110 mm"]
radius = "100 mm"
uy = { of = "time", points = [["0 s", "0 mm"], ["1 s", "-0.02 mm"]] }
[[probe]]
name = "peak"
kind = "point"
field = "contact_pressure"
point = ["0 mm", "10 mm"]
unit = "MPa"
[[contact]]
name = "press"
slave = "y_max"
master = "tool"
formulation = "large_sliding"
search_distance = "1 mm"
)";

const std::string k_coarse = "mesh.block.divisions=[80, 40]";

const solidus::testing::CaseFolder k_here("rigid_surface");

TEST(RigidSurface, ACylinderPressedIntoABlockHasThePressureOfHertz) {
  const CaseRun r = k_here.run("press", k_press);
  ASSERT_TRUE(r.finished) << r.reason;
  const double force = r.history.at("press_force_y[N]").back();
  constexpr double k_star = 196e9 / (1 - 0.3 * 0.3), k_radius = 0.1;
  // Nine elements in the half width, which is an eleventh of the block's: 1.5 %.
  EXPECT_NEAR(r.history.at("peak[MPa]").back() * 1e6,
              std::sqrt(force * k_star / (std::numbers::pi * k_radius)),
              0.03 * r.history.at("peak[MPa]").back() * 1e6);
  EXPECT_GT(force, 1e6);
  EXPECT_NEAR(r.history.at("press_force_x[N]").back(), 0, 1e-9 * force);
  // The force grows with the approach.
  for (std::size_t i = 1; i < r.history.at("press_force_y[N]").size(); ++i)
    EXPECT_GT(r.history.at("press_force_y[N]")[i], r.history.at("press_force_y[N]")[i - 1]);
}

TEST(RigidSurface, ItsWorkIsInTheFirstLaw) {
  const CaseRun r = k_here.run("first_law", k_press, {"analysis.physics=thermomechanical", k_coarse});
  ASSERT_TRUE(r.finished) << r.reason;
  const double work = r.history.at("work[J]").back();
  EXPECT_GT(work, 10);
  // The defect is the residual of the iterations; without the tool's work all of that work would be missing.
  EXPECT_NEAR(r.history.at("energy_defect[J]").back(), 0, 1e-3 * work);
}

const std::string k_friction = k_press + "[contact.friction]\ncoefficient = 0.1\n";
const std::vector<std::string> k_turn = {"time.end=2 s", k_coarse,
                                         "rigid_surface.tool.rotation={ of = \"time\", points = [[\"1 s\", "
                                         "\"0 degree\"], [\"2 s\", \"0.1 degree\"]] }"};

TEST(RigidSurface, ThatTurnsDragsTheBodyByFriction) {
  const CaseRun r = k_here.run("turn", k_friction, k_turn);
  ASSERT_TRUE(r.finished) << r.reason;
  // The block's side of the tool moves along +x: the tool feels -x. Every point slips.
  const double normal = r.history.at("press_force_y[N]").back();
  EXPECT_NEAR(r.history.at("press_force_x[N]").back(), -0.1 * normal, 0.01 * 0.1 * normal);
  EXPECT_EQ(r.history.at("press_sticking_fraction[1]").back(), 0);
}

TEST(RigidSurface, ARunGoesOnWithTheSameBits) {
  k_here.expect_exact_restart("again", k_friction, 5, k_turn);
  EXPECT_EQ(solidus::testing::read_csv(k_here.root() / "again_whole/history.csv").at("time[s]").size(), 9u);
}

}  // namespace
