/// What a body takes along that leaves: its contacts, and its melt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "case_folder.hpp"
#include "run/melt_watch.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseRun;
using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("leaving_bodies");

/// A block that lies on two others, of which one leaves; all one contact.
const std::string k_two_moulds = R"(title = "Cope and drag"
stage = [ { name = "cool", duration = "1 s", steps = 1 }, { name = "air", duration = "1 s", steps = 1 } ]
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
file = "two_moulds.geo"
[time]
[[body]]
name = "part"
material = "steel_mould"
initial_temperature = "100 degC"
[[body]]
name = "cope"
material = "steel_mould"
initial_temperature = "20 degC"
stages = "cool"
[[body]]
name = "drag"
material = "steel_mould"
initial_temperature = "20 degC"
[[contact]]
name = "cavity"
slave = "part_below"
master = "moulds"
penalty = "1e12 N/m3"
[contact.heat]
conductance = "500 W/m2/K"
gap_law = "constant"
)";
const std::string k_two_moulds_geo = R"(
s = 0.01;
Point(1) = {0, 0, 0, s}; Point(2) = {0.02, 0, 0, s}; Point(3) = {0.02, 0.01, 0, s}; Point(4) = {0, 0.01, 0, s};
Point(5) = {0, -0.01, 0, s}; Point(6) = {0.01, -0.01, 0, s}; Point(7) = {0.02, -0.01, 0, s};
Point(8) = {0, 0, 0, s}; Point(9) = {0.01, 0, 0, s}; Point(10) = {0.02, 0, 0, s}; Point(11) = {0.01, 0, 0, s};
Point(12) = {0.01, -0.01, 0, s};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 9}; Line(7) = {9, 8}; Line(8) = {8, 5};
Line(9) = {12, 7}; Line(10) = {7, 10}; Line(11) = {10, 11}; Line(12) = {11, 12};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Curve Loop(3) = {9, 10, 11, 12}; Plane Surface(3) = {3};
Physical Surface("part") = {1}; Physical Surface("cope") = {2}; Physical Surface("drag") = {3};
Physical Curve("part_below") = {1}; Physical Curve("moulds") = {7, 11};
Physical Curve("cope_top") = {7}; Physical Curve("drag_top") = {11};
)";

TEST(LeavingBodies, EndTheirContactsAndNoOthers) {
  k_here.write("two_moulds.geo", k_two_moulds_geo);
  EXPECT_THAT(k_here.refusal("two_moulds", k_two_moulds),
              HasSubstr("the surface 'moulds' of the contact 'cavity' belongs to a body that has gone in the "
                        "stage 'air' and to one that stays"));
  std::string two = k_two_moulds, second = two.substr(two.find("[[contact]]"));
  two.replace(two.find("\"moulds\""), 8, "\"cope_top\"");
  second.replace(second.find("\"moulds\""), 8, "\"drag_top\"");
  second.replace(second.find("\"cavity\""), 8, "\"drag\"");
  const CaseRun r = k_here.run("two_contacts", two + second);
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_GT(at(r.history, "contact_heat[W]", 1), 1.5 * at(r.history, "contact_heat[W]", 2));
  EXPECT_GT(at(r.history, "contact_heat[W]", 2), 1);
  two.replace(two.find("penalty"), 7, "stages = \"air\"\npenalty");
  EXPECT_THAT(k_here.refusal("late_contact", two + second),
              HasSubstr("the contact 'cavity' holds in the stage 'air', but its body has gone"));
}

/// A solid part under a molten riser that is taken away as melt.
const std::string k_riser = R"(title = "A riser that leaves as melt"
stage = [
  { name = "pour", duration = "0.4 s", step = "0.1 s" },
  { name = "cool", duration = "2 s", step = "0.1 s" },
]
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
upper = ["40 mm", "20 mm"]
lower_divisions = [4, 4]
upper_divisions = [4, 4]
gap = "1 mm"
[time]
adaptive = true
[criteria]
[[body]]
name = "lower"
material = "aluminium_alsi7mg"
initial_temperature = "300 degC"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
stages = "pour"
[[thermal_condition]]
name = "air"
group = "lower_y_min"
kind = "film"
coefficient = "200 W/m2/K"
ambient = "20 degC"
)";

// The heat of a body that is removed is no change by a step.
TEST(LeavingBodies, ThatAreMeltShortenNoStep) {
  const CaseRun r = k_here.run("riser", k_riser);
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_THAT(r.steps.at("rejected[1]"), ::testing::Each(0.0));
  EXPECT_THAT(solidus::logging::warnings(), ::testing::Not(::testing::Contains(HasSubstr("steps down"))));
  EXPECT_EQ(at(r.history, "solid_fraction[1]", 0.4),
            0);  // of the melt that is poured; the other half is solid
  EXPECT_EQ(at(r.history, "solid_fraction[1]", 2.4), 1);
  const std::size_t in_pour = static_cast<std::size_t>(std::count_if(
      r.steps.at("time[s]").begin(), r.steps.at("time[s]").end(), [](double t) { return t <= 0.4; }));
  k_here.expect_exact_restart("riser_at", k_riser, static_cast<int>(in_pour));
  k_here.expect_exact_restart("riser_after", k_riser, static_cast<int>(in_pour) + 1);
}

TEST(LeavingBodies, ThatAreMeltHaveNotFrozen) {
  ASSERT_TRUE(k_here.run("riser_pools", k_riser).finished);
  const auto pools = solidus::testing::read_csv(k_here.root() / "riser_pools/pools.csv");
  ASSERT_FALSE(pools.at("frozen_at[s]").empty());
  EXPECT_THAT(pools.at("frozen_at[s]"), ::testing::Each(-1.0));
  EXPECT_EQ(pools.at("volume[m3]").back(), 0);  // the last row of the pool, in the first step without it
  EXPECT_GT(pools.at("time[s]").back(), 0.4);
  EXPECT_LT(pools.at("time[s]").back(), 0.6);
}

/// Melt on a mould that is taken away while it is liquid.
std::string melt_on_a_mould(const std::string& physics) {
  return R"(title = "A mould that leaves too soon"
stage = [
  { name = "pour", duration = "0.4 s", step = "0.1 s" },
  { name = "open", duration = "0.2 s", step = "0.1 s" },
]
[analysis]
kind = "plane_strain"
physics = ")" +
         physics + R"("
[mesh]
shape = "two_blocks"
element = "tri3"
[mesh.two_blocks]
lower = ["40 mm", "20 mm"]
upper = ["40 mm", "20 mm"]
lower_divisions = [4, 4]
upper_divisions = [4, 4]
gap = "0 mm"
[time]
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "200 degC"
stages = "pour"
[[body]]
name = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "1000 W/m2/K"
gap_law = "constant"
)";
}

TEST(LeavingBodies, MayNotLeaveMeltWithoutItsMould) {
  EXPECT_THAT(
      k_here.refusal("too_soon", melt_on_a_mould("thermomechanical")),
      HasSubstr("the stage 'open' frees body 'upper' of its contact 'interface' at t = 0.4 s, while 100 % of "
                "that skin is below coherency"));
  // Heat alone does not care where melt goes to.
  const CaseRun r = k_here.run("too_soon_heat", melt_on_a_mould("heat"));
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_THAT(solidus::logging::warnings(), ::testing::Contains(HasSubstr("the metal would run out")));
  std::string later = melt_on_a_mould("heat");
  later.replace(later.find("0.4 s"), 5, "200 s");
  later.replace(later.find("0.1 s"), 5, "5 s");
  ASSERT_TRUE(k_here.run("late_enough", later).finished);
  EXPECT_THAT(solidus::logging::warnings(), ::testing::Not(::testing::Contains(HasSubstr("would run out"))));
}

/// A block of melt on a floor, between a plane of symmetry and, with `walls`, a wall.
std::string melt_on_a_floor(bool walls) {
  const auto held = [](const char* group, const char* component) {
    return std::string("[[mechanical_condition]]\nname = \"") + group + "\"\ngroup = \"" + group +
           "\"\nkind = \"displacement\"\n" + component + " = \"0 mm\"\n";
  };
  return R"(title = "Melt on a floor"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
gravity = "9.81 m/s2"
[mesh]
shape = "block"
element = "tri3"
[mesh.block]
size = ["20 mm", "20 mm"]
divisions = [4, 4]
[time]
end = "30 s"
step = "1 s"
[[body]]
name = "block"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
)" + held("y_min", "uy") +
         held("x_min", "ux") + (walls ? held("x_max", "ux") : "");
}

TEST(LeavingBodies, MeltThatNothingHoldsRunsOutAndTheRunSaysSo) {
  k_here.run("no_wall", melt_on_a_floor(false));
  EXPECT_THAT(solidus::logging::warnings(),
              ::testing::Contains(HasSubstr("the melt of 'block' has run out: by t = ")));
  ASSERT_TRUE(k_here.run("wall", melt_on_a_floor(true)).finished);
  EXPECT_THAT(solidus::logging::warnings(), ::testing::Not(::testing::Contains(HasSubstr("has run out"))));
}

TEST(LeavingBodies, MeltThatSinksWithinTheBoxOfItsBodyHasNotRunOut) {
  // The riser of the wheel in its die, whose funnel is deeper than half its size.
  const solidus::run::MeltWatch::Box riser{{0, 45e-3, 0}, {40e-3, 110e-3, 0}};
  EXPECT_NEAR(riser.diagonal(), 76.32e-3, 1e-5);
  EXPECT_EQ(riser.distance_outside({0, 110e-3 - 44.3e-3, 0}), 0);
  EXPECT_NEAR(riser.distance_outside({43e-3, 41e-3, 0}), 5e-3, 1e-15);
}

}  // namespace
