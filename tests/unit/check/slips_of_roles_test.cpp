// Slips in what bodies are to the foundry: chills, moulds, risers, sleeves that burn, probes, criteria.
#include <algorithm>
#include <string>
#include <vector>

#include "casting.hpp"
#include "coupling/all_fields.hpp"
#include "criteria/criterion_kind.hpp"
#include "criteria/quantities.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The casting with roles: the lower block is what it says.
std::string with_roles(const std::string& casefile, const std::string& lower) {
  return changed(changed(casefile, "name = \"upper\"\n", "name = \"upper\"\nrole = \"casting\"\n"),
                 "name = \"lower\"\n", "name = \"lower\"\nrole = \"" + lower + "\"\n");
}

std::string with(const std::string& casefile, const std::string& section) {
  return changed(casefile, "[[contact]]", section + "\n[[contact]]");
}

TEST_F(FindingsTest, ChillsThatTakeUpNoHeatAreNamed) {
  const std::string chilled =
      changed(with_roles(k_casting, "chill"), "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
              "\"iron_chill\"\ninitial_temperature = \"20 degC\"");
  EXPECT_THAT(said_of(chilled), IsEmpty());
  EXPECT_THAT(said_of(changed(chilled, "\"iron_chill\"", "\"green_sand\"")),
              Contains(HasSubstr("the chill 'lower' of 'green_sand' conducts")));
  EXPECT_THAT(
      said_of(changed(chilled, "initial_temperature = \"20 degC\"", "initial_temperature = \"650 degC\"")),
      Contains(HasSubstr("the chill 'lower' starts at 650 degC")));
}

TEST_F(FindingsTest, AMouldOfInsulationIsNamed) {
  const auto mould = [](const std::string& role, const std::string& material) {
    return changed(changed(with_roles(k_casting, role), "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
                           "\"" + material + "\"\ninitial_temperature = \"20 degC\""),
                   "end = \"10 min\"", "end = \"10 h\"");
  };
  const char* named = "takes up heat as insulation does";
  for (const char* usual : {"green_sand", "dry_silica_sand", "plaster", "ceramic_shell"})
    EXPECT_THAT(said_of(mould("mould", usual)), Not(Contains(HasSubstr(named)))) << usual;
  for (const char* insulation : {"ceramic_fibre", "insulating_sleeve"}) {
    EXPECT_THAT(said_of(mould("mould", insulation)), Contains(HasSubstr(named))) << insulation;
    EXPECT_THAT(said_of(mould("sleeve", insulation)), Not(Contains(HasSubstr(named)))) << insulation;
  }
}

TEST_F(FindingsTest, AMouldWithinItsCastingIsNamed) {
  // The lower block, with the groups swapped, is the casting; a narrow mould lies in its box where it
  // overlaps.
  std::string inside = changed(with_roles(k_casting, "mould"), "shape = \"two_blocks\"\nelement = \"quad4\"",
                               "file = \"ring.geo\"\nunit = \"mm\"");
  const std::size_t from = inside.find("[mesh.two_blocks]"), to = inside.find("[time]");
  inside.erase(from, to - from);
  std::ofstream(folder_ / "ring.geo")
      << "lc = 10;\nPoint(1) = {0, 0, 0, lc};\nPoint(2) = {60, 0, 0, lc};\nPoint(3) = {60, 60, 0, lc};\n"
         "Point(4) = {0, 60, 0, lc};\nPoint(5) = {20, 0, 0, lc};\nPoint(6) = {40, 0, 0, lc};\n"
         "Point(7) = {40, 30, 0, lc};\nPoint(8) = {20, 30, 0, lc};\nPoint(9) = {20, 0, 0, lc};\n"
         "Point(10) = {40, 0, 0, lc};\nPoint(11) = {40, 30, 0, lc};\nPoint(12) = {20, 30, 0, lc};\n"
         "Line(1) = {1, 5};\nLine(2) = {5, 8};\nLine(3) = {8, 7};\nLine(4) = {7, 6};\nLine(5) = {6, 2};\n"
         "Line(6) = {2, 3};\nLine(7) = {3, 4};\nLine(8) = {4, 1};\nLine(9) = {9, 10};\nLine(10) = {10, 11};\n"
         "Line(11) = {11, 12};\nLine(12) = {12, 9};\nCurve Loop(1) = {1 : 8};\nPlane Surface(1) = {1};\n"
         "Curve Loop(2) = {9 : 12};\nPlane Surface(2) = {2};\nPhysical Surface(\"upper\") = {1};\n"
         "Physical Surface(\"lower\") = {2};\nPhysical Curve(\"upper_bottom\") = {2, 3, 4};\n"
         "Physical Curve(\"lower_top\") = {10, 11, 12};\nPhysical Curve(\"lower_y_min\") = {9};\n";
  EXPECT_THAT(said_of(inside), Contains(HasSubstr("the mould 'lower' lies within the casting 'upper'")));
}

TEST_F(FindingsTest, ABodyThatWasForgottenIsNamed) {
  std::string alone = k_casting;
  const std::size_t body = alone.find("[[body]]\nname = \"lower\""),
                    air = alone.find("[[thermal_condition]]");
  alone.erase(body, air - body);
  alone = changed(alone.substr(0, alone.find("[[contact]]")), "lower_y_min", "upper_y_max");
  EXPECT_THAT(said_of(alone), Contains(HasSubstr("the mesh has a group 'lower' that lies on no body")));
}

TEST_F(FindingsTest, WaterOnSandAndFilmsThatDoNothingAreNamed) {
  const std::string sand = changed(changed(k_casting, "\"steel_mould\"\ninitial_temperature = \"200 degC\"",
                                           "\"green_sand\"\ninitial_temperature = \"20 degC\""),
                                   "end = \"10 min\"", "end = \"2 h\"");
  EXPECT_THAT(said_of(changed(sand, "\"20 W/m2/K\"", "\"3 kW/m2/K\"")),
              Contains(HasSubstr("the film 'air' has 3000 W/m2/K on 'lower', which conducts as sand does")));
  EXPECT_THAT(said_of(changed(k_casting, "\"20 W/m2/K\"", "\"3 kW/m2/K\"")), IsEmpty())
      << "steel withstands water";
  EXPECT_THAT(said_of(changed(k_casting, "\"20 W/m2/K\"", "\"20 W/m2/K\"\nfactor = 0")),
              Contains(HasSubstr("the factor of 'air' is 0")));
}

TEST_F(FindingsTest, MouldsThatAreKeptAboveTheSolidusOrNearZeroAreNamed) {
  EXPECT_THAT(said_of(changed(k_casting, "ambient = \"20 degC\"", "ambient = \"700 degC\"")),
              Contains(HasSubstr("'air' surrounds 'lower' at 700 degC, above the solidus")));
  const auto held = [](const std::string& temperature) {
    return with(k_casting,
                "[[thermal_condition]]\nname = \"channel\"\ngroup = \"lower_x_max\"\n"
                "kind = \"temperature\"\ntemperature = \"" +
                    temperature + "\"\n");
  };
  EXPECT_THAT(said_of(held("80 degC")), IsEmpty());
  EXPECT_THAT(said_of(held("700 degC")), Contains(HasSubstr("'channel' holds 'lower' at 700 degC")));
  EXPECT_THAT(said_of(held("20 K")),
              Contains(HasSubstr("'channel' holds 'lower_x_max' at -253 degC (20 K)")));
}

TEST_F(FindingsTest, RisersWithoutWeightOrCooledByWaterAreNamed) {
  const std::string riser =
      changed(deforming(), "name = \"upper\"\n", "name = \"upper\"\nrole = \"riser\"\n");
  EXPECT_THAT(said_of(riser), ElementsAre(HasSubstr("the riser 'upper' face up and have neither")));
  EXPECT_THAT(said_of(changed(riser, "gravity = \"9.81 m/s2\"\n", "")),
              Contains(HasSubstr("the riser 'upper' has no weight")));
  const auto cooled = [&](const std::string& coefficient) {
    return with(riser,
                "[[thermal_condition]]\nname = \"top\"\ngroup = \"upper_y_max\"\nkind = \"film\"\n"
                "coefficient = \"" +
                    coefficient + "\"\nambient = \"20 degC\"\n");
  };
  EXPECT_THAT(said_of(cooled("10 W/m2/K")), IsEmpty());
  EXPECT_THAT(said_of(cooled("10 kW/m2/K")),
              Contains(HasSubstr("the film 'top' has 10000 W/m2/K on 'upper', which is to freeze last")));
}

TEST_F(FindingsTest, ThePressureOfTheAirIsNamed) {
  const auto pressed = [](const std::string& pressure) {
    return deforming() +
           "[[mechanical_condition]]\nname = \"air\"\ngroup = \"upper_y_max\"\nkind = \"pressure\"\n"
           "pressure = \"" +
           pressure + "\"\n";
  };
  EXPECT_THAT(said_of(pressed("101325 Pa")),
              Contains(HasSubstr("'air' presses with 101325 Pa, as the air does")));
  EXPECT_THAT(said_of(pressed("1 bar")), Contains(HasSubstr("as the air does")));
  EXPECT_THAT(said_of(pressed("5 kPa")), IsEmpty());
}

TEST_F(FindingsTest, SleevesThatDoNotBurnOrBurnTooMuchAreNamed) {
  const auto burning = [](const std::string& group, const std::string& heat, const std::string& ignition,
                          const std::string& duration) {
    return with(k_casting, "[[thermal_condition]]\nname = \"sleeve\"\ngroup = \"" + group +
                               "\"\nkind = \"exothermic\"\nheat = \"" + heat + "\"\nignition = \"" +
                               ignition + "\"\nduration = \"" + duration + "\"\n");
  };
  EXPECT_THAT(said_of(burning("lower", "500 MJ/m3", "400 degC", "60 s")), IsEmpty());
  EXPECT_THAT(said_of(burning("lower", "500 MJ/m3", "1400 degC", "60 s")),
              Contains(HasSubstr("'sleeve' ignites at 1400 degC, but nothing starts hotter than 700 degC")));
  EXPECT_THAT(said_of(burning("lower", "500 MJ/m3", "40 degC", "60 s")),
              Contains(HasSubstr("'sleeve' ignites at 40 degC, and 'lower' starts at 200 degC")));
  EXPECT_THAT(said_of(burning("upper", "500 MJ/m3", "400 degC", "60 s")),
              Contains(HasSubstr("'sleeve' burns in 'upper', which is poured")));
  EXPECT_THAT(said_of(burning("lower", "500 GJ/m3", "400 degC", "60 s")),
              Contains(HasSubstr("'sleeve' releases 5e+11 J/m3")));
  EXPECT_THAT(said_of(burning("lower", "500 MJ/m3", "400 degC", "60 ms")),
              Contains(HasSubstr("'sleeve' burns for 0.06 s")));
}

TEST_F(FindingsTest, ProbesThatMeasureNothingAreNamed) {
  const auto probe = [](const std::string& casefile, const std::string& field, const std::string& unit,
                        const std::string& keys) {
    return with(casefile,
                "[[probe]]\nname = \"p\"\nfield = \"" + field + "\"\nunit = \"" + unit + "\"\n" + keys);
  };
  const std::string in_mould = "point = [\"20 mm\", \"10 mm\"]\n",
                    between = "point = [\"20 mm\", \"20 mm\"]\n";
  EXPECT_THAT(said_of(probe(k_casting, "temperature", "degC", in_mould)), IsEmpty());
  EXPECT_THAT(said_of(probe(k_casting, "solid_fraction", "1", in_mould)),
              Contains(HasSubstr("the probe 'p' takes the solid_fraction of 'lower', of 'steel_mould'")));
  EXPECT_THAT(said_of(probe(k_casting, "temperature", "degC", between)),
              Contains(HasSubstr("the probe 'p' lies where 'upper' and 'lower' touch: it measures 'upper'")));
  EXPECT_THAT(said_of(probe(k_casting, "temperature", "degC", between + "body = \"lower\"\n")), IsEmpty());
  const std::string rigid = changed(changed(deforming(), "\"steel_mould\"", "\"green_sand\""),
                                    deforming().substr(deforming().find("[[mechanical_condition]]")), "");
  EXPECT_THAT(said_of(probe(rigid, "von_mises", "MPa", in_mould)),
              Contains(HasSubstr("the probe 'p' takes the von_mises of 'lower', which only conducts heat")));
}

TEST_F(FindingsTest, EveryFieldOfMechanicsOrOfFreezingIsNamedInABodyThatDoesNeither) {
  const std::string rigid = changed(changed(deforming(), "\"steel_mould\"", "\"green_sand\""),
                                    deforming().substr(deforming().find("[[mechanical_condition]]")), "");
  int named = 0;
  for (const solidus::quantities::Quantity* field : solidus::coupling::all_fields()) {
    using solidus::quantities::Rank;
    const auto& needs = field->needs;
    if (field->of_contact() || needs.inertia || needs.plasticity || needs.isentropic) continue;
    if (std::ranges::count(solidus::criteria::fields::k_of_feeding, field) > 0) continue;  // of heat alone
    const bool from_data = std::ranges::any_of(solidus::criteria::criterion_kinds(), [&](const auto& kind) {
      return kind->from_data() && std::ranges::count(kind->fields(), field) > 0;
    });
    if (from_data) continue;
    const std::string keys = field->rank == Rank::tensor   ? "component = \"xx\"\n"
                             : field->rank == Rank::vector ? "component = \"x\"\n"
                                                           : "";
    const std::string name(field->name);
    const std::vector<std::string> said =
        said_of(with(rigid, "[[probe]]\nname = \"p\"\nfield = \"" + name + "\"\nunit = \"" +
                                std::string(field->unit) + "\"\npoint = [\"20 mm\", \"10 mm\"]\n" + keys));
    const std::string takes = "the probe 'p' takes the " + name + " of 'lower', ";
    if (needs.mechanics)
      EXPECT_THAT(said, Contains(HasSubstr(takes + "which only conducts heat"))) << name;
    else if (needs.melting)
      EXPECT_THAT(said, Contains(HasSubstr(takes + "of 'green_sand', which does not freeze"))) << name;
    else
      EXPECT_THAT(said, Not(Contains(HasSubstr(takes)))) << name;
    named += needs.mechanics || needs.melting ? 1 : 0;
  }
  EXPECT_GT(named, 25);
}

TEST_F(FindingsTest, CriteriaThatFollowNothingAreNamed) {
  EXPECT_THAT(said_of(with(k_casting, "[criteria]\nfollow = false\nfeeders = [\"upper_y_max\"]")),
              Contains(HasSubstr("the feeder 'upper_y_max' has no effect")));
  EXPECT_THAT(said_of(with(k_casting, "[criteria]\nfeeding_limit = 0.05")),
              Contains(HasSubstr("criteria.feeding_limit = 0.05")));
  EXPECT_THAT(said_of(with(k_casting, "[criteria]\nevaluation = 0.9")),
              Contains(HasSubstr("criteria.evaluation = 0.9")));
}

}  // namespace
