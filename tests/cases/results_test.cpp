/// Results of whole runs: of a steady state, of coupling in one direction, of surfaces that are covered in
/// part, of tables with names that are taken.
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

/// Two bars between fixed ends, 50 mm and 30 mm long, the lower one heated at its foot to 300 °C: heat
/// crosses a gap that the heat itself makes narrower. Without lateral strain (ν = 0) and with faces that stay
/// plane it is a problem in one dimension.
const std::string k_gap = R"(title = "Two bars and the gap between them"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
gap = "0.2 mm"
lower = ["10 mm", "50 mm"]
lower_divisions = [2, 10]
upper = ["10 mm", "30 mm"]
upper_divisions = [2, 6]
[time]
steady = true
[[body]]
name = "upper"
material = "bar.toml"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "bar.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "above"
group = "upper_y_max"
kind = "temperature"
temperature = "20 degC"
[[thermal_condition]]
name = "below"
group = "lower_y_min"
kind = "temperature"
temperature = "300 degC"
[[mechanical_condition]]
name = "foot"
group = "lower_y_min"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "head"
group = "upper_y_max"
kind = "displacement"
uy = "0 mm"
[[mechanical_condition]]
name = "symmetry_lower"
group = "lower_x_min"
kind = "displacement"
ux = "0 mm"
[[mechanical_condition]]
name = "symmetry_upper"
group = "upper_x_min"
kind = "displacement"
ux = "0 mm"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
search_distance = "1 mm"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
[[probe]]
name = "below"
kind = "mean"
field = "temperature"
group = "lower_top"
unit = "degC"
[[probe]]
name = "above"
kind = "mean"
field = "temperature"
group = "upper_bottom"
unit = "degC"
[[probe]]
name = "gap"
kind = "mean"
field = "gap"
group = "upper_bottom"
unit = "mm"
)";
const std::string k_bar = R"(title = "A metal"
density = "7800 kg/m3"
conductivity = "40 W/m/K"
specific_heat = "500 J/kg/K"
young_modulus = "200 GPa"
poisson_ratio = 0.0
expansion = "1.2e-5 1/K"
expansion_reference = "20 degC"
)";

/// Flux, temperatures on both sides and gap of the steady state of these bars, gap `g0` when cold.
struct Bars {
  double flux = 0, below = 0, above = 0,
         gap = 0;  ///< [W/m²], [°C], [°C], [m]; negative gap: pressed together
  explicit Bars(double g0) {
    constexpr double k = 40, k_gas = 0.05, h_o = 2000, hot = 300, cold = 20, alpha = 1.2e-5, l1 = 0.05,
                     l2 = 0.03;
    double low = 0, high = (hot - cold) * k / (l1 + l2);
    for (int i = 0; i < 200; ++i) {
      flux = 0.5 * (low + high);
      below = hot - flux * l1 / k, above = cold + flux * l2 / k;
      gap = g0 - alpha * (l1 * (0.5 * (hot + below) - cold) + l2 * (0.5 * (above + cold) - cold));
      const double h = gap > 0 ? k_gas / (gap + k_gas / h_o) : h_o;
      (h * (below - above) > flux ? low : high) = flux;
    }
  }
};

TEST(SteadyRun, FindsTheTemperaturesAndTheGapThatBelongTogether) {
  k_here.write("bar.toml", k_bar);
  const auto run = k_here.run("gap", k_gap);
  ASSERT_TRUE(run.finished) << run.reason;
  const Bars exact(0.2e-3);
  EXPECT_GT(exact.gap, 1e-5);
  EXPECT_NEAR(run.history.at("below[degC]").back(), exact.below, 1e-5);
  EXPECT_NEAR(run.history.at("above[degC]").back(), exact.above, 1e-5);
  EXPECT_NEAR(run.history.at("gap[mm]").back(), 1e3 * exact.gap, 1e-7);
  EXPECT_NEAR(run.history.at("contact_heat[W]").back(), -exact.flux * 0.01, 1e-8 * exact.flux);
  EXPECT_NEAR(run.history.at("heat_in[J]").back(), 0, 1e-6 * exact.flux);
  EXPECT_GT(run.steps.at("coupling_iterations[1]").back(), 2);
}

// A gap that closes: the bars press on each other, p (l1 + l2)/E being what the expansion lacks room for.
TEST(SteadyRun, FindsThePressureOfAGapThatHasClosed) {
  k_here.write("bar.toml", k_bar);
  const auto run = k_here.run("closed", k_gap,
                              {"mesh.two_blocks.gap=20 um", "contact.interface.normal=augmented_lagrangian"});
  ASSERT_TRUE(run.finished) << run.reason;
  const Bars exact(20e-6);
  ASSERT_LT(exact.gap, 0);
  EXPECT_NEAR(run.history.at("below[degC]").back(), exact.below, 1e-5);
  const double force = 200e9 * -exact.gap / 0.08 * 0.01;
  EXPECT_NEAR(run.history.at("contact_force[N]").back(), force, 1e-4 * force);
}

TEST(SteadyRun, OfMechanicsAloneIsOneEquilibrium) {
  k_here.write("bar.toml", k_bar);
  std::string pressed = k_gap;
  for (const std::string section : {"[[thermal_condition]]", "[contact.heat]", "[[probe]]"})
    for (std::size_t at; (at = pressed.find(section)) != std::string::npos;) {
      const std::size_t next = pressed.find("\n[", at + 2);
      pressed.erase(at, next == std::string::npos ? std::string::npos : next + 1 - at);
    }
  pressed.replace(pressed.find("thermomechanical"), 16, "mechanics");
  const auto run = k_here.run("pressed", pressed,
                              {"mesh.two_blocks.gap=0 mm", "mechanical_condition.head.uy=-0.08 mm",
                               "contact.interface.normal=augmented_lagrangian"});
  ASSERT_TRUE(run.finished) << run.reason;
  const double force = 200e9 * 1e-3 * 0.01;
  EXPECT_NEAR(run.history.at("contact_force[N]").back(), force, 1e-4 * force);
}

TEST(SteadyRun, HasNoInertia) {
  k_here.write("bar.toml", k_bar);
  try {
    k_here.run("moving", k_gap + "[dynamics]\n");
    ADD_FAILURE() << "inertia passed";
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("inertia in a steady analysis"));
  }
}

// Deformation follows the temperatures and the gap conducts, but deformation takes up no heat. A phase that
// holds entropy then holds temperature, iterations of both kinds end in the same solution, and heat alone
// closes the first law.
TEST(OneWayCoupling, GoesWithEveryScheme) {
  k_here.write("bar.toml", k_bar);
  const auto go = [](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(), {"time.steady=false", "time.end=100 s", "time.step=5 s",
                             "coupling.structural_heating=none", "coupling.scheme=" + name});
    const auto run = k_here.run("one_way_" + name, k_gap, more);
    EXPECT_TRUE(run.finished) << name << ": " << run.reason;
    EXPECT_NEAR(run.history.at("energy_defect[J]").back(), 0,
                1e-7 * run.history.at("heat_exchanged[J]").back())
        << name;
    return run;
  };
  const auto isothermal = go("isothermal", {}), isentropic = go("isentropic", {}),
             iterated = go("block_iterative", {}), together = go("simultaneous", {}),
             double_pass = go("double_pass", {}),
             two_stages = go("simultaneous", {"coupling.integration=sdirk2", "time.step=1 s"});
  for (const char* column : {"below[degC]", "above[degC]", "gap[mm]"}) {
    SCOPED_TRACE(column);
    EXPECT_EQ(isentropic.history.at(column), isothermal.history.at(column));
    const double fine = two_stages.history.at(column).back();
    EXPECT_NEAR(iterated.history.at(column).back(), together.history.at(column).back(), 1e-6 * fine);
    // Second order beside first.
    EXPECT_LT(std::abs(double_pass.history.at(column).back() - fine),
              0.1 * std::abs(together.history.at(column).back() - fine));
    EXPECT_NEAR(together.history.at(column).back(), fine, 0.02 * fine);
  }
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
