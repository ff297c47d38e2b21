/// A STEP file, written here by Gmsh's OpenCASCADE kernel, read and meshed by the program: a plate of
/// 20 × 10 × 5 mm with a pin of 3 mm radius and 8 mm height on it.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "mesh/gmsh/curved_faces.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "mesh/quality.hpp"
#include "mesh/raw_mesh.hpp"
#include "mesh/surfaces/face_rules.hpp"
#include "mesh/surfaces/skin.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace {

using namespace solidus;
using namespace solidus::mesh;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Key;

using Box = std::array<Point, 2>;

constexpr double k_mm = 1e-3, k_plate = 20e-3 * 10e-3 * 5e-3, k_size = 1e-3;
constexpr double k_pin = std::numbers::pi * 3e-3 * 3e-3 * 8e-3;

class StepFile : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::rank() > 0) GTEST_SKIP() << "files are read on process 0";
    file_ = (std::filesystem::path(SOLIDUS_BINARY_DIR) / "plate_and_pin.step").string();
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("plate and pin");
    const int plate = gmsh::model::occ::addBox(0, 0, 0, 20, 10, 5);
    const int pin = gmsh::model::occ::addCylinder(10, 5, 5, 0, 0, 8, 3);
    gmsh::vectorpair all;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::fragment({{3, plate}}, {{3, pin}}, all, map);
    gmsh::model::occ::synchronize();
    gmsh::write(file_);
    gmsh::finalize();
  }
  RawMesh read(const GeometryChoice& choice = {}, double size = k_size) const {
    RawMesh mesh = read_mesh(file_, k_mm, size, 1, {}, choice);
    validate_and_orient(mesh, file_);
    return mesh;
  }
  std::string complaint(const GeometryGroup& group) const {
    try {
      read({{group}, false});
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  std::string file_;
};

double measure(const RawMesh& mesh, const std::string& group) {
  for (const GroupReport& report : assess(mesh).groups)
    if (report.name == group) return report.measure;
  return NAN;
}

std::size_t shared_nodes(const RawMesh& mesh, const std::string& a, const std::string& b) {
  std::set<Index> of_a;
  for (const RawBlock& block : mesh.groups.at(a).blocks) of_a.insert(block.nodes.begin(), block.nodes.end());
  std::set<Index> both;
  for (const RawBlock& block : mesh.groups.at(b).blocks)
    for (const Index node : block.nodes)
      if (of_a.contains(node)) both.insert(node);
  return both.size();
}

TEST_F(StepFile, HasItsBodiesAndSurfacesByNumber) {
  const RawMesh mesh = read();
  EXPECT_EQ(mesh.dimension, 3);
  EXPECT_NEAR(measure(mesh, "body_1"), k_plate, 1e-9 * k_plate);
  // A prism of 18 sides on the cylinder would hold 0.98 of it.
  EXPECT_NEAR(measure(mesh, "body_2"), k_pin, 1e-3 * k_pin);
  double outside = 0;
  for (int number = 1; number <= 10; ++number) outside += measure(mesh, "surface_" + std::to_string(number));
  const double side = 2 * std::numbers::pi * 3e-3 * 8e-3, end = std::numbers::pi * 9e-6;
  EXPECT_NEAR(outside, 2 * (200e-6 + 100e-6 + 50e-6) + side + 2 * end, 0.02 * outside);
  EXPECT_EQ(shared_nodes(mesh, "body_1", "body_2"), 0u);  // for contact
}

TEST_F(StepFile, EnclosesTheVolumeOfACurvedBodyToFourthOrderAndKeepsPlanesPlane) {
  const auto error = [&](double size) { return std::abs(measure(read({}, size), "body_2") / k_pin - 1); };
  const double coarse = error(3e-3), fine = error(1.5e-3);  // about 6 and 12 edges around the pin
  EXPECT_LT(coarse, 0.03);                                  // a hexagon on the circle holds 0.83 of it
  EXPECT_LT(fine, coarse / 8);
  const RawMesh mesh = read({}, 3e-3);
  for (const Point& x : mesh.x)
    for (const double z : {0.0, 5e-3, 13e-3}) {
      if (std::abs(x[2] - z) < 1e-4) {
        EXPECT_NEAR(x[2], z, 1e-12);
      }
    }
}

TEST(CurvedFaces, AVertexTakesTheOffsetOfEachOfItsFacesAndLeavesNoPlane) {
  const auto curved = [](const Point& normal, double offset, double area) {
    return FaceAtVertex{normal, offset, area, false};
  };
  const FaceAtVertex below{{0, 0, 1}, 0, 1, true}, beside{{0, 1, 0}, 0, 1, true};
  // The rim of a cylinder: along its own normal, within the plane.
  const std::vector<FaceAtVertex> rim = {curved({0.6, 0, 0.8}, 0.3, 1), below};
  Point u = vertex_displacement(rim);
  EXPECT_NEAR(u[0], 0.5, 1e-15);
  EXPECT_EQ(u[2], 0);
  // Two halves of one cylinder, of opposite orientation: the mean.
  u = vertex_displacement(std::vector{curved({1, 0, 0}, 0.1, 3), curved({-1, 0, 0}, -0.2, 1)});
  EXPECT_NEAR(u[0], 0.125, 1e-15);
  // Two curved faces at an angle, as of a pipe that enters another: both.
  const Point oblique{0.6, 0.8, 0};
  u = vertex_displacement(std::vector{curved({1, 0, 0}, 0.1, 1), curved(oblique, 0.2, 1)});
  EXPECT_NEAR(u[0], 0.1, 1e-15);
  EXPECT_NEAR(0.6 * u[0] + 0.8 * u[1], 0.2, 1e-15);
  // A fillet that begins where a plane ends, and the corner of three planes: none.
  EXPECT_EQ(vertex_displacement(std::vector{curved({0, 0.05, 0.9987}, 0.1, 1), below}), (Point{}));
  EXPECT_EQ(vertex_displacement(
                std::vector{curved({1, 0, 0}, 0.1, 1), below, beside, FaceAtVertex{{1, 0, 0}, 0, 1, true}}),
            (Point{}));
}

TEST_F(StepFile, HasGroupsByNumberAndByBox) {
  const RawMesh mesh = read({{{"plate", true, {1}, {}, {}},
                              {"pin", true, {}, {}, Box{{{5e-3, 0, 5e-3}, {15e-3, 10e-3, 13e-3}}}},
                              {"below", false, {}, {}, Box{{{0, 0, 0}, {20e-3, 10e-3, 0}}}},
                              {"sides", false, {1, 2, 3, 4}, {}, {}}},
                             false});
  EXPECT_NEAR(measure(mesh, "plate"), k_plate, 1e-9 * k_plate);
  EXPECT_NEAR(measure(mesh, "pin"), k_pin, 1e-3 * k_pin);
  EXPECT_NEAR(measure(mesh, "below"), 200e-6, 1e-12);
  EXPECT_NEAR(measure(mesh, "sides"), 2 * (100e-6 + 50e-6), 1e-12);
  EXPECT_THAT(mesh.groups, ::testing::Not(Contains(Key("body_1"))));
  EXPECT_THAT(mesh.groups, ::testing::Not(Contains(Key("surface_1"))));
}

TEST_F(StepFile, SharesFacesOfBodiesThatTouchWhereThatIsAsked) {
  const RawMesh mesh = read({{}, true});
  EXPECT_GT(shared_nodes(mesh, "body_1", "body_2"), 5u);
}

TEST_F(StepFile, NamesBodiesAsTheFileDoes) {
  std::ostringstream text;
  text << std::ifstream(file_).rdbuf();
  const std::string labelled = std::regex_replace(
      std::regex_replace(text.str(), std::regex("Open CASCADE STEP translator [0-9.]+ [0-9]+\\.1"),
                         "base plate"),
      std::regex("Open CASCADE STEP translator [0-9.]+ [0-9]+\\.2"), "pin");
  std::ofstream(file_) << labelled;
  EXPECT_THAT(read().groups, AllOf(Contains(Key("base plate")), Contains(Key("pin"))));
  const RawMesh mesh = read({{{"bottom half", true, {}, "base plate", {}}}, false});
  EXPECT_NEAR(measure(mesh, "bottom half"), k_plate, 1e-9 * k_plate);
  EXPECT_THAT(complaint({"x", true, {}, "base plat", {}}),
              AllOf(HasSubstr("no body of the geometry is labelled 'base plat'"), HasSubstr("base plate")));
}

TEST_F(StepFile, WhatAGroupCannotFindIsSaid) {
  EXPECT_THAT(complaint({"top", false, {3, 11}, {}, {}}),
              AllOf(HasSubstr("the group 'top': the geometry has no surface 11"), HasSubstr("1 to 10")));
  EXPECT_THAT(complaint({"nothing", false, {}, {}, Box{{{0, 0, 1e-3}, {1e-3, 1e-3, 2e-3}}}}),
              HasSubstr("no surface of the geometry lies in the box"));
  EXPECT_THAT(complaint({"label", false, {}, "lid", {}}), HasSubstr("the file has no labels"));
  try {
    read({{{"a", true, {1}, {}, {}}, {"b", true, {1}, {}, {}}}, false});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the body 1 is in two groups"));
  }
}

/// Writes the faces of a box of 20 × 10 × 5 mm without its solid, and without its top where it is open.
std::string faces_of_a_box(const std::string& name, bool open) {
  const std::string file = (std::filesystem::path(SOLIDUS_BINARY_DIR) / name).string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  const int box = gmsh::model::occ::addBox(0, 0, 0, 20, 10, 5);
  gmsh::model::occ::synchronize();
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  gmsh::model::occ::remove({{3, box}});
  for (const auto& face : faces) {
    std::vector<double> centre(3);
    gmsh::model::occ::getCenterOfMass(2, face.second, centre[0], centre[1], centre[2]);
    if (open && centre[2] > 4.9) gmsh::model::occ::remove({face});
  }
  gmsh::model::occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

/// The sizes of every body [m].
CastingGeometry sizes(double size) {
  CastingGeometry geometry;
  geometry.sizes = {{"body_1", size, size / 2}};
  return geometry;
}

TEST_F(StepFile, FacesThatCloseAreASolid) {
  const RawMesh mesh = mesh_casting({faces_of_a_box("closed_box.step", false), k_mm}, sizes(3e-3), 0);
  EXPECT_NEAR(measure(mesh, "body_1"), k_plate, 1e-9 * k_plate);
}

TEST_F(StepFile, HealingKeepsEveryBody) {
  CastingGeometry geometry = sizes(2e-3);
  for (std::size_t way = 0; way < solid_ways().size(); ++way)
    if (!geometry.only_way && solid_ways()[way].healing > 0) geometry.only_way = static_cast<int>(way);
  const RawMesh mesh = mesh_casting({file_, k_mm}, geometry, 0);
  EXPECT_NEAR(measure(mesh, "body_1"), k_plate, 1e-6 * k_plate);
  EXPECT_NEAR(measure(mesh, "body_2"), k_pin, 0.03 * k_pin);  // 12 edges or more around it
  EXPECT_EQ(mesh.groups.count("body_3"), 0U);
}

TEST_F(StepFile, FacesThatDoNotCloseToASolidAreToldOnceWithTheirOpenCurves) {
  const std::string file = faces_of_a_box("open_box.step", true);
  std::string text;
  try {
    mesh_casting({file, k_mm}, {}, 0);
  } catch (const InputError& error) {
    text = error.what();
  }
  EXPECT_THAT(text,
              HasSubstr("no solid, and its faces do not close to one: 5 faces in 1 piece; 4 curves bound "
                        "one face only, the longest of 20 mm around (10, "));
  EXPECT_THAT(text, HasSubstr("a file with solids: close these openings in the CAD program"));
  EXPECT_EQ(text.find("in any of these ways"), std::string::npos);
}

/// A block with a bore along y whose halves are drawn apart, 30 × 20 × 30 mm, as a STEP file.
std::string block_with_a_bore_in_two_halves() {
  const std::string file = (std::filesystem::path(SOLIDUS_BINARY_DIR) / "bore_in_halves.step").string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("bore");
  const int block = gmsh::model::occ::addBox(0, 0, 0, 30, 20, 30);
  const int low = gmsh::model::occ::addCylinder(15, 0, 15, 0, 20, 0, 4, -1, std::numbers::pi);
  const int high = gmsh::model::occ::addCylinder(15, 0, 15, 0, 20, 0, 4, -1, std::numbers::pi);
  gmsh::model::occ::rotate({{3, high}}, 15, 0, 15, 0, 1, 0, std::numbers::pi);
  gmsh::vectorpair cut;
  std::vector<gmsh::vectorpair> map;
  gmsh::model::occ::cut({{3, block}}, {{3, low}, {3, high}}, cut, map);
  gmsh::model::occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

TEST(DrawnFaces, ABoreIsTakenWholeHoweverCoarseItsFacetsAndInHowManyPartsItIsDrawn) {
  if (test::rank() > 0) GTEST_SKIP() << "files are read on process 0";
  const std::string file = block_with_a_bore_in_two_halves();
  constexpr double k_whole = 2 * std::numbers::pi * 4e-3 * 20e-3;
  for (const double size : {2e-3, 12e-3}) {  // facets that meet at 30 and at 90 degrees
    RawMesh mesh = read_mesh(file, k_mm, size);
    validate_and_orient(mesh, file);
    logging::clear_warnings();
    add_faces_by_rule(mesh, {"body_1"}, {.name = "bore", .nearest = Point{19e-3, 10e-3, 15e-3}}, file);
    add_faces_by_rule(mesh, {"body_1"}, {.name = "side", .nearest = Point{40e-3, 10e-3, 15e-3}}, file);
    EXPECT_NEAR(area_of(mesh, "bore"), k_whole, 0.12 * k_whole)
        << size;  // of a prism of four sides 10 % less
    EXPECT_NEAR(area_of(mesh, "side"), 30e-3 * 20e-3, 1e-9) << size;
    EXPECT_THAT(logging::warnings(), ::testing::IsEmpty());
  }
}

}  // namespace
