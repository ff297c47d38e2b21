// Slips in what several conditions make of one surface, in ratios of properties, in roles and in numbers of
// the method.
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

std::string with_heat(const std::string& text, const std::string& keys) {
  return text + "\n[[thermal_condition]]\nname = \"added\"\n" + keys + "\n";
}

std::string with_motion(const std::string& text, const std::string& keys) {
  return text + "\n[[mechanical_condition]]\nname = \"added\"\n" + keys + "\n";
}

/// A card that a user wrote, all of it usual.
const std::string k_own = R"(title = "Own"
density = "2700 kg/m3"
poisson_ratio = 0.33
conductivity = "150 W/m/K"
specific_heat = { argument_unit = "degC", unit = "J/kg/K", points = [[20, 900], [550, 1100], [613, 1100]] }
young_modulus = { argument_unit = "degC", unit = "GPa", points = [[20, 70], [550, 30]] }
expansion = "2.2e-5 1/K"
[[phase_change]]
name = "freezing"
solidification = true
latent_heat = "389 kJ/kg"
volume_change = -0.05
[phase_change.fraction]
kind = "linear"
solidus = "550 degC"
liquidus = "613 degC"
[plasticity]
isotropic_hardening = "linear"
kinematic_hardening = "none"
rate_dependence = "none"
flow_stress = { argument_unit = "degC", unit = "MPa", points = [[20, 150], [400, 60], [550, 5]] }
hardening_modulus = "1 GPa"
)";

TEST_F(FindingsTest, ConditionsOnASurfaceInContactAreNamed) {
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"group = \"upper_bottom\"\nkind = \"temperature\"\ntemperature = \"200 degC\"",
       "'added' holds the surface 'upper_bottom' at 200 degC"},
      {"group = \"lower_top\"\nkind = \"radiation\"\nemissivity = 0.8\nambient = \"20 degC\"",
       "the radiation 'added' lies on the surface 'lower_top'"},
      {"group = \"lower_top\"\nkind = \"flux\"\nflux = \"-1e4 W/m2\"",
       "the flux 'added' lies on the surface 'lower_top'"}};
  for (const auto& [keys, said] : slips)
    EXPECT_THAT(said_of(with_heat(k_casting, keys)), Contains(HasSubstr(said))) << keys;
  EXPECT_THAT(said_of(with_heat(k_casting,
                                "group = \"lower_x_max\"\nkind = \"temperature\"\n"
                                "temperature = \"200 degC\"")),
              IsEmpty());
  EXPECT_THAT(
      said_of(with_motion(deforming(), "group = \"lower_top\"\nkind = \"pressure\"\npressure = \"0.1 bar\"")),
      Contains(HasSubstr("acts on the surface 'lower_top', which the contact 'interface' holds")));
}

// A rule that takes all faces of a body takes those in contact too.
TEST_F(FindingsTest, ConditionsOnPartsOfASurfaceInContactAreNamed) {
  const std::string groups = "\n[[mesh.group]]\nname = \"skin\"\nowner = \"lower\"\n";
  const std::string film =
      "group = \"skin\"\nkind = \"film\"\ncoefficient = \"20 W/m2/K\"\nambient = \"20 degC\"";
  EXPECT_THAT(
      said_of(with_heat(changed(k_casting, "group = \"lower_y_min\"", "group = \"lower_x_max\""), film) +
              groups),
      Contains(HasSubstr("8 of the 24 faces of 'skin', on which the film 'added' acts, lie in the contact "
                         "'interface'")));
  EXPECT_THAT(
      said_of(with_motion(deforming(), "group = \"skin\"\nkind = \"displacement\"\nux = \"0 mm\"") + groups),
      Contains(HasSubstr("8 of the 24 faces of 'skin', on which the support 'added' acts, lie in the "
                         "contact 'interface'")));
}

// A film of the whole skin along with one of a side of it; a weak one changes little next to a strong one.
TEST_F(FindingsTest, TwoFilmsOnOneFaceAreNamed) {
  const std::string groups = "\n[[mesh.group]]\nname = \"skin\"\nowner = \"lower\"\n";
  const auto with_film = [&](const char* coefficient) {
    return said_of(with_heat(k_casting, std::string("group = \"skin\"\nkind = \"film\"\ncoefficient = \"") +
                                            coefficient + " W/m2/K\"\nambient = \"20 degC\"") +
                   groups);
  };
  EXPECT_THAT(with_film("20"),
              Contains(HasSubstr("the films 'air' and 'added' both act on 8 of the 24 faces")));
  EXPECT_THAT(with_film("0.1"), ::testing::Not(Contains(HasSubstr("both act on"))));
}

TEST_F(FindingsTest, ConditionsThatTakeEachOthersPlaceAreNamed) {
  const std::string held = "kind = \"temperature\"\ntemperature = \"50 degC\"\ngroup = ";
  EXPECT_THAT(said_of(with_heat(k_casting, held + "\"lower_y_min\"")),
              Contains(HasSubstr("'added' holds the temperature of 'lower_y_min', on which 'air' acts too")));
  const std::string twice = changed(with_heat(k_casting, held + "\"lower_x_max\""), "\"added\"", "\"one\"");
  EXPECT_THAT(said_of(with_heat(twice, held + "\"lower_x_max\"")),
              Contains(HasSubstr("'one' holds another one")));
  EXPECT_THAT(said_of(with_heat(k_casting, held + "\"lower\"")),
              Contains(HasSubstr("'added' holds all of 'lower' at 50 degC")));
  EXPECT_THAT(
      said_of(with_motion(deforming(), "group = \"lower_y_min\"\nkind = \"displacement\"\nuy = \"1 mm\"")),
      Contains(HasSubstr("'table' and 'added' move 'lower_y_min' along the same axis, by 0 and 1 mm")));
  EXPECT_THAT(
      said_of(with_motion(deforming(), "group = \"lower_y_min\"\nkind = \"displacement\"\nuy = \"0 mm\"")),
      IsEmpty());
  EXPECT_THAT(said_of(with_motion(deforming(),
                                  "group = \"upper_y_max\"\nkind = \"pressure\"\npressure = \"-1 bar\"")),
              Contains(HasSubstr("the pressure 'added' of -0.1 MPa pulls at 'upper_y_max'")));
}

TEST_F(FindingsTest, ACastingThatIsHeldAtBothEndsIsNamed) {
  const std::string end = "kind = \"displacement\"\nux = \"0 mm\"\ngroup = ";
  const std::string left =
      changed(with_motion(deforming(), end + "\"upper_x_min\""), "\"added\"", "\"left\"");
  EXPECT_THAT(said_of(left), IsEmpty());
  EXPECT_THAT(
      said_of(with_motion(left, end + "\"upper_x_max\"")),
      Contains(HasSubstr("'left' and 'added' hold 'upper' at both of its ends along x, 40 mm apart")));
}

TEST_F(FindingsTest, HeatersThatMeltTheirBodyAreNamed) {
  const auto heater = [](const std::string& power) {
    return with_heat(k_casting, "group = \"lower\"\nkind = \"source\"\npower = \"" + power + "\"");
  };
  EXPECT_THAT(said_of(heater("1e9 W/m3")), Contains(HasSubstr("heats 'lower' by")));
  EXPECT_THAT(said_of(heater("1e5 W/m3")), Not(Contains(HasSubstr("heats 'lower' by"))));
}

TEST_F(FindingsTest, TablesInTheUnitOfAnotherMagnitudeAreNamed) {
  const auto closed = [](const std::string& unit) {
    return changed(k_casting, "contact_law = \"power\"\nconductance = \"2000 W/m2/K\"\nexponent = 0\n",
                   "contact_law = \"table\"\ncontact_conductance = { argument_unit = \"" + unit +
                       "\", unit = \"W/m2/K\", points = [[0, 2000], [10, 3000]] }\n");
  };
  EXPECT_THAT(said_of(changed(closed("MPa"), "physics = \"heat\"", "physics = \"heat\"")), IsEmpty());
  EXPECT_THAT(said_of(closed("Pa")), Contains(HasSubstr("ends at a pressure of 1e-05 MPa")));
  const auto open = [](const std::string& unit) {
    return changed(k_casting, "gap_law = \"constant\"\n",
                   "gap_law = \"table\"\ngap_conductance = { argument_unit = \"" + unit +
                       "\", unit = \"W/m2/K\", points = [[0, 2000], [0.1, 500], [0.5, 100]] }\n");
  };
  EXPECT_THAT(said_of(open("mm")), IsEmpty());
  EXPECT_THAT(said_of(open("um")), Contains(HasSubstr("ends at a gap of 0.0005 mm")));
}

TEST_F(FindingsTest, NumbersOfTheMethodThatLetNoStepThroughAreNamed) {
  const std::string master = "master = \"lower_top\"\n";
  const auto of_contact = [&](const std::string& keys) {
    return changed(deforming(), master, master + keys + "\n");
  };
  const std::vector<std::pair<std::string, std::string>> slips = {
      {deforming() + "[mechanics]\nmax_iterations = 1\n", "mechanics.max_iterations = 1"},
      {deforming() + "[heat]\nmax_iterations = 2\n", "heat.max_iterations = 2"},
      {changed(deforming(), "step = \"1 s\"", "step = \"1 s\"\nadaptive = true\ncut = 0.99"),
       "time.cut = 0.99"},
      {of_contact("search_distance = \"1 m\""),
       "looks for partners up to 1000 mm away, its body is 40 mm large"},
      {of_contact("search_distance = \"1 um\""), "heat ends where the gap of a casting is wider"},
      {of_contact("atmosphere = \"1 Pa\""), "is held on the wall of 'interface' by 1 Pa"},
      {of_contact("atmosphere = \"1 GPa\""), "is held on the wall of 'interface' by 1e+09 Pa"}};
  for (const auto& [text, said] : slips) EXPECT_THAT(said_of(text), Contains(HasSubstr(said)));
  EXPECT_THAT(said_of(of_contact("search_distance = \"2 mm\"\natmosphere = \"500 bar\"")), IsEmpty());
}

TEST_F(FindingsTest, ASlaveWhosePointsLetMeltThroughIsNamed) {
  const std::string master = "master = \"lower_top\"\n";
  const auto turned = [&](const std::string& integration, const std::string& divisions) {
    std::string text =
        changed(deforming(), "slave = \"upper_bottom\"\n" + master,
                "slave = \"lower_top\"\nmaster = \"upper_bottom\"\nintegration = \"" + integration + "\"\n");
    return changed(text, "lower_divisions = [8, 4]", "lower_divisions = [" + divisions + ", 4]");
  };
  EXPECT_THAT(said_of(turned("nodal", "4")),
              Contains(HasSubstr("the faces of the slave 'lower_top' are 2 times as large")));
  EXPECT_THAT(said_of(turned("nodal", "8")), IsEmpty());
  EXPECT_THAT(said_of(turned("segments", "4")), IsEmpty());
}

TEST_F(FindingsTest, RolesThatAreSwappedAreNamed) {
  const auto roles = [](const std::string& upper, const std::string& lower) {
    return changed(changed(k_casting, "name = \"upper\"\n", "name = \"upper\"\nrole = \"" + upper + "\"\n"),
                   "name = \"lower\"\n", "name = \"lower\"\nrole = \"" + lower + "\"\n");
  };
  EXPECT_THAT(said_of(roles("casting", "mould")), IsEmpty());
  EXPECT_THAT(said_of(roles("mould", "casting")),
              Contains(HasSubstr("the hottest body, 'upper', has the role of a mould")));
}

TEST_F(FindingsTest, RatiosThatNoMetalHasAreNamed) {
  const auto said_with = [&](const std::string& what, const std::string& with) {
    std::ofstream(folder_ / "own.toml") << (what.empty() ? k_own : changed(k_own, what, with));
    return said_of(changed(deforming(), "\"aluminium_alsi7mg\"", "\"own.toml\""));
  };
  EXPECT_THAT(said_with("", ""), IsEmpty());
  const std::string rate = "rate_dependence = \"perzyna\"\nrate_exponent = 5\n";
  EXPECT_THAT(said_with("rate_dependence = \"none\"\n",
                        rate + "viscosity = \"1e9 Pa s\"\ndrag_stress = \"10 MPa\"\n"),
              IsEmpty());
  const std::vector<Slip> slips = {
      {"poisson_ratio = 0.33", "poisson_ratio = 0.033", "poisson_ratio of 0.033"},
      {"\"1 GPa\"", "\"50 GPa\"", "hardening_modulus of 50 GPa with a young_modulus of 70 GPa"},
      {"2.2e-5 1/K", "6.6e-5 1/K", "is it that of the volume, three times as large?"},
      {"389 kJ/kg", "10.7 kJ/kg", "latent heat of 10700 J/kg"},
      {"\"150 W/m/K\"", "\"700 W/m/K\"", "conductivity of 700 W/m/K"},
      {"-0.05", "0.05", "'freezing' makes the volume larger by 5 %"},
      {"[550, 1100], [613", "[550, 1100], [580, 12000], [613", "the specific heat rises to 1.2e+04 J/kg/K"},
      {"solidification = true\n", "", "'freezing' releases 389 kJ/kg and is no solidification"},
      {"rate_dependence = \"none\"\n", rate + "viscosity = \"1 Pa s\"\ndrag_stress = \"10 Pa\"\n",
       "at 0.001 1/s its rate adds"}};
  for (const Slip& slip : slips)
    EXPECT_THAT(said_with(slip.what, slip.with), Contains(HasSubstr(slip.said))) << slip.with;
}

}  // namespace
