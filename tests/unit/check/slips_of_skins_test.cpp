// Slips of first-time users in what joins a casting to its neighbours and holds it.
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A cylinder in an open mould, whose bottom and side have names of their own.
const std::string k_cylinder = R"(title = "An aluminium cylinder in a steel mould"
[analysis]
kind = "axisymmetric"
physics = "heat"
[mesh]
shape = "cylinder_in_mould"
element = "quad4"
[mesh.cylinder_in_mould]
radius = "20 mm"
height = "60 mm"
mould_wall = "20 mm"
mould_bottom = "20 mm"
mould_height = "80 mm"
element_size = "5 mm"
mould_element_size = "5 mm"
[time]
end = "10 min"
step = "1 s"
[[body]]
name = "part"
material = "aluminium_alsi7mg"
initial_temperature = "700 degC"
[[body]]
name = "mould"
material = "steel_mould"
initial_temperature = "200 degC"
[[contact]]
name = "interface"
slave = "part_surface"
master = "mould_surface"
[contact.heat]
contact_law = "power"
conductance = "2000 W/m2/K"
gap_law = "constant"
)";

TEST_F(FindingsTest, ARiserThatNothingJoinsToItsCastingIsNamed) {
  const std::string contact = k_casting + std::string(k_casting).find("[[contact]]");
  const std::string poured = changed(k_casting, "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
                                     "\"aluminium_alsi7mg\"\ninitial_temperature = \"700 degC\"");
  EXPECT_THAT(said_of(changed(poured, contact, "")),
              Contains(HasSubstr("'upper' lies on 'lower' with 33 % of its skin where nothing joins them: no "
                                 "heat passes there, and one does not feed the other")));
}

TEST_F(FindingsTest, ASideOfACastingWithoutContactIsNamed) {
  EXPECT_THAT(said_of(k_cylinder), IsEmpty());
  const std::string rules = R"([[mesh.group]]
name = "part_bottom"
owner = "part"
normal = [0, -1, 0]
)";
  EXPECT_THAT(said_of(changed(k_cylinder, "[time]", rules + "[time]")), IsEmpty());
  const std::string bottom =
      changed(changed(k_cylinder, "[time]", rules + "[time]"), "\"part_surface\"", "\"part_bottom\"");
  EXPECT_THAT(said_of(bottom), Contains(HasSubstr("'part' lies on 'mould' with ")));
  // A condition on the skin says what happens there.
  EXPECT_THAT(said_of(bottom + R"([[thermal_condition]]
name = "coating"
group = "part_surface"
kind = "film"
coefficient = "100 W/m2/K"
ambient = "200 degC"
)"),
              Not(Contains(HasSubstr("where nothing joins them"))));
}

/// Two quads, two of whose corners have a name.
const std::string k_mesh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
0 1 "corner"
0 2 "other"
2 3 "block"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
4
1 15 2 1 1 1
2 15 2 2 2 3
3 3 2 3 1 1 2 5 4
4 3 2 3 1 2 3 6 5
$EndElements
)";

TEST_F(FindingsTest, ABodyThatSupportsLetTurnIsNamed) {
  std::ofstream(folder_ / "block.msh") << k_mesh;
  const std::string held = R"(title = "A block on its corners"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
file = "block.msh"
unit = "cm"
[time]
end = "1 s"
step = "0.1 s"
[[body]]
name = "block"
material = "h13_tool_steel"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "foot"
group = "corner"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
)";
  const std::string said = "nothing keeps 'block' from turning: its supports hold a point or a line of it";
  EXPECT_THAT(said_of(held), Contains(HasSubstr(said)));
  const auto with_second = [&](const std::string& component) {
    return held +
           "[[mechanical_condition]]\nname = \"second\"\ngroup = \"other\"\nkind = \"displacement\"\n" +
           component + " = \"0 mm\"\n";
  };
  EXPECT_THAT(said_of(with_second("uy")), Not(Contains(HasSubstr(said))));
  EXPECT_THAT(said_of(with_second("ux")), Contains(HasSubstr(said))) << "along the line between the two";
}

TEST_F(FindingsTest, APressureOfSomePascalsIsNamed) {
  const auto piston = [](const std::string& pressure) {
    return deforming() +
           "[[mechanical_condition]]\nname = \"piston\"\ngroup = \"upper_y_max\"\nkind = \"pressure\"\n" +
           "pressure = \"" + pressure + "\"\n";
  };
  EXPECT_THAT(said_of(piston("10 kPa")), IsEmpty());
  EXPECT_THAT(said_of(piston("60 Pa")),
              Contains(HasSubstr("the pressure 'piston' is 60 Pa at most; is it in MPa?")));
}

TEST_F(FindingsTest, ACastingOfWhatDoesNotFreezeIsNamed) {
  const std::string sand = changed(k_casting, "aluminium_alsi7mg", "green_sand");
  EXPECT_THAT(
      said_of(sand),
      Contains(HasSubstr("the hottest body, 'upper', which starts at 700 degC, is of 'green_sand', which "
                         "does not freeze: nothing is poured")));
  const auto of_steel = [](const std::string& role) {
    return changed(changed(k_casting, "aluminium_alsi7mg", "h13_tool_steel"), "name = \"upper\"\n",
                   "name = \"upper\"\n" + role);
  };
  EXPECT_THAT(said_of(of_steel("role = \"casting\"\n")),
              Contains(HasSubstr("the casting 'upper', which starts")));
  EXPECT_THAT(said_of(of_steel("")), IsEmpty()) << "a hot block that cools on another one";
  EXPECT_THAT(
      said_of(changed(of_steel(""), "name = \"lower\"\n", "name = \"lower\"\nrole = \"mould\"\n")),
      Contains(HasSubstr("the hottest body, 'upper', which starts at 700 degC, is of 'h13_tool_steel'")));
}

TEST_F(FindingsTest, FurtherNumbersOfContactAreNamed) {
  const std::string heat = "exponent = 0\n", master = "master = \"lower_top\"\n";
  const std::string friction = "gap_law = \"constant\"\n";
  const auto wear = [&](const std::string& keys) {
    return changed(deforming(), friction,
                   friction + "[contact.friction]\ncoefficient = 0.3\n[contact.wear]\n" + keys);
  };
  EXPECT_THAT(said_of(wear("archard = 1e-5\nhardness = \"1 GPa\"\n")), IsEmpty());
  const std::vector<std::pair<std::string, std::string>> slips = {
      {changed(k_casting, heat, heat + "slave_emissivity = 0.8\n"),
       "'interface' has an emissivity of its slave alone"},
      {changed(k_casting, master, master + "touching = \"20 mm\"\n"),
       "the contact 'interface' takes gaps of up to 20 mm as closed"},
      {wear("archard = 1\nhardness = \"1 GPa\"\n"), "the coefficient of wear of 'interface' is 1"},
      {wear("archard = 1e-5\nhardness = \"1500 Pa\"\n"), "wears has a hardness of 0.0015 MPa"},
      {changed(k_casting, "\"700 degC\"", "\"973 degC\""), "starts 359 K above the liquidus"}};
  for (const auto& [text, said] : slips) EXPECT_THAT(said_of(text), Contains(HasSubstr(said)));
  EXPECT_THAT(said_of(changed(k_casting, heat, heat + "slave_emissivity = 0.8\nmaster_emissivity = 0.6\n")),
              IsEmpty());
}

}  // namespace
