/// Heat through an interface whose conductance follows the pressure: where forces are rounding, so are the
/// pressures, and the heat out of balance does not fall below what they make of it.
#include <gtest/gtest.h>

#include <string>

#include "case_folder.hpp"

namespace {

const solidus::testing::CaseFolder k_here("rounding_of_heat");

/// Steel in its mould for two steps, by the simultaneous scheme in two stages with tolerances that rounding
/// does not allow: the melt presses with its weight alone.
const std::string k_case = R"(title = "Melt on spots of contact"
[analysis]
kind = "axisymmetric"
gravity = "9.81 m/s2"
[mesh]
shape = "cylinder_in_mould"
element = "tri3"
[mesh.cylinder_in_mould]
radius = "21.1 mm"
height = "42.2 mm"
mould_wall = "21.1 mm"
mould_bottom = "14.8 mm"
mould_height = "57 mm"
element_size = "7.03 mm"
mould_element_size = "10.55 mm"
[time]
end = "4 ms"
step = "2 ms"
[[body]]
name = "part"
material = "low_carbon_steel"
initial_temperature = "1614 degC"
[[body]]
name = "mould"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "floor"
group = "mould_bottom"
kind = "displacement"
uy = "0 mm"
[[contact]]
name = "interface"
slave = "part_surface"
master = "mould_surface"
formulation = "large_sliding"
smoothing = false
integration = "gauss"
normal = "augmented_lagrangian"
wet = false
[contact.heat]
contact_law = "spots"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
hardness = "300 MPa"
[contact.heat.asperities]
roughness = "3 um"
slope = 0.15
conductivity = "40 W/m/K"
hardness_coefficient = "3 GPa"
hardness_exponent = -0.2
[contact.friction]
coefficient = 0.2
[heat]
tolerance = 1e-11
[mechanics]
tolerance = 1e-9
b_bar = false
[coupling]
scheme = "simultaneous"
integration = "sdirk2"
)";

TEST(SimultaneousScheme, TakesHeatThatIsRoundingOfTheDisplacementsForBalanced) {
  const auto run = k_here.run("spots", k_case, {});
  ASSERT_TRUE(run.finished) << run.reason;
  // 18 steps were cut, and those that were taken had up to 75 iterations.
  EXPECT_EQ(run.history.at("time[s]").size(), 3u);
  EXPECT_LT(run.history.at("T_max[degC]").back(), 1614.1);
}

}  // namespace
