#include "mesh/making/wall_layers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "mesh/quality.hpp"
#include "sample_mesh.hpp"
#include "split_block.hpp"
#include "system/errors.hpp"

namespace solidus::test {
namespace {

using ::testing::HasSubstr;

std::string complaint_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

/// Length, area or volume of every group.
std::map<std::string, double> measures(const RawMesh& mesh) {
  std::map<std::string, double> sizes;
  for (const GroupReport& group : assess(mesh).groups) sizes[group.name] = group.measure;
  return sizes;
}

void expect_same_measures(const RawMesh& mesh, const std::map<std::string, double>& before) {
  const auto now = measures(mesh);
  ASSERT_EQ(now.size(), before.size());
  for (const auto& [name, size] : before) EXPECT_NEAR(now.at(name), size, 1e-12 * (1 + size)) << name;
}

/// How many vertices of a body lie at x.
std::size_t vertices_at(const RawMesh& mesh, const std::string& body, double x) {
  std::set<Index> found;
  for (const RawBlock& block : mesh.groups.at(body).blocks)
    for (std::size_t e = 0; e < block.nodes.size(); e += static_cast<std::size_t>(node_count(block.shape)))
      for (int a = 0; a < vertex_count(block.shape); ++a) {
        const Index node = block.nodes[e + static_cast<std::size_t>(a)];
        if (std::abs(mesh.x[static_cast<std::size_t>(node)][0] - x) < 1e-12) found.insert(node);
      }
  return found.size();
}

class LayersOfEveryShape : public ::testing::TestWithParam<Shape> {};

TEST_P(LayersOfEveryShape, HaveTheThicknessThatWasAskedForAndKeepTheBoundary) {
  const Shape shape = GetParam();
  RawMesh mesh = sample_box(shape);
  const auto before = measures(mesh);
  const std::size_t nodes = mesh.x.size(), wall = vertices_at(mesh, "block", 0);
  const WallLayerReport report = add_wall_layers(mesh, {"x_min", "block", 3, 2, 0.005}, "box");
  validate_and_orient(mesh, "box");
  expect_same_measures(mesh, before);
  EXPECT_EQ(report.n_columns, static_cast<Index>(wall));
  EXPECT_EQ(report.n_bare, 0);
  EXPECT_NEAR(report.whole, 0.035, 1e-15);
  EXPECT_NEAR(report.mean, 0.035, 1e-12);
  for (const double x : {0.0, 0.005, 0.015, 0.035}) EXPECT_EQ(vertices_at(mesh, "block", x), wall) << x;
  if (order(shape) == 1) {
    EXPECT_EQ(mesh.x.size(), nodes + 3 * wall);
  }
  EXPECT_EQ(assess(mesh).n_unused_nodes, 0U);
  std::set<GlobalIndex> numbers(mesh.input_node.begin(), mesh.input_node.end());
  EXPECT_EQ(numbers.size(), mesh.x.size()) << "numbers of nodes repeat";
  for (const auto& [name, group] : mesh.groups)
    for (const RawBlock& block : group.blocks)
      EXPECT_EQ(block.input_element.size() * static_cast<std::size_t>(node_count(block.shape)),
                block.nodes.size());
}

INSTANTIATE_TEST_SUITE_P(Shapes, LayersOfEveryShape, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& shape) { return std::string(name(shape.param)); });

TEST(WallLayers, WithoutAThicknessFollowTheSizeOfTheWall) {
  RawMesh mesh = make_block({{0.4, 0.2}, {}, {4, 4}, "block"}, Shape::quad4);
  const WallLayerReport report = add_wall_layers(mesh, {.surface = "x_min", .body = "block"}, "box");
  EXPECT_NEAR(report.whole, 0.8 * 0.05, 1e-15);
  EXPECT_NEAR(report.first, 0.8 * 0.05 / 3, 1e-15);
}

TEST(WallLayers, GoRoundTheCornersOfAMouldAndEndOnItsOtherSurfaces) {
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
    RawMesh mesh = make_cylinder_in_mould({0.03, 0.05, 0.04, 0.03, 0.08, 0.01, 0.02}, shape);
    const auto before = measures(mesh);
    const WallLayerReport report = add_wall_layers(mesh, {"mould_surface", "mould", 2, 2, 0.0005}, "mould");
    validate_and_orient(mesh, "mould");
    expect_same_measures(mesh, before);
    EXPECT_EQ(report.n_bare, 0) << name(shape);
    // A corner's column is longer, so that both of its sides have the thickness.
    EXPECT_GT(report.mean, 0.0015);
    EXPECT_LT(report.mean, 0.00165);
  }
}

TEST(WallLayers, TaperWhereTheWallGoesOnWithoutThem) {
  RawMesh mesh = make_cylinder_in_mould({0.03, 0.05, 0.04, 0.03, 0.1, 0.01, 0.02}, Shape::tri3);
  const auto before = measures(mesh);
  const WallLayerReport report = add_wall_layers(mesh, {"mould_surface", "mould", 2, 2, 0.001}, "mould");
  validate_and_orient(mesh, "mould");
  expect_same_measures(mesh, before);
  EXPECT_EQ(report.n_bare, 1) << "at the height of the casting's top";
}

TEST(WallLayers, OnAFaceBetweenTwoBodiesLeaveTheOtherBodyAsItIs) {
  for (const Shape shape : {Shape::tri6, Shape::quad4, Shape::tet4, Shape::tet10, Shape::hex8}) {
    const bool solid = dimension(shape) == 3;
    RawMesh mesh = solid ? split_block(shape, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2)
                         : split_block(shape, {0.4, 0.2}, {4, 2}, 0.2);
    const auto before = measures(mesh);
    const RawGroup left = mesh.groups.at("left");
    add_wall_layers(mesh, {"between", "right", 2, 2, 0.004}, "box");
    validate_and_orient(mesh, "box");
    expect_same_measures(mesh, before);
    EXPECT_EQ(mesh.groups.at("left").blocks.front().nodes, left.blocks.front().nodes);
    const auto nodes = [&](std::vector<std::string> bodies) {
      return distribute(mesh, bodies, {}).n_global_nodes;
    };
    const auto shared = nodes({"left"}) + nodes({"right"}) - nodes({"left", "right"});
    RawMesh plain = solid ? split_block(shape, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2)
                          : split_block(shape, {0.4, 0.2}, {4, 2}, 0.2);
    EXPECT_EQ(shared, distribute(plain, {"left"}, {}).n_global_nodes +
                          distribute(plain, {"right"}, {}).n_global_nodes -
                          distribute(plain, {"left", "right"}, {}).n_global_nodes)
        << name(shape);
  }
}

/// The faces of the body `left` on the side y = 0 of a split block.
void add_floor(RawMesh& mesh) {
  const RawBlock all = mesh.groups.at("y_min").blocks.front();
  RawBlock floor{all.shape, {}, {}};
  const auto n = static_cast<std::size_t>(node_count(all.shape));
  for (std::size_t f = 0; f < all.nodes.size(); f += n)
    if (std::all_of(all.nodes.begin() + static_cast<std::ptrdiff_t>(f),
                    all.nodes.begin() + static_cast<std::ptrdiff_t>(f + n),
                    [&](Index i) { return mesh.x[static_cast<std::size_t>(i)][0] < 0.2 + 1e-9; })) {
      floor.nodes.insert(floor.nodes.end(), all.nodes.begin() + static_cast<std::ptrdiff_t>(f),
                         all.nodes.begin() + static_cast<std::ptrdiff_t>(f + n));
      floor.input_element.push_back(all.input_element[f / n]);
    }
  mesh.groups["floor"] = {mesh.dimension - 1, {floor}};
}

TEST(WallLayers, EndWhereAnotherBodyBeginsAndStayConformingThere) {
  RawMesh mesh = split_block(Shape::tet4, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2);
  add_floor(mesh);
  const auto before = measures(mesh);
  const WallLayerReport report = add_wall_layers(mesh, {"floor", "left", 2, 2, 0.004}, "box");
  validate_and_orient(mesh, "box");
  expect_same_measures(mesh, before);
  EXPECT_EQ(report.n_bare, 3);
  EXPECT_EQ(report.n_columns, 6);
  RawMesh hexes = split_block(Shape::hex8, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2);
  add_floor(hexes);
  EXPECT_THAT(complaint_of([&] {
                add_wall_layers(hexes, {"floor", "left", 2, 2, 0.004}, "box");
              }),
              HasSubstr("no room for layers on 'floor'"));
}

TEST(WallLayers, AreThinnerWhereThereIsNoRoom) {
  for (const Shape shape : {Shape::tri3, Shape::tet4, Shape::tet10, Shape::hex8}) {
    RawMesh mesh = sample_box(shape);
    const auto before = measures(mesh);
    const WallLayerReport report = add_wall_layers(mesh, {"x_min", "block", 2, 2, 1.0}, "box");
    validate_and_orient(mesh, "box");
    expect_same_measures(mesh, before);
    EXPECT_LT(report.mean, 0.5) << "thicker than the body";
    for (const ElementReport& worst : assess(mesh).worst) EXPECT_GT(worst.quality, 0.05) << name(shape);
  }
}

TEST(WallLayers, OnTwoWallsThatMeetGoAroundTheCornerBetweenThem) {
  for (const Shape shape : {Shape::tri3, Shape::quad4}) {
    RawMesh mesh = make_block({{0.4, 0.4}, {}, {8, 8}, "block"}, shape);
    const auto before = measures(mesh);
    const std::vector<WallLayerReport> reports =
        add_wall_layers(mesh, {{"x_min", "block", 2, 2, 0.01}, {"y_min", "block", 2, 2, 0.01}}, "box");
    validate_and_orient(mesh, "box");
    expect_same_measures(mesh, before);
    ASSERT_EQ(reports.size(), 2U);
    for (const WallLayerReport& report : reports) {
      EXPECT_EQ(report.n_columns, 9) << name(shape);
      EXPECT_EQ(report.n_bare, 0) << name(shape);
    }
    const auto corner = std::count_if(mesh.x.begin(), mesh.x.end(), [](const Point& p) {
      return std::abs(p[0] - p[1]) < 1e-12 &&
             (std::abs(p[0] - 0.01) < 1e-12 || std::abs(p[0] - 0.03) < 1e-12);
    });
    EXPECT_EQ(corner, 2) << "both layers of either wall end at one vertex on the diagonal";
  }
}

TEST(WallLayers, OfWallsWithThicknessesOfTheirOwnPassFromOneToTheOther) {
  RawMesh mesh = make_block({{0.4, 0.4}, {}, {16, 16}, "block"}, Shape::tri3);
  const std::vector<WallLayerReport> reports =
      add_wall_layers(mesh, {{"x_min", "block", 1, 1, 0.04}, {"y_min", "block", 1, 1, 0.01}}, "box");
  validate_and_orient(mesh, "box");
  EXPECT_GT(reports[0].mean, 0.03);
  EXPECT_LT(reports[1].mean, 0.02);
  for (const WallLayerReport& report : reports) EXPECT_EQ(report.n_bare, 0);
}

TEST(WallLayers, MayBeManyElementsThickWhereTheBodyHasTheRoom) {
  // Three elements deep of ten: those behind give way over the whole depth, on the open sides too.
  for (const Shape shape : {Shape::tri3, Shape::tet4}) {
    const bool solid = dimension(shape) == 3;
    RawMesh mesh = solid ? make_block({{0.1, 0.04, 0.04}, {}, {10, 4, 4}, "block"}, shape)
                         : make_block({{0.1, 0.04}, {}, {10, 4}, "block"}, shape);
    const auto before = measures(mesh);
    const WallLayerReport report = add_wall_layers(mesh, {"x_min", "block", 3, 1, 0.01}, "box");
    validate_and_orient(mesh, "box");
    expect_same_measures(mesh, before);
    EXPECT_NEAR(report.mean, 0.03, 1e-12) << name(shape);
    EXPECT_GT(assess(mesh).worst.front().quality, 0.2) << name(shape);
  }
}

TEST(WallLayers, LeaveTheBordersOfSurfacesWithinAPlaneWhereTheyAre) {
  RawMesh mesh = make_block({{0.1, 0.04}, {}, {10, 4}, "block"}, Shape::tri3);
  RawGroup& bottom = mesh.groups.at("y_min");
  RawBlock far{bottom.blocks.front().shape, {}, {}};
  RawBlock& near = bottom.blocks.front();
  for (std::size_t f = 6; f < near.input_element.size(); ++f) {  // those beyond 60 mm
    far.nodes.insert(far.nodes.end(), near.nodes.begin() + static_cast<std::ptrdiff_t>(2 * f),
                     near.nodes.begin() + static_cast<std::ptrdiff_t>(2 * f + 2));
    far.input_element.push_back(near.input_element[f]);
  }
  mesh.groups["far"] = {1, {far}};
  const auto before = measures(mesh);
  add_wall_layers(mesh, {"x_min", "block", 2, 1, 0.01}, "box");
  validate_and_orient(mesh, "box");
  expect_same_measures(mesh, before);
}

TEST(WallLayers, OfAGeometryThatIsMeshedHereSurroundTheCasting) {
  const auto path =
      std::filesystem::temp_directory_path() /
      ("wall_layers_" + std::to_string(rank()) + "_of_" + std::to_string(n_processes()) + ".geo");
  std::ofstream(path) << "SetFactory(\"OpenCASCADE\");\n"
                         "Cylinder(1) = {0,0,0, 0,0,40, 15};\n"
                         "Box(2) = {-40,-40,-25, 80,80,65};\n"  // open at the top
                         "v() = Translate{0,0,0}{Duplicata{Volume{1};}};\n"
                         "BooleanDifference(100) = {Volume{2}; Delete;}{Volume{v()}; Delete;};\n"
                         "cavity() = Surface In BoundingBox{-16,-16,-1, 16,16,41};\n"
                         "cavity() -= Abs(Boundary{Volume{1};});\n"
                         "rest() = Abs(Boundary{Volume{100};}); rest() -= cavity();\n"
                         "Physical Volume(\"part\") = {1}; Physical Volume(\"sand\") = {100};\n"
                         "Physical Surface(\"cavity\") = cavity(); Physical Surface(\"outside\") = rest();\n"
                         "MeshSize{:} = 12;\n";
  for (const int element_order : {1, 2}) {
    const RawMesh plain = read_mesh(path.string(), 0.001, 0, element_order);
    RawMesh mesh = plain;
    const auto before = measures(mesh);
    const WallLayerReport report = add_wall_layers(mesh, {"cavity", "sand", 2, 2, 0.001}, "geo");
    validate_and_orient(mesh, "geo");
    const auto now = measures(mesh);
    for (const char* group : {"part", "cavity"}) EXPECT_NEAR(now.at(group), before.at(group), 1e-15) << group;
    // Curved elements of quadratic meshes keep their volume to the square of the curvature.
    const double accuracy = element_order == 1 ? 1e-12 : 2e-3;
    for (const char* group : {"sand", "outside"})
      EXPECT_NEAR(now.at(group), before.at(group), accuracy * before.at(group)) << group;
    EXPECT_EQ(report.n_bare, 0);
    EXPECT_GT(report.mean, 0.003);
    EXPECT_LT(report.mean, 0.0036);
    EXPECT_GT(assess(mesh).worst.front().quality, 0.1);
  }
  std::filesystem::remove(path);
}

TEST(WallLayers, OfASurfaceThatDoesNotBoundTheBodyAreRefused) {
  RawMesh mesh = split_block(Shape::tet4, {0.4, 0.2, 0.2}, {4, 2, 2}, 0.2);
  EXPECT_THAT(complaint_of([&] { add_wall_layers(mesh, {.surface = "y_min", .body = "left"}, "box"); }),
              HasSubstr("8 of the 16 faces of 'y_min' are not faces of the body 'left'"));
  RawMesh block = make_block({{0.4, 0.2}, {}, {4, 2}, "block"}, Shape::tri3);
  block.groups["inner"] = {1, {faces_at(block, block.groups.at("block").blocks.front(), 0.2)}};
  EXPECT_THAT(complaint_of([&] { add_wall_layers(block, {.surface = "inner", .body = "block"}, "box"); }),
              HasSubstr("lies inside the body 'block'"));
}

}  // namespace
}  // namespace solidus::test
