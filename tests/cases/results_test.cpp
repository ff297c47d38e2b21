/// Results of whole runs: of a steady state, of the second law, of surfaces that are covered in part, of
/// probes over groups, of contact whose augmentations do not end, of tables with names that are taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../unit/results/vtu_reader.hpp"
#include "case_folder.hpp"
#include "coupling/all_fields.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST(SteadyWall, WritesItsSolutionAndWhatFlows) {
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

/// A steel that softens when it warms, stretched far beyond its yield stress while it is cooled from the
/// right.
const std::string k_stretched = R"(title = "A stretched wall"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["20 mm", "10 mm"]
divisions = [16, 4]
[time]
end = "20 s"
step = "0.25 s"
[[body]]
name = "wall"
group = "block"
material = "softening.toml"
initial_temperature = "600 K"
[[thermal_condition]]
name = "cold"
group = "x_max"
kind = "film"
coefficient = "2000 W/m2/K"
ambient = "500 K"
[[mechanical_condition]]
name = "foot"
group = "y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "side"
group = "x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "pulled"
group = "y_max"
kind = "displacement"
uy = { of = "time", argument_unit = "s", unit = "mm", points = [[0, 0], [20, 0.4]] }
[mechanics]
tolerance = 1e-10
[output]
every = "20 s"
fields = ["temperature", "dissipation", "thermal_dissipation", "inelastic_entropy", "conduction_dissipation"]
)";
const std::string k_softening = R"(title = "A steel that softens"
expansion_reference = "293 K"
[density]
value = "7800 kg/m3"
[conductivity]
value = "40 W/m/K"
[specific_heat]
value = "500 J/kg/K"
[young_modulus]
value = "200 GPa"
[poisson_ratio]
value = 0.3
[expansion]
value = "1.2e-5 1/K"
[plasticity]
flow_stress = { argument_unit = "K", unit = "MPa", points = [[300, 500], [700, 100]] }
)";

// D_mech, D_ther and D_cond are nowhere negative, and what the fields sum up to is what the columns say;
// entropy is made at the rate of the three over the temperature.
TEST(SecondLaw, OfTheBulkHoldsInTheFieldsAndInTheHistory) {
  k_here.write("softening.toml", k_softening);
  std::string text = k_stretched;
  for (const auto& [field, unit] :
       {std::pair{"dissipation", "W"}, std::pair{"thermal_dissipation", "W"},
        std::pair{"conduction_dissipation", "W"}, std::pair{"inelastic_entropy", "J/K"}}) {
    const std::string of_cells = std::string(unit) + "/m3" == "W/m3" ? "W/m3" : "J/m3/K";
    text += "[[probe]]\nname = \"sum_" + std::string(field) + "\"\nkind = \"integral\"\nfield = \"" + field +
            "\"\ngroup = \"block\"\nunit = \"" + unit + "\"\n";
    text += "[[probe]]\nname = \"least_" + std::string(field) + "\"\nkind = \"minimum\"\nfield = \"" + field +
            "\"\ngroup = \"block\"\nunit = \"" + of_cells + "\"\n";
  }
  const auto run = k_here.run("stretched", text);
  ASSERT_TRUE(run.finished) << run.reason;
  const auto& column = run.history;
  for (const char* field : {"dissipation[W/m3]", "thermal_dissipation[W/m3]", "conduction_dissipation[W/m3]",
                            "inelastic_entropy[J/m3/K]"})
    for (const double least : column.at(std::string("least_") + field)) EXPECT_GE(least, 0) << field;
  const auto& time = column.at("time[s]");
  double rate = 0, made = 0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double dt = time[i] - time[i - 1];
    const auto gained = [&](const char* name) { return column.at(name)[i] - column.at(name)[i - 1]; };
    const double dissipated = gained("plastic_dissipation[J]") + gained("viscous_dissipation[J]");
    EXPECT_NEAR(column.at("sum_dissipation[W]")[i] * dt, dissipated, 1e-9 * std::abs(dissipated));
    EXPECT_GE(gained("entropy_production[J/K]"), 0);
    EXPECT_NEAR(column.at("sum_inelastic_entropy[J/K]")[i], column.at("inelastic_entropy[J/K]")[i],
                1e-10 * column.at("inelastic_entropy[J/K]").back());
    rate = column.at("sum_dissipation[W]")[i] + column.at("sum_thermal_dissipation[W]")[i] +
           column.at("sum_conduction_dissipation[W]")[i];
    made += dt * rate;
  }
  const double hottest = *std::ranges::max_element(column.at("T_max[degC]")) + 273.15,
               coldest = *std::ranges::min_element(column.at("T_min[degC]")) + 273.15;
  EXPECT_LT(hottest / coldest, 1.2);
  EXPECT_GT(column.at("entropy_production[J/K]").back(), 0.99 * made / hottest);
  EXPECT_LT(column.at("entropy_production[J/K]").back(), 1.01 * made / coldest);
  EXPECT_GT(column.at("inelastic_entropy[J/K]").back(), 0.2 * column.at("entropy_production[J/K]").back());
  // And the first law of two states (a specific heat at constant pressure).
  EXPECT_NEAR(column.at("internal_energy_defect[J]").back(), 0, 1e-7 * column.at("heat_exchanged[J]").back());
}

// The case of section 6.3.1 and its variant, as its page says.
TEST(CastIronInSand, LeavesItsRangeOfTemperaturesWithTheOpenRuleAlone) {
  const auto closed = solidus::testing::run("cases/cast_iron_in_sand/case.toml", "results/iron_closed"),
             open = solidus::testing::run("cases/cast_iron_in_sand/open.toml", "results/iron_open");
  ASSERT_TRUE(closed.finished && open.finished);
  const auto least = [](const solidus::testing::CaseRun& run) {
    return *std::ranges::min_element(run.history.at("T_min[degC]"));
  };
  const auto largest = [](const solidus::testing::CaseRun& run) {
    return *std::ranges::max_element(run.history.at("T_max[degC]"));
  };
  EXPECT_NEAR(least(closed), 20, 1e-6);
  EXPECT_NEAR(largest(closed), 1000, 1e-6);
  EXPECT_LT(least(open), -5);
  EXPECT_GT(largest(open), 1001);
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

// A penalty this soft leaves nearly all of the penetration to the next augmentation.
TEST(AugmentedLagrangian, WhoseTurnsDoNotEndSaysWhereAndAdvisesOnTheContactAlone) {
  std::string text = k_ledge;
  text.insert(text.find("[[probe]]"), "normal = \"augmented_lagrangian\"\npenalty_factor = 1e-4\n");
  const auto run = k_here.run("turns", text, {"time.min_step=\"0.5 s\""});
  EXPECT_FALSE(run.finished);
  EXPECT_THAT(run.reason, HasSubstr("reason: the contact pressure on body "));
  EXPECT_THAT(run.reason,
              HasSubstr("does not come to rest: contact 'faces': 200 augmentations of the Lagrangian leave"));
  EXPECT_THAT(run.reason, HasSubstr("where: node "));
  EXPECT_THAT(run.reason, HasSubstr("normal = \"penalty\" in that [[contact]]"));
  EXPECT_THAT(run.reason, HasSubstr("penalty_factor"));
  EXPECT_THAT(run.reason, Not(HasSubstr("heat.")));
}

/// A casting that freezes, is pushed along a mould and rubs, with inertia and wear: it has every field.
const std::string k_rubbing = R"(title = "A casting that rubs"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["60 mm", "20 mm"]
upper = ["40 mm", "20 mm"]
lower_divisions = [6, 2]
upper_divisions = [4, 3]
[time]
end = "20 s"
step = "1 s"
[[body]]
name = "lower"
material = "steel_mould"
initial_temperature = "100 degC"
[[body]]
name = "upper"
role = "casting"
material = "aluminium_alsi7mg"
initial_temperature = "600 degC"
[[mechanical_condition]]
name = "held"
group = "lower_y_min"
kind = "displacement"
ux = "0 mm"
uy = "0 mm"
[[mechanical_condition]]
name = "pushed"
group = "upper_y_max"
kind = "displacement"
ux = { of = "time", points = [["0 s", "0 mm"], ["20 s", "0.2 mm"]] }
uy = { of = "time", points = [["0 s", "0 mm"], ["20 s", "-0.5 mm"]] }
[[thermal_condition]]
name = "air"
group = "upper_y_max"
kind = "film"
coefficient = "1000 W/m2/K"
ambient = "20 degC"
[[contact]]
name = "faces"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "3000 W/m2/K"
gap_law = "constant"
[contact.friction]
coefficient = 0.2
internal_variable = "normal_work"
[contact.wear]
archard = 1e-4
hardness = "1 GPa"
[dynamics]
[criteria]
feeders = ["upper_y_max"]
)";

TEST(Probes, TakeMeanIntegralAndExtremesOfEveryFieldOverABodyAndASurface) {
  using solidus::quantities::Rank;
  struct Group {
    std::string name, unit;
    double measure;  ///< for a metre of thickness
  };
  const Group groups[] = {{"upper", "m3", 0.04 * 0.02}, {"upper_bottom", "m2", 0.04}};
  const auto header = [](const std::string& field, const Group& group, const std::string& kind) {
    const std::string unit(solidus::coupling::field_of(field).unit);
    const std::string shown = kind != "integral" ? unit : unit == "1" ? group.unit : unit + " " + group.unit;
    return std::array{field + "_" + group.name + "_" + kind, shown};
  };
  std::string text = k_rubbing;
  auto fields = solidus::coupling::field_names(true);
  for (const auto* of_heat_alone : solidus::criteria::fields::k_of_feeding)
    std::erase(fields, std::string(of_heat_alone->name));
  for (const auto& kind : solidus::criteria::criterion_kinds())
    if (kind->from_data())
      for (const auto* field : kind->fields()) std::erase(fields, std::string(field->name));
  for (const std::string& field : fields)
    for (const Group& group : groups)
      for (const char* kind : {"mean", "minimum", "maximum", "integral"}) {
        const Rank rank = solidus::coupling::field_of(field).rank;
        const auto [name, unit] = header(field, group, kind);
        text += "[[probe]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\nfield = \"" + field +
                "\"\ngroup = \"" + group.name + "\"\nunit = \"" + unit + "\"\n";
        if (rank != Rank::scalar)
          text += rank == Rank::vector ? "component = \"x\"\n" : "component = \"xx\"\n";
      }
  const auto run = k_here.run("rubbing", text);
  ASSERT_TRUE(run.finished) << run.reason;
  for (const std::string& field : fields)
    for (const Group& group : groups) {
      const auto column = [&](const std::string& kind) -> const std::vector<double>& {
        const auto [name, unit] = header(field, group, kind);
        return run.history.at(name + "[" + unit + "]");
      };
      for (std::size_t row = 0; row < run.history.at("time[s]").size(); ++row) {
        const double least = column("minimum")[row], largest = column("maximum")[row],
                     mean = column("mean")[row];
        const double rounding = 1e-12 * std::max(std::abs(least), std::abs(largest));
        EXPECT_GE(mean, least - rounding) << field << " of " << group.name << ", row " << row;
        EXPECT_LE(mean, largest + rounding) << field << " of " << group.name << ", row " << row;
        EXPECT_NEAR(column("integral")[row], group.measure * mean, group.measure * rounding)
            << field << " of " << group.name << ", row " << row;
      }
    }
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

// A mistake in a case must not cost what an earlier run of it has left.
TEST(Results, StayWhereTheNextRunIsRefused) {
  k_here.write("metal.toml", k_metal);
  ASSERT_TRUE(k_here.run("kept", k_wall).finished);
  const auto table = k_here.root() / "kept" / "history.csv";
  const std::string before = solidus::testing::read_text(table);
  ASSERT_FALSE(before.empty());
  const std::string probe =
      "[[probe]]\nname = \"T\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = [\"500 mm\", \"1 mm\"]\n";
  EXPECT_THAT(k_here.refusal("kept", k_wall + probe), HasSubstr("lies outside the mesh"));
  EXPECT_EQ(solidus::testing::read_text(table), before);
  EXPECT_TRUE(std::filesystem::exists(k_here.root() / "kept" / "summary.json"));
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
