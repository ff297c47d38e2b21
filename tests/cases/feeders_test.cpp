/// Risers with necks and sleeves, and chills, on a STEP file; files of them.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>

#include "case_run.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/hot_spots.hpp"
#include "new_case/feeder_solids.hpp"
#include "new_case/feeders_file.hpp"
#include "new_case/new_case.hpp"

namespace {

namespace fs = std::filesystem;
namespace mesh = solidus::mesh;
using ::testing::HasSubstr;

constexpr double k_pi = std::numbers::pi;

fs::path root() {
  return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "feeders";
}

/// A block of 60 x 60 x 30 mm.
fs::path block() {
  fs::create_directories(root());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("block");
  gmsh::model::occ::addBox(0, 0, 0, 60, 60, 30);
  gmsh::model::occ::synchronize();
  gmsh::write((root() / "block.step").string());
  gmsh::finalize();
  return root() / "block.step";
}

double volume(const mesh::RawMesh& raw, const std::string& body) {
  return mesh::extent_of(raw, body).volume;
}

/// A riser of 30 mm with a neck of 20 mm, in a sleeve of 5 mm, and a chill in a corner below the block.
mesh::CastingGeometry with_riser_and_chill() {
  mesh::CastingGeometry geometry;
  geometry.risers.push_back({"riser", {0.03, 0.03, 0.028}, 0.03, 0.047, 0.02, 0.007});
  geometry.risers.back().sleeve = 0.005;
  geometry.chills.push_back({"chill", {0.01, 0.01, -0.01}, {0.03, 0.03, 0.001}});
  return geometry;
}

TEST(Feeders, RisersWithNeckAndSleeveAndChillsHaveTheVolumesOfTheirShapes) {
  const mesh::RawMesh raw = mesh::mesh_casting({block().string(), 1e-3}, with_riser_and_chill(), 0);
  EXPECT_NEAR(volume(raw, "body_1"), 108e-6, 1e-9);  // the part keeps what overlaps
  const double neck = k_pi / 4 * 0.02 * 0.02 * 0.005, above = k_pi / 4 * 0.03 * 0.03 * 0.04;
  constexpr double k_facets = 0.04;
  EXPECT_NEAR(volume(raw, "riser"), neck + above, k_facets * (neck + above));
  const double sleeve = k_pi / 4 * (0.04 * 0.04 - 0.03 * 0.03) * 0.04;
  EXPECT_NEAR(volume(raw, "riser_sleeve"), sleeve, 3 * k_facets * sleeve);
  EXPECT_NEAR(volume(raw, "chill"), 4e-6, 1e-10);
}

TEST(Feeders, ARiserBesideThePartIsOneWithItsNeck) {
  mesh::CastingGeometry geometry;
  geometry.risers.push_back({"riser", {0.09, 0.03, 0}, 0.03, 0.045, 0.01, 0});
  geometry.risers.back().neck_to = mesh::Point{0.05, 0.03, 0.02};
  const mesh::RawMesh raw = mesh::mesh_casting({block().string(), 1e-3}, geometry, 0);
  // The neck is seen between the part, 60 mm, and the riser, 75 mm and a little less around its middle.
  const double riser = k_pi / 4 * 0.03 * 0.03 * 0.045, neck = k_pi / 4 * 0.01 * 0.01 * 0.015;
  EXPECT_GT(volume(raw, "riser"), 0.96 * (riser + neck));
  EXPECT_LT(volume(raw, "riser"), riser + 1.1 * neck);
}

/// Gating on the face x = 60 mm of the block, whose runner leads away at a slope of three in four.
mesh::GatingSystem gating_at_an_angle() {
  return {"gating", {0.06, 0.03, 0.008}, 0.02, 0.008, 0.012, 0.016, 0.016, {0.1, 0.06, 0.08}, 0.012, 0.02};
}

/// Volumes of ingate, runner and the cone of the sprue, which stands in the runner [cm3].
double volume_of_gating() {
  const auto frustum = [](double height, double first, double second) {
    return k_pi * height / 3 * (first * first + first * second + second * second);
  };
  const double at_roof = 6 + 4 * 16.0 / 76;  // radius of the sprue where the runner ends
  return 1e-3 * (20 * 8 * 12 + 16 * 16 * (50 + 8 - 12) + frustum(76, 6, 10) - frustum(16, 6, at_roof));
}

TEST(Feeders, GatingHasTheVolumesOfIngateRunnerAndSprueOutsideOfThePart) {
  mesh::CastingGeometry geometry;
  geometry.gatings.push_back(gating_at_an_angle());
  const mesh::RawMesh raw = mesh::mesh_casting({block().string(), 1e-3}, geometry, 0);
  EXPECT_NEAR(volume(raw, "body_1"), 108e-6, 1e-9);  // the part keeps what overlaps
  // A corner of the ingate is within the part: a triangle with sides of 10 and 7.5 mm.
  const double outside = volume_of_gating() - 1e-3 * 0.5 * 10 * 7.5 * 8;
  constexpr double k_facets = 0.02;
  EXPECT_NEAR(1e6 * volume(raw, "gating"), outside, k_facets * outside);
}

// The file is read by itself, as a CAD program would.
TEST(Feeders, SolidsAreWrittenWithNecksAndHollowSleeves) {
  solidus::new_case::Draft draft;
  solidus::new_case::DraftRiser& riser = draft.risers.emplace_back();
  riser.foot = {0.03, 0.03, 0.028};
  riser.diameter = 0.03, riser.height = 0.047;
  riser.neck_diameter = 0.02, riser.neck_height = 0.007;
  riser.sleeve = 0.005;
  draft.chills.push_back({"chill", {0.01, 0.01, -0.01}, {0.03, 0.03, 0.001}});
  draft.gatings.push_back(gating_at_an_angle());
  fs::create_directories(root());
  const fs::path file = root() / "solids.step";
  fs::remove(file);
  solidus::new_case::write_feeder_solids(draft, file);
  const mesh::RawMesh raw = mesh::mesh_casting({file.string(), 1e-3}, {}, 0);
  std::vector<double> volumes;
  for (const auto& [name, group] : raw.groups)
    if (group.dimension == 3) volumes.push_back(1e6 * volume(raw, name));
  std::ranges::sort(volumes);
  const double sleeve = k_pi / 4 * (40 * 40 - 30 * 30) * 0.04,
               metal = k_pi / 4 * (20 * 20 * 0.007 + 30 * 30 * 0.04);
  ASSERT_EQ(volumes.size(), 4U);
  EXPECT_NEAR(volumes[0], 4.4, 1e-4);
  EXPECT_NEAR(volumes[1], sleeve, 0.1 * sleeve);
  EXPECT_NEAR(volumes[2], volume_of_gating(), 0.02 * volume_of_gating());
  EXPECT_NEAR(volumes[3], metal, 0.05 * metal);
  EXPECT_FALSE(fs::exists(file.string() + ".geo"));
}

/// What is reported of a file with these lines.
std::string refusal(const std::string& text) {
  fs::create_directories(root());
  std::ofstream(root() / "feeders.toml") << text;
  try {
    if (text.starts_with("[[gating]]"))
      solidus::new_case::read_gating(root() / "feeders.toml");
    else
      solidus::new_case::read_feeders(root() / "feeders.toml");
  } catch (const solidus::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Feeders, WhatNoSolidCanBeMadeOfIsRefusedWithItsPlace) {
  const std::string riser =
      "[[riser]]\nfoot = [\"0 mm\", \"0 mm\", \"0 mm\"]\ndiameter = \"30 mm\"\nheight = \"40 mm\"\n";
  EXPECT_EQ(refusal(riser), "");
  EXPECT_THAT(refusal(riser + "neck_diameter = \"31 mm\"\nneck_height = \"5 mm\"\n"),
              HasSubstr("wider than the riser"));
  EXPECT_THAT(refusal(riser + "neck_height = \"40 mm\"\n"), HasSubstr("feeders.toml:1"));
  EXPECT_THAT(refusal(riser + "neck_diameter = \"20 mm\"\n"), HasSubstr("without 'neck_height'"));
  EXPECT_THAT(refusal(riser + "neck_to = [\"0 mm\", \"0 mm\", \"0 mm\"]\n"),
              HasSubstr("without 'neck_diameter'"));
  EXPECT_THAT(refusal(riser + riser), HasSubstr("two of risers, gating and chills have the name 'riser'"));
  EXPECT_THAT(refusal(riser + "width = \"3 mm\"\n"), HasSubstr("unknown key 'width'"));
  EXPECT_THAT(
      refusal(
          "[[chill]]\nlowest = [\"0 mm\", \"0 mm\", \"0 mm\"]\nhighest = [\"1 mm\", \"1 mm\", \"0 mm\"]\n"),
      HasSubstr("'highest' is 0 m in z"));
}

TEST(Feeders, ANewCaseHasItsGatingAsAPouredBodyThatIsOpenAtItsTop) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = block();
  options.alloy = "aluminium_alsi7mg";
  options.fineness = 0.5;
  options.folder = root() / "gated";
  options.gating = root() / "gating.toml";
  fs::remove_all(options.folder);
  std::ofstream(options.gating)
      << "[[gating]]\nname = \"gating_1\"\ngate = [\"58 mm\", \"30 mm\", \"8 mm\"]\n"
         "gate_size = [\"20 mm\", \"8 mm\"]\ngate_length = \"14 mm\"\nrunner_size = [\"16 mm\", \"16 mm\"]\n"
         "sprue = [\"100 mm\", \"30 mm\", \"80 mm\"]\nfoot_diameter = \"12 mm\"\ntop_diameter = \"20 mm\"\n";
  // The mould ends at the top of the sprue, 80 mm high, and has walls on its other sides.
  options.preview = true;
  const std::string ahead = solidus::new_case::make_new_case(options).text;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      ahead, found,
      std::regex(R"rx("high": \[([^,]+), [^,]+, ([^\]]+)\], "walls": \[([^,]+), ([^,]+), .*, 0\])rx")))
      << ahead;
  EXPECT_NEAR(std::stod(found[2]), 0.08, 1e-9);
  EXPECT_NEAR(std::stod(found[1]), 0.11 + std::stod(found[4]), 1e-9);  // the sprue is 20 mm wide at 100 mm
  EXPECT_FALSE(fs::exists(options.folder));
  options.preview = false;
  const solidus::new_case::NewCaseReport report = solidus::new_case::make_new_case(options);
  EXPECT_THAT(report.text, HasSubstr("areas of sprue, runner and ingate 1 : 2.3 : 1.4"));
  const solidus::setup::Case c = solidus::setup::load_case(
      report.file, {"time.end=\"3 s\"", "time.step=\"1 s\""}, solidus::cases::Physics::heat);
  const auto body = std::ranges::find(c.spec.bodies, "gating_1", &solidus::cases::BodySpec::name);
  ASSERT_NE(body, c.spec.bodies.end());
  EXPECT_EQ(body->role, solidus::cases::Role::gating);
  EXPECT_NE(std::ranges::find(c.spec.thermal_conditions, "radiation_of_gating_1",
                              &solidus::cases::ThermalConditionSpec::name),
            c.spec.thermal_conditions.end());
  solidus::run::RunOptions run;
  run.folder = root() / "gated_results";
  const solidus::run::RunResult result = solidus::run::run_case(c, run);
  EXPECT_TRUE(result.finished) << result.reason;
}

TEST(Feeders, GatingThatCannotBeDrawnIsRefusedWithItsReason) {
  const auto gating = [](const std::string& sprue, const std::string& size) {
    return "[[gating]]\ngate = [\"0 mm\", \"0 mm\", \"10 mm\"]\ngate_size = " + size +
           "\ngate_length = \"20 mm\"\nrunner_size = [\"20 mm\", \"25 mm\"]\nsprue = " + sprue +
           "\nfoot_diameter = \"10 mm\"\ntop_diameter = \"15 mm\"\n";
  };
  const std::string size = "[\"20 mm\", \"10 mm\"]", sprue = "[\"40 mm\", \"0 mm\", \"80 mm\"]";
  EXPECT_EQ(refusal(gating(sprue, size)), "");
  EXPECT_THAT(refusal(gating("[\"24 mm\", \"0 mm\", \"80 mm\"]", size)), HasSubstr("have no room"));
  // The runner lies on the floor of the ingate, 5 mm, and is 25 mm high.
  EXPECT_THAT(refusal(gating("[\"40 mm\", \"0 mm\", \"29 mm\"]", size)),
              HasSubstr("the sprue ends at 0.029 m, and the runner reaches 0.03 m"));
  EXPECT_THAT(refusal(gating("[\"40 mm\", \"0 mm\"]", size)), HasSubstr("'sprue' has 2 coordinates"));
  EXPECT_THAT(refusal(gating(sprue, "[\"20 mm\"]")), HasSubstr("'gate_size' is no width and height"));
}

}  // namespace
