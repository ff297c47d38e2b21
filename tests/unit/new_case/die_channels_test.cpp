/// Bores of a drawing that `solidus new` takes for cooling channels, and those that it does not.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "mesh/surfaces/face_rules.hpp"
#include "mesh/surfaces/skin.hpp"
#include "new_case/die_channels.hpp"

namespace solidus {
namespace {

constexpr double k_mm = 1e-3;

/// A block of 60 × 40 × 30 mm: a bore of 8 mm along y, a hole of 6 mm from the top, 20 mm deep, and a hollow
/// of 24 mm, 10 mm deep, in the side at x = 60 mm.
std::string block_with_holes() {
  const std::string file = (std::filesystem::path(SOLIDUS_BINARY_DIR) / "block_with_holes.step").string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("block");
  const int block = gmsh::model::occ::addBox(0, 0, 0, 60, 40, 30);
  const int bore = gmsh::model::occ::addCylinder(15, 0, 10, 0, 40, 0, 4);
  const int hole = gmsh::model::occ::addCylinder(30, 20, 10, 0, 0, 20, 3);
  const int hollow = gmsh::model::occ::addCylinder(50, 20, 15, 10, 0, 0, 12);
  gmsh::vectorpair cut;
  std::vector<gmsh::vectorpair> map;
  gmsh::model::occ::cut({{3, block}}, {{3, bore}, {3, hole}, {3, hollow}}, cut, map);
  gmsh::model::occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

TEST(DieChannels, AreBoresThatOpenToNoCavity) {
  const std::string file = block_with_holes();
  for (const double size : {3e-3, 12e-3}) {
    mesh::RawMesh mesh = mesh::read_mesh(file, k_mm, size);
    mesh::validate_and_orient(mesh, file);
    mesh::add_faces_by_rule(mesh, {"body_1"}, {.name = "free", .owner = "body_1"}, file);
    mesh::add_faces_by_rule(
        mesh, {"body_1"},
        {.name = "top", .normal = mesh::Point{0, 0, 1}, .angle = 0.1, .plane = mesh::Point{0, 0, 30e-3}},
        file);
    const std::vector<new_case::DieChannel> open = new_case::die_channels(mesh, "body_1", "free", {});
    ASSERT_EQ(open.size(), 2U) << size;  // the hollow is wider than it is deep
    EXPECT_NEAR(open[0].length, 40e-3, 0.01 * 40e-3) << size;
    EXPECT_NEAR(open[1].length, 20e-3, 0.01 * 20e-3) << size;
    EXPECT_NEAR(open[0].diameter, 8e-3, 1e-9) << size;
    EXPECT_NEAR(open[1].diameter, 6e-3, 1e-9) << size;
    // The hole in the top ends where another body is: one for a pin.
    const std::vector<new_case::DieChannel> channels =
        new_case::die_channels(mesh, "body_1", "free", {"top"});
    ASSERT_EQ(channels.size(), 1U) << size;
    EXPECT_EQ(channels[0], open[0]);
  }
}

TEST(DieChannels, OfAMeshWithoutItsDrawingHaveTheCrossSectionOfTheirFacets) {
  const std::string file = block_with_holes();
  mesh::RawMesh mesh = mesh::read_mesh(file, k_mm, 2e-3);
  mesh::validate_and_orient(mesh, file);
  mesh.drawn_faces.clear();
  mesh::add_faces_by_rule(mesh, {"body_1"}, {.name = "free", .owner = "body_1"}, file);
  const std::vector<new_case::DieChannel> open = new_case::die_channels(mesh, "body_1", "free", {});
  ASSERT_EQ(open.size(), 2U);
  EXPECT_NEAR(open[0].diameter, 8e-3, 0.02 * 8e-3);
}

TEST(DieChannels, HaveTheFilmOfTurbulentWater) {
  // Re = 12 500 at 10 mm, Nu = 0.023 · 12500^0.8 · 5.4^0.4 = 85.6.
  EXPECT_NEAR(new_case::film_of_water(10e-3), 85.6 * 0.615 / 10e-3, 5);
  EXPECT_NEAR(new_case::film_of_water(20e-3) / new_case::film_of_water(10e-3), 0.8706, 1e-3);  // 2^−0.2
  // In a narrow one as much faster as makes Re = 10 000.
  EXPECT_DOUBLE_EQ(new_case::speed_of_water(8e-3), 1);
  EXPECT_DOUBLE_EQ(new_case::speed_of_water(4e-3), 2);
  EXPECT_NEAR(new_case::film_of_water(4e-3), 0.023 * std::pow(1e4, 0.8) * std::pow(5.4, 0.4) * 0.615 / 4e-3,
              5);
}

TEST(DieChannels, AreAsWideAsChannelsAreMade) {
  const std::string file = (std::filesystem::path(SOLIDUS_BINARY_DIR) / "block_with_odd_bores.step").string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("block");
  namespace occ = gmsh::model::occ;
  const int block = occ::addBox(0, 0, 0, 100, 60, 60);
  gmsh::vectorpair cut, bores;
  std::vector<gmsh::vectorpair> map;
  for (const auto& [x, diameter] : {std::pair{10, 3.8}, {25, 5.0}, {45, 24.0}, {80, 28.0}})
    bores.emplace_back(3, occ::addCylinder(x, 0, 30, 0, 60, 0, diameter / 2));
  occ::cut({{3, block}}, bores, cut, map);
  occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  mesh::RawMesh mesh = mesh::read_mesh(file, k_mm, 3e-3);
  mesh::validate_and_orient(mesh, file);
  mesh::add_faces_by_rule(mesh, {"body_1"}, {.name = "free", .owner = "body_1"}, file);
  std::vector<double> widths;
  for (const new_case::DieChannel& channel : new_case::die_channels(mesh, "body_1", "free", {}))
    widths.push_back(1e3 * channel.diameter);
  std::ranges::sort(widths);
  ASSERT_EQ(widths.size(), 2U);
  EXPECT_NEAR(widths[0], 5, 1e-6);
  EXPECT_NEAR(widths[1], 24, 1e-6);
}

}  // namespace
}  // namespace solidus
