// Unstructured grids of VTK, as other programs write them.
#include "mesh/files/vtu_mesh.hpp"

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

/// Two cells side by side, quadrilaterals of one metre, with cell data.
RawMesh two_squares(const std::string& cell_data, int type = 9) {
  const auto folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("vtu_meshes_" + std::to_string(rank()));
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "mesh.vtu").string();
  std::ofstream(file) << fmt::format(
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"6\" "
      "NumberOfCells=\"2\">\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
      "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</DataArray></Points>\n"
      "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{}</DataArray>\n"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">{}</DataArray>\n"
      "<DataArray type=\"Int8\" Name=\"types\" format=\"ascii\">{} {}</DataArray></Cells>\n"
      "<CellData>{}</CellData></Piece></UnstructuredGrid></VTKFile>\n",
      type == 69 ? "0 1 4 1 5 4" : "0 1 4 3 1 2 5 4", type == 69 ? "3 6" : "4 8", type, type, cell_data);
  return read_vtu_mesh(file, 1);
}

std::string data(const std::string& name, const std::string& values) {
  return fmt::format("<DataArray type=\"Float64\" Name=\"{}\" format=\"ascii\">{}</DataArray>", name, values);
}

TEST(VtuMesh, RegionsUnderTheNamesOfOtherProgramsAreBodiesAndSaid) {
  for (const char* name :
       {"material", "MaterialIds", "GroupIds", "Region_ID", "cell_tags", "ElementBlockIds"}) {
    SCOPED_TRACE(name);
    const RawMesh raw = two_squares(data("temperature", "300.5 20") + data(name, "7 3"));
    ASSERT_EQ(raw.groups.size(), 2u);
    EXPECT_EQ(raw.groups.at("body_1").blocks.at(0).input_element, (InputNumbers{2}));
    EXPECT_THAT(raw.notes, ElementsAre(AllOf(HasSubstr(name), HasSubstr("3, 7"))));
  }
}

TEST(VtuMesh, OurOwnNamesComeBeforeOthersWithoutAWord) {
  const RawMesh raw = two_squares(data("material", "2 1") + data("body", "0 1"));
  EXPECT_EQ(raw.groups.at("body_1").blocks.at(0).input_element, (InputNumbers{1}));
  EXPECT_THAT(raw.notes, IsEmpty());
}

TEST(VtuMesh, OtherWholeNumbersAreNamedAndNotTaken) {
  const RawMesh raw = two_squares(data("colour", "1 2") + data("same", "4 4") + data("t", "0.5 1"));
  EXPECT_EQ(raw.groups.size(), 1u);
  EXPECT_THAT(raw.notes, ElementsAre(AllOf(HasSubstr("`colour`"), ::testing::Not(HasSubstr("same")))));
}

TEST(VtuMesh, LinearLagrangeCellsAreThoseOfTheirCorners) {
  EXPECT_EQ(two_squares("", 70).groups.at("body_1").blocks.at(0).shape, Shape::quad4);
  EXPECT_EQ(two_squares("", 69).groups.at("body_1").blocks.at(0).shape, Shape::tri3);
}

TEST(VtuMesh, FilesOfDolfinxAreRead) {
  const std::string folder = std::string(SOLIDUS_SOURCE_DIR) + "/tests/unit/mesh/dolfinx/";
  for (const auto& [file, shape, n] :
       {std::tuple{"tetra71.vtu", Shape::tet4, 48}, std::tuple{"hexa72.vtu", Shape::hex8, 1}}) {
    RawMesh raw = read_vtu_mesh(folder + file, 1);
    validate_and_orient(raw, file);
    const RawBlock& block = raw.groups.at("body_1").blocks.at(0);
    EXPECT_EQ(block.shape, shape);
    EXPECT_EQ(block.input_element.size(), static_cast<std::size_t>(n));
    EXPECT_NEAR(volume(distribute(raw, {"body_1"}, {}), AnalysisKind::solid), 1, 1e-12);
  }
}

}  // namespace
