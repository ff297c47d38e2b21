/// Temperatures that no balance of heat forbids, but that cannot follow from those at the start: two
/// insulated bodies that touch come to one temperature between theirs, and melt that is chilled gets no
/// hotter.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "case_folder.hpp"

namespace {

const solidus::testing::CaseFolder k_here("false_roots");

/// Quadratic hexahedra bulge as they cool, and heat passes where they still touch: with conductances between
/// nodes, some of them below zero, the equations of a long step had solutions far outside that range, with
/// every balance closed.
const std::string k_case = R"(title = "Two insulated blocks"
[analysis]
kind = "solid"
[mesh]
shape = "two_blocks"
element = "hex20"
[mesh.two_blocks]
lower = ["60 mm", "60 mm", "20 mm"]
lower_divisions = [2, 2, 2]
upper = ["60 mm", "60 mm", "30 mm"]
upper_divisions = [2, 2, 2]
[time]
end = "1280 s"
step = "320 s"
[coupling]
scheme = "simultaneous"
[[body]]
name = "upper"
material = "nodular_iron"
initial_temperature = "680 degC"
[[body]]
name = "lower"
material = "nodular_iron"
initial_temperature = "472 degC"
[[mechanical_condition]]
name = "table"
group = "lower_z_min"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "symmetry_x_lower"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_x_upper"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_y_lower"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "symmetry_y_upper"
group = "upper_y_min"
kind = "displacement"
uy = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.03 W/m/K"
)";

void expect_to_come_together(const std::string& name, const std::vector<std::string>& overrides) {
  const auto run = k_here.run(name, k_case, overrides);
  ASSERT_TRUE(run.finished) << run.reason;
  const auto& low = run.history.at("T_min[degC]");
  const auto& high = run.history.at("T_max[degC]");
  for (std::size_t i = 1; i < low.size(); ++i) {
    EXPECT_GE(low[i], 472) << name << ", step "
                           << i;  // 460 and 772 degC after the first step, 260 below zero
    EXPECT_LE(high[i], 680) << name << ", step " << i;  // and 1885 degC with other materials
    EXPECT_LT(high[i] - low[i], high[i - 1] - low[i - 1]) << name << ", step " << i;
  }
}

TEST(InsulatedBodies, ComeTogetherInStepsOfWhateverSize) {
  for (const std::string step : {"160 s", "320 s", "640 s"})
    expect_to_come_together("in_" + step.substr(0, 3), {"time.step=\"" + step + "\""});
}

TEST(InsulatedBodies, OfIronAndAluminiumComeTogetherToo) {
  expect_to_come_together("other",
                          {"body.upper.material=\"grey_iron\"", "body.lower.material=\"aluminium_alsi7mg\"",
                           "contact.interface.heat.conductance=\"5000 W/m2/K\""});
}

/// Heat goes through the quadratic elements of the melt, some of it from cold to hot where nothing limits it.
/// Friction below, which gives some watts, took the limit away everywhere.
const std::string k_chilled = R"(title = "Chilled from above, rubbing below"
[analysis]
kind = "axisymmetric"
[mesh]
shape = "two_blocks"
element = "tri6"
[mesh.two_blocks]
lower = ["60 mm", "20 mm"]
lower_divisions = [4, 4]
upper = ["60 mm", "36 mm"]
upper_divisions = [3, 4]
[time]
end = "0.8 s"
step = "0.2 s"
[coupling]
scheme = "simultaneous"
[[body]]
name = "upper"
material = "low_carbon_steel"
initial_temperature = "1550 degC"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "200 degC"
[[thermal_condition]]
name = "chill"
group = "upper_y_max"
kind = "temperature"
temperature = "100 degC"
[[mechanical_condition]]
name = "axis_upper"
group = "upper_x_min"
kind = "displacement"
ur = "0 mm"
[[mechanical_condition]]
name = "axis_lower"
group = "lower_x_min"
kind = "displacement"
ur = "0 mm"
[[mechanical_condition]]
name = "table"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
contact_law = "power"
gap_law = "constant"
conductance = "12 kW/m2/K"
[contact.friction]
coefficient = 0.2
)";

TEST(ChilledMelt, GetsNoHotterWhereItRubsOnItsMould) {
  const auto run = k_here.run("chilled", k_chilled);
  ASSERT_TRUE(run.finished) << run.reason;
  // Poured at 1550 °C; 1736 °C before. Limits of conduction are found again five times a step, which leaves
  // 1.04 K of a chill of 1350 K (1.04 K without structural heat too, 0.07 K by the splits); the run says so.
  EXPECT_LT(*std::ranges::max_element(run.history.at("T_max[degC]")), 1551.2);
}

/// 1737 °C in whole passes, once friction had taken the limits away, and 1885 °C in single steps of Newton's
/// method, which did not look at them.
TEST(ChilledMelt, GetsNoHotterInBlockIterations) {
  for (const std::string loop : {"nested", "single"}) {
    const auto run =
        k_here.run("block_" + loop, k_chilled,
                   {"coupling.scheme=\"block_iterative\"", "coupling.iteration.loop=\"" + loop + "\""});
    ASSERT_TRUE(run.finished) << run.reason;
    EXPECT_LT(*std::ranges::max_element(run.history.at("T_max[degC]")), 1551.2) << loop;
  }
}

/// Melt meets a cold mould through quadratic faces in steps much shorter than heat needs to cross an element.
const std::string k_first_moment = R"(title = "The first moment of a chill"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "hex20"
[mesh.two_blocks]
lower = ["21.1 mm", "21.1 mm", "5.98 mm"]
lower_divisions = [1, 2, 1]
upper = ["21.1 mm", "21.1 mm", "6.9 mm"]
upper_divisions = [1, 1, 1]
[time]
end = "0.3 s"
step = "0.06 s"
[[body]]
name = "upper"
material = "aluminium_99_7"
initial_temperature = "685 degC"
[[body]]
name = "lower"
material = "h13_tool_steel"
initial_temperature = "200 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
contact_law = "power"
gap_law = "constant"
conductance = "2 kW/m2/K"
)";

TEST(ChilledMelt, GetsNoHotterThroughQuadraticFaces) {
  for (const std::string integration : {"gauss", "segments", "nodal"}) {
    const auto run = k_here.run("first_moment_" + integration, k_first_moment,
                                {"contact.interface.integration=\"" + integration + "\""});
    ASSERT_TRUE(run.finished) << run.reason;
    // 686.5 degC before, by Gauss points.
    EXPECT_LT(*std::ranges::max_element(run.history.at("T_max[degC]")), 685 + 1e-6) << integration;
    EXPECT_GT(*std::ranges::min_element(run.history.at("T_min[degC]")), 200 - 1e-6) << integration;
  }
}

/// Two stages of second order overshoot where a step is long against the time of freezing: melt that was
/// chilled for six times as long as it needs to freeze ended 140 K below its chill.
const std::string k_long_steps = R"(title = "A plate that is chilled from above, in long steps"
[analysis]
kind = "plane_strain"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["18 mm", "17 mm"]
divisions = [3, 1]
[time]
end = "800 s"
step = "160 s"
[[body]]
name = "block"
material = "aluminium_1070"
initial_temperature = "900 degC"
[[thermal_condition]]
name = "chill"
group = "y_max"
kind = "temperature"
temperature = "100 degC"
[[mechanical_condition]]
name = "left"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "top"
group = "y_max"
kind = "displacement"
uy = "0 mm"
[coupling]
scheme = "simultaneous"
integration = "sdirk2"
)";

TEST(ChilledMelt, StaysAboveItsChillInTwoStagesOfALongStep) {
  const auto run = k_here.run("long_steps", k_long_steps);
  ASSERT_TRUE(run.finished) << run.reason;
  // What deformation cools is below a kelvin.
  EXPECT_GT(*std::ranges::min_element(run.history.at("T_min[degC]")), 99);
  EXPECT_LT(*std::ranges::max_element(run.history.at("T_max[degC]")), 901);
}

/// The thermal pass of the double pass is of second order too: in steps 25 times as long as the casting takes
/// to freeze it ended 242 K below the air that cools it.
TEST(ChilledMelt, StaysAboveItsSurroundingsInTheDoublePass) {
  const std::string film = R"([[thermal_condition]]
name = "air"
group = "y_max"
kind = "film"
coefficient = "300 W/m2/K"
ambient = "20 degC"
)";
  std::string text = k_long_steps;
  const std::size_t first = text.find("[[thermal_condition]]"), last = text.find("[[mechanical_condition]]");
  text.replace(first, last - first, film);
  const auto run = k_here.run("double_pass_long_steps", text,
                              {"coupling.scheme=\"double_pass\"", "coupling.integration=\"backward_euler\"",
                               "time.step=\"550 s\"", "time.end=\"1650 s\""});
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_GT(*std::ranges::min_element(run.history.at("T_min[degC]")), 15);
  EXPECT_LT(*std::ranges::max_element(run.history.at("T_max[degC]")), 901);
  EXPECT_LT(run.history.at("T_max[degC]").back(), 60) << "and it cools down";
}

}  // namespace
