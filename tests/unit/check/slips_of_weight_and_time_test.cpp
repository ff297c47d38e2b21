// Slips that show in the whole alone: gravity that takes a casting off its mould, a casting that comes in a
// later stage, tables that the run hardly sees, one element, a melt that does not conduct.
#include <fstream>
#include <string>
#include <vector>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string with_gravity(const std::string& direction) {
  return changed(deforming(), "gravity = \"9.81 m/s2\"",
                 "gravity = \"9.81 m/s2\"\ngravity_direction = " + direction);
}

TEST_F(FindingsTest, GravityThatTakesACastingOffItsMouldIsNamed) {
  const std::string said = "gravity, along y, takes 'upper' off what it lies on";
  const std::string up = with_gravity("[0, 1]");
  EXPECT_THAT(said_of(up), Contains(HasSubstr(said)));
  EXPECT_THAT(said_of(with_gravity("[0, -2]")), IsEmpty());
  const std::string turned =
      changed(changed(changed(up, "slave = \"upper_bottom\"", "slave = \"x\""), "lower_top", "upper_bottom"),
              "\"x\"", "\"lower_top\"");
  EXPECT_THAT(said_of(turned), Contains(HasSubstr(said))) << "whichever surface is named first";
  EXPECT_THAT(said_of(up + "[[mechanical_condition]]\nname = \"hook\"\ngroup = \"upper_y_max\"\n"
                           "kind = \"displacement\"\nuy = \"0 mm\"\n"),
              IsEmpty());
  EXPECT_THAT(said_of(up + "[[mechanical_condition]]\nname = \"clamp\"\ngroup = \"upper_y_max\"\n"
                           "kind = \"pressure\"\npressure = \"10 kPa\"\n"),
              Not(Contains(HasSubstr(said))));
}

TEST_F(FindingsTest, ACastingThatIsThereOnlyWhileTheDieStandsOpenIsNamed) {
  const std::string stages = R"(step = "1 s"
[[stage]]
name = "freeze"
duration = "10 min"
[[stage]]
name = "open"
duration = "2 s"
[[cycle]]
name = "shots"
stages = ["freeze", "open"]
repeat = 3
)";
  const auto shots = [&](const std::string& of_casting) {
    return changed(changed(k_casting, "end = \"10 min\"\nstep = \"1 s\"\n", stages), "name = \"upper\"\n",
                   "name = \"upper\"\nstages = [\"" + of_casting + "\"]\n");
  };
  EXPECT_THAT(said_of(shots("freeze")), IsEmpty());
  EXPECT_THAT(said_of(shots("open")), Contains(HasSubstr("'upper' leaves 2 s after its pour")));
}

TEST_F(FindingsTest, TablesThatGoOnLongAfterTheRunOrEndAtItsStartAreNamed) {
  const auto film = [](const std::string& unit, const std::string& points) {
    return changed(
        k_casting, "\"20 W/m2/K\"",
        "{ of = \"time\", argument_unit = \"" + unit + "\", unit = \"W/m2/K\", points = " + points + " }");
  };
  EXPECT_THAT(said_of(film("min", "[[0, 20], [5, 30], [60, 200]]")), IsEmpty());
  EXPECT_THAT(said_of(film("h", "[[0, 20], [5, 200]]")),
              Contains(HasSubstr("the table of 'air' has its second point at 18000 s")));
  EXPECT_THAT(said_of(film("h", "[[0, 20], [0.5, 30], [5, 200]]")),
              Contains(HasSubstr("the table of 'air' goes on to 18000 s")));
  EXPECT_THAT(said_of(film("s", "[[0, 20], [2, 30], [5, 200]]")),
              Contains(HasSubstr("the table of 'air' ends at 5 s, but the run ends at 600 s")));
  EXPECT_THAT(said_of(film("s", "[[0, 20], [5, 200]]")), IsEmpty()) << "a ramp";
}

TEST_F(FindingsTest, ACastingOfOneElementIsNamed) {
  const std::string quadratic = changed(k_casting, "quad4", "quad8");
  EXPECT_THAT(said_of(changed(quadratic, "upper_divisions = [8, 4]", "upper_divisions = [2, 2]")), IsEmpty());
  EXPECT_THAT(said_of(changed(quadratic, "upper_divisions = [8, 4]", "upper_divisions = [1, 1]")),
              Contains(HasSubstr("the body 'upper' is one element")));
}

TEST_F(FindingsTest, MeltThatConductsAFractionOfTheSolidIsNamed) {
  const auto said_of_melt = [&](const std::string& conductivity) {
    std::ofstream(folder_ / "own.toml") << R"(title = "Own"
density = "2700 kg/m3"
conductivity = { argument_unit = "degC", unit = "W/m/K", points = [[20, 159], [550, 150], [613, )" +
                                               conductivity + R"(]] }
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
[phase_change.fraction]
kind = "linear"
solidus = "550 degC"
liquidus = "613 degC"
)";
    return said_of(changed(k_casting, "\"aluminium_alsi7mg\"", "\"own.toml\""));
  };
  EXPECT_THAT(said_of_melt("65"), IsEmpty());
  EXPECT_THAT(said_of_melt("600"), IsEmpty()) << "as some give it for the flow of the melt";
  EXPECT_THAT(said_of_melt("5"), Contains(HasSubstr("conductivity of 5 W/m/K in the melt, 150")));
}

TEST_F(FindingsTest, AMouldThatMeltsUnderWhatItHoldsIsNamed) {
  const auto forging = [](const std::string& temperature) {
    const std::string hot = changed(changed(k_casting, "aluminium_alsi7mg", "h13_tool_steel"), "\"700 degC\"",
                                    "\"" + temperature + "\"");
    return changed(changed(hot, "\"steel_mould\"", "\"aluminium_alsi7mg\""), "\"200 degC\"", "\"400 degC\"");
  };
  const std::string said = "'lower' of 'aluminium_alsi7mg' melts from";
  EXPECT_THAT(said_of(forging("1000 degC")), Contains(HasSubstr(said)));
  EXPECT_THAT(said_of(forging("550 degC")), Not(Contains(HasSubstr(said))));
}

TEST_F(FindingsTest, ConditionsOnTheAxisAndFurtherNumbersAreNamed) {
  const auto film = [](const std::string& text) {
    return text +
           "[[thermal_condition]]\nname = \"left\"\ngroup = \"lower_x_min\"\nkind = \"film\"\n"
           "coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\n";
  };
  EXPECT_THAT(said_of(film(k_casting)), IsEmpty());
  EXPECT_THAT(said_of(film(changed(k_casting, "plane_strain", "axisymmetric"))),
              Contains(HasSubstr("'left' lies on the axis: the surface 'lower_x_min' has no area")));
  const std::vector<Slip> slips = {
      {"step = \"1 s\"", "step = \"1 s\"\nadaptive = true\ndisplacement_error = \"10 mm\"",
       "each step may be wrong by 10000 um of motion"},
      {"step = \"1 s\"", "step = \"1 s\"\nadaptive = true\ndisplacement_error = \"1 nm\"",
       "each step may be wrong by 0.001 um of motion"},
      {"step = \"1 s\"", "step = \"0.1 ms\"\nadaptive = true\nmax_step = \"0.1 ms\"",
       "steps of 0.0001 s: 'upper'"},
      {"gap_law = \"constant\"\n", "gap_law = \"constant\"\n[contact.friction]\ncoefficient = 3e-6\n",
       "the coefficient of friction of 'interface' is 3e-06"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(deforming(), slip.what, slip.with)), Contains(HasSubstr(slip.said)))
        << slip.with;
}

}  // namespace
