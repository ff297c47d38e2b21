/// Shapes that Gmsh cannot mesh as they are, or only with poor elements: what the program does, and what it
/// says.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/reader_process.hpp"
#include "mesh/making/worst_tetrahedron.hpp"
#include "mesh/quality.hpp"
#include "new_case/new_case.hpp"

namespace {

namespace fs = std::filesystem;
namespace mesh = solidus::mesh;
namespace occ = gmsh::model::occ;
using ::testing::HasSubstr;

/// A STEP file of solids that `draw` makes by Gmsh's OpenCASCADE kernel, in mm.
std::string step_file(const std::string& name, const std::function<void()>& draw) {
  const fs::path folder = fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "difficult_shapes";
  fs::create_directories(folder);
  const std::string file = (folder / (name + ".step")).string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add(name);
  draw();
  occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

/// A drum of 120 mm with an outlet whose side is tangent to it and a rib next to the seam of its face, which
/// Gmsh 4.8 refuses: "Impossible to mesh periodic surface".
std::string drum() {
  return step_file("drum", [] {
    const int drum = occ::addCylinder(0, 0, 0, 0, 0, 50, 60),
              outlet = occ::addCylinder(42, 0, 26, 0, 95, 0, 18), rib = occ::addBox(40, -1, 0, 30, 2, 40);
    occ::rotate({{3, rib}}, 0, 0, 0, 0, 0, 1, 0.13);
    gmsh::vectorpair all;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, drum}}, {{3, outlet}, {3, rib}}, all, map);
  });
}

double volume(const mesh::RawMesh& raw, const std::string& group) {
  for (const mesh::GroupReport& report : mesh::assess(raw).groups)
    if (report.name == group) return report.measure;
  return 0;
}

mesh::CastingGeometry in_a_mould(int way) {
  mesh::CastingGeometry geometry;
  geometry.sizes = {{"body_1", 12e-3, 6e-3}, {"mould", 25e-3, 12e-3, 0}};
  geometry.mould = mesh::MouldBlock{"mould", "core", {0.02, 0.02, 0.02, 0.02, 0.02, 0.02}};
  geometry.attempt = way;
  return geometry;
}

TEST(DifficultShapes, AnErrorOfGmshInASurfaceNamesTheFaceByItsBodyAndPlace) {
  const mesh::MeshSource source{drum(), 1e-3};
  const mesh::CastingGeometry geometry = in_a_mould(0);
  try {
    mesh::read_in_one_way(source, &geometry);
    GTEST_SKIP() << "this version of Gmsh meshes it, as 4.13 does";
  } catch (const solidus::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Impossible to mesh periodic surface"));
    EXPECT_THAT(error.what(), HasSubstr("at fault: a face of 'body_1' around (0, 0, 25)"));
  }
}

/// A yoke with a pin in its bores and another through its base, which are not cut out of it.
std::string pins_in_a_yoke(bool with_boss) {
  return step_file(with_boss ? "pins_in_a_yoke_with_boss" : "pins_in_a_yoke", [&] {
    const int base = occ::addBox(-60, -30, 0, 120, 60, 12);
    gmsh::vectorpair others{{3, occ::addBox(-55, -30, 12, 15, 60, 45)},
                            {3, occ::addBox(40, -30, 12, 15, 60, 45)}},
        all;
    if (with_boss) {
      others.emplace_back(3, occ::addCylinder(0, 0, 12, 0, 0, 20, 18));
      others.emplace_back(3, occ::addBox(-42, -4, 12, 84, 8, 14));
    }
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, base}}, others, all, map);
    occ::addCylinder(-60, 0, 45, 120, 0, 0, 13);
    occ::addCylinder(0, 0, -1, 0, 0, 40, 9);
  });
}

/// A block with a pin that reaches 10 mm deep in it and is not cut out.
std::string sunk_in_pin() {
  return step_file("sunk_in_pin", [] {
    occ::addBox(-30, -20, 0, 60, 40, 20);
    occ::addCylinder(0, 0, 10, 0, 0, 40, 12);
  });
}

TEST(DifficultShapes, BodiesThatOverlapAreSaidToDoSo) {
  std::string overlap;  // the program says it in a warning
  mesh::listen_to_outlook([&](const mesh::MeshingOutlook& outlook) { overlap = outlook.overlap; });
  const mesh::RawMesh raw = mesh::mesh_casting({pins_in_a_yoke(false), 1e-3}, in_a_mould(0));
  mesh::listen_to_outlook({});
  EXPECT_GT(volume(raw, "body_1"), 0);
  // A pin of 26 mm through two lugs of 15 mm.
  EXPECT_THAT(overlap, HasSubstr("'body_1' and 'body_2' have 15.7 cm3 in common"));
}

TEST(DifficultShapes, BodiesThatOverlapAreSaidToDoSoInWhateverWayTheyAreMeshed) {
  std::string overlap;
  mesh::CastingGeometry geometry;
  geometry.sizes = {{"body_1", 15e-3, 8e-3}};
  geometry.only_way = 1;
  mesh::listen_to_outlook([&](const mesh::MeshingOutlook& outlook) { overlap = outlook.overlap; });
  mesh::mesh_casting({sunk_in_pin(), 1e-3}, geometry);
  mesh::listen_to_outlook({});
  EXPECT_THAT(overlap, HasSubstr("'body_1' and 'body_2' have 4.52 cm3 in common"));
}

TEST(DifficultShapes, ANewCaseOfBodiesThatOverlapSaysSo) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = sunk_in_pin();
  options.alloy = "aluminium_alsi7mg";
  options.fineness = 0.5;
  options.folder = fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "difficult_shapes" / "sunk_in_pin";
  fs::remove_all(options.folder);
  EXPECT_THAT(solidus::new_case::make_new_case(options).text,
              HasSubstr("bodies of the geometry overlap: 'body_1' and 'body_2' have 4.52 cm3 in common"));
}

// Nine ways took a minute and said nine times that Gmsh had made no elements.
TEST(DifficultShapes, BodiesThatOverlapAreNamedWhereGmshCannotMeshThem) {
  try {
    mesh::mesh_casting({pins_in_a_yoke(true), 1e-3}, in_a_mould(0));
    ADD_FAILURE() << "meshed";
  } catch (const mesh::UnusableGeometry& error) {
    EXPECT_THAT(error.what(), HasSubstr("bodies overlap"));
    EXPECT_THAT(error.what(), HasSubstr("cm3 in common"));
  }
}

TEST(DifficultShapes, BodiesAreCutAlongTheSeamOfAFaceThatCannotBeMeshed) {
  const mesh::RawMesh raw = mesh::mesh_casting({drum(), 1e-3}, in_a_mould(0));
  double least = 1;
  for (const auto& [name, group] : raw.groups)
    for (const mesh::RawBlock& block : group.blocks)
      for (std::size_t e = 0; group.dimension == 3 && e < block.nodes.size(); e += 4)
        least = std::min(least, mesh::element_quality(raw, mesh::Shape::tet4, block.nodes.data() + e));
  EXPECT_GT(least, mesh::k_sound_quality);
  const double farthest = 0.07 * std::cos(0.13) + 0.001 * std::sin(0.13);  // the corner of the rib
  const double block = (0.06 + farthest + 0.04) * 0.195 * 0.09,
               drum_alone = std::numbers::pi * 0.06 * 0.06 * 0.05;
  EXPECT_NEAR(volume(raw, "body_1") + volume(raw, "mould"), block, 1e-6 * block);
  EXPECT_GT(volume(raw, "body_1"), drum_alone);
  EXPECT_LT(volume(raw, "body_1"), 1.3 * drum_alone);
}

TEST(DifficultShapes, TheWorstElementIsDescribedByItsBodyPlaceAndTheAngleAtWhichFacesMeet) {
  mesh::RawMesh raw;
  raw.dimension = 3;
  const double rise = std::tan(3 * std::numbers::pi / 180);
  raw.x = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {1, 0.5, rise}};
  raw.input_node = {1, 2, 3, 4};
  raw.groups["casting"] = {3, {{mesh::Shape::tet4, {0, 1, 2, 3}, {1}}}};
  mesh::validate_and_orient(raw, "wedge");
  EXPECT_EQ(mesh::worst_tetrahedron_text(raw),
            "in 'casting' around (500, 500, 13.1) mm, where its faces meet at 3 degrees");
}

}  // namespace
