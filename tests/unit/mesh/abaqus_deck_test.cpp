// Keywords of Abaqus that make and move nodes and elements, parts and instances, and those that are not read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesh/files/abaqus_deck.hpp"
#include "mesh/files/abaqus_input.hpp"
#include "mesh/quality.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string write_deck(const std::string& text, const std::string& name = "deck.inp") {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("decks_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

/// The mesh of a deck in mm.
RawMesh deck(const std::string& text) {
  const std::string file = write_deck(text);
  RawMesh raw = read_abaqus_input(file, 0.001);
  validate_and_orient(raw, file);
  return raw;
}

std::string complaint(const std::string& text) {
  try {
    deck(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

/// [mm³]
double volume_of(const RawMesh& raw, const std::string& body) {
  return 1e9 * volume(distribute(raw, {body}, {}), AnalysisKind::solid);
}

/// The corners of the box around the nodes of a group [mm].
std::array<Point, 2> box_of(const RawMesh& raw, const std::string& group) {
  std::array<Point, 2> box{Point{1e9, 1e9, 1e9}, Point{-1e9, -1e9, -1e9}};
  for (const RawBlock& block : raw.groups.at(group).blocks)
    for (const Index n : block.nodes)
      for (std::size_t i = 0; i < 3; ++i) {
        box[0][i] = std::min(box[0][i], 1e3 * raw.x[static_cast<std::size_t>(n)][i]);
        box[1][i] = std::max(box[1][i], 1e3 * raw.x[static_cast<std::size_t>(n)][i]);
      }
  return box;
}

void expect_box(const RawMesh& raw, const std::string& group, const Point& low, const Point& high) {
  const auto box = box_of(raw, group);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(box[0][i], low[i], 1e-9) << group << " from, axis " << i;
    EXPECT_NEAR(box[1][i], high[i], 1e-9) << group << " to, axis " << i;
  }
}

/// A cube of 10 mm with nodes 1 to 8.
const std::string k_cube_nodes = R"(1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 10
6, 10, 0, 10
7, 10, 10, 10
8, 0, 10, 10
)";
const std::string k_cube =
    "*NODE, NSET=B\n" + k_cube_nodes + "*ELEMENT, TYPE=C3D8, ELSET=ONE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

TEST(AbaqusGeneration, RowsOfNodesAndElementsMakeABar) {
  const RawMesh raw = deck(R"(*NODE
1, 0, 0, 0
5, 40, 0, 0
11, 0, 10, 0
15, 40, 10, 0
101, 0, 0, 10
105, 40, 0, 10
111, 0, 10, 10
115, 40, 10, 10
*NGEN, NSET=FOOT
1, 5, 1
11, 15, 1
*NGEN
101, 105
111, 115, 1
*ELEMENT, TYPE=C3D8, ELSET=BAR
1, 1, 2, 12, 11, 101, 102, 112, 111
*ELGEN, ELSET=BAR
1, 4, 1, 1
)");
  EXPECT_EQ(raw.x.size(), 20u);
  EXPECT_THAT(raw.groups.at("BAR").blocks.at(0).input_element, (InputNumbers{1, 2, 3, 4}));
  EXPECT_NEAR(volume_of(raw, "BAR"), 4000, 1e-9);
  EXPECT_EQ(raw.groups.at("FOOT").blocks.at(0).nodes.size(), 10u);
  expect_box(raw, "FOOT", {0, 0, 0}, {40, 10, 0});
}

TEST(AbaqusGeneration, LayersOfElementsFillABlock) {
  // 3 x 2 x 2 cells of 10 mm: nodes rise by 1 along x, by 10 along y and by 100 along z.
  std::string text = "*NODE\n";
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i)
        text += std::to_string(1 + i + 10 * j + 100 * k) + "," + std::to_string(10 * i) + "," +
                std::to_string(10 * j) + "," + std::to_string(10 * k) + "\n";
  text += "*ELEMENT, TYPE=C3D8, ELSET=BLOCK\n1, 1, 2, 12, 11, 101, 102, 112, 111\n*ELGEN, ELSET=BLOCK\n";
  const RawMesh raw = deck(text + "1, 3, 1, 1, 2, 10, 10, 2, 100, 100\n");
  EXPECT_NEAR(volume_of(raw, "BLOCK"), 12000, 1e-9);
  EXPECT_THAT(raw.groups.at("BLOCK").blocks.at(0).input_element,
              (InputNumbers{1, 2, 3, 11, 12, 13, 101, 102, 103, 111, 112, 113}));
  EXPECT_THAT(complaint(text + "1, 4, 1, 1\n"), AllOf(HasSubstr("deck.inp:41"), HasSubstr("no node 5")));
}

TEST(AbaqusGeneration, LinesBetweenTwoSetsFillAPlate) {
  const RawMesh raw = deck(R"(*NODE
1, 0, 0
4, 30, 0
31, 0, 30
34, 30, 30
*NGEN, NSET=LOW
1, 4
*NGEN, NSET=HIGH
31, 34
*NFILL, NSET=ALL
LOW, HIGH, 3, 10
*ELEMENT, TYPE=CPE4, ELSET=PLATE
1, 1, 2, 12, 11
*ELGEN, ELSET=PLATE
1, 3, 1, 1, 3, 10, 10
)");
  EXPECT_EQ(raw.x.size(), 16u);
  EXPECT_EQ(raw.groups.at("ALL").blocks.at(0).nodes.size(), 16u);
  EXPECT_NEAR(1e6 * volume(distribute(raw, {"PLATE"}, {}), AnalysisKind::plane_strain), 900, 1e-9);
}

TEST(AbaqusGeneration, AnArcLiesOnItsCircle) {
  const RawMesh raw = deck(R"(*NODE
1, 10, 0
4, 0, 10
99, 0, 0
11, 20, 0
14, 0, 20
*NGEN, LINE=C
1, 4, 1, 99
11, 14, 1, , 0, 0, 0
*ELEMENT, TYPE=CPE4, ELSET=RING
1, 1, 11, 12, 2
*ELGEN, ELSET=RING
1, 3, 1, 1
)");
  // Three trapezia of 30 degrees between radii of 10 and 20 mm.
  EXPECT_NEAR(1e6 * volume(distribute(raw, {"RING"}, {}), AnalysisKind::plane_strain),
              3 * 0.5 * std::sin(std::acos(-1.0) / 6) * (400 - 100), 1e-9);
}

TEST(AbaqusGeneration, CopiesAreShiftedOrTurnedAndShareNoNodes) {
  const std::string copy = "*ELCOPY, ELEMENT SHIFT=100, OLD SET=ONE, SHIFT NODES=100, NEW SET=TWO\n";
  const RawMesh shifted = deck(k_cube +
                               "*NCOPY, CHANGE NUMBER=100, OLD SET=B, NEW SET=C, SHIFT\n0, 0, 10\n"
                               "0, 0, 0, 0, 0, 1, 0\n" +
                               copy);
  EXPECT_EQ(shifted.x.size(), 16u);
  expect_box(shifted, "ONE", {0, 0, 0}, {10, 10, 10});
  expect_box(shifted, "TWO", {0, 0, 10}, {10, 10, 20});
  EXPECT_NEAR(volume_of(shifted, "TWO"), 1000, 1e-9);
  const RawMesh turned = deck(k_cube +
                              "*NCOPY, CHANGE NUMBER=100, OLD SET=B, NEW SET=C, SHIFT\n0, 0, 0\n"
                              "20, 0, 0, 20, 0, 1, 90\n" +
                              copy);
  expect_box(turned, "TWO", {10, -20, 0}, {20, -10, 10});
  const RawMesh row =
      deck(k_cube + "*NCOPY, CHANGE NUMBER=100, OLD SET=B, NEW SET=C, SHIFT, MULTIPLE=3\n20, 0, 0\n" +
           "*ELCOPY, ELEMENT SHIFT=1, OLD SET=ONE, SHIFT NODES=300, NEW SET=LAST\n");
  expect_box(row, "LAST", {60, 0, 0}, {70, 10, 10});
}

TEST(AbaqusGeneration, WhatIsNotReadIsRefusedByNameAndLine) {
  for (const std::string keyword : {"NMAP", "REFLECTION", "PARAMETER", "IMPORT"})
    EXPECT_THAT(complaint(k_cube + "*" + keyword + ", NSET=B\n"),
                AllOf(HasSubstr("deck.inp:12"), HasSubstr("*" + keyword)));
  EXPECT_THAT(complaint(k_cube + "*NCOPY, CHANGE NUMBER=9, OLD SET=B, REFLECT=MIRROR\n0,0,0,1,0,0\n0,1,0\n"),
              AllOf(HasSubstr("deck.inp:12"), HasSubstr("'REFLECT'")));
  EXPECT_THAT(complaint(k_cube + "*NCOPY, CHANGE NUMBER=9, OLD SET=B, SHIFT\n1,0,0\n0,0,0,0,0,1,90\n"),
              HasSubstr("shifts and turns at once"));
  EXPECT_THAT(complaint(k_cube + "*NGEN, LINE=P\n1, 7, 2, 2\n"), HasSubstr("LINE=P"));
  EXPECT_THAT(complaint(k_cube + "*NGEN\n1, 8, 2\n"), AllOf(HasSubstr("deck.inp:13"), HasSubstr("NGEN")));
  EXPECT_THAT(complaint(k_cube + "*NFILL, BIAS=2\nB, B, 2, 1\n"), HasSubstr("'BIAS'"));
  EXPECT_THAT(complaint(k_cube + "*ELCOPY, ELEMENT SHIFT=1, OLD SET=ONE, SHIFT NODES=50\n"),
              HasSubstr("no node 51"));
  EXPECT_THAT(complaint(k_cube + "*NODE, SYSTEM=S\n20, 1, 0, 0\n"), HasSubstr("SYSTEM=S"));
}

TEST(AbaqusCoordinates, NodesInACylindricalSystemMakeASector) {
  const RawMesh raw = deck(R"(*NODE, NSET=A, SYSTEM=C
1, 10, 0, 0
2, 20, 0, 0
3, 20, 90, 0
4, 10, 90, 0
5, 10, 0, 10
6, 20, 0, 10
7, 20, 90, 10
8, 10, 90, 10
*ELEMENT, TYPE=C3D8, ELSET=SECTOR
1, 1, 2, 3, 4, 5, 6, 7, 8
)");
  expect_box(raw, "SECTOR", {0, 0, 0}, {20, 20, 10});
  EXPECT_NEAR(volume_of(raw, "SECTOR"), 1500, 1e-9);
}

TEST(AbaqusCoordinates, ASystemMovesAndTurnsTheNodesBehindItUntilTheNextOne) {
  const auto with = [](const std::string& system) { return deck(system + k_cube); };
  expect_box(with("*SYSTEM\n50, 0, 0\n"), "ONE", {50, 0, 0}, {60, 10, 10});
  // The first axis along y: the second one, turned around z, along -x.
  expect_box(with("*SYSTEM\n50, 0, 0, 50, 1, 0\n"), "ONE", {40, 0, 0}, {50, 10, 10});
  // The first axis along z, the second along x.
  expect_box(with("*SYSTEM\n0, 0, 5, 0, 0, 6\n1, 0, 5\n"), "ONE", {0, 0, 5}, {10, 10, 15});
  expect_box(with("*SYSTEM\n50, 0, 0\n*SYSTEM\n"), "ONE", {0, 0, 0}, {10, 10, 10});
  EXPECT_THAT(complaint("*SYSTEM\n0, 0, 0, 1, 0, 0\n2, 0, 0\n" + k_cube),
              AllOf(HasSubstr("deck.inp:2"), HasSubstr("SYSTEM")));
}

TEST(AbaqusInputFiles, NodesAndElementsComeFromOtherFiles) {
  write_deck(k_cube_nodes, "cube.nodes");
  write_deck("1, 1, 2, 3, 4, 5, 6, 7, 8\n", "cube.elements");
  const RawMesh raw = deck("*NODE, INPUT=cube.nodes\n*ELEMENT, TYPE=C3D8, ELSET=ONE, INPUT=cube.elements\n");
  EXPECT_NEAR(volume_of(raw, "ONE"), 1000, 1e-9);
  EXPECT_THAT(complaint("*NODE, INPUT=absent.nodes\n"),
              AllOf(HasSubstr("deck.inp:1"), HasSubstr("absent.nodes")));
}

/// A part of one cube with a set and a surface.
const std::string k_part = "*PART, NAME=Cube\n*NODE\n" + k_cube_nodes + R"(*ELEMENT, TYPE=C3D8
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELSET, ELSET=metal
1
*NSET, NSET=left, GENERATE
1, 5, 4
*END PART
)";

TEST(AbaqusAssembly, InstancesAreMovedAndTurnedAndKeepTheirSets) {
  const RawMesh raw = deck(k_part + R"(*PART, NAME=Spare
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=one, PART=Cube
*END INSTANCE
*INSTANCE, NAME=two, PART=Cube
30, 0, 0
30, 0, 0, 30, 0, 1, 90
*END INSTANCE
*ELSET, ELSET=_hot_S1, INTERNAL, INSTANCE=two
1
*SURFACE, TYPE=ELEMENT, NAME=hot
_hot_S1, S1
*NSET, NSET=both
one.left, two.left
*ELSET, ELSET=second, INSTANCE=two, GENERATE
1, 1
*END ASSEMBLY
)");
  expect_box(raw, "one.metal", {0, 0, 0}, {10, 10, 10});
  expect_box(raw, "two.metal", {20, 0, 0}, {30, 10, 10});
  expect_box(raw, "second", {20, 0, 0}, {30, 10, 10});
  expect_box(raw, "hot", {20, 0, 0}, {30, 10, 0});
  EXPECT_EQ(raw.groups.at("both").blocks.at(0).nodes.size(), 4u);
  EXPECT_FALSE(raw.groups.contains("_hot_S1"));
  EXPECT_NEAR(volume_of(raw, "two.metal"), 1000, 1e-9);
  // A number tells one node and one element.
  EXPECT_EQ(std::set(raw.input_node.begin(), raw.input_node.end()).size(), raw.x.size());
  EXPECT_THAT(raw.notes, ElementsAre(AllOf(HasSubstr("'Spare'"), HasSubstr("no *INSTANCE")),
                                     HasSubstr("'two' are raised by 10")));
}

TEST(AbaqusAssembly, MistakesAreNamed) {
  EXPECT_THAT(complaint(k_part + "*ASSEMBLY\n*INSTANCE, NAME=a, PART=Kube\n"), HasSubstr("no part 'Kube'"));
  EXPECT_THAT(
      complaint(k_part + "*ASSEMBLY\n*INSTANCE, NAME=a, PART=Cube\n*END INSTANCE\n*NSET, NSET=x\nb.left\n"),
      HasSubstr("no instance 'b'"));
  EXPECT_THAT(
      complaint(k_part +
                "*ASSEMBLY\n*INSTANCE, NAME=a, PART=Cube\n1,0,0\n*NODE\n20, 0, 0, 0\n*END INSTANCE\n"),
      HasSubstr("inside of an *INSTANCE that is moved"));
}

TEST(AbaqusKeywords, ThoseThatMaySayMoreAreNamedAndOthersAreNot) {
  EXPECT_THAT(deck(k_cube + "*MATERIAL, NAME=s\n*ELASTIC\n2e5, 0.3\n*STEP\n*STATIC\n1, 1\n*END STEP\n").notes,
              IsEmpty());
  EXPECT_THAT(deck(k_cube + "*TIE, NAME=t\na, b\n*TIE, NAME=u\nc, d\n*EQUATION\n2\n1,1,1.,2,1,-1.\n").notes,
              ElementsAre(AllOf(HasSubstr("*TIE"), HasSubstr("deck.inp:12"), HasSubstr("*EQUATION"))));
}

TEST(AbaqusKeywords, ASetOfElementsThatAreNotInTheFileIsSaid) {
  const RawMesh raw =
      deck(k_cube + "*ELSET, ELSET=outside\n7,\n8,\n*ELSET, ELSET=early, GENERATE\n1, 999999999\n");
  EXPECT_FALSE(raw.groups.contains("outside"));
  EXPECT_EQ(raw.groups.at("early").blocks.at(0).input_element, (InputNumbers{1}));
  EXPECT_THAT(raw.notes, ElementsAre(HasSubstr("'early' names 999999998 elements"),
                                     AllOf(HasSubstr("'outside' names 2 elements"), HasSubstr("such as 7"))));
}

TEST(AbaqusKeywords, SetsOfTheNodesOfElementsAndSurfacesOfNodesAreSetsOfNodes) {
  const RawMesh raw =
      deck(k_cube + "*NSET, NSET=all, ELSET=ONE\n*SURFACE, TYPE=NODE, NAME=foot\n1, 1.\n2, 1.\n");
  EXPECT_EQ(raw.groups.at("all").blocks.at(0).nodes.size(), 8u);
  EXPECT_EQ(raw.groups.at("foot").dimension, 0);
  EXPECT_EQ(raw.groups.at("foot").blocks.at(0).nodes, (std::vector<Index>{0, 1}));
}

}  // namespace
