#include "results/formats/vtu.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numeric>

#include "results/formats/vtk_data.hpp"
#include "results/output/output_error.hpp"
#include "sample.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

using mesh::Mesh;
using mesh::Point;
using mesh::Shape;
using ::testing::Test;

std::vector<double> count_up(std::size_t n, double step = 1) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = step * static_cast<double>(i);
  return values;
}

struct Vtu : Test {
  test::TemporaryFolder folder;
  Mesh mesh = test::triangles_and_quad();
};

TEST_F(Vtu, HoldsPointsCellsAndFieldsBitByBit) {
  const auto temperature = count_up(6, 0.1), displacement = count_up(12, 1e-7), stress = count_up(18, 1.7e6);
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  fields.add({"displacement", "m", 2, mesh::FieldPlace::node, displacement});
  fields.add({"stress", "Pa", 6, mesh::FieldPlace::cell, stress});
  write_vtu(folder.path / "a.vtu", mesh, fields, 12.5);

  const test::VtuFile file(folder.path / "a.vtu");
  EXPECT_EQ(file.array<double>("temperature"), temperature);
  EXPECT_EQ(file.array<double>("stress"), stress);
  const auto padded = file.array<double>("displacement");
  ASSERT_EQ(padded.size(), 18U);
  for (std::size_t node = 0; node < 6; ++node) {
    EXPECT_EQ(padded[3 * node], displacement[2 * node]);
    EXPECT_EQ(padded[3 * node + 1], displacement[2 * node + 1]);
    EXPECT_EQ(padded[3 * node + 2], 0.0);
  }
  EXPECT_EQ(file.array<double>("Points").size(), 18U);
  EXPECT_EQ(file.array<std::int64_t>("connectivity"),
            (std::vector<std::int64_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 4}));
  EXPECT_EQ(file.array<std::int64_t>("offsets"), (std::vector<std::int64_t>{3, 6, 10}));
  EXPECT_EQ(file.array<std::uint8_t>("types"), (std::vector<std::uint8_t>{5, 5, 9}));
  EXPECT_EQ(file.array<std::int32_t>("body"), (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(file.array<std::int64_t>("element"), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(file.array<std::int64_t>("node")[0], 100);
  EXPECT_NE(file.xml.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">12.5<"),
            std::string::npos);
  EXPECT_NE(file.xml.find(">K</InformationKey>"), std::string::npos);
  EXPECT_NE(file.attributes("stress").find("ComponentName5=\"XZ\""), std::string::npos);
}

TEST_F(Vtu, HoldsOnlyCountedElementsAndTheirNodes) {
  mesh.blocks[0].n_counted = 0;
  const auto temperature = count_up(6), pressure = count_up(3);
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  fields.add({"pressure", "Pa", 1, mesh::FieldPlace::cell, pressure});
  write_vtu(folder.path / "a.vtu", mesh, fields, 0);
  const test::VtuFile file(folder.path / "a.vtu");
  EXPECT_EQ(file.array<double>("temperature"), (std::vector<double>{1, 2, 4, 5}));
  EXPECT_EQ(file.array<double>("pressure"), (std::vector<double>{2}));
  EXPECT_EQ(file.array<std::int64_t>("connectivity"), (std::vector<std::int64_t>{0, 1, 3, 2}));
}

TEST_F(Vtu, OfComputedFieldsIsTheSameFileWithoutHoldingThem) {
  const auto pressure = count_up(3, 0.3), stress = count_up(18, 1.7e6), speed = count_up(12, 0.1);
  FieldSet stored, computed;
  int calls = 0;
  const auto add = [&](const char* name, int components, mesh::FieldPlace place,
                       const std::vector<double>& values) {
    stored.add({name, "1", components, place, values});
    computed.add({name, "1", components, place, {}, [&calls, values] {
                    ++calls;
                    return values;
                  }});
  };
  add("speed", 2, mesh::FieldPlace::node, speed);
  add("pressure", 1, mesh::FieldPlace::cell, pressure);
  add("stress", 6, mesh::FieldPlace::cell, stress);
  write_vtu(folder.path / "stored.vtu", mesh, stored, 3);
  write_vtu(folder.path / "computed.vtu", mesh, computed.select({}), 3);
  EXPECT_EQ(test::read_text(folder.path / "computed.vtu"), test::read_text(folder.path / "stored.vtu"));
  EXPECT_EQ(calls, 3) << "each once";
  for (const Field& field : computed.all()) {
    std::vector<double> storage;
    EXPECT_TRUE(field.values.empty());
    const std::span<const double> values = field.read(storage);
    EXPECT_EQ(values.data(), storage.data()) << "the reader's own";
  }
  for (const Field& field : stored.all()) {
    std::vector<double> storage;
    EXPECT_EQ(field.read(storage).data(), field.values.data());
    EXPECT_TRUE(storage.empty());
  }
}

TEST_F(Vtu, LeavesNothingButItselfInTheFolder) {
  write_vtu(folder.path / "a.vtu", mesh, {}, 0);
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder.path))
    names.push_back(file.path().filename());
  EXPECT_EQ(names, (std::vector<std::string>{"a.vtu"}));
}

TEST_F(Vtu, HidesTheCellsOfBodiesThatHaveLeft) {
  const int size = processes::count();
  if (size > 1) return;  // the sample is the mesh of one process
  const linear::ActiveSet active(mesh, std::vector<std::string>{mesh.bodies[1].name});
  const auto pressure = count_up(3);
  FieldSet fields;
  fields.add({"pressure", "Pa", 1, mesh::FieldPlace::cell, pressure});
  fields.set_active(&active);
  write_vtu(folder.path / "a.vtu", mesh, fields.select({"pressure"}), 0);
  const test::VtuFile file(folder.path / "a.vtu");
  EXPECT_EQ(file.array<std::uint8_t>("vtkGhostType"), (std::vector<std::uint8_t>{0, 0, 32}));
}

TEST_F(Vtu, OfSeveralCompressionBlocksReadsBack) {
  // 100 000 nodes are 800 kB, some six blocks of 128 kB and a shorter one.
  mesh::ElementBlock points;
  points.shape = Shape::point1;
  points.nodes.resize(100000);
  std::iota(points.nodes.begin(), points.nodes.end(), 0);
  const Mesh many = test::make_mesh(3, std::vector<Point>(100000, Point{1, 2, 3}), {points});
  const auto values = count_up(100000, 1.0 / 3.0);
  FieldSet fields;
  fields.add({"v", "1", 1, mesh::FieldPlace::node, values});
  write_vtu(folder.path / "a.vtu", many, fields, 0);
  EXPECT_EQ(test::VtuFile(folder.path / "a.vtu").array<double>("v"), values);
}

// The nodes of the reference element in Gmsh's order, from the basis functions themselves: node a is where
// N_a = 1 among the corners and edge middles.
std::vector<Point> gmsh_nodes(Shape shape) {
  const int n = mesh::node_count(shape);
  const bool simplex = shape == Shape::tri6 || shape == Shape::tet10;
  const std::vector<double> ticks = simplex ? std::vector{0.0, 0.5, 1.0} : std::vector{-1.0, 0.0, 1.0};
  std::vector<Point> nodes(static_cast<std::size_t>(n), Point{9, 9, 9});
  std::vector<double> values(static_cast<std::size_t>(n));
  for (const double x : ticks)
    for (const double y : ticks)
      for (const double z : mesh::dimension(shape) == 3 ? ticks : std::vector{0.0}) {
        if (simplex && x + y + z > 1) continue;
        mesh::basis_values(shape, {x, y, z}, values);
        for (std::size_t a = 0; a < nodes.size(); ++a)
          if (std::abs(values[a] - 1) < 1e-12) nodes[a] = {x, y, z};
      }
  return nodes;
}

// VTK's definition of its quadratic cells: the corners each mid node lies between (vtkQuadraticTriangle,
// vtkQuadraticQuad, vtkQuadraticTetra, vtkQuadraticHexahedron).
std::vector<std::array<int, 2>> vtk_edges(Shape shape) {
  if (shape == Shape::tri6) return {{0, 1}, {1, 2}, {2, 0}};
  if (shape == Shape::quad8) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  if (shape == Shape::tet10) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
}

class QuadraticVtu : public ::testing::TestWithParam<Shape> {};

TEST_P(QuadraticVtu, MidNodesLieBetweenTheCornersVtkExpects) {
  const Shape shape = GetParam();
  mesh::ElementBlock block;
  block.shape = shape;
  block.body = 0;
  block.nodes.resize(static_cast<std::size_t>(mesh::node_count(shape)));
  std::iota(block.nodes.begin(), block.nodes.end(), 0);
  const Mesh mesh = test::make_mesh(mesh::dimension(shape), gmsh_nodes(shape), {block});
  test::TemporaryFolder folder;
  write_vtu(folder.path / "a.vtu", mesh, {}, 0);

  const test::VtuFile file(folder.path / "a.vtu");
  const auto x = file.array<double>("Points");
  const auto nodes = file.array<std::int64_t>("connectivity");
  const auto corners = static_cast<std::size_t>(mesh::vertex_count(shape));
  const auto edges = vtk_edges(shape);
  ASSERT_EQ(nodes.size(), corners + edges.size());
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = [&](std::size_t k) { return x[3 * static_cast<std::size_t>(nodes[k]) + i]; };
      const auto [a, b] = edges[edge];
      EXPECT_EQ(at(corners + edge), (at(static_cast<std::size_t>(a)) + at(static_cast<std::size_t>(b))) / 2)
          << mesh::name(shape) << " edge " << edge << " direction " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, QuadraticVtu,
                         ::testing::Values(Shape::tri6, Shape::quad8, Shape::tet10, Shape::hex20),
                         [](const auto& of) { return std::string(mesh::name(of.param)); });

TEST_F(Vtu, OfASurfaceHoldsItsFacesAndNodalFieldsOnly) {
  mesh::Surface& surface = mesh.surfaces["wall"];
  mesh::ElementBlock lines;
  lines.shape = Shape::line2;
  lines.nodes = {2, 5};
  lines.input_element = {77};
  lines.n_counted = 1;
  surface.faces = {lines};
  auto gap = count_up(6, 1e-5);
  gap[0] = std::numeric_limits<double>::quiet_NaN();  // not on the surface: no one computed it
  const auto pressure = count_up(3);
  FieldSet fields;
  fields.add({"gap", "m", 1, mesh::FieldPlace::node, gap});
  fields.add({"pressure", "Pa", 1, mesh::FieldPlace::cell, pressure});
  write_surface_vtu(folder.path / "a.vtu", mesh, surface, fields, 0);
  const test::VtuFile file(folder.path / "a.vtu");
  EXPECT_EQ(file.array<std::uint8_t>("types"), (std::vector<std::uint8_t>{3}));
  EXPECT_EQ(file.array<double>("gap"), (std::vector<double>{gap[2], gap[5]}));
  EXPECT_FALSE(file.has("pressure"));
}

TEST_F(Vtu, IsNotWrittenWithAValueThatIsNotANumber) {
  auto temperature = count_up(6);
  temperature[4] = std::numeric_limits<double>::quiet_NaN();
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  try {
    write_vtu(folder.path / "a.vtu", mesh, fields, 0);
    FAIL() << "must throw";
  } catch (const NotFiniteError& error) {
    EXPECT_STREQ(
        error.what(),
        "field 'temperature' is not finite at node 104 (1, 1, 0) m; it is not written to the results");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST_F(Vtu, NamesTheElementWhoseValueIsInfinite) {
  const std::vector<double> pressure = {0, 1, std::numeric_limits<double>::infinity()};
  FieldSet fields;
  fields.add({"pressure", "Pa", 1, mesh::FieldPlace::cell, pressure});
  try {
    write_vtu(folder.path / "a.vtu", mesh, fields, 0);
    FAIL() << "must throw";
  } catch (const NotFiniteError& error) {
    EXPECT_STREQ(
        error.what(),
        "field 'pressure' is not finite at element 3 near (1, 0, 0) m; it is not written to the results");
  }
}

TEST_F(Vtu, LeavesNothingBehindOnAFullDisk) {
  // The temporary name leads to /dev/full, where every write fails as on a full disk.
  std::filesystem::create_symlink("/dev/full", folder.path / "a.vtu.part");
  try {
    write_vtu(folder.path / "a.vtu", mesh, {}, 0);
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder.path / "a.vtu").string() + ": cannot write: No space left on device");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST_F(Vtu, IsNotBegunWhenTheDiskIsFullBeforeIt) {
  std::filesystem::create_symlink("/dev/full", folder.path / "a.vtu.spool");
  try {
    write_vtu(folder.path / "a.vtu", mesh, {}, 0);
    FAIL() << "must throw";
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder.path / "a.vtu.spool").string() + ": cannot write: No space left on device");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST_F(Vtu, KeepsTheOldFileWhenAComputedFieldIsNotFinite) {
  write_vtu(folder.path / "a.vtu", mesh, {}, 0);
  const std::string before = test::read_text(folder.path / "a.vtu");
  FieldSet fields;
  fields.add({"number", "1", 1, mesh::FieldPlace::node, {}, [] { return count_up(6); }});
  fields.add({"pressure", "Pa", 1, mesh::FieldPlace::cell, {}, [] {
                return std::vector<double>{0, 1, std::numeric_limits<double>::quiet_NaN()};
              }});
  EXPECT_THROW(write_vtu(folder.path / "a.vtu", mesh, fields, 0), NotFiniteError);
  EXPECT_EQ(test::read_text(folder.path / "a.vtu"), before);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.vtu.part"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.vtu.spool"));
}

TEST(AppendedData, RefusesAnotherNumberOfValuesThanItWasTold) {
  test::TemporaryFolder folder;
  SpoolFile spool(folder.path / "data");
  AppendedData data(spool);
  for (const int n : {1, 3})
    EXPECT_THROW(data.add<double>({"v"}, 2,
                                  [n](const auto& put) {
                                    for (int i = 0; i < n; ++i) put(1.0);
                                  }),
                 std::logic_error);
}

TEST(SpoolFile, HasNoNameAndGivesBackWhatWasWritten) {
  test::TemporaryFolder folder;
  SpoolFile spool(folder.path / "data");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
  const auto write = [](const std::string& text) { return std::as_bytes(std::span(text)); };
  const std::string many(300000, 'x'), place = "____", there = "here", last = "end";
  spool.write(write(place));
  spool.write(write(many));
  spool.overwrite(0, write(there));
  spool.write(write(last));
  EXPECT_EQ(spool.size(), 300007U);
  OutputFile out(folder.path / "out");
  spool.copy_to(out);
  out.close();
  EXPECT_EQ(test::read_text(folder.path / "out"), there + many + last);
}

TEST_F(Vtu, ListsTheArraysAndPartsOfAllProcesses) {
  const auto temperature = count_up(6), displacement = count_up(12);
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  fields.add({"displacement", "m", 2, mesh::FieldPlace::node, displacement});
  write_pvtu(folder.path / "a.pvtu", {"a_p0.vtu", "a_p1.vtu"}, fields, false);
  const std::string text = test::read_text(folder.path / "a.pvtu");
  for (const char* piece :
       {"type=\"PUnstructuredGrid\"", "<Piece Source=\"a_p0.vtu\"/>", "<Piece Source=\"a_p1.vtu\"/>",
        "<PDataArray type=\"Float64\" Name=\"temperature\">",
        "<PDataArray type=\"Float64\" Name=\"displacement\" NumberOfComponents=\"3\">"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece;
}

TEST(FieldSet, KnowsItsFieldsByName) {
  const std::vector<double> none;
  FieldSet fields;
  fields.add({"a", "1", 1, mesh::FieldPlace::node, none});
  fields.add({"b", "1", 1, mesh::FieldPlace::node, none});
  EXPECT_EQ(fields.find("b")->name, "b");
  EXPECT_EQ(fields.find("c"), nullptr);
  EXPECT_EQ(fields.select({"b"}).all().size(), 1U);
  EXPECT_EQ(fields.select({}).all().size(), 2U);
  EXPECT_THROW(fields.select({"c"}), InputError);
  EXPECT_THROW(fields.add({"a", "1", 1, mesh::FieldPlace::node, none}), std::invalid_argument);
}

TEST_F(Vtu, RefusesAFieldThatDoesNotFitTheMesh) {
  const auto values = count_up(5);
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, values});
  EXPECT_THROW(write_vtu(folder.path / "a.vtu", mesh, fields, 0), std::invalid_argument);
}

}  // namespace
}  // namespace solidus::results
