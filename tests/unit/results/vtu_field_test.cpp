/// Fields read from VTK files: our own, and the ways in which other programs write theirs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "results/formats/vtu.hpp"
#include "results/formats/vtu_reader.hpp"
#include "sample.hpp"

namespace solidus::results {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const SourceLocation k_where{"case.toml", 4, 1};

struct VtuField : ::testing::Test {
  test::TemporaryFolder folder;
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder.path / "a.vtu", std::ios::binary) << text;
    return folder.path / "a.vtu";
  }
  ReadField read(const std::string& text, const std::string& field = "T", int body = -1) const {
    return read_vtu(write(text), field, body, 1.0, k_where);
  }
};

TEST_F(VtuField, OfOurOwnIsReadBitByBit) {
  const mesh::Mesh mesh = test::triangles_and_quad();
  std::vector<double> temperature;
  for (std::size_t i = 0; i < mesh.x.size(); ++i) temperature.push_back(300 + 0.1 * static_cast<double>(i));
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  const std::vector<double> rest(2 * mesh.x.size(), 0.0);
  fields.add({"displacement", "m", 2, mesh::FieldPlace::node, rest});
  write_vtu(folder.path / "a.vtu", mesh, fields, 1);
  const ReadField read = read_vtu(folder.path / "a.vtu", "temperature", -1, 1, k_where);
  EXPECT_EQ(read.values, temperature);
  EXPECT_EQ(read.mesh.x, mesh.x);
  EXPECT_EQ(read.unit, "K");
  ASSERT_EQ(read.mesh.blocks.size(), 2U);
  EXPECT_EQ(read.mesh.blocks[0].nodes, mesh.blocks[0].nodes);
  const ReadField second = read_vtu(folder.path / "a.vtu", "temperature", 1, 0.001, k_where);
  ASSERT_EQ(second.mesh.blocks.size(), 1U);
  EXPECT_EQ(second.mesh.blocks[0].shape, mesh::Shape::quad4);
  EXPECT_EQ(second.mesh.x[1][0], 0.001 * mesh.x[1][0]);
  EXPECT_THAT(
      [&] { read_vtu(folder.path / "a.vtu", "temperature", 7, 1, k_where); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("case.toml:4"), HasSubstr("no cells of the body 7"))));
  EXPECT_THAT([&] { read_vtu(folder.path / "a.vtu", "temprature", -1, 1, k_where); },
              ThrowsMessage<InputError>(HasSubstr("did you mean 'temperature'")));
  EXPECT_THAT([&] { read_vtu(folder.path / "a.vtu", "displacement", -1, 1, k_where); },
              ThrowsMessage<InputError>(HasSubstr("several components")));
  EXPECT_THAT([&] { read_vtu(folder.path / "b.vtu", "temperature", -1, 1, k_where); },
              ThrowsMessage<InputError>(HasSubstr("does not exist")));
}

TEST_F(VtuField, PartsOfAParallelRunAreReadTogether) {
  const mesh::Mesh mesh = test::triangles_and_quad();
  FieldSet fields;
  const std::vector<double> sevens(mesh.x.size(), 7.0);
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, sevens});
  write_vtu(folder.path / "a.vtu", mesh, fields, 1);
  write_vtu(folder.path / "b.vtu", mesh, fields, 1);
  write_pvtu(folder.path / "all.pvtu", {"a.vtu", "b.vtu"}, fields, false);
  const ReadField read = read_vtu(folder.path / "all.pvtu", "temperature", -1, 1, k_where);
  EXPECT_EQ(read.values, std::vector<double>(2 * mesh.x.size(), 7.0));
}

// A tetrahedron, a wedge and a voxel as text.
TEST_F(VtuField, TextOfOtherProgramsIsRead) {
  const ReadField field = read(R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="3">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 4 0 1 2 4 5 6 0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 10 18</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 13 11</DataArray></Cells>
<PointData><DataArray type="Float64" Name="T" format="ascii">1 2 3 4 5 6 7 8.5</DataArray></PointData>
</Piece></UnstructuredGrid></VTKFile>)");
  EXPECT_THAT(field.values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8.5));
  ASSERT_EQ(field.mesh.blocks.size(), 2U);
  EXPECT_EQ(field.mesh.blocks[0].shape, mesh::Shape::tet4);
  EXPECT_EQ(field.mesh.blocks[0].size(), 4);  // one, and three of the wedge
  EXPECT_THAT(field.mesh.blocks[1].nodes, ElementsAre(0, 1, 3, 2, 4, 5, 7, 6));
}

// The same triangle as base64, without compression, as meshio and VTK write it: 8 bytes of length first.
const std::string k_base64 =
    R"(<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
<PointData><DataArray type="Float64" Name="T" format="binary">
GAAAAAAAAAAAAAAAAADwPwAAAAAAAABAAAAAAAAACEA=
</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>)";

TEST_F(VtuField, Base64IsRead) {
  EXPECT_THAT(read(k_base64).values, ElementsAre(1, 2, 3));
}

TEST_F(VtuField, DamageIsNamed) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto message = [](const std::string& text) { return ThrowsMessage<InputError>(HasSubstr(text)); };
  EXPECT_THAT([&] { read("no xml"); }, message("no XML"));
  EXPECT_THAT([&] { read(with(k_base64, "LittleEndian", "BigEndian")); }, message("big endian"));
  EXPECT_THAT([&] { read(with(k_base64, "GAAAAAAAAAAAAAAAAADw", "GAAA")); }, message("ends before"));
  EXPECT_THAT([&] { read(with(k_base64, ">0 1 2<", ">0 1 3<")); }, message("no point"));
  EXPECT_THAT([&] { read(with(k_base64, ">0 1 2<", ">0 1 x<")); }, message("'x' in the file is no number"));
  EXPECT_THAT([&] { read(with(k_base64, ">5<", ">42<")); }, message("type 42 are not read"));
  EXPECT_THAT([&] { read(with(k_base64, ">5<", ">3<")); }, message("no areas or volumes"));
  EXPECT_THAT([&] { read(k_base64, "T", 0); }, message("no cell data `body`"));
  EXPECT_THAT([&] { read(with(k_base64, ">5<", ">nan<")); }, message("type nan are not read"));
}

// What a file says of its sizes takes no memory that its bytes do not account for.
TEST_F(VtuField, SizesBeyondTheFileAreRefusedBeforeTheyAreTaken) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto message = [](const std::string& text) { return ThrowsMessage<InputError>(HasSubstr(text)); };
  const std::string many = with(k_base64, "NumberOfPoints=\"3\"", "NumberOfPoints=\"2000\"");
  EXPECT_THAT([&] { read(many); }, message("shorter than its grid"));
  EXPECT_THAT([&] { read(with(k_base64, "NumberOfCells=\"1\"", "NumberOfCells=\"2000\"")); },
              message("shorter than its grid"));
  const std::string packed = with(with(k_base64, "NumberOfPoints=\"3\"", "NumberOfPoints=\"2000000\""),
                                  "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order");
  EXPECT_THAT([&] { read(packed); }, message("shorter than its grid"));
  // A block of 100 000 bytes.
  const std::string long_block =
      with(with(k_base64, "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order"),
           "GAAAAAAAAAAAAAAAAADwPwAAAAAAAABAAAAAAAAACEA=", "AQAAAAAAAAAYAAAAAAAAAAAAAAAAAAAAoIYBAAAAAAA=");
  EXPECT_THAT([&] { read(long_block); }, message("a block is longer than the file"));
}

// Grids have ten levels, 50 are allowed.
TEST_F(VtuField, ElementsTooDeepInEachOtherAreRefused) {
  std::string deep = "<VTKFile type=\"UnstructuredGrid\">";
  for (int i = 0; i < 60; ++i) deep += "<a b='/>'>";
  EXPECT_THAT([&] { read(deep); }, ThrowsMessage<InputError>(HasSubstr("deeper in each other")));
  std::string wide = k_base64;  // many next to each other are in order, comments and all
  for (int i = 0; i < 1000; ++i)
    wide.insert(wide.find("<UnstructuredGrid>"), "<FieldData><!-- <a> --><Array/><?a <b> ?></FieldData>");
  EXPECT_THAT(read(wide).values, ElementsAre(1, 2, 3));
}

TEST_F(VtuField, PartsThatAreListsOrComeTwiceAreRefused) {
  const auto list = [&](const std::string& name, const std::vector<std::string>& parts) {
    std::ofstream out(folder.path / name);
    out << "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>";
    for (const std::string& part : parts) out << "<Piece Source=\"" << part << "\"/>";
    out << "</PUnstructuredGrid></VTKFile>";
  };
  const auto read_list = [&] { read_vtu(folder.path / "all.pvtu", "T", -1, 1, k_where); };
  write(k_base64);
  list("all.pvtu", {"a.vtu"});
  EXPECT_NO_THROW(read_list());
  list("all.pvtu", {"a.vtu", "./a.vtu"});
  EXPECT_THAT(read_list, ThrowsMessage<InputError>(HasSubstr("is in the list of parts twice")));
  list("all.pvtu", {"other.pvtu"});
  list("other.pvtu", {"a.vtu"});
  EXPECT_THAT(read_list, ThrowsMessage<InputError>(HasSubstr("a grid of the type 'PUnstructuredGrid'")));
}

}  // namespace
}  // namespace solidus::results
