/// MED files, read again with MED's own library, in MED's own numbering. Built where the library is.
#include "results/formats/med.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/parts/distribute.hpp"
#include "results/formats/field_output.hpp"
#include "results/formats/pvd.hpp"
#include "results/output/output_error.hpp"
#include "sample.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::results {
namespace {

using mesh::Shape;
using Edges = std::vector<std::array<std::size_t, 2>>;

/// A kind of cells in MED: its number, its corners, and between which corners its mid nodes lie.
struct MedCells {
  med_geometry_type type;
  std::size_t corners;
  Edges mid_nodes;
};

const Edges k_triangle = {{0, 1}, {1, 2}, {2, 0}}, k_square = {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
            k_tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
            k_hexahedron = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                            {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

const std::map<Shape, MedCells> k_cells = {
    {Shape::tri3, {MED_TRIA3, 3, {}}},  {Shape::tri6, {MED_TRIA6, 3, k_triangle}},
    {Shape::quad4, {MED_QUAD4, 4, {}}}, {Shape::quad8, {MED_QUAD8, 4, k_square}},
    {Shape::tet4, {MED_TETRA4, 4, {}}}, {Shape::tet10, {MED_TETRA10, 4, k_tetrahedron}},
    {Shape::hex8, {MED_HEXA8, 8, {}}},  {Shape::hex20, {MED_HEXA20, 8, k_hexahedron}}};

using Vector = std::array<double, 3>;
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double triple(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

struct Med : ::testing::TestWithParam<Shape> {
  test::SharedFolder folder;
};

TEST_P(Med, HoldsTheMeshInItsOwnNumberingAndTheFieldsOfAllTimes) {
  const Shape shape = GetParam();
  const MedCells& cells = k_cells.at(shape);
  const bool solid = cells.type > 300;
  const mesh::OneBlock block =
      solid ? mesh::OneBlock{{3, 2, 1}, {}, {3, 2, 2}, "part"} : mesh::OneBlock{{3, 2}, {}, {3, 2}, "part"};
  if (processes::count() > 1) GTEST_SKIP() << "one process reads the parts of several as vtkhdf does";
  const mesh::Mesh mesh = mesh::distribute(mesh::make_block(block, shape), {"part"}, {});
  std::vector<double> temperature, number;
  for (const mesh::Point& x : mesh.x) temperature.push_back(300 + 10 * x[0] + x[1]);
  for (const mesh::ElementBlock& b : mesh.blocks)
    for (const GlobalIndex e : b.input_element) number.push_back(static_cast<double>(e));
  FieldSet fields;
  fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  fields.add({"number", "1", 1, mesh::FieldPlace::cell, number});
  const RunFolder run(folder.path, "");
  FieldOutput output(run, mesh);
  output.write(0, fields);
  for (double& t : temperature) t += 5;
  output.write(2.5, fields);

  const std::string path = (folder.path / "run.med").string();
  const MedReport report = write_med(run.root() / k_collection, {"the part"}, path);
  EXPECT_EQ(report.times, 2u);
  EXPECT_EQ(report.fields, 2u);
  EXPECT_EQ(report.points, mesh.x.size());
  EXPECT_EQ(report.cells, number.size());

  const med_idt file = MEDfileOpen(path.c_str(), MED_ACC_RDONLY);
  ASSERT_GE(file, 0);
  std::vector<double> x(3 * report.points), t(report.points), n(report.cells);
  ASSERT_EQ(MEDmeshNodeCoordinateRd(file, "solidus", MED_NO_DT, MED_NO_IT, MED_FULL_INTERLACE, x.data()), 0);
  const std::size_t per_cell = cells.corners + cells.mid_nodes.size();
  std::vector<med_int> nodes(report.cells * per_cell), families(report.cells);
  ASSERT_EQ(MEDmeshElementConnectivityRd(file, "solidus", MED_NO_DT, MED_NO_IT, MED_CELL, cells.type,
                                         MED_NODAL, MED_FULL_INTERLACE, nodes.data()),
            0);
  const auto at = [&](std::size_t cell, std::size_t i) {
    const auto node = 3 * static_cast<std::size_t>(nodes[cell * per_cell + i] - 1);
    return Vector{x[node], x[node + 1], x[node + 2]};
  };
  for (std::size_t c = 0; c < report.cells; ++c) {
    // The bases of MED's solids are seen clockwise from their tops, which is the other way round than VTK's.
    if (solid) {
      const Vector first = at(c, 0), up = at(c, cells.corners == 8 ? 4 : 3) - first;
      EXPECT_LT(triple(at(c, 1) - first, at(c, cells.corners == 8 ? 3 : 2) - first, up), 0);
    }
    for (std::size_t m = 0; m < cells.mid_nodes.size(); ++m) {
      const Vector a = at(c, cells.mid_nodes[m][0]), b = at(c, cells.mid_nodes[m][1]),
                   middle = at(c, cells.corners + m);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(middle[i], (a[i] + b[i]) / 2, 1e-12);
    }
  }

  med_int step = 0, iteration = 0;
  double time = 0;
  for (const int moment : {1, 2}) {
    ASSERT_EQ(MEDfieldComputingStepInfo(file, "temperature", moment, &step, &iteration, &time), 0);
    EXPECT_EQ(time, moment == 1 ? 0 : 2.5);
    ASSERT_EQ(MEDfieldValueRd(file, "temperature", step, iteration, MED_NODE, MED_NONE, MED_FULL_INTERLACE,
                              MED_ALL_CONSTITUENT, reinterpret_cast<unsigned char*>(t.data())),
              0);
    for (std::size_t i = 0; i < t.size(); ++i)
      EXPECT_EQ(t[i], 300 + 10 * x[3 * i] + x[3 * i + 1] + (moment == 2 ? 5 : 0));
    ASSERT_EQ(MEDfieldValueRd(file, "number", step, iteration, MED_CELL, cells.type, MED_FULL_INTERLACE,
                              MED_ALL_CONSTITUENT, reinterpret_cast<unsigned char*>(n.data())),
              0);
    EXPECT_EQ(n, number);
  }

  ASSERT_EQ(MEDmeshEntityFamilyNumberRd(file, "solidus", MED_NO_DT, MED_NO_IT, MED_CELL, cells.type,
                                        families.data()),
            0);
  EXPECT_EQ(families, std::vector<med_int>(report.cells, -1));
  std::string group;
  for (int i = 1; i <= MEDnFamily(file, "solidus"); ++i) {
    std::string family(MED_NAME_SIZE + 1, '\0'), groups(2 * MED_LNAME_SIZE + 1, '\0');
    med_int number_of_family = 0;
    ASSERT_EQ(MEDfamilyInfo(file, "solidus", i, family.data(), &number_of_family, groups.data()), 0);
    if (number_of_family == -1) group = groups.substr(0, groups.find_last_not_of(std::string(" \0", 2)) + 1);
  }
  EXPECT_EQ(group, "the part");
  MEDfileClose(file);

  EXPECT_THROW(write_med(run.root() / k_collection, {"the part"}, folder.path / "no" / "folder.med"),
               OutputError);
  std::filesystem::remove(run.fields() / "fields_00001.vtu");
  EXPECT_THROW(write_med(run.root() / k_collection, {"the part"}, folder.path / "none.med"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "none.med"));
}

INSTANTIATE_TEST_SUITE_P(AllShapes, Med,
                         ::testing::Values(Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4,
                                           Shape::tet10, Shape::hex8, Shape::hex20));

}  // namespace
}  // namespace solidus::results
