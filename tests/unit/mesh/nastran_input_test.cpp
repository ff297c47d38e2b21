// Bulk data of Nastran, as programs and people write them.
#include "mesh/files/nastran_input.hpp"

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

std::string write_bulk(const std::string& text, const std::string& name = "bulk.bdf") {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("bulks_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

RawMesh bulk(const std::string& text) {
  const std::string file = write_bulk(text);
  RawMesh raw = read_nastran(file, 1);
  validate_and_orient(raw, file);
  return raw;
}

std::string complaint_of_bulk(const std::string& text) {
  try {
    bulk(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

double volume_of_body(const RawMesh& raw, const std::string& body) {
  return volume(distribute(raw, {body}, {}), AnalysisKind::solid);
}

const std::string k_bottom =
    "GRID           1          0.0000  0.0000  0.0000\n"
    "GRID           2          0.0400  0.0000  0.0000\n"
    "GRID           3          0.0400  0.0200  0.0000\n"
    "GRID           4          0.0000  0.0200  0.0000\n";
const std::string k_hexahedron =
    "CHEXA          1       1       1       2       3       4       5       6+\n"
    "+              7       8\n";

TEST(NastranInput, GridsInALocalSystemLieWhereTheSystemPutsThem) {
  const RawMesh raw = bulk(
      "BEGIN BULK\n"
      "CORD2R         1       0     0.0     0.0    0.03     0.0     0.0     1.0+\n"
      "+            1.0     0.0     0.0\n" +
      k_bottom +
      "GRID           5       1  0.0000  0.0000  0.0100\n"
      "GRID           6       1  0.0400  0.0000  0.0100\n"
      "GRID           7       1  0.0400  0.0200  0.0100\n"
      "GRID           8       1  0.0000  0.0200  0.0100\n" +
      k_hexahedron + "PSOLID         1       1\nENDDATA\n");
  EXPECT_NEAR(raw.x[6][2], 0.04, 1e-15);
  EXPECT_NEAR(volume_of_body(raw, "body_1"), 32e-6, 1e-15);
  EXPECT_THAT(raw.notes, IsEmpty());
}

TEST(NastranInput, FreeAndLargeFieldsAndNumbersWithoutAnEMeanTheSame) {
  const RawMesh raw = bulk(
      "GRID,1,,0.,0.,0.\nGRID,2,,4.-2,0.,0.\nGRID,3,,4.0D-2,.02,0.\nGRID,4,,0.,2.-2,0.\n"
      "GRID*                  5                              0.              0.\n"
      "*                    .04\n"
      "GRID*                  6                             .04              0.*A\n"
      "*A                 4.0-2\n"
      "GRID,7,0,+.04,.02,.04\nGRID,8,0,0.,.02,.04\n"
      "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n");
  EXPECT_NEAR(volume_of_body(raw, "body_1"), 32e-6, 1e-15);
}

TEST(NastranInput, SystemsOfEveryKindMayBeGivenInEachOther) {
  // System 1 is at x = 1; system 2, cylindrical, in it at y = 1 with its axis along x; system 3 is
  // spherical; system 4 is spanned by nodes 1, 2 and 3.
  const RawMesh raw = read_nastran(write_bulk("CORD2R,1,0,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\n"
                                              "CORD2C,2,1,0.,1.,0.,1.,1.,0.\n,0.,2.,0.\n"
                                              "CORD2S,3,0,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
                                              "GRDSET,,0\n"
                                              "GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,1.\nGRID,3,,0.,1.,0.\n"
                                              "CORD1R,4,1,2,3\n"
                                              "GRID,4,2,3.,90.,5.\nGRID,5,3,2.,90.,90.\nGRID,6,4,1.,2.,3.\n"
                                              "CTETRA,1,1,1,2,3,4\nCTETRA,2,1,1,2,3,6\n"),
                                   1);
  const auto expect = [&](std::size_t node, const Point& x) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(raw.x[node][i], x[i], 1e-12) << node << " " << i;
  };
  expect(3, {6, 1, 3});
  expect(4, {0, 2, 0});
  expect(5, {-2, 1, 3});
}

TEST(NastranInput, SystemsThatCannotBeAreRefused) {
  const std::string grid = "GRID,1,5,0.,0.,0.\n";
  EXPECT_THAT(complaint_of_bulk(grid), AllOf(HasSubstr("bulk.bdf:1"), HasSubstr("no coordinate system 5")));
  EXPECT_THAT(complaint_of_bulk(grid + "CORD2R,5,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"), HasSubstr("in itself"));
  EXPECT_THAT(complaint_of_bulk(grid + "CORD1R,5,1,2,3\nGRID,2,,0.,0.,1.\nGRID,3,,1.,0.,0.\n"),
              HasSubstr("a system of its own"));
  EXPECT_THAT(complaint_of_bulk(grid + "CORD2R,5,0,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\n"), HasSubstr("one line"));
  EXPECT_THAT(complaint_of_bulk("CORD3G,5,1\n"), AllOf(HasSubstr("bulk.bdf:1"), HasSubstr("CORD3G")));
}

TEST(NastranInput, NamesOfPropertiesComeFromCommentsAndSurfacesFromShells) {
  const std::string mesh =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nGRID,5,,1.,1.,1.\n"
      "CTETRA,1,7,1,2,3,4\nCTETRA,2,8,2,3,4,5\nCTRIA3,3,9,1,2,3\n";
  const RawMesh plain = bulk(mesh);
  EXPECT_EQ(plain.groups.at("body_7").dimension, 3);
  EXPECT_EQ(plain.groups.at("surface_9").dimension, 2);
  EXPECT_EQ(plain.groups.at("body_8").blocks.at(0).input_element, (InputNumbers{2}));
  const RawMesh named = bulk(
      "$ANSA_NAME_COMMENT;7;PSOLID;casting;\n$HMNAME COMP        8\"mould\"\n"
      "$ Femap Property 9 : outside\n" +
      mesh);
  EXPECT_TRUE(named.groups.contains("casting") && named.groups.contains("mould") &&
              named.groups.contains("outside"));
}

TEST(NastranInput, TheNodesOfQuadraticSolidsComeInOurOrder) {
  // Nastran numbers the mid nodes of CHEXA bottom, vertical, top.
  const std::array<std::array<int, 2>, 12> hex_edges{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}};
  const std::array<std::array<int, 2>, 6> tet_edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (const Shape shape : {Shape::hex20, Shape::tet10}) {
    const Rule reference = nodal_rule(shape);
    std::vector<Point> x;
    for (std::size_t a = 0; a < static_cast<std::size_t>(vertex_count(shape)); ++a)
      x.push_back(reference[a].xi);
    const auto add_mid = [&](const std::array<int, 2>& edge) {
      Point mid{};
      for (std::size_t i = 0; i < 3; ++i)
        mid[i] = 0.5 * (x[static_cast<std::size_t>(edge[0])][i] + x[static_cast<std::size_t>(edge[1])][i]);
      x.push_back(mid);
    };
    if (shape == Shape::hex20)
      for (const auto& edge : hex_edges) add_mid(edge);
    else
      for (const auto& edge : tet_edges) add_mid(edge);
    std::string text, element = shape == Shape::hex20 ? "CHEXA,1,1" : "CTETRA,1,1";
    std::size_t fields = 2;
    for (std::size_t a = 0; a < x.size(); ++a) {
      text += "GRID," + std::to_string(a + 1) + ",," + std::to_string(x[a][0]) + "," +
              std::to_string(x[a][1]) + "," + std::to_string(x[a][2]) + "\n";
      if (fields++ % 8 == 0) element += ",+\n+";
      element += "," + std::to_string(a + 1);
    }
    const RawMesh raw = read_nastran(write_bulk(text + element + "\n"), 1);
    const RawBlock& block = raw.groups.at("body_1").blocks.at(0);
    ASSERT_EQ(block.shape, shape);
    for (std::size_t a = 0; a < x.size(); ++a)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(raw.x[static_cast<std::size_t>(block.nodes[a])][i], reference[a].xi[i], 1e-6) << a;
  }
}

TEST(NastranInput, WhatIsNotReadIsSaidOrRefused) {
  const std::string nodes = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
  const std::string mesh = nodes + "CTETRA,1,7,1,2,3,4\n";
  EXPECT_THAT(
      bulk("SOL 101\nCEND\nTITLE = GRID, 5\nBEGIN BULK\n" + mesh + "RBE2,9,1,123,2,3\nMAT1,1,2.+5\n").notes,
      ElementsAre(AllOf(HasSubstr("RBE2"), HasSubstr("bulk.bdf:10"))));
  EXPECT_THAT(complaint_of_bulk(mesh + "CPENTA,2,1,1,2,3,4,1,2\n,5,6\n"),
              AllOf(HasSubstr(":6"), HasSubstr("CPENTA 2 is of second order")));
  EXPECT_THAT(complaint_of_bulk(nodes + "=,*(1),=,*(1.)\n"), AllOf(HasSubstr(":5"), HasSubstr("'='")));
  EXPECT_THAT(complaint_of_bulk("BEGIN SUPER=1\n" + mesh), HasSubstr("superelements"));
  EXPECT_THAT(complaint_of_bulk(nodes + "CTETRA,1,7,1,2,3\n"), HasSubstr("has 3 nodes"));
  EXPECT_THAT(complaint_of_bulk(nodes + "CTETRA,1,7,1,2,3,9\n"), HasSubstr("no GRID 9"));
  EXPECT_THAT(complaint_of_bulk("GRID,1,,0.,zero,0.\n"), AllOf(HasSubstr(":1"), HasSubstr("'zero'")));
  EXPECT_THAT(complaint_of_bulk(nodes + "GRID,4,,0.,0.,1.\n"), HasSubstr("defined twice"));
  EXPECT_THAT(complaint_of_bulk(nodes), HasSubstr("no triangles"));
}

/// meshio leaves the property out: each element would be a body of its own.
TEST(NastranInput, ElementsWithoutPropertyAreOneBody) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nGRID,5,,1.,1.,1.\n";
  const RawMesh several = bulk(nodes + "CTETRA,1,,1,2,3,4\nCTETRA,2,,2,3,4,5\nCTRIA3,7,,1,2,3\n");
  EXPECT_EQ(several.groups.at("body_without_property").blocks.at(0).input_element.size(), 2u);
  EXPECT_TRUE(several.groups.contains("surface_7"));
  EXPECT_THAT(several.notes, ElementsAre(HasSubstr("2 elements name no property: they are one body")));
  // A single one keeps the number that the format gives to it.
  EXPECT_TRUE(bulk(nodes + "CTETRA,4,,1,2,3,4\n").groups.contains("body_4"));
}

// Gmsh writes all nodes of its elements, whatever the format has.
TEST(NastranInput, MoreNodesThanTheFormatHasAreRefused) {
  std::string nodes, all;
  for (int i = 1; i <= 27; ++i) {
    nodes += "GRID," + std::to_string(i) + ",,0.,0.," + std::to_string(i) + ".\n";
    all += "," + std::to_string(i) + (i == 6 || i == 14 || i == 22 ? "\n" : "");
  }
  EXPECT_THAT(complaint_of_bulk(nodes + "CHEXA,1,1" + all + "\n"),
              AllOf(HasSubstr(":28"), HasSubstr("CHEXA 1 has more than 20 nodes"), HasSubstr("8 or 20")));
  EXPECT_THAT(complaint_of_bulk(nodes + "CTRIA3,1,1,1,2,3,4,5,6\n,7,8,9,10\n"),
              HasSubstr("CTRIA3 1 has more than 3 nodes"));
  EXPECT_THAT(complaint_of_bulk(nodes + "CQUAD9,1,1,1,2,3,4,5,6\n,7,8,9\n"), HasSubstr("'CQUAD9'"));
  // A system and an offset of a shell are no nodes.
  EXPECT_EQ(bulk("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nCTRIA3,1,1,1,2,3,4,0.5\n")
                .groups.at("body_1")
                .blocks.at(0)
                .shape,
            Shape::tri3);
}

TEST(NastranInput, AnIncludedFileIsReadBesideIt) {
  write_bulk("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n", "nodes.inc");
  EXPECT_EQ(bulk("INCLUDE 'nodes.inc'\nCTRIA3,1,1,1,2,3\n").groups.at("body_1").dimension, 2);
  EXPECT_THAT(complaint_of_bulk("INCLUDE 'bulk.bdf'\n"), HasSubstr("circles"));
}

}  // namespace
