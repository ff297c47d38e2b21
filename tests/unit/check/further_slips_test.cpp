// Slips that pass every check of a key: bodies that nothing holds, melt next to melt, strengths, tables,
// steps.
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

TEST_F(FindingsTest, BodiesThatNothingHoldsInADirectionAreNamed) {
  const std::string condition = deforming().substr(deforming().find("[[mechanical_condition]]"));
  EXPECT_THAT(
      said_of(changed(deforming(), condition, "")),
      Contains(HasSubstr("nothing holds 'upper', 'lower': they are in contact with each other alone")));
  EXPECT_THAT(said_of(changed(deforming(), "ux = \"0 mm\"\n", "")),
              Contains(HasSubstr("nothing holds 'upper', 'lower' along x")));
  const std::string sideways =
      changed(deforming(), "gravity = \"9.81 m/s2\"", "gravity = \"9.81 m/s2\"\ngravity_direction = [1, 0]");
  EXPECT_THAT(said_of(sideways),
              Contains(HasSubstr("nothing holds 'upper' against its weight: gravity acts along x")));
  EXPECT_THAT(said_of(sideways + "[[mechanical_condition]]\nname = \"wall\"\ngroup = \"upper_x_max\"\n"
                                 "kind = \"displacement\"\nux = \"0 mm\"\n"),
              IsEmpty());
  EXPECT_THAT(said_of(changed(sideways, "gap_law = \"constant\"\n",
                              "gap_law = \"constant\"\n[contact.friction]\ncoefficient = 0.3\n")),
              IsEmpty());
  // Round an axis a body moves along it alone.
  const std::string round = changed(changed(deforming(), "plane_strain", "axisymmetric"), "ux =", "ur =");
  EXPECT_THAT(said_of(changed(round, "ur = \"0 mm\"\n", "")), IsEmpty());
  EXPECT_THAT(said_of(changed(round, "uy = \"0 mm\"\n", "")),
              Contains(HasSubstr("nothing holds 'upper', 'lower'")));
}

TEST_F(FindingsTest, AFilmOnAPlaneOfSymmetryAndInertiaOverMinutesAreNamed) {
  const auto side = [](const std::string& components) {
    return deforming() +
           "[[mechanical_condition]]\nname = \"middle\"\ngroup = \"upper_x_min\"\n"
           "kind = \"displacement\"\n" +
           components +
           "[[thermal_condition]]\nname = \"draught\"\ngroup = \"upper_x_min\"\nkind = \"film\"\n"
           "coefficient = \"20 W/m2/K\"\nambient = \"20 degC\"\n";
  };
  EXPECT_THAT(said_of(side("ux = \"0 mm\"\n")),
              Contains(HasSubstr("which 'middle' holds along one axis, as on a plane of symmetry")));
  EXPECT_THAT(said_of(deforming() + "[dynamics]\nmethod = \"newmark\"\n"),
              Contains(HasSubstr("inertia with steps of 1 s")));
}

TEST_F(FindingsTest, MeltBesideMeltIsNamed) {
  const std::string two = changed(k_casting, "\"steel_mould\"", "\"aluminium_alsi7mg\"");
  EXPECT_THAT(
      said_of(changed(two, "\"200 degC\"", "\"690 degC\"")),
      Contains(HasSubstr("the contact 'interface' joins 'upper' and 'lower', which are both poured")));
  EXPECT_THAT(said_of(changed(two, "\"200 degC\"", "\"590 degC\"")),
              Contains(HasSubstr("the body 'lower' starts at 590 degC, partly solid")));
}

TEST_F(FindingsTest, FurtherSlipsOfStepsShapesAndTablesAreNamed) {
  const auto film = [](const std::string& unit, const std::string& points) {
    return "{ of = \"time\", argument_unit = \"" + unit + "\", unit = \"W/m2/K\", points = " + points + " }";
  };
  const auto spots = [](const std::string& roughness, const std::string& slope) {
    return "contact_law = \"spots\"\ngap_law = \"constant\"\nopen_conductance = \"100 W/m2/K\"\n"
           "hardness = \"300 MPa\"\n[contact.heat.asperities]\nroughness = \"" +
           roughness + "\"\nslope = " + slope +
           "\nconductivity = \"40 W/m/K\"\nhardness_coefficient = \"3 GPa\"\nhardness_exponent = -0.2\n";
  };
  const std::string law = std::string(k_casting).substr(std::string(k_casting).find("contact_law"));
  EXPECT_THAT(said_of(changed(k_casting, law, spots("3 um", "0.15"))), IsEmpty());
  EXPECT_THAT(said_of(changed(k_casting, "\"20 W/m2/K\"", film("min", "[[0, 20], [5, 200]]"))), IsEmpty());
  const std::vector<Slip> slips = {
      {"step = \"1 s\"", "step = \"1 s\"\nadaptive = true\nsolid_fraction_change = 1",
       "100 % of the casting may freeze in one step"},
      {"step = \"1 s\"", "step = \"100 s\"\nadaptive = true\nmin_step = \"100 s\"", "at least, but 'upper'"},
      {"step = \"1 s\"", "step = \"1 ms\"", "steps of 0.001 s: 'upper' freezes in some"},
      {"[[contact]]", "[output]\nevery = \"0.2 s\"\n[[contact]]", "outputs every 0.2 s cut the steps of 1 s"},
      {"\"200 degC\"", "\"-20 degC\"", "'lower' has an initial temperature of -20 degC"},
      {"\"20 W/m2/K\"", film("h", "[[1, 20], [2, 200]]"), "the table of 'air' begins at 3600 s"},
      {"upper_divisions = [8, 4]", "upper_divisions = [1, 400]", "800 times as long as wide"},
      {law, spots("3 mm", "0.15"), "a roughness of 3000 um"},
      {law, spots("3 um", "15"), "a mean slope of 15"},
      {law, law + "[contact.interface]\nheat_capacity = \"1e9 J/m2/K\"\n", "stores 1e+09 J/m2/K"},
      {"upper = [\"40 mm\", \"20 mm\"]", "upper = [\"1.6 mm\", \"0.8 mm\"]",
       "the casting 'upper' is 1.6 mm large"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_of(changed(k_casting, slip.what, slip.with)), Contains(HasSubstr(slip.said)))
        << slip.with;
}

TEST_F(FindingsTest, StrengthsAndVolumesThatNoMetalHasAreNamed) {
  const auto said_of_card = [&](const std::string& change, const std::string& to) {
    std::ofstream(folder_ / "own.toml") << changed(R"(title = "Own"
density = "2700 kg/m3"
conductivity = "159 W/m/K"
specific_heat = "1000 J/kg/K"
poisson_ratio = 0.33
young_modulus = { argument_unit = "degC", unit = "GPa", points = [[20, 70], [550, 30]] }
expansion = "2.3e-5 1/K"
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "389 kJ/kg"
volume_change = -0.05
[phase_change.fraction]
kind = "linear"
solidus = "550 degC"
liquidus = "613 degC"
[plasticity]
isotropic_hardening = "none"
flow_stress = { argument_unit = "degC", unit = "MPa", points = [[20, 150], [400, 30], [550, 2]] }
)",
                                                   change, to);
    return said_of(changed(deforming(), "\"aluminium_alsi7mg\"", "\"own.toml\""));
  };
  EXPECT_THAT(said_of_card("\"Own\"", "\"Mine\""), IsEmpty());
  EXPECT_THAT(said_of_card("-0.05", "-0.5"), Contains(HasSubstr("changes the volume by -50 %")));
  EXPECT_THAT(said_of_card("unit = \"MPa\"", "unit = \"Pa\""),
              Contains(HasSubstr("flow_stress of 150 Pa at most")));
  EXPECT_THAT(said_of_card("\"550 degC\"", "\"55 degC\""), Contains(HasSubstr("it freezes over 558 K")));
  EXPECT_THAT(said_of_card("[[20, 70], [550, 30]]", "[[20, 50], [700, 70]]"),
              Contains(HasSubstr("young_modulus rises with temperature")));
  EXPECT_THAT(said_of(changed(deforming(), "\"steel_mould\"", "\"graphite_mould\"")),
              Not(Contains(HasSubstr("young_modulus rises"))))
      << "as graphite's does";
  std::ofstream(folder_ / "die.toml") << "title = \"A die\"\ndensity = \"7800 kg/m3\"\n"
                                         "conductivity = \"30 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
                                         "poisson_ratio = 0.3\nyoung_modulus = \"210 MPa\"\n"
                                         "expansion = \"1.2e-5 1/K\"\n";
  EXPECT_THAT(said_of(changed(deforming(), "\"steel_mould\"", "\"die.toml\"")),
              Contains(HasSubstr("young_modulus of 2.1e+08 Pa at most")));
}

}  // namespace
