// MED files as Salome, FreeCAD and Code_Aster write them, made by MED's own library.
#include "mesh/med/read_med.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <med.h>

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
using ::testing::Not;
using ::testing::UnorderedElementsAre;

std::string padded(std::string text, std::size_t width) {
  text.resize(width, ' ');
  return text;
}

struct Cells {
  med_geometry_type type;
  std::vector<med_int> nodes;     ///< counted from 1
  std::vector<med_int> families;  ///< empty: none
};
struct Family {
  med_int number;
  std::vector<std::string> groups;
};

class MedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("med_files_" + std::to_string(rank()));
    std::filesystem::create_directories(folder_);
    path_ =
        (folder_ / (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".med"))
            .string();
    file_ = MEDfileOpen(path_.c_str(), MED_ACC_CREAT);
    ASSERT_GE(file_, 0);
  }
  void TearDown() override {
    if (file_ >= 0) MEDfileClose(file_);
  }
  void add_mesh(const std::string& name, const std::vector<double>& x, const std::vector<Cells>& all,
                const std::vector<Family>& families = {}, const std::vector<med_int>& of_nodes = {},
                const std::string& unit = "", med_int space = 3) {
    std::string axes, units;
    for (med_int i = 0; i < space; ++i) {
      axes += padded(std::string(1, static_cast<char>('X' + i)), MED_SNAME_SIZE);
      units += padded(unit, MED_SNAME_SIZE);
    }
    ok(MEDmeshCr(file_, name.c_str(), space, space, MED_UNSTRUCTURED_MESH, "a mesh", "s", MED_SORT_DTIT,
                 MED_CARTESIAN, axes.c_str(), units.c_str()));
    ok(MEDmeshNodeCoordinateWr(file_, name.c_str(), MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE,
                               static_cast<med_int>(x.size()) / space, x.data()));
    for (const Cells& c : all) {
      const auto n = static_cast<med_int>(c.nodes.size()) / (c.type % 100);
      ok(MEDmeshElementConnectivityWr(file_, name.c_str(), MED_NO_DT, MED_NO_IT, 0, MED_CELL, c.type,
                                      MED_NODAL, MED_FULL_INTERLACE, n, c.nodes.data()));
      if (!c.families.empty())
        ok(MEDmeshEntityFamilyNumberWr(file_, name.c_str(), MED_NO_DT, MED_NO_IT, MED_CELL, c.type, n,
                                       c.families.data()));
    }
    if (!of_nodes.empty())
      ok(MEDmeshEntityFamilyNumberWr(file_, name.c_str(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                     static_cast<med_int>(of_nodes.size()), of_nodes.data()));
    ok(MEDfamilyCr(file_, name.c_str(), "FAMILLE_ZERO", 0, 0, ""));
    for (const Family& f : families) {
      std::string groups;
      for (const std::string& g : f.groups) groups += padded(g, MED_LNAME_SIZE);
      ok(MEDfamilyCr(file_, name.c_str(), ("FAM_" + std::to_string(f.number)).c_str(), f.number,
                     static_cast<med_int>(f.groups.size()), groups.c_str()));
    }
  }
  RawMesh read(double unit = 0.001) {
    close();
    RawMesh raw = read_mesh_here({path_, unit});
    validate_and_orient(raw, path_);
    return raw;
  }
  std::string complaint() {
    close();
    try {
      read_mesh_here({path_, 0.001});
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }
  void close() {
    if (file_ >= 0) ok(MEDfileClose(file_));
    file_ = -1;
  }
  static void ok(med_err code) { ASSERT_GE(code, 0); }

  std::filesystem::path folder_;
  std::string path_;
  med_idt file_ = -1;
};

double measure(const RawMesh& raw, const std::string& name) {
  for (const GroupReport& g : assess(raw).groups)
    if (g.name == name) return g.measure;
  return -1;
}
std::vector<std::string> names(const RawMesh& raw) {
  std::vector<std::string> all;
  for (const auto& [name, group] : raw.groups) all.push_back(name);
  return all;
}

// Two cubes of 20 mm side by side; MED goes round the bases of bricks the other way than Gmsh.
const std::vector<double> k_cubes = {0, 0, 0,  20, 0, 0,  40, 0, 0,  0, 20, 0,  20, 20, 0,  40, 20, 0,
                                     0, 0, 20, 20, 0, 20, 40, 0, 20, 0, 20, 20, 20, 20, 20, 40, 20, 20};
const std::vector<med_int> k_bricks = {1, 4, 5, 2, 7, 10, 11, 8, 2, 5, 6, 3, 8, 11, 12, 9};

TEST_F(MedFile, GroupsOfFamiliesAreBodiesSurfacesAndNodes) {
  add_mesh(
      "Mesh_1", k_cubes, {{MED_HEXA8, k_bricks, {-1, -2}}, {MED_QUAD4, {1, 4, 10, 7, 3, 6, 12, 9}, {-3, -4}}},
      {{-1, {"casting", "all"}}, {-2, {"mould", "all"}}, {-3, {"left"}}, {-4, {}}, {5, {"left", "corner"}}},
      {5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5});
  const RawMesh raw = read();
  EXPECT_THAT(names(raw),
              UnorderedElementsAre("casting", "mould", "all", "left", "left_0d", "corner", "Mesh_1_2d"));
  EXPECT_NEAR(measure(raw, "casting"), 8e-6, 1e-18);
  EXPECT_NEAR(measure(raw, "mould"), 8e-6, 1e-18);
  EXPECT_NEAR(measure(raw, "all"), 16e-6, 1e-18);
  EXPECT_NEAR(measure(raw, "left"), 4e-4, 1e-16);
  EXPECT_EQ(raw.groups.at("corner").blocks.at(0).input_element.size(), 2u);
  EXPECT_THAT(raw.notes, IsEmpty());
}

TEST_F(MedFile, AMeshWithoutGroupsIsABodyOfItsName) {
  add_mesh("part", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{MED_TETRA4, {1, 3, 2, 4}, {}}}, {}, {}, "m");
  const RawMesh raw = read();
  EXPECT_THAT(names(raw), UnorderedElementsAre("part"));
  EXPECT_NEAR(measure(raw, "part"), 1e-9 / 6, 1e-22);
  EXPECT_THAT(raw.notes, Contains(AllOf(HasSubstr("m as its unit of length"), HasSubstr("0.001 m"))));
}

TEST_F(MedFile, SeveralMeshesAreAllRead) {
  add_mesh("casting", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{MED_TETRA4, {1, 3, 2, 4}, {}}});
  add_mesh("mould", {5, 0, 0, 7, 0, 0, 5, 2, 0, 5, 0, 2},
           {{MED_TETRA4, {1, 3, 2, 4}, {}}, {MED_TRIA3, {1, 2, 3}, {-1}}}, {{-1, {"skin"}}});
  const RawMesh raw = read(1);
  EXPECT_THAT(names(raw), UnorderedElementsAre("casting", "mould", "skin"));
  EXPECT_NEAR(measure(raw, "mould"), 8.0 / 6, 1e-14);
  EXPECT_NEAR(measure(raw, "skin"), 2, 1e-14);
  EXPECT_THAT(raw.notes, Contains(HasSubstr("2 meshes, 'casting', 'mould'")));
}

TEST_F(MedFile, GroupsOfOneNameInTwoMeshesHaveTheNamesOfTheMeshes) {
  for (const char* name : {"coarse", "fine"})
    add_mesh(name, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{MED_TETRA4, {1, 3, 2, 4}, {-1}}},
             {{-1, {"part"}}});
  EXPECT_THAT(names(read()), UnorderedElementsAre("coarse.part", "fine.part"));
}

TEST_F(MedFile, WedgesAndPyramidsHaveTheirVolume) {
  add_mesh("cells", {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 3, 2, 0, 3, 0, 2, 3, -1, 1, 1.5},
           {{MED_PENTA6, {1, 3, 2, 4, 6, 5}, {}}, {MED_PYRA5, {1, 4, 6, 3, 7}, {}}});
  EXPECT_NEAR(measure(read(1), "cells"), 8, 1e-13);
}

TEST_F(MedFile, PlaneMeshesMayHaveTwoCoordinates) {
  add_mesh("plate", {0, 0, 2, 0, 2, 1, 0, 1}, {{MED_QUAD4, {1, 2, 3, 4}, {}}}, {}, {}, "", 2);
  EXPECT_NEAR(measure(read(1), "plate"), 2, 1e-15);
}

TEST_F(MedFile, WhatIsNotReadIsRefusedByName) {
  add_mesh("bent", {0, 0, 0, 1, 0, 0, 0, 1, 0, .5, 0, 0, .5, .5, 0, 0, .5, 0, .3, .3, 0},
           {{MED_TRIA7, {1, 2, 3, 4, 5, 6, 7}, {}}});
  EXPECT_THAT(complaint(), AllOf(HasSubstr("TRIA7"), HasSubstr("'bent'")));
}

TEST_F(MedFile, AnElementWithANodeThatIsNotThereIsRefused) {
  add_mesh("part", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{MED_TETRA4, {1, 3, 2, 5}, {}}});
  EXPECT_THAT(complaint(), HasSubstr("TETRA4 1 of the mesh 'part' has the node 5, and there are 4"));
}

TEST_F(MedFile, StructuredMeshesAreRefused) {
  const std::string axes = padded("X", MED_SNAME_SIZE) + padded("Y", MED_SNAME_SIZE),
                    units(2 * MED_SNAME_SIZE, ' ');
  ok(MEDmeshCr(file_, "grid", 2, 2, MED_STRUCTURED_MESH, "", "s", MED_SORT_DTIT, MED_CARTESIAN, axes.c_str(),
               units.c_str()));
  EXPECT_THAT(complaint(), HasSubstr("'grid' is a structured grid"));
}

TEST_F(MedFile, ACutFileIsRefused) {
  add_mesh("part", k_cubes, {{MED_HEXA8, k_bricks, {}}});
  close();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_THAT(complaint(), HasSubstr("cut off or damaged"));
}

}  // namespace
