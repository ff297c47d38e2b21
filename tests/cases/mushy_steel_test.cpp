/// A small casting of mushy steel: fifty triangles in a mould, contact, adaptive steps and nothing set but
/// the data. It comes to its end, and it may be stopped before every try of a step.
#include <gtest/gtest.h>

#include <numeric>

#include "case_folder.hpp"

namespace {

const solidus::testing::CaseFolder k_here("mushy_steel");

/// 40 × 20 mm, open at the top; casting and mould have nodes of their own.
const std::string k_geometry = R"(lc = 0.0072;
Point(1) = {0, 0, 0, lc}; Point(2) = {0.04, 0, 0, lc};
Point(3) = {0.04, 0.02, 0, lc}; Point(4) = {0, 0.02, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, lc}; Point(12) = {0.04, 0, 0, lc};
Point(13) = {0.04, 0.02, 0, lc}; Point(14) = {0, 0.02, 0, lc};
Point(15) = {-0.02, 0.02, 0, 0.01}; Point(16) = {-0.02, -0.02, 0, 0.01};
Point(17) = {0.06, -0.02, 0, 0.01}; Point(18) = {0.06, 0.02, 0, 0.01};
Line(11) = {14, 15}; Line(12) = {15, 16}; Line(13) = {16, 17}; Line(14) = {17, 18}; Line(15) = {18, 13};
Line(16) = {13, 12}; Line(17) = {12, 11}; Line(18) = {11, 14};
Curve Loop(2) = {11:18}; Plane Surface(2) = {2};
Physical Surface("casting") = {1}; Physical Surface("mould") = {2};
Physical Curve("casting_outside") = {1, 2, 4}; Physical Curve("casting_top") = {3};
Physical Curve("mould_inside") = {16, 17, 18}; Physical Curve("mould_bottom") = {13};
Physical Curve("mould_outside") = {12, 13, 14};
)";
const std::string k_case = R"(title = "Mushy steel"
[analysis]
kind = "plane_strain"
gravity = "9.81 m/s2"
[mesh]
file = "steel.geo"
[time]
end = "600 s"
step = "1 s"
adaptive = true
[[body]]
name = "casting"
material = "low_carbon_steel"
initial_temperature = "1510 degC"
[[body]]
name = "mould"
material = "steel_mould"
initial_temperature = "200 degC"
[[mechanical_condition]]
name = "ground"
group = "mould_bottom"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[thermal_condition]]
name = "air"
group = "mould_outside"
kind = "film"
coefficient = "50 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "air_above"
group = "casting_top"
kind = "film"
coefficient = "50 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "wall"
slave = "casting_outside"
master = "mould_inside"
[contact.heat]
conductance = "1000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
)";

TEST(MushySteel, FreezesInFewIterationsAndMayBeStoppedBeforeEveryTry) {
  k_here.write("steel.geo", k_geometry);
  const std::string file = k_here.write("steel.toml", k_case);
  solidus::run::RunOptions options;
  options.folder = k_here.root() / "steel";
  int asked = 0;
  options.stop_asked = [&] {
    ++asked;
    return false;
  };
  const auto result = solidus::run::run_case(solidus::setup::load_case(file), options);
  ASSERT_TRUE(result.finished) << result.reason;
  const auto history = solidus::testing::read_csv(options.folder / "history.csv");
  EXPECT_EQ(history.at("solid_fraction[1]").back(), 1);
  EXPECT_LT(std::abs(history.at("energy_defect[J]").back()), 1e-8 * history.at("heat_exchanged[J]").back());
  const auto steps = solidus::testing::read_csv(options.folder / "steps.csv");
  const auto sum = [&](const char* column) {
    const std::vector<double>& values = steps.at(column);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  EXPECT_GE(asked, static_cast<double>(steps.at("time[s]").size()) + sum("rejected[1]"));
  EXPECT_LT(sum("mechanics_iterations[1]"), 6 * static_cast<double>(steps.at("time[s]").size()));
  EXPECT_LT(sum("rejected[1]"), 20);
}

}  // namespace
