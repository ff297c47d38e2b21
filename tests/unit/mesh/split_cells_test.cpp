// Wedges, pyramids and bricks with corners that fall together become tetrahedra that fit their neighbours.
#include "mesh/files/split_cells.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "mesh/files/abaqus_input.hpp"
#include "mesh/gmsh/import.hpp"
#include "mesh/quality.hpp"
#include "mesh/surfaces/soundness.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Bricks of a box as two wedges each, with their nodes in an order that has nothing to do with their places:
/// cuts by the lowest number then run in all directions.
/// @param keeps_bricks  one in four stays a brick, so that columns of bricks are next to wedges
RawMesh box_of_wedges(bool keeps_bricks = false) {
  RawMesh raw = sample_box(Shape::hex8);
  std::erase_if(raw.groups, [](const auto& group) { return group.first.starts_with("z_"); });  // of triangles
  std::vector<Index> moved(raw.x.size());
  std::iota(moved.begin(), moved.end(), 0);
  std::shuffle(moved.begin(), moved.end(), std::mt19937(7));
  const std::vector<Point> old = raw.x;
  for (std::size_t i = 0; i < moved.size(); ++i) raw.x[static_cast<std::size_t>(moved[i])] = old[i];
  for (auto& [name, group] : raw.groups) {
    std::vector<RawBlock> blocks;
    for (RawBlock& block : group.blocks) {
      for (Index& node : block.nodes) node = moved[static_cast<std::size_t>(node)];
      if (block.shape != Shape::hex8) {
        blocks.push_back(block);
        continue;
      }
      RawBlock wedges{Shape::wedge6, {}, {}}, bricks{Shape::hex8, {}, {}};
      for (std::size_t e = 0; e < block.input_element.size(); ++e) {
        const Index* h = &block.nodes[8 * e];
        if (keeps_bricks && e % 4 == 1) {
          bricks.nodes.insert(bricks.nodes.end(), h, h + 8);
          bricks.input_element.push_back(block.input_element[e]);
          continue;
        }
        wedges.nodes.insert(wedges.nodes.end(), {h[0], h[1], h[2], h[4], h[5], h[6]});
        wedges.nodes.insert(wedges.nodes.end(), {h[0], h[2], h[3], h[4], h[6], h[7]});
        wedges.input_element.push_back(1000 + block.input_element[e]);
        wedges.input_element.push_back(2000 + block.input_element[e]);
      }
      blocks.push_back(wedges);
      if (!bricks.input_element.empty()) blocks.push_back(bricks);
    }
    group.blocks = blocks;
  }
  return raw;
}

std::string body_of(const RawMesh& raw) {
  for (const auto& [name, group] : raw.groups)
    if (group.dimension == raw.dimension) return name;
  return "";
}

double measure(const RawMesh& raw, const std::string& name) {
  for (const GroupReport& g : assess(raw).groups)
    if (g.name == name) return g.measure;
  return -1;
}

std::size_t count(const RawMesh& raw, const std::string& name, Shape shape) {
  for (const RawBlock& block : raw.groups.at(name).blocks)
    if (block.shape == shape) return block.input_element.size();
  return 0;
}

/// The area of the skin of a body: faces that do not match a neighbour's would be in it twice.
double skin_area(const RawMesh& raw, const std::string& body) {
  double area = 0;
  for (const OuterFace& face : faces_on_skin(raw, body)) {
    EXPECT_EQ(face.shape, Shape::tri3);
    const auto x = [&](std::size_t i) { return raw.x[static_cast<std::size_t>(face.nodes[i])]; };
    Point a{}, b{};
    for (std::size_t i = 0; i < 3; ++i) a[i] = x(1)[i] - x(0)[i], b[i] = x(2)[i] - x(0)[i];
    area += 0.5 * std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

constexpr double k_volume = 0.5 * 0.3 * 0.4, k_area = 2 * (0.5 * 0.3 + 0.3 * 0.4 + 0.4 * 0.5);

std::string write(const std::string& name, const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("split_cells_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << text;
  return (folder / name).string();
}

TEST(SplitCells, WedgesBecomeThreeTetrahedraThatMatchAcrossTheirFaces) {
  RawMesh raw = box_of_wedges();
  const std::string body = body_of(raw);
  split_cells(raw, "wedges");
  validate_and_orient(raw, "wedges");
  EXPECT_EQ(count(raw, body, Shape::tet4), 3u * 48u);
  EXPECT_NEAR(measure(raw, body), k_volume, 1e-14);
  EXPECT_NEAR(skin_area(raw, body), k_area, 1e-13);
  EXPECT_THAT(raw.notes, Contains(HasSubstr("48 wedges are split into tetrahedra")));
}

TEST(SplitCells, FacesOfSurfacesAreThoseOfTheTetrahedra) {
  RawMesh raw = box_of_wedges();
  const std::string body = body_of(raw);
  split_cells(raw, "wedges");
  validate_and_orient(raw, "wedges");
  int n_surfaces = 0;
  for (const auto& [name, group] : raw.groups) {
    if (group.dimension != 2) continue;
    ++n_surfaces;
    EXPECT_EQ(count(raw, name, Shape::quad4), 0u) << name;
    EXPECT_EQ(inner_faces(raw, {body}, {faces_on_skin(raw, body)}, group).n, 0u) << name;
  }
  EXPECT_EQ(n_surfaces, 4);
}

TEST(SplitCells, BricksThatHangTogetherWithWedgesAreSplitToo) {
  RawMesh raw = box_of_wedges(true);
  const std::string body = body_of(raw);
  split_cells(raw, "mixed");
  validate_and_orient(raw, "mixed");
  EXPECT_EQ(count(raw, body, Shape::hex8), 0u);
  EXPECT_EQ(count(raw, body, Shape::tet4), 3u * 36u + 6u * 6u);
  EXPECT_NEAR(measure(raw, body), k_volume, 1e-14);
  EXPECT_NEAR(skin_area(raw, body), k_area, 1e-13);
  EXPECT_THAT(raw.notes, Contains(HasSubstr("36 wedges and the 6 hexahedra that hang together with them")));
}

TEST(SplitCells, BricksOfAnotherBodyStay) {
  RawMesh raw = box_of_wedges();
  const RawMesh other = sample_box(Shape::hex8, 2);
  const auto first = static_cast<Index>(raw.x.size());
  raw.x.insert(raw.x.end(), other.x.begin(), other.x.end());
  RawGroup group = other.groups.at(body_of(other));
  for (RawBlock& block : group.blocks)
    for (Index& node : block.nodes) node += first;
  raw.groups.emplace("mould", group);
  split_cells(raw, "mixed");
  EXPECT_EQ(count(raw, "mould", Shape::hex8), 24u);
}

// A brick whose corners 7 and 8 are its 5 and 6 is a wedge on its side, as ANSYS and Salome write them.
TEST(SplitCells, BricksWithRepeatedCornersAreTheCellsThatTheyLookLike) {
  const std::string text =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,0.5,0.5,1\n"
      "*ELEMENT,TYPE=C3D8,ELSET=ramp\n1,1,2,3,4,5,6,6,5\n";
  RawMesh raw = read_mesh_here({write("collapsed.inp", text)});
  validate_and_orient(raw, "collapsed");
  EXPECT_NEAR(measure(raw, "ramp"), 0.5, 1e-14);
  const std::string pyramid =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0.5,0.5,1\n"
      "*ELEMENT,TYPE=C3D8,ELSET=tip\n1,1,2,3,4,5,5,5,5\n";
  raw = read_mesh_here({write("pyramid.inp", pyramid)});
  validate_and_orient(raw, "pyramid");
  EXPECT_NEAR(measure(raw, "tip"), 1.0 / 3, 1e-14);
}

TEST(SplitCells, AreReadFromEveryFormatWithTheirFaces) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,3\n5,2,0,3\n6,0,2,3\n7,-1,1,1.5\n";
  // The pyramid is on the face 3-1-4-6 of the wedge.
  const std::string deck = nodes +
                           "*ELEMENT,TYPE=C3D6,ELSET=part\n1,1,2,3,4,5,6\n"
                           "*ELEMENT,TYPE=C3D5,ELSET=part\n2,1,3,6,4,7\n"
                           "*SURFACE,NAME=floor\n1,S1\n*SURFACE,NAME=front\n1,S3\n*SURFACE,NAME=slope\n1,S4\n"
                           "*SURFACE,NAME=tip\n2,S2\n";
  RawMesh raw = read_mesh_here({write("wedge.inp", deck)});
  validate_and_orient(raw, "wedge.inp");
  EXPECT_NEAR(measure(raw, "part"), 6 + 2, 1e-13);
  EXPECT_NEAR(measure(raw, "floor"), 2, 1e-13);
  EXPECT_NEAR(measure(raw, "front"), 6, 1e-13);
  EXPECT_NEAR(measure(raw, "slope"), 3 * std::sqrt(8), 1e-13);
  EXPECT_NEAR(measure(raw, "tip"), 0.5 * 3.6055512754639891, 1e-13);
  EXPECT_EQ(faces_on_skin(raw, "part").size(), 4 + 2 + 4u);

  const std::string bulk =
      "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,2.,0.\nGRID,4,,0.,0.,3.\nGRID,5,,2.,0.,3.\n"
      "GRID,6,,0.,2.,3.\nGRID,7,,-1.,1.,1.5\nCPENTA,1,1,1,2,3,4,5,6\nCPYRAM,2,1,1,3,6,4,7\nENDDATA\n";
  raw = read_mesh_here({write("wedge.bdf", bulk)});
  validate_and_orient(raw, "wedge.bdf");
  EXPECT_NEAR(measure(raw, "body_1"), 8, 1e-13);

  std::string unv = "    -1\n  2411\n";
  constexpr double k_x[7][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0},   {0, 0, 3},
                                {2, 0, 3}, {0, 2, 3}, {-1, 1, 1.5}};
  for (int i = 0; i < 7; ++i)
    unv += fmt::format("{:10}{:10}{:10}{:10}\n{:25.16E}{:25.16E}{:25.16E}\n", i + 1, 1, 1, 11, k_x[i][0],
                       k_x[i][1], k_x[i][2]);
  unv += "    -1\n    -1\n  2412\n 1 112 1 1 7 6\n 1 2 3 4 5 6\n 2 115 1 1 7 8\n 1 3 6 4 7 7 7 7\n    -1\n";
  raw = read_mesh_here({write("wedge.unv", unv)});
  validate_and_orient(raw, "wedge.unv");
  EXPECT_NEAR(measure(raw, "group_3d_1"), 8, 1e-13);

  const std::string msh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 3\n5 2 0 3\n6 0 2 "
      "3\n"
      "7 -1 1 1.5\n$EndNodes\n$Elements\n2\n1 6 2 1 1 1 2 3 4 5 6\n2 7 2 1 1 1 3 6 4 7\n$EndElements\n";
  raw = read_mesh_here({write("wedge.msh", msh)});
  validate_and_orient(raw, "wedge.msh");
  EXPECT_NEAR(measure(raw, body_of(raw)), 8, 1e-13);

  const std::string vtu =
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"7\" NumberOfCells=\"2\">"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 2 0 0 0 2 0 0 0 3 "
      "2 0 3 "
      "0 2 3 -1 1 1.5</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 2 3 4 5 0 2 5 3 6</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">6 11</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">13 14"
      "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
  raw = read_mesh_here({write("wedge.vtu", vtu)});
  validate_and_orient(raw, "wedge.vtu");
  EXPECT_NEAR(measure(raw, "body_1"), 8, 1e-13);

  const std::string vtk =
      "# vtk DataFile Version 3.0\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n0 0 0 2 0 0 0 2 "
      "0 0 0 "
      "3 2 0 3 0 2 3 -1 1 1.5\nCELLS 2 13\n6 0 1 2 3 4 5\n5 0 2 5 3 6\nCELL_TYPES 2\n13\n14\n";
  raw = read_mesh_here({write("wedge.vtk", vtk)});
  validate_and_orient(raw, "wedge.vtk");
  EXPECT_NEAR(measure(raw, body_of(raw)), 8, 1e-13);
}

TEST(SplitCells, ThoseThatCannotBeSplitAreRefused) {
  // The top is turned by half a turn against the bottom.
  const std::string twisted =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0.7,0.7,0.1\n5,-0.3,0.7,0.1\n6,0.7,-0.3,0.1\n"
      "*ELEMENT,TYPE=C3D6,ELSET=part\n17,1,2,3,4,5,6\n";
  try {
    read_mesh_here({write("twisted.inp", twisted)});
    FAIL() << "a twisted wedge was split";
  } catch (const InputError& e) {
    EXPECT_THAT(std::string(e.what()), AllOf(HasSubstr("element 17"), HasSubstr("warped")));
  }
}

}  // namespace
