// Meshes of Medit (.mesh), as Gmsh and others write them.
#include "mesh/files/medit_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string write_medit(const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("medit_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mesh.mesh") << text;
  return (folder / "mesh.mesh").string();
}

RawMesh medit(const std::string& text) {
  const std::string file = write_medit(text);
  RawMesh raw = read_medit_file(file, 0.001);
  validate_and_orient(raw, file);
  return raw;
}

std::string complaint_of_medit(const std::string& text) {
  try {
    medit(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

const std::string k_head = "MeshVersionFormatted 2\nDimension\n3\n";
const std::string k_cube_corners =
    "Vertices\n8\n0 0 0 1\n2 0 0 1\n2 2 0 1\n0 2 0 1\n0 0 2 1\n2 0 2 1\n2 2 2 1\n0 2 2 1\n";
const std::string k_tetrahedron_of_ten =
    "Vertices\n10\n0 0 0 0\n2 0 0 0\n0 2 0 0\n0 0 2 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n0 1 1 "
    "0\n";

TEST(MeditFile, NumbersBehindTheNodesAreBodiesAndSurfaces) {
  const RawMesh raw = medit(k_head + "# a comment\n" + k_cube_corners +
                            "Quadrilaterals 1\n1 2 3 4 9\nHexahedra\n1\n1 2 3 4 5 6 7 8 7\n"
                            "RequiredVertices\n1\n3\nEnd\n");
  EXPECT_EQ(raw.dimension, 3);
  EXPECT_THAT(raw.notes, IsEmpty());
  ASSERT_EQ(raw.groups.size(), 2u);
  EXPECT_EQ(raw.groups.at("body_7").blocks.at(0).shape, Shape::hex8);
  EXPECT_EQ(raw.groups.at("surface_9").blocks.at(0).shape, Shape::quad4);
  EXPECT_NEAR(raw.x[6][2], 0.002, 1e-15);
}

TEST(MeditFile, APlaneMeshMayHaveTwoCoordinates) {
  const RawMesh raw = medit(
      "MeshVersionFormatted 1\nDimension 2\nVertices 3\n0 0 1\n1 0 1\n0 1 1\nEdges 1\n1 2 4\n"
      "Triangles 1\n1 2 3 1\nEnd\n");
  EXPECT_EQ(raw.groups.at("body_1").dimension, 2);
  EXPECT_EQ(raw.groups.at("surface_4").dimension, 1);
}

// Their order puts (1, 3) before (2, 3), where Gmsh's own has them the other way round.
TEST(MeditFile, NodesAmidEdgesLieBetweenTheirCorners) {
  const RawMesh raw = medit(k_head + k_tetrahedron_of_ten + "TetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 1\nEnd\n");
  const RawBlock& block = raw.groups.at("body_1").blocks.at(0);
  ASSERT_EQ(block.shape, Shape::tet10);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto x = [&](int a) {
      return raw.x[static_cast<std::size_t>(block.nodes[static_cast<std::size_t>(a)])][i];
    };
    EXPECT_NEAR(x(8), (x(2) + x(3)) / 2, 1e-15);
    EXPECT_NEAR(x(9), (x(1) + x(3)) / 2, 1e-15);
  }
}

// So does Gmsh write a mesh that was raised by setOrder(2).
TEST(MeditFile, SecondOrderUnderAKeywordOfFirstOrderIsRefused) {
  EXPECT_THAT(
      complaint_of_medit(k_head + k_tetrahedron_of_ten + "Tetrahedra\n1\n1 2 3 4 5 6 7 8 9 10 1\nEnd\n"),
      AllOf(HasSubstr(":18"), HasSubstr("Tetrahedra has 11 numbers"), HasSubstr("4 nodes"),
            HasSubstr("second order")));
  EXPECT_THAT(complaint_of_medit(k_head + k_tetrahedron_of_ten + "Triangles\n1\n1 2 3 5 6 7 1\nEnd\n"),
              AllOf(HasSubstr("Triangles has 7 numbers"), HasSubstr("3 nodes")));
  EXPECT_THAT(complaint_of_medit(k_head + k_cube_corners + "HexahedraQ2\n0\nEnd\n"),
              HasSubstr("HexahedraQ2"));
}

TEST(MeditFile, MistakesAreNamedWithTheirLine) {
  const std::string mesh = k_head + k_cube_corners;
  EXPECT_THAT(complaint_of_medit(mesh + "Tetrahedra\n1\n1 2 3 1\n"),
              AllOf(HasSubstr(":16"), HasSubstr("has 4 numbers")));
  EXPECT_THAT(complaint_of_medit(mesh + "Tetrahedra\n1\n1 2 3 99 1\n"), HasSubstr("vertex 99"));
  EXPECT_THAT(complaint_of_medit(mesh + "Tetrahedra\n2\n1 2 4 5 1\n"), HasSubstr("the file ends within"));
  EXPECT_THAT(complaint_of_medit(mesh + "Tetrahedra\nmany\n"), HasSubstr("'many'"));
  EXPECT_THAT(complaint_of_medit(mesh), HasSubstr("no triangles"));
  EXPECT_THAT(complaint_of_medit(k_head + "Vertices\n1\n0 0 1\n"), HasSubstr("3 coordinates"));
  EXPECT_THAT(medit(mesh + "Tetrahedra\n1\n1 2 4 5 1\nColours\n1\n3\nEnd\n").notes,
              ElementsAre(HasSubstr("Colours")));
}

}  // namespace
