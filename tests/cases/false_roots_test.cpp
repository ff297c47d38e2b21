/// Two insulated bodies that touch can only come to one temperature between theirs.
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

}  // namespace
