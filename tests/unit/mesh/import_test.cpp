// Files that Gmsh wrote read back, and files that are no meshes.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "mesh/files/file_format.hpp"
#include "mesh/files/gmsh_mesh_file.hpp"
#include "mesh/gmsh/session.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A folder of this process.
class MeshFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(SOLIDUS_BINARY_DIR) / ("mesh_files_" + std::to_string(rank()));
    std::filesystem::create_directories(folder_);
  }
  std::string path(const std::string& file) const { return (folder_ / file).string(); }
  std::string write(const std::string& file, const std::string& text) const {
    std::ofstream(path(file), std::ios::binary) << text;
    return path(file);
  }
  static std::string text_of(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path folder_;
};

// Two unit cubes side by side in millimetres with named volumes and surfaces, or two squares.
void make_model(int dimension, int element_order, bool named, bool recombine) {
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("two bodies");
  namespace occ = gmsh::model::occ;
  if (dimension == 3) {
    occ::addBox(0, 0, 0, 10, 10, 10, 1);
    occ::addBox(10, 0, 0, 20, 10, 10, 2);
  } else {
    occ::addRectangle(0, 0, 0, 10, 10, 1);
    occ::addRectangle(10, 0, 0, 20, 10, 2);
  }
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  occ::fragment({{dimension, 1}}, {{dimension, 2}}, out, map);
  occ::synchronize();
  if (named) {
    gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, {1}), "part");
    gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, {2}), "mould");
    gmsh::vectorpair left;
    gmsh::model::getEntitiesInBoundingBox(-0.1, -0.1, -0.1, 0.1, 10.1, 10.1, left, dimension - 1);
    std::vector<int> tags;
    for (const auto& [d, tag] : left) tags.push_back(tag);
    gmsh::model::setPhysicalName(dimension - 1, gmsh::model::addPhysicalGroup(dimension - 1, tags), "left");
  }
  gmsh::option::setNumber("Mesh.MeshSizeMax", 6);
  if (recombine) gmsh::option::setNumber("Mesh.RecombineAll", 1);
  if (element_order == 2) gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  gmsh::model::mesh::generate(dimension);
  gmsh::model::mesh::setOrder(element_order);
}

void write_model(const std::string& path, int dimension, int element_order, double version, bool named = true,
                 bool recombine = false, bool binary = false) {
  gmsh::initialize(0, nullptr, false);
  make_model(dimension, element_order, named, recombine);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
  gmsh::option::setNumber("Mesh.SaveGroupsOfNodes", 1);
  gmsh::write(path);
  gmsh::finalize();
}

// Areas in mm² or volumes in mm³ and the groups of the two bodies, however they were stored.
void expect_two_bodies(RawMesh raw, int dimension) {
  validate_and_orient(raw, "two bodies");
  EXPECT_EQ(raw.dimension, dimension);
  ASSERT_TRUE(raw.groups.contains("part") && raw.groups.contains("mould") && raw.groups.contains("left"));
  EXPECT_EQ(raw.groups.at("part").dimension, dimension);
  EXPECT_EQ(raw.groups.at("left").dimension, dimension - 1);
  const double unit = dimension == 3 ? 1e-9 : 1e-6, depth = dimension == 3 ? 10 : 1;
  const AnalysisKind kind = dimension == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain;
  EXPECT_NEAR(volume(distribute(raw, {"part"}, {"left"}), kind, 4), 100 * depth * unit,
              1e-12 * depth * unit * 100);
  EXPECT_NEAR(volume(distribute(raw, {"mould"}, {}), kind, 4), 200 * depth * unit,
              1e-12 * depth * unit * 200);
  // The interface's nodes are shared: both together have fewer nodes than each alone.
  const auto nodes = [&](std::vector<std::string> bodies) {
    return distribute(raw, bodies, {}).n_global_nodes;
  };
  EXPECT_LT(nodes({"part", "mould"}), nodes({"part"}) + nodes({"mould"}));
}

void expect_same(const RawMesh& a, const RawMesh& b) {
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.input_node, b.input_node);
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (auto of_a = a.groups.begin(), of_b = b.groups.begin(); of_a != a.groups.end(); ++of_a, ++of_b) {
    EXPECT_EQ(of_a->first, of_b->first);
    EXPECT_EQ(of_a->second.dimension, of_b->second.dimension);
    ASSERT_EQ(of_a->second.blocks.size(), of_b->second.blocks.size()) << of_a->first;
    for (std::size_t k = 0; k < of_a->second.blocks.size(); ++k) {
      EXPECT_EQ(of_a->second.blocks[k].shape, of_b->second.blocks[k].shape);
      EXPECT_EQ(of_a->second.blocks[k].nodes, of_b->second.blocks[k].nodes);
      EXPECT_EQ(of_a->second.blocks[k].input_element, of_b->second.blocks[k].input_element);
    }
  }
}

std::string complaint_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST_F(MeshFiles, MshOfBothVersionsReadsBackInEveryOrderTextOrBinary) {
  for (const int dimension : {2, 3})
    for (const int element_order : {1, 2})
      for (const double version : {2.2, 4.1})
        for (const bool binary : {false, true}) {
          const std::string file = path("two.msh");
          write_model(file, dimension, element_order, version, true, dimension == 2 && binary, binary);
          SCOPED_TRACE(std::to_string(dimension) + "D, order " + std::to_string(element_order) +
                       ", version " + std::to_string(version) + (binary ? ", binary" : ""));
          expect_two_bodies(read_mesh(file, 0.001), dimension);
        }
}

// Gmsh writes groups in dataset 2477, and mid nodes between the corners.
TEST_F(MeshFiles, UniversalFilesOfGmshReadBackInEveryOrder) {
  for (const int dimension : {2, 3})
    for (const int element_order : {1, 2})
      for (const bool recombine : {false, true}) {
        SCOPED_TRACE(std::to_string(dimension) + "D, order " + std::to_string(element_order));
        const std::string file = path("two.unv");
        write_model(file, dimension, element_order, 2.2, true, dimension == 2 && recombine);
        expect_two_bodies(read_mesh(file, 0.001), dimension);
      }
}

// Of a last line without an end Gmsh runs the first statement alone.
TEST_F(MeshFiles, AScriptWithoutANewlineAtItsEndIsRunToItsEnd) {
  const std::string script =
      "SetFactory(\"OpenCASCADE\");\nBox(1)={0,0,0,40,40,40};\nMesh.MeshSizeMax=30;\n"
      "Box(2)={40,0,0,20,40,40}; Coherence; Physical Volume(\"casting\",1)={1}; "
      "Physical Volume(\"mould\",2)={2};";
  for (const char* end : {"", "\n"}) {
    const RawMesh mesh = read_mesh(write("open.geo", script + end), 0.001);
    EXPECT_TRUE(mesh.groups.contains("casting") && mesh.groups.contains("mould")) << mesh.groups.size();
  }
}

TEST_F(MeshFiles, OptionsOfAScriptThatAreNotTakenAreSaid) {
  const std::string square =
      "Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Line(1)={1,2};\n"
      "Extrude{0,1,0}{Curve{1};}\n";
  EXPECT_TRUE(read_mesh(write("plain.geo", square), 1).notes.empty());
  const RawMesh mesh =
      read_mesh(write("set.geo", square + "Mesh.ScalingFactor = 0.001;\nMesh.ElementOrder = 2;\n"), 1);
  ASSERT_EQ(mesh.notes.size(), 2u);
  EXPECT_THAT(mesh.notes[0], AllOf(HasSubstr("ScalingFactor"), HasSubstr("0.001")));
  EXPECT_THAT(mesh.notes[1], AllOf(HasSubstr("ElementOrder"), HasSubstr("mesh.order")));
}

// Solidus reads .msh by itself; Gmsh reads the same from the same file.
TEST_F(MeshFiles, OurReaderOfMshGivesWhatGmshReads) {
  for (const int dimension : {2, 3})
    for (const int element_order : {1, 2})
      for (const double version : {2.2, 4.1})
        for (const bool binary : {false, true})
          for (const bool named : {false, true}) {
            const std::string file = path("same.msh");
            write_model(file, dimension, element_order, version, named, dimension == 2 && binary, binary);
            SCOPED_TRACE(std::to_string(dimension) + "D, order " + std::to_string(element_order) +
                         ", version " + std::to_string(version) + (binary ? ", binary" : "") +
                         (named ? ", named" : ""));
            const auto ours = read_gmsh_mesh_file(file, 0.001);
            ASSERT_TRUE(ours);
            expect_same(*ours,
                        read_with_gmsh({.path = file, .unit_in_metres = 0.001}, FileHolds::mesh, nullptr));
          }
}

TEST_F(MeshFiles, VersionsThatOnlyGmshReadsAreLeftToIt) {
  write_model(path("old.msh"), 2, 1, 1.0);
  EXPECT_FALSE(read_gmsh_mesh_file(path("old.msh"), 1));
  EXPECT_GT(read_mesh(path("old.msh"), 0.001).x.size(), 20u);
}

TEST_F(MeshFiles, GridsOfVtkAreMeshesOfTheirBodies) {
  const std::string head =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"6\" NumberOfCells=\"3\"><Points><DataArray type=\"Float64\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0</DataArray></Points>"
      "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 1 4 5 2 3 "
      "0</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 8 10</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">9 9 3</DataArray></Cells>";
  const std::string data =
      "<CellData><DataArray type=\"Int32\" Name=\"gmsh:physical\" format=\"ascii\">7 3 "
      "9</DataArray></CellData>";
  const std::string tail = "</Piece></UnstructuredGrid></VTKFile>";
  RawMesh mesh = read_mesh(write("two.vtu", head + data + tail), 0.001);
  validate_and_orient(mesh, "two.vtu");
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.x[4], (Point{0.002, 0, 0}));
  EXPECT_EQ(mesh.groups.at("body_1").blocks.at(0).input_element, InputNumbers{2});  // number 3
  EXPECT_EQ(mesh.groups.at("body_2").blocks.at(0).input_element, InputNumbers{1});
  EXPECT_EQ(mesh.groups.at("surface_1").blocks.at(0).shape, Shape::line2);
  const RawMesh whole = read_mesh(write("one.vtu", head + tail), 1);
  EXPECT_EQ(whole.groups.at("body_1").blocks.at(0).nodes.size(), 8u);
  std::string wedge = head + tail;
  wedge.replace(wedge.find("9 9 3"), 5, "9 7 3");
  EXPECT_THAT(complaint_of([&] { read_mesh(write("w.vtu", wedge), 1); }),
              AllOf(HasSubstr("w.vtu"), HasSubstr("type 7"), HasSubstr("quad4")));
}

TEST_F(MeshFiles, AbaqusInputOfGmshReadsBackWithItsSets) {
  for (const int dimension : {2, 3})
    for (const int element_order : {1, 2}) {
      const std::string file = path("two.inp");
      write_model(file, dimension, element_order, 4.1);
      SCOPED_TRACE(std::to_string(dimension) + "D, order " + std::to_string(element_order));
      expect_two_bodies(read_mesh(file, 0.001), dimension);
    }
}

TEST_F(MeshFiles, AGeometryIsMeshedHere) {
  const std::string file = write("square.geo",
                                 "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 30, 10};\n"
                                 "Physical Surface(\"plate\") = {1}; Physical Curve(\"bottom\") = {1};\n");
  const RawMesh coarse = read_mesh(file, 0.001, 0.005), fine = read_mesh(file, 0.001, 0.0025);
  EXPECT_EQ(coarse.dimension, 2);
  EXPECT_TRUE(coarse.groups.contains("bottom"));
  EXPECT_NEAR(volume(distribute(coarse, {"plate"}, {}), AnalysisKind::plane_strain), 3e-4, 1e-17);
  const double ratio = static_cast<double>(fine.x.size()) / static_cast<double>(coarse.x.size());
  EXPECT_GT(ratio, 2.5);  // half the size: about four times the nodes
  EXPECT_LT(ratio, 5);
  const RawMesh quadratic = read_mesh(file, 0.001, 0.005, 2);
  EXPECT_EQ(quadratic.groups.at("plate").blocks.at(0).shape, Shape::tri6);
}

TEST_F(MeshFiles, ConstantsOfAScriptTakeTheValuesOfTheCase) {
  const std::string file =
      write("constants.geo",
            "DefineConstant[ width = {30, Name \"width\"}, size = {5, Name \"size\"} ];\n"
            "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, width, 10};\n"
            "Characteristic Length{ PointsOf{ Surface{1}; } } = size;\n"
            "Physical Surface(\"plate\") = {1};\n");
  const auto area = [](const RawMesh& m) {
    return volume(distribute(m, {"plate"}, {}), AnalysisKind::plane_strain);
  };
  const RawMesh as_written = read_mesh(file, 0.001);
  EXPECT_NEAR(area(as_written), 3e-4, 1e-17);
  const RawMesh wide = read_mesh(file, 0.001, 0, 1, {{"width", 60}});
  EXPECT_NEAR(area(wide), 6e-4, 1e-17);
  const RawMesh fine = read_mesh(file, 0.001, 0, 1, {{"size", 1.25}, {"width", 30}});
  EXPECT_GT(fine.x.size(), 10 * as_written.x.size());
  EXPECT_THAT(complaint_of([&] {
                read_mesh(file, 0.001, 0, 1, {{"sise", 1}});
              }),
              AllOf(HasSubstr("'sise'"), HasSubstr("did you mean 'size'")));
  EXPECT_EQ(read_mesh(file, 0.001).x.size(), as_written.x.size()) << "values stay behind";
  const std::string plain = write("plain.geo", "width = 3; Point(1) = {0, 0, 0};\n");
  EXPECT_THAT(complaint_of([&] {
                read_mesh(plain, 0.001, 0, 1, {{"width", 1}});
              }),
              HasSubstr("DefineConstant"));
  EXPECT_THAT(complaint_of([&] {
                read_mesh(write("a.msh", "$MeshFormat\n"), 1, 0, 1, {{"size", 1}});
              }),
              HasSubstr("no .geo script"));
}

TEST_F(MeshFiles, APlainMeshWithoutNamesHasBodiesByNumber) {
  write_model(path("plain.msh"), 2, 1, 4.1, false);
  const RawMesh raw = read_mesh(path("plain.msh"), 0.001);
  EXPECT_TRUE(raw.groups.contains("body_1"));
  EXPECT_TRUE(raw.groups.contains("body_2"));
}

TEST_F(MeshFiles, AMissingFileIsNamed) {
  const std::string file = path("nowhere.msh");
  EXPECT_THAT(complaint_of([&] { read_mesh(file, 1); }), AllOf(HasSubstr("nowhere.msh"), HasSubstr("exist")));
  EXPECT_THAT(complaint_of([&] { read_mesh(path("."), 1); }), HasSubstr("not a file"));
}

TEST_F(MeshFiles, AnEmptyFileIsCalledEmpty) {
  for (const char* file : {"empty.msh", "empty.inp", "empty.geo"})
    EXPECT_THAT(complaint_of([&] { read_mesh(write(file, ""), 1); }),
                AllOf(HasSubstr(file), HasSubstr("empty")));
}

TEST_F(MeshFiles, GarbageIsRefusedUnderEveryName) {
  std::string garbage;
  unsigned state = 12345;
  for (int i = 0; i < 5000; ++i) garbage += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  for (const char* file :
       {"g.msh", "g.inp", "g.geo", "g.unv", "g.step", "g.brep", "g.vtk", "g.med", "g.bdf", "g.xyz"})
    EXPECT_THAT(complaint_of([&] { read_mesh(write(file, garbage), 1); }), HasSubstr(file)) << file;
  EXPECT_THAT(complaint_of([&] { read_mesh(write("g.msh", "$MeshFormat\n" + garbage), 1); }),
              HasSubstr("g.msh"));
  EXPECT_THAT(complaint_of([&] { read_mesh(write("t.msh", "a letter, no mesh\n"), 1); }), HasSubstr("t.msh"));
}

TEST_F(MeshFiles, ATruncatedFileIsRefusedWhereverItEnds) {
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true}) {
      const std::string file = path("whole.msh");
      write_model(file, 2, 1, version, true, false, binary);
      const std::string text = text_of(file);
      // up to the end of the elements, behind which nothing that matters follows
      const std::size_t end = text.find("$EndElements");
      ASSERT_NE(end, std::string::npos);
      for (const double part : {0.02, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97}) {
        const auto length = static_cast<std::size_t>(part * static_cast<double>(end));
        EXPECT_THAT(complaint_of([&] { read_mesh(write("cut.msh", text.substr(0, length)), 1); }),
                    HasSubstr("cut.msh"))
            << "version " << version << (binary ? " binary" : "") << ", first " << part;
      }
    }
}

TEST_F(MeshFiles, ElementsThatCannotBeUsedAreNamed) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("wedge");
  gmsh::model::addDiscreteEntity(3, 1);
  gmsh::model::mesh::addNodes(3, 1, {1, 2, 3, 4, 5, 6},
                              {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1});
  gmsh::model::mesh::addElementsByType(1, 18, {1}, {1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 1, 2, 3});
  gmsh::write(path("wedge.msh"));
  gmsh::finalize();
  EXPECT_THAT(complaint_of([&] { read_mesh(path("wedge.msh"), 1); }),
              AllOf(HasSubstr("Prism"), HasSubstr("hex8")));
}

TEST_F(MeshFiles, LengthsAreConvertedToMetres) {
  write_model(path("mm.msh"), 2, 1, 4.1);
  const RawMesh mm = read_mesh(path("mm.msh"), 0.001), m = read_mesh(path("mm.msh"), 1);
  for (std::size_t i = 0; i < m.x.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_DOUBLE_EQ(1000 * mm.x[i][d], m.x[i][d]);
}

}  // namespace
