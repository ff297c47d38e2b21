// Universal files (.unv), as Salome, FreeCAD and others write them.
#include "mesh/files/universal_file.hpp"

#include <fmt/format.h>
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

std::string write_universal(const std::string& text) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("universal_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mesh.unv") << text;
  return (folder / "mesh.unv").string();
}

RawMesh universal(const std::string& text) {
  const std::string file = write_universal(text);
  RawMesh raw = read_universal_file(file, 0.001);
  validate_and_orient(raw, file);
  return raw;
}

std::string complaint_of_universal(const std::string& text) {
  try {
    universal(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

std::string dataset(int number, const std::string& lines) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, lines);
}

std::string nodes_as(int number, const std::vector<Point>& x, int system = 1) {
  std::string lines;
  for (std::size_t i = 0; i < x.size(); ++i) {
    lines += fmt::format("{:10}{:10}{:10}{:10}", i + 1, system, 1, 11);
    lines += number == 15 ? "" : "\n";
    lines += fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", x[i][0], x[i][1], x[i][2]);
  }
  return dataset(number, lines);
}

std::vector<Point> corners_of_two_cubes() {
  std::vector<Point> x;
  for (const double z : {0., 20.})
    for (const double y : {0., 20.})
      for (const double c : {0., 20., 40.}) x.push_back({c, y, z});
  return x;
}

const std::string k_elements =
    "         1       115         1         1         7         8\n"
    "         1         2         5         4         7         8        11        10\n"
    "         2       115         1         1         7         8\n"
    "         2         3         6         5         8         9        12        11\n"
    "         3        94         3         3         7         4\n"
    "         3         6        12         9\n";

/// The members of a group as dataset `number` lists them.
std::string group(int number, int label, const std::string& name, int type, const std::vector<int>& members) {
  const bool has_leaf = number != 2429 && number != 2430 && number != 2432;
  const std::size_t a_line = has_leaf ? 2 : 4;
  std::string lines = fmt::format("{:10}", label);
  for (int i = 0; i < (number == 2429 ? 5 : 6); ++i) lines += fmt::format("{:10}", 0);
  lines += fmt::format("{:10}\n{}\n", members.size(), name);
  for (std::size_t i = 0; i < members.size(); ++i) {
    lines += fmt::format("{:10}{:10}", type, members[i]);
    if (has_leaf) lines += fmt::format("{:10}{:10}", 0, 0);
    if ((i + 1) % a_line == 0 || i + 1 == members.size()) lines += "\n";
  }
  return lines;
}

const std::string k_two_cubes = nodes_as(2411, corners_of_two_cubes()) + dataset(2412, k_elements);

TEST(UniversalFile, GroupsOfEveryDatasetNameBodiesSurfacesAndPoints) {
  for (const int number : {2429, 2430, 2432, 2435, 2452, 2467, 2477}) {
    SCOPED_TRACE(number);
    const RawMesh raw = universal(
        k_two_cubes +
        dataset(number, group(number, 1, "casting", 8, {1}) + group(number, 2, "die half", 8, {2}) +
                            group(number, 3, "outside", 8, {3}) + group(number, 4, "foot", 7, {1, 2, 3})));
    EXPECT_EQ(raw.groups.size(), 4u);
    EXPECT_NEAR(volume(distribute(raw, {"casting"}, {}), AnalysisKind::solid), 8e-6, 1e-15);
    EXPECT_EQ(raw.groups.at("die half").blocks.at(0).input_element, (InputNumbers{2}));
    EXPECT_EQ(raw.groups.at("outside").dimension, 2);
    EXPECT_EQ(raw.groups.at("foot").blocks.at(0).nodes, (std::vector<Index>{0, 1, 2}));
    EXPECT_THAT(raw.notes, IsEmpty());
  }
}

TEST(UniversalFile, ElementsOfNoGroupAreKnownByTheirProperty) {
  const RawMesh raw = universal(k_two_cubes + dataset(2467, group(2467, 1, "casting", 8, {1})));
  EXPECT_EQ(raw.groups.at("group_3d_1").blocks.at(0).input_element, (InputNumbers{2}));
  EXPECT_EQ(raw.groups.at("group_2d_3").dimension, 2);
}

TEST(UniversalFile, NodesOfEveryDatasetAreRead) {
  for (const int number : {15, 781, 2411}) {
    SCOPED_TRACE(number);
    const RawMesh raw = universal(nodes_as(number, corners_of_two_cubes()) + dataset(2412, k_elements));
    EXPECT_NEAR(volume(distribute(raw, {"group_3d_1"}, {}), AnalysisKind::solid), 16e-6, 1e-15);
  }
}

TEST(UniversalFile, NodesInALocalSystemAreRefused) {
  const auto system = [](const std::string& origin, int type) {
    return dataset(2420,
                   fmt::format("         1\nPart\n         1{:10}         0\nCS1\n 1. 0. 0.\n 0. 1. 0.\n"
                               " 0. 0. 1.\n {} 0. 0.\n",
                               type, origin));
  };
  EXPECT_EQ(universal(system("0.", 0) + k_two_cubes).dimension, 3);
  for (const std::string& moved : {system("5.", 0), system("0.", 1)})
    EXPECT_THAT(complaint_of_universal(moved + k_two_cubes),
                AllOf(HasSubstr("mesh.unv:15"), HasSubstr("coordinate system 1")));
}

TEST(UniversalFile, AUnitThatTheFileNamesIsSaidAndNotTaken) {
  const auto unit = [](double factor) {
    return dataset(164, fmt::format("         1  SI: Meter (newton)         2\n{:25.16E}{:25.16E}{:25.16E}\n"
                                    "{:25.16E}\n",
                                    factor, 1., 1., 273.15));
  };
  const RawMesh raw = universal(unit(1) + k_two_cubes);
  EXPECT_DOUBLE_EQ(raw.x[2][0], 0.04);
  EXPECT_THAT(raw.notes, ElementsAre(AllOf(HasSubstr("40 mm"), HasSubstr("40000 mm"))));
  EXPECT_THAT(universal(unit(1000) + k_two_cubes).notes, IsEmpty());
}

TEST(UniversalFile, DatasetsThatMaySaySomethingOfTheMeshAreNamed) {
  EXPECT_THAT(universal(k_two_cubes + dataset(2414, "   1\n") + dataset(2438, "   1\n")).notes,
              ElementsAre(AllOf(HasSubstr("2438"), ::testing::Not(HasSubstr("2414")))));
}

TEST(UniversalFile, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(complaint_of_universal("mesh\n"), AllOf(HasSubstr(":1"), HasSubstr("-1")));
  EXPECT_THAT(complaint_of_universal(k_two_cubes.substr(0, k_two_cubes.rfind("    -1"))),
              HasSubstr("the file ends inside"));
  const std::string nodes = nodes_as(2411, corners_of_two_cubes());
  EXPECT_THAT(complaint_of_universal(nodes + dataset(2412, "1 113 1 1 7 6\n1 2 3 4 5 6\n")),
              AllOf(HasSubstr(":30"), HasSubstr("wedge")));
  EXPECT_THAT(complaint_of_universal(nodes + dataset(2412, "1 111 1 1 7 4\n1 2 3 99\n")),
              HasSubstr("node 99"));
  EXPECT_THAT(complaint_of_universal(nodes + dataset(2412, "1 111 1 1 7 3\n1 2 3\n")),
              HasSubstr("has 3 nodes"));
  EXPECT_THAT(complaint_of_universal(nodes), HasSubstr("no triangles"));
  EXPECT_THAT(universal(k_two_cubes + dataset(2467, group(2467, 1, "casting", 8, {1, 77}))).notes,
              ElementsAre(HasSubstr("'casting' names 1 elements")));
}

}  // namespace
