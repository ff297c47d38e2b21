/// Results of whole runs: of a steady state, of surfaces that are covered in part, of tables with names that
/// are taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../unit/results/vtu_reader.hpp"
#include "case_folder.hpp"

namespace {

using ::testing::HasSubstr;

const solidus::testing::CaseFolder k_here("results");

/// Held at 100 °C on the left, with a film on the right: 2 kW/(m² K) of metal in a row with 2 kW/(m² K) of
/// film.
const std::string k_wall = R"(title = "A wall"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
divisions = [4, 2]
[time]
steady = true
[[body]]
name = "wall"
group = "block"
material = "metal.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "hot"
group = "x_min"
kind = "temperature"
temperature = "100 degC"
[[thermal_condition]]
name = "cold"
group = "x_max"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "20 degC"
)";
const std::string k_metal = R"(title = "A metal"
[density]
value = "7800 kg/m3"
[conductivity]
value = "40 W/m/K"
[specific_heat]
value = "500 J/kg/K"
)";

TEST(SteadyRun, WritesItsSolutionAndWhatFlows) {
  k_here.write("metal.toml", k_metal);
  const auto run = k_here.run("wall", k_wall);
  ASSERT_TRUE(run.finished) << run.reason;
  const auto folder = k_here.root() / "wall";
  const std::string list = solidus::testing::read_text(folder / "fields.pvd");
  EXPECT_THAT(list, HasSubstr("fields_00000.vtu"));
  EXPECT_EQ(list.find("fields_00001"), std::string::npos);
  const auto values = solidus::test::VtuFile(folder / "fields/fields_00000.vtu").array<double>("temperature");
  EXPECT_NEAR(*std::ranges::max_element(values), 373.15, 1e-6);
  EXPECT_NEAR(*std::ranges::min_element(values), 333.15, 1e-6);
  // 80 kW/m² through 10 mm of a metre's thickness, in the joules of one second; what comes in goes out.
  EXPECT_NEAR(run.history.at("heat_exchanged[J]").back(), 800, 1e-3);
  EXPECT_NEAR(run.history.at("heat_in[J]").back(), 0, 1e-5);
  EXPECT_NEAR(run.history.at("energy_defect[J]").back(), -run.history.at("heat_in[J]").back(), 1e-9);
}

/// A block of 40 mm on one of 60 mm.
const std::string k_ledge = R"(title = "A block on a ledge"
[analysis]
kind = "plane_strain"
physics = "mechanics"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "10 mm"]
upper = ["45 mm", "5 mm"]
lower_divisions = [6, 2]
upper_divisions = [9, 1]
[time]
end = "1 s"
step = "1 s"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "20 degC"
[[body]]
name = "upper"
material = "steel_mould"
initial_temperature = "20 degC"
[[mechanical_condition]]
name = "held"
group = "lower"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "pushed"
group = "upper"
kind = "displacement"
ux = "0 mm"
uy = "-0.01 mm"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
[[probe]]
name = "on_slave"
kind = "integral"
field = "contact_pressure"
group = "upper_bottom"
unit = "N"
[[probe]]
name = "on_master"
kind = "integral"
field = "contact_pressure"
group = "lower_top"
unit = "N"
)";

// 45 mm cover four and a half of six faces: the nodes at the rim of the contact show its pressure, for half
// of their surface and less.
TEST(ContactPressure, IntegratesToTheForceOnASurfaceThatIsCoveredInPart) {
  const auto run = k_here.run("ledge", k_ledge);
  ASSERT_TRUE(run.finished) << run.reason;
  const double force = run.history.at("faces_normal_force[N]").back();
  EXPECT_GT(force, 1e3);
  EXPECT_NEAR(run.history.at("on_slave[N]").back(), force, 1e-9 * force);
  EXPECT_NEAR(run.history.at("on_master[N]").back(), force, 1e-9 * force);
}

TEST(InternalVariable, IsALengthWhereItIsASlip) {
  const std::string friction = R"([contact.friction]
coefficient = 0.2
internal_variable = "%"
)";
  const auto probe = [](const std::string& unit) {
    return "[[probe]]\nname = \"z\"\nkind = \"maximum\"\nfield = \"internal_variable\"\ngroup = "
           "\"upper_bottom\"\nunit = \"" +
           unit + "\"\n";
  };
  const auto with = [&](const char* variable, const std::string& unit) {
    std::string text = k_ledge;
    std::string law = friction;
    law.replace(law.find('%'), 1, variable);
    text.insert(text.find("[[probe]]"), law);
    return k_here.run("internal", text + probe(unit)).finished;
  };
  EXPECT_TRUE(with("slip", "mm"));
  EXPECT_TRUE(with("normal_work", "N/mm"));
  EXPECT_THROW(with("slip", "N/mm"), solidus::InputError);
  EXPECT_THROW(with("normal_work", "mm"), solidus::InputError);
}

TEST(Profiles, DoNotTakeTheNamesOfOtherTables) {
  k_here.write("metal.toml", k_metal);
  for (const char* name : {"pools", "history", "steps"}) {
    const std::string profile =
        std::string("[[profile]]\nname = \"") + name +
        "\"\ngroup = \"x_min\"\ncolumn = [{ name = \"T\", field = \"temperature\", unit = "
        "\"degC\" }]\n";
    try {
      k_here.run("taken", k_wall + profile);
      ADD_FAILURE() << name;
    } catch (const solidus::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("a file cannot be called '") + name + ".csv' here"));
    }
  }
}

}  // namespace
