/// From the case to what the phases are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_keys.hpp"
#include "coupling/simulation.hpp"
#include "setup/case_file.hpp"
#include "setup/contact_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/mesh_checks.hpp"
#include "setup/mesh_input.hpp"
#include "setup/run_input.hpp"
#include "setup/time_input.hpp"

namespace solidus::setup {
namespace {

using ::testing::HasSubstr;

const std::string k_mould = R"(title = "A cylinder in its mould"
[analysis]
kind = "axisymmetric"
gravity = "9.81 m/s2"
[mesh]
shape = "cylinder_in_mould"
element = "quad4"
[mesh.cylinder_in_mould]
radius = "10 mm"
height = "20 mm"
mould_wall = "10 mm"
mould_bottom = "10 mm"
mould_height = "30 mm"
element_size = "5 mm"
mould_element_size = "5 mm"
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "part"
material = "a"
initial_temperature = "670 degC"
[[body]]
name = "mould"
material = "b"
initial_temperature = "200 degC"
)";

cases::CaseSpec read(const std::string& more = "") {
  const cases::CaseSpec spec = cases::case_keys().read(parse_document(k_mould + more, "case.toml"));
  check_case(spec);
  return spec;
}

std::string error(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no InputError";
}

TEST(ModelInput, GravityPointsDownTheAxisUnlessSaidOtherwise) {
  EXPECT_DOUBLE_EQ(gravity(read().analysis)[1], -9.81);
  cases::AnalysisSpec solid;
  solid.kind = AnalysisKind::solid;
  solid.gravity = 2;
  EXPECT_DOUBLE_EQ(gravity(solid)[2], -2);
  solid.gravity_direction = {3, 0, 4};
  EXPECT_DOUBLE_EQ(gravity(solid)[0], 2 * 0.6);
  EXPECT_DOUBLE_EQ(gravity(solid)[2], 2 * 0.8);
}

TEST(ModelInput, InAxisymmetryTheAxialDisplacementIsTheSecondComponent) {
  const cases::CaseSpec spec = read(
      "[[mechanical_condition]]\nname = \"a\"\ngroup = \"mould_bottom\"\nkind = \"displacement\"\nuz = \"1 "
      "mm\"\n"
      "[[mechanical_condition]]\nname = \"b\"\ngroup = \"mould_outside\"\nkind = \"displacement\"\nur = \"2 "
      "mm\"\n"
      "[[mechanical_condition]]\nname = \"c\"\ngroup = \"part_top\"\nkind = \"pressure\"\npressure = \"3 "
      "MPa\"\n"
      "[[mechanical_condition]]\nname = \"d\"\ngroup = \"mould_top\"\nkind = \"traction\"\ntraction = [\"1 "
      "Pa\", { of = \"time\", "
      "argument_unit = \"s\", unit = \"Pa\", points = [[0, 0], [2, 4]] }]\n"
      "[[mechanical_condition]]\nname = \"e\"\ngroup = \"part_top\"\nkind = \"plane\"\n");
  const mechanics::MechanicalConditions c = mechanical_conditions(spec);
  ASSERT_EQ(c.displacements.size(), 2u);
  EXPECT_EQ(c.displacements[0].component, 1);
  EXPECT_DOUBLE_EQ(c.displacements[0].value.value(0), 1e-3);
  EXPECT_EQ(c.displacements[1].component, 0);
  EXPECT_DOUBLE_EQ(c.pressures[0].value.value(0), 3e6);
  EXPECT_DOUBLE_EQ(c.tractions[0].value[0].value(1), 1);
  EXPECT_DOUBLE_EQ(c.tractions[0].value[1].value(1), 2);
  EXPECT_DOUBLE_EQ(c.tractions[0].value[2].value(1), 0);
  ASSERT_EQ(c.plane_faces.size(), 1u);
  EXPECT_EQ(c.plane_faces[0].node_set, "part_top");
}

TEST(ModelInput, AFilmTableOfTemperatureIsToldFromOneOfTime) {
  const std::string head =
      "[[thermal_condition]]\nname = \"f\"\ngroup = \"mould_outside\"\nkind = \"film\"\nambient = \"20 "
      "degC\"\n";
  const auto film = [&](const std::string& of, const std::string& unit) {
    return thermal_conditions(read(head + "coefficient = { of = \"" + of + "\", argument_unit = \"" + unit +
                                   "\", unit = \"W/m2/K\", points = [[0, 5], [100, 15]] }\n"))
        .films[0];
  };
  EXPECT_FALSE(film("time", "s").coefficient.of_temperature);
  EXPECT_DOUBLE_EQ(film("time", "s").coefficient.table.value(50), 10);
  EXPECT_TRUE(film("temperature", "degC").coefficient.of_temperature);
  EXPECT_DOUBLE_EQ(film("temperature", "degC").coefficient.table.value(323.15), 10);
}

TEST(ModelInput, ContactTakesItsPenaltyAsANumberOrAsAFactor) {
  const std::string pair =
      "[[contact]]\nname = \"c\"\nslave = \"part_surface\"\nmaster = \"mould_surface\"\n";
  const contact::ContactParameters by_factor = contact_specs(read(pair + "penalty_factor = 20.0\n"))[0];
  EXPECT_TRUE(by_factor.penalty_is_factor);
  EXPECT_DOUBLE_EQ(by_factor.penalty, 20);
  EXPECT_TRUE(by_factor.nodal_heat);
  EXPECT_FALSE(by_factor.heat.has_value());
  const contact::ContactParameters absolute = contact_specs(
      read(pair + "penalty = \"5 N/mm3\"\n[contact.heat]\nconductance = \"2.3 N/mm/s/K\"\ngap_law = \"gas\"\n"
                  "gas_conductivity = \"0.026 W/m/K\"\n[heat]\nintegration = \"open\"\n"))[0];
  EXPECT_FALSE(absolute.penalty_is_factor);
  EXPECT_DOUBLE_EQ(absolute.penalty, 5e9);
  EXPECT_DOUBLE_EQ(contact::HeatTransferLaw(*absolute.heat).at(0, 0, 300).value, 2300);
  EXPECT_FALSE(absolute.nodal_heat);
}

TEST(ModelInput, WearIsSharedOnlyWhereTheCaseSaysWhichSurfaceIsTheMaster) {
  const std::string wear =
      "[contact.heat]\nconductance = \"1 N/mm/s/K\"\ngap_law = \"constant\"\n[contact.friction]\ncoefficient "
      "= "
      "0.2\n[contact.wear]\narchard = 1e-4\nhardness = \"1 GPa\"\n"
      "master_share = 0.3\n";
  const std::string named =
      "[[contact]]\nname = \"c\"\nslave = \"part_surface\"\nmaster = \"mould_surface\"\n";
  EXPECT_EQ(contact_specs(read(named + wear))[0].wear->master_share, 0.3);
  const std::string chosen = "[[contact]]\nname = \"c\"\nsurfaces = [\"part_surface\", \"mould_surface\"]\n";
  EXPECT_THROW(contact_specs(read(chosen + wear)), InputError);
}

TEST(ModelInput, TheSplitChoosesWhatTheMechanicalPhaseHolds) {
  using mechanics::Mapping;
  EXPECT_EQ(mechanics_options(read()).mapping, Mapping::isentropic);
  EXPECT_EQ(mechanics_options(read("[coupling]\nscheme = \"isothermal\"\n")).mapping, Mapping::isothermal);
  const std::string isentropic = "[coupling]\nscheme = \"isentropic\"\n";
  EXPECT_EQ(mechanics_options(read(isentropic)).mapping, Mapping::isentropic);
  cases::CaseSpec alone = read(isentropic);
  alone.analysis.physics = cases::Physics::mechanics;
  EXPECT_EQ(mechanics_options(alone).mapping, Mapping::isothermal);
  EXPECT_EQ(mechanics_options(read(isentropic + "structural_heating = \"none\"\n")).mapping,
            Mapping::isothermal);
}

TEST(ModelInput, OutputTimesAreTheListAndTheMultiples) {
  const coupling::TimeOptions t = time_options(read("[output]\nevery = \"4 s\"\ntimes = [\"1 s\"]\n"));
  EXPECT_THAT(t.output_times, ::testing::ElementsAre(1.0, 4.0, 8.0));
  EXPECT_DOUBLE_EQ(t.end, 10);
}

TEST(ModelInput, ProbesKnowBodyComponentAndTerms) {
  const std::string at =
      "field = \"displacement\"\ncomponent = \"r\"\npoint = [\"10 mm\", \"5 mm\"]\nunit = \"mm\"\n";
  const auto found = probes(
      read("[[probe]]\nname = \"a\"\nbody = \"mould\"\n" + at + "[[probe]]\nname = \"b\"\nbody = \"part\"\n" +
           at + "[[probe]]\nname = \"gap\"\nkind = \"difference\"\nof = [\"a\", \"b\"]\nunit = \"mm\"\n"));
  const auto& point = std::get<results::PointProbe>(found[0]);
  EXPECT_EQ(point.body, 1);
  EXPECT_EQ(point.component, 0);
  EXPECT_DOUBLE_EQ(point.at[0], 0.01);
  const auto& gap = std::get<results::LinearProbe>(found[2]);
  EXPECT_EQ(gap.terms[1], (std::pair<double, std::string>(-1.0, "b")));
  EXPECT_THAT(error([&] {
                read(
                    "[[probe]]\nname = \"a\"\nfield = \"temperature\"\ncomponent = \"x\"\npoint = [\"0 m\", "
                    "\"0 m\"]\nunit = \"K\"\n");
              }),
              HasSubstr("case.toml:27"));
}

TEST(ModelInput, TheBuiltInShapeHasTheGroupsTheGuideNames) {
  const mesh::RawMesh mesh = raw_mesh(read());
  for (const char* group :
       {"part", "mould", "part_surface", "mould_surface", "part_top", "mould_outside", "mould_bottom"})
    EXPECT_TRUE(mesh.groups.contains(group)) << group;
}

TEST(ModelInput, LayersOnTheMouldAreMadeAndTheirMistakesAreNamed) {
  const auto layers = [](const std::string& surface, const std::string& body, int number) {
    return "[[mesh.layers]]\nname = \"sand\"\nsurface = \"" + surface + "\"\nbody = \"" + body +
           "\"\nnumber = " + std::to_string(number) + "\nfirst = \"0.2 mm\"\n";
  };
  const std::size_t plain = raw_mesh(read()).x.size();
  EXPECT_EQ(raw_mesh(read(layers("mould_surface", "mould", 0))).x.size(), plain);
  const std::size_t one = raw_mesh(read(layers("mould_surface", "mould", 1))).x.size();
  EXPECT_GT(one, plain);
  EXPECT_EQ(raw_mesh(read(layers("mould_surface", "mould", 3))).x.size() - plain, 3 * (one - plain));
  EXPECT_THAT(error([&] { raw_mesh(read(layers("mold_surface", "mould", 1))); }),
              HasSubstr("did you mean 'mould_surface'?"));
  EXPECT_THAT(error([&] { raw_mesh(read(layers("part_surface", "mould", 1))); }),
              HasSubstr("are not faces of the body 'mould'"));
  EXPECT_THAT(error([&] { read(layers("mould_surface", "mould", 1) + layers("mould_surface", "mould", 2)); }),
              HasSubstr("the name 'sand' is used by two [[mesh.layers]] sections"));
}

TEST(ModelInput, GroupsOfTheWrongDimensionAreRefused) {
  const auto with_group = [](const std::string& group) {
    return error([&] {
      raw_mesh(read("[[thermal_condition]]\nname = \"f\"\ngroup = \"" + group +
                    "\"\nkind = \"flux\"\nflux = \"1 W/m2\"\n"));
    });
  };
  EXPECT_EQ(with_group("mould_top"), "no InputError");
  EXPECT_THAT(with_group("mould"), HasSubstr("'mould' is a body"));
  EXPECT_THAT(with_group("mold_top"), HasSubstr("did you mean 'mould_top'?"));
}

}  // namespace
}  // namespace solidus::setup
