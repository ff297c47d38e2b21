// Input files of Abaqus and CalculiX, written as people write them.
#include "mesh/files/abaqus_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesh/files/abaqus_elements.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string write(const std::string& name, const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("inp_files_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}
std::string complaint_of(const std::string& text) {
  try {
    read_abaqus_input(write("bad.inp", text), 1);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

// Two squares of 10 × 10 mm, the second of two triangles.
const std::string k_plate = R"(*Heading
 a plate, **not a comment here
** comment
*NODE, NSET=Nall
  1,  0.0, 0.0
  2, 10.0, 0.,  0.
  3, 2.0E1, 0
  4, 0, 1.D1
  5, 10, +10
  6, 20, 10
*Element, type=CPE4R, elset=Quads
 11, 1, 2,
     5, 4
*element, Type = cax3, ELSET="Tris"
 12, 2, 3, 6
 13, 2, 6, 5
*ELSET, ELSET=both
 quads, Tris
*ELSET, ELSET=some, GENERATE
 12, 13
*NSET, NSET=left
 1, 4
*SURFACE, NAME=right, TYPE=ELEMENT
 12, S2
*SURFACE, NAME=bottom
 quads, S1
 12, S1
*MATERIAL, NAME=steel
*ELASTIC
 210000., 0.3
*STEP
*STATIC
 1., 1.
*END STEP
)";

TEST(AbaqusInput, NodesElementsSetsAndSurfacesAreRead) {
  RawMesh raw = read_abaqus_input(write("plate.inp", k_plate), 0.001);
  validate_and_orient(raw, "plate.inp");
  EXPECT_EQ(raw.dimension, 2);
  ASSERT_EQ(raw.x.size(), 6u);
  EXPECT_DOUBLE_EQ(raw.x[2][0], 0.02);
  EXPECT_DOUBLE_EQ(raw.x[3][1], 0.01);
  EXPECT_DOUBLE_EQ(raw.x[4][1], 0.01);
  EXPECT_EQ(raw.groups.at("Quads").blocks.at(0).shape, Shape::quad4);
  EXPECT_EQ(raw.groups.at("Tris").blocks.at(0).nodes, (std::vector<Index>{1, 2, 5, 1, 5, 4}));
  EXPECT_EQ(raw.groups.at("some").blocks.at(0).input_element, (InputNumbers{12, 13}));
  EXPECT_EQ(raw.groups.at("both").blocks.size(), 2u);
  EXPECT_EQ(raw.groups.at("left").dimension, 0);
  EXPECT_EQ(raw.groups.at("left").blocks.at(0).nodes, (std::vector<Index>{0, 3}));
  EXPECT_EQ(raw.groups.at("right").blocks.at(0).nodes, (std::vector<Index>{2, 5}));
  EXPECT_EQ(raw.groups.at("bottom").blocks.at(0).nodes, (std::vector<Index>{0, 1, 1, 2}));
  EXPECT_FALSE(raw.groups.contains("body_1"));
  EXPECT_NEAR(volume(distribute(raw, {"both"}, {"right"}), AnalysisKind::plane_strain), 2e-4, 1e-18);
}

TEST(AbaqusInput, AnIncludedFileIsReadBesideIt) {
  write("nodes.inc", "*NODE\n1,0,0\n2,1,0\n3,0,1\n");
  const RawMesh raw =
      read_abaqus_input(write("main.inp", "*INCLUDE, INPUT=nodes.inc\n*ELEMENT, TYPE=CPS3\n1,1,2,3\n"), 1);
  EXPECT_EQ(raw.groups.at("body_1").blocks.at(0).nodes, (std::vector<Index>{0, 1, 2}));
  EXPECT_THAT(complaint_of("*INCLUDE, INPUT=bad.inp\n"), HasSubstr("circles"));
}

TEST(AbaqusInput, TheNodesOfQuadraticSolidsComeInOurOrder) {
  // Abaqus numbers the mid nodes of a hexahedron bottom, top, then the vertical edges.
  const std::array<std::array<int, 2>, 12> abaqus_edges{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  const std::array<std::array<int, 2>, 6> abaqus_tet{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (const Shape shape : {Shape::hex20, Shape::tet10}) {
    const Rule reference = nodal_rule(shape);
    const auto vertices = static_cast<std::size_t>(vertex_count(shape));
    std::vector<Point> x;
    for (std::size_t a = 0; a < vertices; ++a) x.push_back(reference[a].xi);
    const auto add_mid = [&](const std::array<int, 2>& edge) {
      Point mid{};
      for (std::size_t i = 0; i < 3; ++i)
        mid[i] = 0.5 * (x[static_cast<std::size_t>(edge[0])][i] + x[static_cast<std::size_t>(edge[1])][i]);
      x.push_back(mid);
    };
    if (shape == Shape::hex20)
      for (const auto& edge : abaqus_edges) add_mid(edge);
    else
      for (const auto& edge : abaqus_tet) add_mid(edge);
    std::string text = "*NODE\n", element = "1";
    for (std::size_t a = 0; a < x.size(); ++a) {
      text += std::to_string(a + 1) + "," + std::to_string(x[a][0]) + "," + std::to_string(x[a][1]) + "," +
              std::to_string(x[a][2]) + "\n";
      element += (a == 10 ? ",\n" : ",") + std::to_string(a + 1);
    }
    text +=
        "*ELEMENT, TYPE=" + std::string(shape == Shape::hex20 ? "C3D20R" : "C3D10M") + "\n" + element + "\n";
    const RawMesh raw = read_abaqus_input(write("solid.inp", text), 1);
    const RawBlock& block = raw.groups.at("body_1").blocks.at(0);
    EXPECT_EQ(block.shape, shape);
    for (std::size_t a = 0; a < x.size(); ++a)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(raw.x[static_cast<std::size_t>(block.nodes[a])][i], reference[a].xi[i], 1e-6) << a;
  }
}

TEST(AbaqusInput, FaceLabelsMeanTheFacesOfTheManual) {
  // Abaqus Analysis User's Guide, "Solid elements", faces by node numbers from one
  const std::vector<std::vector<int>> tet{{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}};
  const std::vector<std::vector<int>> hex{{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2},
                                          {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
  for (const auto& [shape, faces] : {std::pair{Shape::tet4, tet}, std::pair{Shape::hex8, hex}})
    for (int label = 1; label <= static_cast<int>(faces.size()); ++label) {
      const auto local = face_nodes(shape, face_of_abaqus_label(shape, label).value());
      std::vector<int> ours;
      for (const int a : local) ours.push_back(a + 1);
      EXPECT_THAT(ours, ::testing::UnorderedElementsAreArray(faces[static_cast<std::size_t>(label - 1)]))
          << label;
    }
  EXPECT_FALSE(face_of_abaqus_label(Shape::tet4, 5));
}

TEST(AbaqusInput, ElementTypesAreKnownByTheirShape) {
  using S = Shape;
  const std::vector<std::pair<std::string, Shape>> types{
      {"C3D4", S::tet4},   {"C3D10T", S::tet10}, {"C3D8RT", S::hex8},  {"C3D20R", S::hex20},
      {"DC3D8", S::hex8},  {"CPE4H", S::quad4},  {"CAX4RT", S::quad4}, {"CAX8R", S::quad8},
      {"CPS6", S::tri6},   {"DCAX3", S::tri3},   {"DC2D4", S::quad4},  {"S4R", S::quad4},
      {"STRI65", S::tri6}, {"S3", S::tri3},      {"T3D2", S::line2},   {"B32R", S::line3},
      {"B31", S::line2},   {"M3D4R", S::quad4},  {"C3D6", S::wedge6},  {"C3D5", S::pyramid5},
      {"T2D3", S::line3}};
  for (const auto& [type, shape] : types) EXPECT_EQ(shape_of_abaqus_type(type), shape) << type;
  for (const char* type : {"C3D15", "C3D13", "SPRINGA", "MASS", "SAX1", "C3D", ""})
    EXPECT_FALSE(shape_of_abaqus_type(type)) << type;
}

TEST(AbaqusInput, MistakesAreNamedWithTheirLine) {
  const std::string nodes = "*NODE\n1,0,0\n2,1,0\n3,0,1\n";
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT, TYPE=C3D15\n1,1,2,3\n"),
              AllOf(HasSubstr("bad.inp:5"), HasSubstr("C3D15")));
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT, TYPE=CPE3\n1,1,2,9\n"),
              AllOf(HasSubstr(":6"), HasSubstr("node 9")));
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT, TYPE=CPE3\n1,1,2,\n"), HasSubstr("ends after 2"));
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT, TYPE=CPE3\n1,1,2,3,1\n"), HasSubstr("more than the 3"));
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT\n1,1,2,3\n"), HasSubstr("TYPE"));
  EXPECT_THAT(complaint_of("*NODE\n1,0,zero\n"), AllOf(HasSubstr(":2"), HasSubstr("'zero'")));
  EXPECT_THAT(complaint_of("*NODE\n1,0,nan\n"), HasSubstr("'nan'"));
  EXPECT_THAT(complaint_of("*NODE\n1,0,1e999\n"), HasSubstr("'1e999'"));
  EXPECT_THAT(complaint_of(nodes + "2,0,0\n"), HasSubstr("defined twice"));
  EXPECT_THAT(complaint_of(nodes + "*ELEMENT, TYPE=CPE3\n1,1,2,3\n*NSET,NSET=a\n1,7\n"),
              AllOf(HasSubstr(":7"), HasSubstr("node 7")));
  EXPECT_THAT(complaint_of(nodes + "*ELSET,ELSET=a\nother\n"), HasSubstr("'other'"));
  EXPECT_THAT(complaint_of(nodes), HasSubstr("no triangles"));
}

}  // namespace
