// Legacy files of VTK (.vtk) of old versions and of 5.1, as VTK 9, ParaView and meshio write them.
#include "mesh/files/vtk_legacy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/gmsh/import.hpp"
#include "mesh/quality.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string write(const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("legacy_vtk_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mesh.vtk", std::ios::binary) << text;
  return (folder / "mesh.vtk").string();
}

RawMesh read(const std::string& text) {
  const std::string file = write(text);
  RawMesh raw = read_mesh_here({file});
  validate_and_orient(raw, file);
  return raw;
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

double measure(const RawMesh& raw, const std::string& name) {
  for (const GroupReport& g : assess(raw).groups)
    if (g.name == name) return g.measure;
  return -1;
}

// A tetrahedron of 1/6 m³ and a wedge of 1/2 m³ on its right.
const std::string k_head = "# vtk DataFile Version 5.1\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n",
                  k_points =
                      "POINTS 10 float\n0 0 0 1 0 0 0 1 0\n0 0 1 2 0 0 3 0 0\n2 1 0 2 0 1 3 0 1\n2 1 1\n",
                  k_offsets =
                      "CELLS 3 10\nOFFSETS vtktypeint64\n0 4 10\nCONNECTIVITY vtktypeint64\n0 1 2 3\n4 5 6 7 "
                      "8 9\n",
                  k_old_cells = "CELLS 2 12\n4 0 1 2 3\n6 4 5 6 7 8 9\n", k_types = "CELL_TYPES 2\n10\n13\n",
                  k_material = "CELL_DATA 2\nSCALARS material int\nLOOKUP_TABLE default\n1 2\n";

void expect_two_bodies(const RawMesh& raw) {
  EXPECT_NEAR(measure(raw, "body_1"), 1.0 / 6, 1e-7);
  EXPECT_NEAR(measure(raw, "body_2"), 0.5, 1e-7);
  EXPECT_THAT(raw.notes, Contains(HasSubstr("the cell data `material` tell bodies apart")));
}

TEST(LegacyVtk, VersionsWithOffsetsAndWithCountsAreOneMesh) {
  expect_two_bodies(read(k_head + k_points + k_offsets + k_types + k_material));
  expect_two_bodies(read(k_head + k_points + k_old_cells + k_types + k_material));
}

TEST(LegacyVtk, DataOfEveryKindStandBesideTheBodies) {
  const std::string data =
      "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 3.3\n\n" + k_offsets +
      k_types + "\nPOINT_DATA 10\nVECTORS u double\n" +
      std::string(30, '1').replace(1, 29, " 1 1 1 1 1 1 1 1 1 1 1 1 1 1") +
      " 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\nCELL_DATA 2\nTENSORS s float\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n"
      "FIELD FieldData 2\nheat%20flux 3 2 double\n1 2 3 4 5 6\nmaterial 1 2 int\n7 9\n"
      "METADATA\nINFORMATION 0\n\n";
  const RawMesh raw = read(k_head + k_points + data);
  EXPECT_NEAR(measure(raw, "body_2"), 0.5, 1e-7);
}

template <class Number>
std::string bytes(std::initializer_list<Number> numbers) {
  std::string text;
  for (const Number number : numbers) {
    std::array<char, sizeof(Number)> b{};
    std::memcpy(b.data(), &number, sizeof number);
    std::ranges::reverse(b);
    text.append(b.begin(), b.end());
  }
  return text;
}

TEST(LegacyVtk, BinaryFilesHaveTheHighestByteFirst) {
  using Long = std::int64_t;
  using Int = std::int32_t;
  const std::string head = "# vtk DataFile Version 5.1\nby hand\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
                    points =
                        "POINTS 10 float\n" + bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0,
                                                            3, 0, 0, 2, 1, 0, 2, 0, 1, 3, 0, 1, 2, 1, 1}),
                    end = "\nCELL_TYPES 2\n" + bytes<Int>({10, 13}) +
                          "\nCELL_DATA 2\nSCALARS material int\nLOOKUP_TABLE default\n" + bytes<Int>({1, 2}) +
                          "\n";
  expect_two_bodies(read(head + points + "\nCELLS 3 10\nOFFSETS vtktypeint64\n" + bytes<Long>({0, 4, 10}) +
                         "\nCONNECTIVITY vtktypeint64\n" + bytes<Long>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) +
                         end));
  expect_two_bodies(
      read(head + points + "\nCELLS 2 12\n" + bytes<Int>({4, 0, 1, 2, 3, 6, 4, 5, 6, 7, 8, 9}) + end));
}

TEST(LegacyVtk, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(complaint(k_head + k_points + k_offsets), HasSubstr("types"));
  EXPECT_THAT(complaint(k_head + "POINTS 10 float\n0 0 0 1\n"), HasSubstr("cut off"));
  EXPECT_THAT(complaint(k_head + "POINTS 2 float\n0 0 zero 1 1 1\n"),
              AllOf(HasSubstr(":6"), HasSubstr("'zero'")));
  EXPECT_THAT(complaint(k_head + k_points + "CELLS 1 5\n4 0 1 2 33\nCELL_TYPES 1\n10\n"),
              HasSubstr("no point"));
  EXPECT_THAT(complaint(k_head + k_points + "CELLS 1 5\n9 0 1 2 3\nCELL_TYPES 1\n10\n"),
              HasSubstr("more corners"));
  EXPECT_THAT(complaint(k_head + k_points + k_offsets + "CELL_TYPES 2\n10 42\n"), HasSubstr("type 42"));
}

}  // namespace
