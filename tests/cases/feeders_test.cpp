/// Risers with necks and sleeves, and chills, on a STEP file; files of them.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

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

// The file is read by itself, as a CAD program would.
TEST(Feeders, SolidsAreWrittenWithNecksAndHollowSleeves) {
  solidus::new_case::Draft draft;
  solidus::new_case::DraftRiser& riser = draft.risers.emplace_back();
  riser.foot = {0.03, 0.03, 0.028};
  riser.diameter = 0.03, riser.height = 0.047;
  riser.neck_diameter = 0.02, riser.neck_height = 0.007;
  riser.sleeve = 0.005;
  draft.chills.push_back({"chill", {0.01, 0.01, -0.01}, {0.03, 0.03, 0.001}});
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
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_NEAR(volumes[0], 4.4, 1e-4);
  EXPECT_NEAR(volumes[1], sleeve, 0.1 * sleeve);
  EXPECT_NEAR(volumes[2], metal, 0.05 * metal);
  EXPECT_FALSE(fs::exists(file.string() + ".geo"));
}

/// What is reported of a file with these lines.
std::string refusal(const std::string& text) {
  fs::create_directories(root());
  std::ofstream(root() / "feeders.toml") << text;
  try {
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
  EXPECT_THAT(refusal(riser + riser), HasSubstr("two risers or chills have the name 'riser'"));
  EXPECT_THAT(refusal(riser + "width = \"3 mm\"\n"), HasSubstr("unknown key 'width'"));
  EXPECT_THAT(
      refusal(
          "[[chill]]\nlowest = [\"0 mm\", \"0 mm\", \"0 mm\"]\nhighest = [\"1 mm\", \"1 mm\", \"0 mm\"]\n"),
      HasSubstr("'highest' is 0 m in z"));
}

}  // namespace
