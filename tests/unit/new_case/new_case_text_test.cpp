/// The case that `solidus new` writes: shots into a die.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_keys.hpp"
#include "cases/stage_input.hpp"
#include "new_case/new_case_text.hpp"
#include "setup/body_input.hpp"

namespace solidus::new_case {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Draft draft() {
  Draft d;
  d.geometry = "part.step";
  d.unit = "mm";
  d.process = "gravity_die";
  d.alloy = "aluminium_alsi7mg";
  d.bodies = {{.name = "casting",
               .group = "casting",
               .material = d.alloy,
               .comment = "",
               .role = cases::Role::casting,
               .start = 690},
              {.name = "core",
               .group = "core",
               .material = "furan_sand",
               .comment = "",
               .role = cases::Role::core,
               .start = 80},
              {.name = "die",
               .group = "die",
               .material = "h13_tool_steel",
               .comment = "",
               .role = cases::Role::die,
               .start = 250}};
  d.size = 0.005;
  d.smallest = 0.003;
  d.mould_size = 0.015;
  d.end = 200;
  d.every = 10;
  d.step = 0.5;
  d.films = {"die"};
  d.film = 20;
  d.cavity = {"die_to_casting"};
  return d;
}

TEST(NewCaseText, OfShotsHasStagesACycleAndSpray) {
  Draft d = draft();
  d.shots = {.number = 7,
             .pour = 5,
             .solidify = 90,
             .open = 5,
             .eject = 15,
             .spray = 0.25,
             .close = 10,
             .spray_film = 300,
             .spray_source = "a guess",
             .cooling = 0};
  cases::CaseSpec spec = cases::case_keys().read(parse_document(case_text(d), "case.toml"));
  cases::resolve_stages(spec);
  const std::vector<cases::StageRun> runs = cases::stage_runs(spec);
  ASSERT_EQ(runs.size(), 42u);
  EXPECT_EQ(runs.back().shot, 7);
  EXPECT_EQ(cases::first_step(*runs[4].stage, spec.time), 0.25);  // no longer than its stage
  EXPECT_THAT(cases::staying_bodies(spec), ElementsAre(0, 0, 1));
  EXPECT_THAT(setup::new_bodies(spec, runs, 6), ElementsAre(1, 1, 0));
  std::vector<std::string> names;
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    if (cases::holds(c.stages, &runs[4])) names.push_back(c.name);
  EXPECT_THAT(names, ElementsAre("air_on_die", "spray_on_die_to_casting"));
}

TEST(NewCaseText, OfShotsCoolsTheOutsideOfTheDieByWhatTheCastingsBring) {
  Draft d = draft();
  d.films = {"casting", "die"};
  DraftShots& shots = d.shots.emplace();
  shots.number = 10;
  shots.pour = shots.open = shots.spray = 5;
  shots.solidify = 90;
  shots.eject = shots.close = 15;
  shots.cooling = 120;
  const std::string text = case_text(d);
  EXPECT_THAT(text, HasSubstr("name = \"air_on_casting\"\ngroup = \"casting_free\"\nkind = \"film\"\n"
                              "coefficient = \"20 W/m2/K\""));
  EXPECT_THAT(text, HasSubstr("what keeps it at 250 degC in the mean\nname = \"cooling_of_die\"\n"
                              "group = \"die_free\"\nkind = \"film\"\ncoefficient = \"120 W/m2/K\""));
  shots.cooling = 5;  // air alone takes more
  EXPECT_THAT(case_text(d), HasSubstr("name = \"air_on_die\""));
}

TEST(NewCaseText, OfOneCastingHasNoStages) {
  const std::string text = case_text(draft());
  EXPECT_THAT(text, HasSubstr("end = \"200 s\""));
  EXPECT_THAT(text, HasSubstr("until = \"solid\""));
  const cases::CaseSpec spec = cases::case_keys().read(parse_document(text, "case.toml"));
  EXPECT_TRUE(spec.stages.empty());
  EXPECT_EQ(spec.thermal_conditions.size(), 1u);
}

TEST(NewCaseText, NamesTheWayOfMeshingWhereItHadToBeLookedFor) {
  Draft d = draft();
  EXPECT_EQ(cases::case_keys().read(parse_document(case_text(d), "case.toml")).mesh.way, 0);
  d.way = 5;
  EXPECT_EQ(cases::case_keys().read(parse_document(case_text(d), "case.toml")).mesh.way, 5);
}

TEST(NewCaseText, HasALayerSectionForEachWallAndSandThatGrowsSlowlyBehindThem) {
  Draft d = draft();
  d.layers = {{"core_on_casting", "core_to_casting", "core", 7, 1.2, 0.0015},
              {"core_on_riser", "core_to_riser", "core", 7, 1.2, 0.002}};
  const cases::CaseSpec spec = cases::case_keys().read(parse_document(case_text(d), "case.toml"));
  ASSERT_EQ(spec.mesh.layers.size(), 2U);
  EXPECT_EQ(spec.mesh.layers[1].surface, "core_to_riser");
  EXPECT_EQ(spec.mesh.layers[1].body, "core");
  EXPECT_EQ(spec.mesh.layers[1].number, 7);
  EXPECT_EQ(spec.mesh.layers[1].growth, 1.2);
  EXPECT_NEAR(*spec.mesh.layers[1].first, 0.002, 1e-12);
  for (const cases::MeshSizeSpec& size : spec.mesh.sizes) {
    if (size.body == "core") EXPECT_EQ(size.growth, 0.2);
    if (size.body == "die") EXPECT_EQ(size.growth, 0.6) << "without layers as before";
  }
}

TEST(NewCaseText, OfAMeshWithItsMouldAsksForNoElements) {
  Draft d = draft();
  d.meshed = true;
  const cases::CaseSpec spec = cases::case_keys().read(parse_document(case_text(d), "case.toml"));
  EXPECT_TRUE(spec.mesh.sizes.empty());
  EXPECT_FALSE(spec.mesh.mould);
}

}  // namespace
}  // namespace solidus::new_case
