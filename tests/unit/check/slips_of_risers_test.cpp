// Slips in what belongs together in a casting: a hub round its axis with riser, core and chill in sand.
#include <string>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* k_hub = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {30,0,0, 30,80};
Rectangle(2) = {60,0,0, 50,25};
BooleanUnion(3) = {Surface{1}; Delete;}{Surface{2}; Delete;};
Rectangle(4) = {30,80,0, 28,50};
q() = BooleanFragments{Surface{3}; Delete;}{Surface{4}; Delete;};
Rectangle(5) = {0,-20,0, 30,150};
Rectangle(6) = {75,-15,0, 30,15};
Rectangle(10) = {0,-70,0, 170,200};
c() = Translate{0,0,0}{Duplicata{Surface{3,4,5,6};}};
m() = BooleanDifference{Surface{10}; Delete;}{Surface{c()}; Delete;};
Physical Surface("casting") = {3};
Physical Surface("riser") = {4};
Physical Surface("core") = {5};
Physical Surface("chill") = {6};
Physical Surface("mould") = m();
rt() = Curve In BoundingBox{29.9,129.9,-1, 58.1,130.1,1};
Physical Curve("riser_top") = rt();
MeshSize{ PointsOf{Surface{m()};} } = 14;
MeshSize{ PointsOf{Surface{3,4,5,6};} } = 7;
)";

constexpr const char* k_hub_case = R"(title = "A hub of nodular iron in green sand"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
gravity = "9.81 m/s2"
[mesh]
file = "hub.geo"
unit = "mm"
[time]
until = "solid"
end = "2 h"
step = "1 s"
adaptive = true
[[body]]
name = "casting"
group = "casting"
material = "nodular_iron"
initial_temperature = "1340 degC"
[[body]]
name = "riser"
group = "riser"
role = "riser"
material = "nodular_iron"
initial_temperature = "1340 degC"
[[body]]
name = "core"
group = "core"
role = "core"
material = "chromite_sand"
initial_temperature = "20 degC"
physics = "heat"
[[body]]
name = "chill"
group = "chill"
role = "chill"
material = "iron_chill"
initial_temperature = "20 degC"
physics = "heat"
[[body]]
name = "mould"
group = "mould"
role = "mould"
material = "green_sand"
initial_temperature = "20 degC"
physics = "heat"
[[interface]]
bodies = "all"
[[thermal_condition]]
name = "air"
group = "riser_top"
kind = "film"
coefficient = "15 W/m2/K"
ambient = "20 degC"
[criteria]
feeders = ["riser"]
)";

/// The hub with two groups exchanged.
std::string swapped(const std::string& a, const std::string& b) {
  const std::string group = "group = \"";
  return changed(changed(changed(k_hub_case, group + a + "\"\n", group + "?\"\n"), group + b + "\"\n",
                         group + a + "\"\n"),
                 group + "?\"\n", group + b + "\"\n");
}

class HubTest : public FindingsTest {
 protected:
  void SetUp() override {
    FindingsTest::SetUp();
    mesh(k_hub);
  }
  void mesh(const std::string& geometry) const { std::ofstream(folder_ / "hub.geo") << geometry; }
};

TEST_F(HubTest, HasNoFinding) {
  EXPECT_THAT(said_of(k_hub_case), IsEmpty());
}

TEST_F(HubTest, SwappedGroupsAreNamed) {
  EXPECT_THAT(
      said_of(swapped("core", "chill")),
      Contains(HasSubstr("the core 'core' lies outside what is poured, and the chill 'chill' within it")));
  EXPECT_THAT(
      said_of(swapped("casting", "riser")),
      Contains(HasSubstr("what is poured as riser ('riser') is 3.5 times as large as what it feeds")));
}

TEST_F(HubTest, ARiserThatFreezesFirstIsNamed) {
  mesh(changed(k_hub, "30,80,0, 28,50", "30,80,0, 6,50"));
  EXPECT_THAT(said_of(k_hub_case), Contains(HasSubstr("the riser 'riser' freezes in some")));
}

TEST_F(HubTest, ACoreAsHotAsMeltAndMeltThatDoesNotDeformAreNamed) {
  const std::string core = "material = \"chromite_sand\"\ninitial_temperature = \"";
  EXPECT_THAT(
      said_of(changed(k_hub_case, core + "20 degC", core + "1340 degC")),
      Contains(HasSubstr("the body 'core' starts at 1340 degC, above the liquidus of what is poured, 1150")));
  const std::string melt = "material = \"nodular_iron\"\n";
  EXPECT_THAT(
      said_of(changed(k_hub_case, melt, melt + "physics = \"heat\"\n")),
      Contains(HasSubstr("'casting' only conducts heat, but 'riser', with which it is poured, deforms")));
}

TEST_F(HubTest, ARiserThatStandsApartIsNamed) {
  // Five millimetres above its casting, with the sand of the mould between.
  mesh(changed(k_hub, "Rectangle(4) = {30,80,0, 28,50};", "Rectangle(4) = {30,85,0, 28,45};"));
  EXPECT_THAT(
      said_of(k_hub_case),
      Contains(HasSubstr("the riser 'riser' touches no other body that is poured: it feeds nothing")));
}

TEST_F(HubTest, AnOpenRiserThatNothingCoolsIsNamed) {
  const std::string all = k_hub_case;
  const std::size_t film = all.find("[[thermal_condition]]"), end = all.find("[criteria]");
  const std::vector<std::string> bare = said_of(all.substr(0, film) + all.substr(end));
  EXPECT_THAT(bare, Contains(HasSubstr("of the skin of the riser 'riser' face up and have neither")));
}

TEST_F(HubTest, ARiserThatLiesOnItsSideIsNamed) {
  const std::string plane = changed(k_hub_case, "\"axisymmetric\"", "\"plane_strain\"");
  EXPECT_THAT(said_of(plane), Not(Contains(HasSubstr("is closed on top and open at its side"))));
  EXPECT_THAT(said_of(changed(plane, "gravity = \"9.81 m/s2\"",
                              "gravity = \"9.81 m/s2\"\ngravity_direction = [1, 0]")),
              Contains(HasSubstr("the riser 'riser' is closed on top and open at its side")));
}

TEST_F(HubTest, SandAsHotAsAShellAndAChillInKelvinsAreNamed) {
  const auto start = [](const std::string& material, const std::string& temperature) {
    const std::string at = "\"" + material + "\"\ninitial_temperature = \"";
    return changed(k_hub_case, at + "20 degC", at + temperature);
  };
  EXPECT_THAT(said_of(start("green_sand", "800 degC")),
              Contains(HasSubstr("the body 'mould' of 'green_sand' starts at 800 degC")));
  EXPECT_THAT(said_of(start("green_sand", "150 degC")), IsEmpty());
  for (const char* kelvins : {"473 degC", "473.15 degC"})
    EXPECT_THAT(said_of(start("iron_chill", kelvins)), Contains(HasSubstr("is it in K? 473")));
  EXPECT_THAT(said_of(start("iron_chill", "480 degC")), Not(Contains(HasSubstr("is it in K?"))));
}

TEST_F(HubTest, ARiserBelowItsCastingIsNamed) {
  const std::string unnamed = changed(k_hub_case, "feeders = [\"riser\"]", "follow = true");
  const std::string said = "the riser 'riser' ends below the middle of 'casting', as gravity acts";
  EXPECT_THAT(said_of(unnamed), IsEmpty());
  EXPECT_THAT(said_of(changed(unnamed, "gravity = \"9.81 m/s2\"",
                              "gravity = \"9.81 m/s2\"\ngravity_direction = [0, 1]")),
              Contains(HasSubstr(said)));
}

TEST_F(HubTest, AMouldOfWashWallsOfMetresAndSandHeldColdAreNamed) {
  EXPECT_THAT(said_of(changed(k_hub_case, "\"green_sand\"", "\"mould_wash\"")),
              Contains(HasSubstr("the body 'mould' is of 'mould_wash' and")));
  // Heat comes through 10 mm of sand next to the flange, and not through 60 mm.
  const std::string cold =
      "[[thermal_condition]]\nname = \"floor\"\ngroup = \"wall\"\nkind = \"temperature\"\n"
      "temperature = \"20 degC\"\n";
  const auto wall = [](const std::string& box) {
    return changed(k_hub, "MeshSize{ PointsOf{Surface{m()};} }",
                   "w() = Curve In BoundingBox{" + box +
                       "};\nPhysical Curve(\"wall\") = w();\n"
                       "MeshSize{ PointsOf{Surface{m()};} }");
  };
  mesh(wall("169.9,-70.1,-1, 170.1,130.1,1"));
  const std::string held = changed(k_hub_case, "[criteria]", cold + "[criteria]");
  EXPECT_THAT(said_of(held), IsEmpty());
  mesh(changed(wall("119.9,-70.1,-1, 120.1,130.1,1"), "170,200", "120,200"));
  EXPECT_THAT(said_of(held), Contains(HasSubstr("'floor' holds 'mould' at 20 degC, 10 mm from the melt")));
  mesh(changed(changed(k_hub, "170,200", "1700,200"), "} = 14", "} = 60"));
  EXPECT_THAT(said_of(k_hub_case),
              Contains(HasSubstr("the body 'mould' reaches 1.59 m beyond what is poured, "
                                 "which is 0.13 m large")));
}

TEST_F(HubTest, PressuresOfADieInSandAreNamed) {
  const auto pressed = [](const std::string& pressure) {
    return std::string(k_hub_case) +
           "[[mechanical_condition]]\nname = \"piston\"\ngroup = \"riser_top\"\n"
           "kind = \"pressure\"\npressure = \"" +
           pressure + "\"\n";
  };
  EXPECT_THAT(said_of(pressed("0.5 bar")), IsEmpty());
  EXPECT_THAT(said_of(pressed("1 MPa")), Contains(HasSubstr("'piston' presses 'riser' with 1 MPa")));
  EXPECT_THAT(said_of(pressed("1000 bar")), Contains(HasSubstr("'piston' presses 'riser' with 100 MPa")));
}

TEST_F(FindingsTest, AMeltThatPressureHoldsUpFromBelowIsNotOpenBelow) {
  const std::string low =
      changed(deforming(), "gravity = \"9.81 m/s2\"", "gravity = \"9.81 m/s2\"\ngravity_direction = [0, 1]");
  EXPECT_THAT(said_of(low), Contains(HasSubstr("the melt is open below")));
  EXPECT_THAT(said_of(low + "[[mechanical_condition]]\nname = \"furnace\"\ngroup = \"upper_y_max\"\n"
                            "kind = \"pressure\"\npressure = \"20 kPa\"\n"),
              Not(Contains(HasSubstr("the melt is open below"))));
}

}  // namespace
