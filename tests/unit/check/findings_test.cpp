// Slips of a first-time user on a small casting, each found with its own words; the casting itself gives
// none.
#include "check/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "cases/case_materials.hpp"
#include "casting.hpp"
#include "run/range_watch.hpp"

namespace {

using namespace solidus;
using namespace solidus::check;
using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST_F(FindingsTest, ANormalPourGivesNone) {
  EXPECT_THAT(said_of(k_casting), IsEmpty());
}

TEST_F(FindingsTest, EachSlipIsNamed) {
  const std::string contact = std::string(k_casting).substr(std::string(k_casting).find("[[contact]]"));
  const std::string heat = std::string(k_casting).substr(std::string(k_casting).find("[contact.heat]"));
  const std::vector<Slip> slips = {
      {contact, "", "no contact joins them"},
      {heat, "", "has no [contact.heat]"},
      {contact, contact + changed(contact, "\"interface\"", "\"again\""), "join the same two surfaces"},
      {"\"2000 W/m2/K\"", "\"2000 W/mm2/K\"", "error"},
      {"\"2000 W/m2/K\"", "\"2 W/m2/K\"", "conducts 2 W/m2/K"},
      {"gap_law = \"constant\"", "gap_law = \"gas\"\ngas_conductivity = \"50 W/m/K\"", "the gas in the gap"},
      {"group = \"lower_y_min\"", "group = \"lower_top\"", "which the contact 'interface' cools too"},
      {"[[contact]]",
       "[[thermal_condition]]\nname = \"air again\"\ngroup = \"lower_y_min\"\nkind = \"film\"\n"
       "coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\n[[contact]]",
       "lie on the same surface"},
      {"\"700 degC\"", "\"500 degC\"", "below the liquidus"},
      {"\"700 degC\"", "\"700 K\"", "below the liquidus"},
      {"\"700 degC\"", "\"1700 degC\"", "above the liquidus"},
      {"ambient = \"20 degC\"", "ambient = \"20 K\"", "surroundings of -253 degC"},
      {"ambient = \"20 degC\"", "ambient = \"2000 degC\"", "surroundings of 2000 degC"},
      {"\"20 W/m2/K\"", "\"2000 W/mm2/K\"", "error"},
      {"\"20 W/m2/K\"", "\"3 W/m2/K\"", "has 3 W/m2/K, and nothing radiates there"},
      {"\"9.81 m/s2\"", "\"9.81 mm/s2\"", "gravity is 0.00981"},
      {"\"9.81 m/s2\"", "\"98.1 m/s2\"", "gravity is 98.1"},
      {"step = \"1 s\"", "step = \"600 s\"", "one step of 600 s"},
      {"lower = [\"40 mm\", \"20 mm\"]", "lower = [\"160 m\", \"20 m\"]", "the mesh is 160 m"}};
  for (const Slip& slip : slips) {
    const std::vector<std::string> said = said_of(changed(k_casting, slip.what, slip.with));
    EXPECT_THAT(said, ::testing::Contains(HasSubstr(slip.said))) << slip.with;
  }
  const std::string swapped =
      changed(changed(changed(k_casting, "steel_mould", "x"), "aluminium_alsi7mg", "steel_mould"), "\"x\"",
              "\"aluminium_alsi7mg\"");
  EXPECT_THAT(said_of(swapped), ::testing::Contains(HasSubstr("swapped")));
}

TEST_F(FindingsTest, NormalPoursOfAllAlloysIntoAllMouldsGiveNone) {
  // The cards with the monograph's data hold from 200 or 350 degC up, and say so: not among these.
  const std::vector<std::pair<std::string, std::string>> alloys = {{"aluminium_1070", "740 degC"},
                                                                   {"aluminium_alsi7mg", "700 degC"},
                                                                   {"grey_iron", "1300 degC"},
                                                                   {"nodular_iron", "1350 degC"},
                                                                   {"low_carbon_steel", "1600 degC"}};
  const std::vector<std::string> moulds = {"green_sand", "steel_mould", "h13_tool_steel", "iron_chill",
                                           "copper_chill"};
  std::string pour = changed(k_casting, "end = \"10 min\"", "end = \"2 h\"\nadaptive = true");
  pour = changed(pour, "lower = [\"40 mm\", \"20 mm\"]", "lower = [\"40 mm\", \"100 mm\"]");
  pour = changed(pour, "lower_divisions = [8, 4]", "lower_divisions = [8, 20]");
  for (const auto& [alloy, temperature] : alloys) {
    for (const std::string& mould : moulds) {
      const std::string text = changed(
          changed(changed(pour, "aluminium_alsi7mg", alloy), "700 degC", temperature), "steel_mould", mould);
      EXPECT_THAT(said_of(text), IsEmpty()) << alloy << " in " << mould;
    }
    // The properties of the solid count up to its solidus, those of heat in the melt too.
    said_of(changed(changed(deforming(), "aluminium_alsi7mg", alloy), "700 degC", temperature));
    const cases::CaseSpec spec = setup::load_case(folder_ / "case.toml").spec;
    const double hot = spec.bodies[0].initial_temperature.table.value(0);
    std::vector<std::string> said;
    EXPECT_EQ(run::left_data(spec, 0, cases::load_materials(spec)[0], 293.15, hot, said), "") << alloy;
  }
}

TEST_F(FindingsTest, ANormalPourWithMechanicsGivesNone) {
  EXPECT_THAT(said_of(deforming()), IsEmpty());
}

TEST_F(FindingsTest, ShrinkingMetalInElementsWithoutPoresIsNamedOnce) {
  EXPECT_THAT(said_of(changed(deforming(), "tri3", "quad4")),
              ElementsAre(HasSubstr("'upper' shrinks by 4.5 % as it freezes")));
  EXPECT_THAT(said_of(deforming() + "[mechanics]\nsimplices = \"displacement\"\n"),
              Contains(HasSubstr("neither open pores nor feed")));
  // Heat alone, a mould that only conducts, and metal that does not shrink have nothing to feed.
  EXPECT_THAT(said_of(changed(deforming(), "aluminium_alsi7mg", "aluminium_99_7")),
              Not(Contains(HasSubstr("neither open pores"))));
}

TEST_F(FindingsTest, WhatKeepsACastingFromFreezingIsNamed) {
  const std::string contact = std::string(k_casting).substr(std::string(k_casting).find("[[contact]]"));
  const auto condition = [](const std::string& text) {
    return "[[thermal_condition]]\nname = \"slip\"\n" + text + "\n[[contact]]";
  };
  const std::vector<Slip> slips = {
      {"[[contact]]", condition("group = \"upper_y_max\"\nkind = \"flux\"\nflux = \"1e5 W/m2\""),
       "the flux 'slip' of 100000 W/m2 heats 'upper'"},
      {"[[contact]]",
       condition("group = \"upper_y_max\"\nkind = \"temperature\"\ntemperature = \"700 degC\""),
       "holds the skin 'upper_y_max' of 'upper' at 700 degC"},
      {"[[contact]]",
       condition(
           "group = \"upper_y_max\"\nkind = \"film\"\ncoefficient = \"2000 W/m2/K\"\nambient = \"700 degC\""),
       "the surroundings of 'slip' have 700 degC"},
      {"[[contact]]",
       condition(
           "group = \"upper_y_max\"\nkind = \"film\"\ncoefficient = \"0 W/m2/K\"\nambient = \"20 degC\""),
       "the film 'slip' has 0 W/m2/K"},
      {"[[contact]]", condition("group = \"upper\"\nkind = \"source\"\npower = \"1e12 W/m3\""),
       "the source 'slip' has 1e+12 W/m3"},
      {"end = \"10 min\"", "end = \"10 ms\"", "longer than the whole time"},
      {"end = \"10 min\"\nstep = \"1 s\"", "end = \"2 s\"\nstep = \"0.1 s\"", "the run ends after 2 s"},
      {"step = \"1 s\"", "step = \"100 s\"", "steps of 100 s"},
      {"step = \"1 s\"", "step = \"1 s\"\nadaptive = true\ntemperature_error = \"200 K\"",
       "each step may be wrong by 200 K"},
      {"initial_temperature = \"200 degC\"", "initial_temperature = \"700 degC\"", "nothing cools"},
      {"lower = [\"40 mm\", \"20 mm\"]", "lower = [\"40 mm\", \"1 mm\"]", "\'upper\' takes some"},
      {"upper = [\"40 mm\", \"20 mm\"]\nupper_divisions = [8, 4]",
       "upper = [\"40 mm\", \"2 mm\"]\nupper_divisions = [1, 1]", "its deepest place is 2 mm"},
      {"material = \"steel_mould\"", "material = \"grey_iron\"", "counts as a casting"},
      {"[[contact]]", "[criteria]\nfeeders = [\"lower_y_min\"]\n[[contact]]",
       "the feeder 'lower_y_min' has no node of a body that is poured"},
      {"[[contact]]", "[criteria]\nfeeders = [\"upper_bottom\"]\n[[contact]]", "lies in the lowest quarter"},
      {"[[contact]]", "[output]\nevery = \"1 ms\"\n[[contact]]", "600000 outputs"},
      {"upper_divisions = [8, 4]", "upper_divisions = [8, 4]\ngap = \"3 mm\"", "are 3 mm apart"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(k_casting, slip.what, slip.with)), ::testing::Contains(HasSubstr(slip.said)))
        << slip.with;
  EXPECT_THAT(
      said_of(changed(changed(k_casting, contact, ""), "group = \"lower_y_min\"", "group = \"lower_x_min\"")),
      ::testing::Contains(HasSubstr("nothing cools the body 'upper'")));
}

TEST_F(FindingsTest, FurtherSlipsOfUnitsAreNamed) {
  const std::vector<Slip> slips = {
      {"ambient = \"20 degC\"", "ambient = \"293 degC\"", "is it in K?"},
      {"\"200 degC\"", "\"298.15 degC\"", "'lower' has an initial temperature of 298.15 degC; is it in K?"},
      {"\"200 degC\"", "\"-200 degC\"", "'lower' has an initial temperature of -200 degC"},
      {"gap_law = \"constant\"", "gap_law = \"gas\"\ngas_conductivity = \"0.05 mW/m/K\"",
       "the gas in the gap"},
      {"\"20 W/m2/K\"",
       "{ of = \"time\", argument_unit = \"s\", unit = \"W/m2/K\", points = [[0, 20], [600, 2e9]] }",
       "comes to 2e+09 W/m2/K"},
      {"[[contact]]", "[output]\nevery = \"1 h\"\n[[contact]]", "an output is asked for at 3600 s"},
      {"[[contact]]", "[output]\ntimes = [\"1 h\"]\n[[contact]]", "an output is asked for at 3600 s"},
      {"step = \"1 s\"", "step = \"1 s\"\nadaptive = true\ntemperature_error = \"1 uK\"", "by 1e-06 K alone"},
      {"\"700 degC\"", "\"700 degF\"", "below the liquidus"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(k_casting, slip.what, slip.with)), ::testing::Contains(HasSubstr(slip.said)))
        << slip.with;
}

/// The casting in shots: it freezes, and the die is open.
std::string shots() {
  const std::string stages = R"(step = "1 s"
[[stage]]
name = "freeze"
duration = "4 min"
[[stage]]
name = "open"
duration = "10 s"
[[cycle]]
name = "shots"
stages = ["freeze", "open"]
repeat = 3
)";
  return changed(changed(k_casting, "end = \"10 min\"\nstep = \"1 s\"\n", stages), "name = \"upper\"\n",
                 "name = \"upper\"\nstages = [\"freeze\"]\n");
}

TEST_F(FindingsTest, SlipsOfShotsAreNamed) {
  EXPECT_THAT(said_of(shots()), IsEmpty());
  const std::string periodic = changed(shots(), "repeat = 3", "repeat = 30\nperiodic = \"1 K\"");
  EXPECT_THAT(said_of(periodic), IsEmpty());
  const std::vector<Slip> slips = {
      {"stages = [\"freeze\"]\n", "", "'shots' comes round 30 times, but 'upper' is poured once"},
      {"\"1 K\"", "\"1 uK\"", "counts as periodic where its rounds differ by 1e-06 K"},
      {"\"1 K\"", "\"500 K\"", "counts as periodic where its rounds differ by 500 K"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(periodic, slip.what, slip.with)), ::testing::Contains(HasSubstr(slip.said)))
        << slip.with;
  // A die that is warmed up before the first pour: contacts and films of the casting wait for it.
  EXPECT_THAT(said_of(changed(shots(), "[[stage]]\nname = \"freeze\"",
                              "[[stage]]\nname = \"warm_up\"\nduration = \"1 min\"\n"
                              "[[stage]]\nname = \"freeze\"")),
              IsEmpty());
}

TEST_F(FindingsTest, FurtherSlipsOfConditionsAreNamed) {
  const auto condition = [](const std::string& text) {
    return "[[thermal_condition]]\nname = \"slip\"\n" + text + "\n[[contact]]";
  };
  const auto gap = [](const std::string& unit, const std::string& points) {
    return "gap_law = \"table\"\ngap_conductance = { argument_unit = \"" + unit +
           "\", unit = \"W/m2/K\", points = " + points + " }";
  };
  const std::string gap_law = "gap_law = \"constant\"";
  EXPECT_THAT(said_of(changed(k_casting, gap_law, gap("mm", "[[0, 2000], [0.1, 400], [0.5, 100]]"))),
              IsEmpty());
  const std::vector<Slip> slips = {
      {"kind = \"film\"\ncoefficient = \"20 W/m2/K\"", "kind = \"radiation\"\nemissivity = 0.001",
       "the emissivity of 'air' is 0.001"},
      {"\"20 W/m2/K\"",
       "{ of = \"temperature\", argument_unit = \"K\", unit = \"W/m2/K\", points = [[20, 10], [500, 40]] }",
       "the table of 'coefficient' of 'air' begins at 20 K"},
      {"[[contact]]", condition("group = \"lower_x_max\"\nkind = \"flux\"\nflux = \"-1e8 W/m2\""),
       "the flux 'slip' has -1e+08 W/m2"},
      {"[[contact]]", condition("group = \"upper\"\nkind = \"source\"\npower = \"-1e9 W/m3\""),
       "takes all the heat that 'upper' has within"},
      {"[[contact]]", "[heat]\ntolerance = 0.05\n[[contact]]", "may leave 5 % of its heat unaccounted for"},
      {"[[contact]]", "[criteria]\nfeeders = [\"upper\"]\n[[contact]]", "'upper' is all that is poured"},
      {"end = \"10 min\"\nstep = \"1 s\"", "steady = true", "no time in which 'upper' freezes"},
      {gap_law, gap("m", "[[0, 2000], [0.1, 400], [0.5, 100]]"), "goes up to a gap of 500 mm"},
      {gap_law, gap("mm", "[[0, 2000], [0.1, 4000], [0.5, 10000]]"),
       "rises with the gap, from 2000 to 10000"},
      {"exponent = 0", "exponent = 0.95\nhardness = \"300 Pa\"", "a hardness of 0.0003 MPa"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(k_casting, slip.what, slip.with)), ::testing::Contains(HasSubstr(slip.said)))
        << slip.with;
}

TEST_F(FindingsTest, AJetOnASurfaceMuchLargerThanItsCircleIsNamed) {
  const std::string block = R"(title = "A block of steel under a jet"
[analysis]
kind = "solid"
physics = "heat"
[mesh]
shape = "block"
element = "hex8"
[mesh.block]
size = ["SIDE", "SIDE", "20 mm"]
divisions = [4, 4, 2]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "steel_mould"
initial_temperature = "200 degC"
[[jet]]
name = "nozzle"
group = "z_max"
nozzle = "4 mm"
distance = "20 mm"
radius = "15 mm"
flow = "3 l/min"
inlet_temperature = "30 degC"
)";
  const auto of_side = [&](const std::string& side) {
    return changed(changed(block, "SIDE", side), "SIDE", side);
  };
  EXPECT_THAT(said_of(of_side("100 mm")),
              Contains(HasSubstr("cools a circle of 7.07 cm2, and 'z_max' has 100 cm2")));
  EXPECT_THAT(said_of(of_side("30 mm")), Not(Contains(HasSubstr("cools a circle"))));
}

TEST_F(FindingsTest, ARiserThatIsABodyOfItsOwnIsBelowOrAboveWhatIsPouredWithIt) {
  const std::string poured = changed(k_casting, "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
                                     "\"aluminium_alsi7mg\"\ninitial_temperature = \"700 degC\"");
  const std::string both =
      changed(poured, "upper = [\"40 mm\", \"20 mm\"]", "upper = [\"40 mm\", \"30 mm\"]");
  const auto fed_by = [&](const std::string& body) {
    return said_of(changed(both, "[[contact]]", "[criteria]\nfeeders = [\"" + body + "\"]\n[[contact]]"));
  };
  EXPECT_THAT(fed_by("lower"), Contains(HasSubstr("the feeder 'lower' lies in the lowest quarter")));
  EXPECT_THAT(fed_by("upper"), Not(Contains(HasSubstr("lies in the lowest quarter"))));
}

TEST_F(FindingsTest, PressureOnMeltThatNothingHoldsAndFrictionBeyondAllMetalsAreNamed) {
  const std::string pressed = deforming() + R"(
[[mechanical_condition]]
name = "piston"
group = "upper_y_max"
kind = "pressure"
pressure = "60 MPa"
)";
  EXPECT_THAT(
      said_of(pressed),
      ::testing::Contains(HasSubstr("'piston' presses on the melt of 'upper' with 60 MPa, but 33 %")));
  std::string walled = pressed;
  for (const char* side : {"min", "max"})
    walled += std::string("[[mechanical_condition]]\nname = \"wall_") + side + "\"\ngroup = \"upper_x_" +
              side + "\"\nkind = \"displacement\"\nux = \"0 mm\"\n";
  EXPECT_THAT(said_of(walled), ::testing::Not(::testing::Contains(HasSubstr("presses on the melt"))));
  EXPECT_THAT(said_of(changed(pressed, "60 MPa", "10 kPa")), IsEmpty()) << "a head of melt";
  const std::string rubbing = changed(deforming(), "gap_law = \"constant\"\n",
                                      "gap_law = \"constant\"\n[contact.friction]\ncoefficient = 0.3\n");
  EXPECT_THAT(said_of(rubbing), IsEmpty());
  EXPECT_THAT(said_of(changed(rubbing, "0.3", "30")),
              ::testing::Contains(HasSubstr("the coefficient of friction of 'interface' is 30")));
}

TEST_F(FindingsTest, SupportsThatHoldTooMuchOrNothingAreNamed) {
  const auto support = [](const std::string& text) {
    return "[[mechanical_condition]]\nname = \"slip\"\n" + text + "\n[[mechanical_condition]]";
  };
  const std::string held = "kind = \"displacement\"\nux = \"0 mm\"\nuy = \"0 mm\"";
  const std::vector<Slip> slips = {
      {"[[mechanical_condition]]", support("group = \"upper\"\n" + held),
       "100 % of the nodes of 'upper' are held"},
      {"master = \"lower_top\"", "master = \"lower_top\"\npenalty = \"1 N/m3\"", "a penalty of 1 N/m3"},
      {"master = \"lower_top\"", "master = \"lower_top\"\ntouching = \"1 m\"",
       "gaps of up to 1000 mm as closed"},
      {"[[mechanical_condition]]", support("group = \"upper_bottom\"\n" + held), "no gap can open"},
      {"[[mechanical_condition]]", support("group = \"upper_y_max\"\nkind = \"displacement\"\nuy = \"-3 m\""),
       "moves 'upper_y_max' by 3000 mm"},
      {"[[mechanical_condition]]",
       support("group = \"upper_y_max\"\nkind = \"pressure\"\npressure = \"101325 MPa\""), "101.325 GPa"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(deforming(), slip.what, slip.with)),
                ::testing::Contains(HasSubstr(slip.said)))
        << slip.with;
  const std::string loose = deforming().substr(0, deforming().find("[[contact]]"));
  EXPECT_THAT(said_of(loose), ::testing::Contains(HasSubstr("nothing holds the body 'upper'")));
}

/// A plate in a mould: the mould's cavity reaches from `left` to 60 mm, and the two have nodes of their own,
/// or share those of their common side.
std::string two_squares(const std::string& left, bool shared) {
  return "lc = 5;\nPoint(1) = {0, 0, 0, lc};\nPoint(2) = {30, 0, 0, lc};\nPoint(3) = {30, 30, 0, lc};\n"
         "Point(4) = {0, 30, 0, lc};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\n"
         "Line(4) = {4, 1};\nCurve Loop(1) = {1, 2, 3, 4};\nPlane Surface(1) = {1};\n"
         "Point(6) = {60, 0, 0, lc};\nPoint(7) = {60, 30, 0, lc};\n" +
         (shared ? std::string("Line(5) = {2, 6};\nLine(6) = {6, 7};\nLine(7) = {7, 3};\n"
                               "Curve Loop(2) = {5, 6, 7, -2};\n")
                 : "Point(5) = {" + left + ", 0, 0, lc};\nPoint(8) = {" + left +
                       ", 30, 0, lc};\nLine(5) = {5, 6};\nLine(6) = {6, 7};\nLine(7) = {7, 8};\n"
                       "Line(8) = {8, 5};\nCurve Loop(2) = {5, 6, 7, 8};\n") +
         "Plane Surface(2) = {2};\nPhysical Surface(\"upper\") = {1};\nPhysical Surface(\"lower\") = {2};\n"
         "Physical Curve(\"upper_bottom\") = {2};\nPhysical Curve(\"lower_top\") = {" +
         (shared ? "2" : "8") + "};\nPhysical Curve(\"lower_y_min\") = {6};\n";
}

TEST_F(FindingsTest, BodiesThatOverlapOrAreGluedAreNamed) {
  const std::string text = k_casting;
  const std::size_t mesh = text.find("[mesh]"), time = text.find("[time]");
  const std::string meshed =
      text.substr(0, mesh) + "[mesh]\nfile = \"squares.geo\"\nunit = \"mm\"\n" + text.substr(time);
  const auto said_of_squares = [&](const std::string& left, bool shared, const std::string& casefile) {
    std::ofstream(folder_ / "squares.geo") << two_squares(left, shared);
    return said_of(casefile);
  };
  EXPECT_THAT(said_of_squares("30", false, meshed), IsEmpty());
  EXPECT_THAT(said_of_squares("27", false, meshed), ::testing::Contains(HasSubstr("overlap by up to 3 mm")));
  EXPECT_THAT(said_of_squares("30", true, meshed), ::testing::Contains(HasSubstr("share all their nodes")));
  const std::string glued = meshed.substr(0, meshed.find("[[contact]]"));
  EXPECT_THAT(said_of_squares("30", true, glued),
              ::testing::Contains(HasSubstr("'upper' and 'lower', which start 500 K apart, share 7 nodes")));
}

TEST_F(FindingsTest, PropertiesThatNoMaterialHasAreNamed) {
  const auto said_of_material = [&](const std::string& change, const std::string& to) {
    std::string card = changed(R"(title = "Own"
density = "2700 kg/m3"
conductivity = "159 W/m/K"
specific_heat = "1000 J/kg/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
[phase_change.fraction]
kind = "linear"
solidus = "550 degC"
liquidus = "613 degC"
)",
                               change, to);
    std::ofstream(folder_ / "own.toml") << card;
    return said_of(changed(k_casting, "\"aluminium_alsi7mg\"", "\"own.toml\""));
  };
  EXPECT_THAT(said_of_material("\"Own\"", "\"Mine\""), IsEmpty());
  EXPECT_THAT(said_of_material("389 kJ/kg", "389 J/kg"),
              ::testing::Contains(HasSubstr("latent heat of 389")));
  EXPECT_THAT(said_of_material("159 W/m/K", "159 kW/m/K"), ::testing::Contains(HasSubstr("conductivity of")));
  EXPECT_THAT(said_of_material("159 W/m/K", "0.159 W/m/K"),
              ::testing::Contains(HasSubstr("conductivity of")));
  EXPECT_THAT(said_of_material("2700 kg/m3", "2.7 kg/m3"), ::testing::Contains(HasSubstr("density of")));
  const auto table = [](const std::string& unit, const std::string& points) {
    return "{ argument_unit = \"" + unit + "\", unit = \"W/m/K\", points = " + points + " }";
  };
  const std::string kelvins = "[[293, 159], [823, 140], [886, 90]]",
                    degrees = "[[20, 159], [550, 140], [613, 90]]";
  EXPECT_THAT(said_of_material("\"159 W/m/K\"", table("K", kelvins)), IsEmpty());
  EXPECT_THAT(said_of_material("\"159 W/m/K\"", table("degC", degrees)), IsEmpty());
  EXPECT_THAT(said_of_material("\"159 W/m/K\"", table("degC", kelvins)),
              ::testing::Contains(HasSubstr("are its temperatures in K?")));
  EXPECT_THAT(said_of_material("\"159 W/m/K\"", table("K", degrees)),
              ::testing::Contains(HasSubstr("are its temperatures in degC?")));
}

TEST_F(FindingsTest, HardeningThatFollowsTheTemperatureOfAnInterfaceThatStoresNothingIsNamed) {
  const std::string rubbing = deforming() + R"([coupling]
scheme = "isentropic"
[contact.friction]
coefficient = [0.1, { of = "temperature", argument_unit = "degC", unit = "1", points = [[0, 0.3], [100, 0.1]] }]
)";
  // The tables of the contact belong behind it.
  const std::string friction = rubbing.substr(rubbing.find("[contact.friction]"));
  const std::string text = changed(changed(rubbing, friction, ""), "gap_law = \"constant\"\n",
                                   "gap_law = \"constant\"\n" + friction);
  const auto degenerates = ::testing::Contains(HasSubstr("the isentropic scheme holds its temperature"));
  EXPECT_THAT(said_of(text), degenerates);
  EXPECT_THAT(said_of(changed(text, "[contact.friction]",
                              "[contact.interface]\nheat_capacity = \"1000 J/m2/K\"\n[contact.friction]")),
              ::testing::Not(degenerates));
  EXPECT_THAT(said_of(changed(text, "\"isentropic\"", "\"simultaneous\"")), ::testing::Not(degenerates));
  EXPECT_THAT(said_of(changed(text, "[contact.friction]",
                              "[contact.friction]\ninternal_variable = \"frictional_work\"")),
              ::testing::Not(degenerates));
}

TEST_F(FindingsTest, AnInterfaceThatStoresHeatNeedsAWayForIt) {
  const std::string heat = std::string(k_casting).substr(std::string(k_casting).find("[contact.heat]"));
  EXPECT_THAT(said_of(changed(k_casting, heat, "[contact.interface]\nheat_capacity = \"1000 J/m2/K\"\n")),
              ::testing::ElementsAre(HasSubstr("nothing conducts heat to it")));
}

}  // namespace
