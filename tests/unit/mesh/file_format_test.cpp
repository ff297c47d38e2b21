// Formats of mesh files: each has endings and a place of its own, and something that reads it.
#include "mesh/files/file_format.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace {

using namespace solidus::mesh;

TEST(FileFormats, ComeInTheOrderOfTheirPlacesAndShareNoEnding) {
  std::set<std::string_view> endings;
  int last = 0;
  for (const FileFormat& format : file_formats()) {
    EXPECT_GT(format.place, last) << format.name;
    last = format.place;
    EXPECT_FALSE(format.begins_with.empty()) << format.name;
    for (const std::string_view ending : format.endings) EXPECT_TRUE(endings.insert(ending).second) << ending;
  }
  EXPECT_EQ(file_formats().size(), 13U);
}

TEST(FileFormats, AreKeptFromGmshUnlessItKnowsThem) {
  std::set<std::string_view> by_gmsh;
  for (const FileFormat& format : file_formats())
    if (format.by_gmsh) by_gmsh.insert(format.name);
  EXPECT_EQ(by_gmsh, (std::set<std::string_view>{"BREP", "Gmsh mesh", "Gmsh script", "IGES", "STEP", "VTK"}));
}

TEST(FileFormats, AreRefusedWhereAnEndingIsTakenOrNothingReadsThem) {
  const auto nothing = [](const std::string&, double) { return std::optional<RawMesh>(); };
  const auto add = [&](int place, std::string_view ending, ReadMeshFile read) {
    add_file_format(
        {.name = "another", .place = place, .endings = {ending}, .begins_with = "", .read = read});
  };
  EXPECT_THROW(add(1000, ".step", nothing), std::logic_error);
  EXPECT_THROW(add(file_formats().front().place, ".another", nothing), std::logic_error);
  EXPECT_THROW(add(1000, ".another", nullptr), std::logic_error);
}

TEST(FileFormats, AreToldInTheirOrder) {
  EXPECT_EQ(common_formats(), ".msh 2.2 or 4.1, .geo, .step, Abaqus .inp, .unv, .med, .bdf, .vtu, …");
}

}  // namespace
