/// Iron in sand, on the tetrahedra that Gmsh makes: the sand stays at its temperature until the heat comes,
/// and a run says where it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "case_folder.hpp"

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const solidus::testing::CaseFolder k_here("bounds");

/// A cylinder in a block, with common nodes; flat elements in the sand.
const std::string k_cylinder = R"(
SetFactory("OpenCASCADE");
Box(1) = {-0.1, -0.1, -0.02, 0.2, 0.2, 0.12};
Cylinder(2) = {0, 0, 0, 0, 0, 0.1, 0.025};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("part") = {2};
Physical Volume("sand") = {3};
Mesh.MeshSizeMin = 0.012;
Mesh.MeshSizeMax = 0.03;
)";
const std::string k_case = R"(title = "Iron in sand"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
file = "cylinder.geo"
[time]
step = "2 s"
end = "20 s"
[[body]]
name = "part"
material = "grey_iron"
initial_temperature = "1300 degC"
[[body]]
name = "sand"
material = "green_sand"
initial_temperature = "20 degC"
[[probe]]
name = "coldest"
kind = "minimum"
field = "temperature"
group = "sand"
unit = "degC"
[[probe]]
name = "hottest"
kind = "maximum"
field = "temperature"
group = "part"
unit = "degC"
)";

class Sand : public testing::Test {
 protected:
  void SetUp() override { k_here.write("cylinder.geo", k_cylinder); }
  /// The lowest temperature of the run [degC].
  static double coldest(const std::string& name, const std::vector<std::string>& overrides) {
    const auto run = k_here.run(name, k_case, overrides);
    EXPECT_TRUE(run.finished) << run.reason;
    return *std::ranges::min_element(run.history.at("coldest[degC]"));
  }
};

TEST_F(Sand, IsNotCooledByTheHeatThatComes) {
  // Nodes on the interface start between the temperatures of both bodies.
  const auto run = k_here.run("limited", k_case);
  EXPECT_GE(*std::ranges::min_element(run.history.at("coldest[degC]")), 20 - 1e-6);
  EXPECT_LE(*std::ranges::max_element(run.history.at("hottest[degC]")), 1300 + 1e-6);
  EXPECT_THAT(solidus::logging::warnings(), Not(Contains(HasSubstr("beyond all initial and boundary"))));
}

TEST_F(Sand, ThatFallsBelowItsTemperatureIsSaidOnce) {
  EXPECT_LT(coldest("free", {"heat.bounds=false"}), 19.0);
  const auto said = std::ranges::count_if(solidus::logging::warnings(), [](const std::string& text) {
    return text.find("heat.bounds = true keeps temperatures within their range") != std::string::npos;
  });
  EXPECT_EQ(said, 1);
  EXPECT_LT(coldest("open", {"heat.integration=\"open\""}), 19.0);
  EXPECT_THAT(solidus::logging::warnings(), Contains(HasSubstr("the open rule over- and undershoots")));
}

}  // namespace
