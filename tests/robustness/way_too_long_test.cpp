/// A way of meshing that takes longer than it may is ended, said, and another one follows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "foreign_files.hpp"
#include "mesh/gmsh/import.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/kept_mesh.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/reader_process.hpp"
#include "system/program_path.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using namespace solidus;

constexpr double k_mm = 1e-3;

/// A box of 30 × 20 × 10 mm as a skin of triangles.
std::string box_of_triangles() {
  constexpr std::array<std::array<int, 3>, 12> k_faces = {{{0, 2, 1},
                                                           {0, 3, 2},
                                                           {4, 5, 6},
                                                           {4, 6, 7},
                                                           {0, 1, 5},
                                                           {0, 5, 4},
                                                           {1, 2, 6},
                                                           {1, 6, 5},
                                                           {2, 3, 7},
                                                           {2, 7, 6},
                                                           {3, 0, 4},
                                                           {3, 4, 7}}};
  constexpr std::array<std::array<int, 3>, 8> k_corners = {
      {{0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0}, {0, 0, 10}, {30, 0, 10}, {30, 20, 10}, {0, 20, 10}}};
  std::string text = "solid part\n";
  for (const auto& face : k_faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      const auto& x = k_corners[static_cast<std::size_t>(corner)];
      text +=
          "vertex " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid part\n";
}

/// Readers are those of a folder for a while, in which the first one never ends.
class WayTooLong : public tests::ForeignFiles {
 protected:
  void SetUp() override {
    ForeignFiles::SetUp();
    before_ = program_path();
    mesh::read_in_this_process(nullptr);
    set_program_path(folder_ / "solidus");
    const std::string met = (folder_ / "met").string();
    write("solidus-reader", "#!/bin/bash\nif [ ! -e '" + met + "' ]; then touch '" + met +
                                "'; while :; do :; done; fi\nexec '" SOLIDUS_BINARY_DIR "/solidus-reader'\n");
    fs::permissions(folder_ / "solidus-reader", fs::perms::owner_all);
    mesh::listen_to_progress([this](const std::string& text) { progress_.push_back(text); });
  }
  void TearDown() override {
    mesh::listen_to_progress({});
    set_program_path(before_);
    mesh::read_in_this_process(&mesh::read_mesh_here);
    ForeignFiles::TearDown();
  }

  fs::path before_;
  std::vector<std::string> progress_;
};

TEST_F(WayTooLong, IsEndedAndAnotherOneGivesTheMesh) {
  write("part.stl", box_of_triangles());
  mesh::KeptMesh kept;
  kept.search().time_of_direct_ways = 1;
  mesh::CastingGeometry geometry;
  geometry.sizes = {{.body = "part", .size = 5 * k_mm, .smallest = 5 * k_mm, .across = 0}};
  const mesh::RawMesh mesh =
      mesh::mesh_casting({.path = (folder_ / "part.stl").string(), .unit_in_metres = k_mm}, geometry);
  EXPECT_THAT(progress_, Contains(HasSubstr("took longer than 1 s and was ended; another way is tried")));
  ASSERT_TRUE(kept.search().way);
  EXPECT_NE(kept.search().way->number, 0);  // the first of all is the direct one
  EXPECT_GE(kept.search().way->quality, mesh::k_sound_quality);
  EXPECT_TRUE(mesh.groups.contains("part"));
  EXPECT_LE(kept.search().time_of_direct_ways, 0);
}

}  // namespace
