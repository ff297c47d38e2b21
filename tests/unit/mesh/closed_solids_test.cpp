// Faces that close to several bodies, as IGES files have them: each body with faces of its own.
#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/quality.hpp"
#include "mesh/raw_mesh.hpp"
#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::mesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace occ = gmsh::model::occ;

/// A box by its corner and edges [mm]; or a cylinder along z.
struct Solid {
  std::array<double, 3> corner, edges;
  bool round = false;  ///< of diameter edges[0] around the corner
};

/// Writes the faces of solids without the solids.
std::string write_faces(const std::string& name, const std::vector<Solid>& solids, bool open = false) {
  const std::string file =
      (std::filesystem::path(SOLIDUS_BINARY_DIR) / (name + std::to_string(test::rank()) + ".brep")).string();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  for (const Solid& s : solids) {
    const int made =
        s.round ? occ::addCylinder(s.corner[0], s.corner[1], s.corner[2], 0, 0, s.edges[2], s.edges[0] / 2)
                : occ::addBox(s.corner[0], s.corner[1], s.corner[2], s.edges[0], s.edges[1], s.edges[2]);
    occ::synchronize();
    occ::remove({{3, made}});
  }
  gmsh::vectorpair faces;
  occ::getEntities(faces, 2);
  if (open) occ::remove({faces.back()});
  occ::synchronize();
  gmsh::write(file);
  gmsh::finalize();
  return file;
}

/// The volumes of the bodies of a mesh [mm³].
std::vector<double> volumes(const RawMesh& mesh) {
  std::vector<double> volumes;
  for (const GroupReport& g : assess(mesh).groups)
    if (g.dimension == 3) volumes.push_back(1e9 * g.measure);
  std::ranges::sort(volumes);
  return volumes;
}

std::vector<double> volumes_of_plain_mesh(const std::string& file) {
  RawMesh mesh = read_mesh(file, 1e-3, 4e-3);
  validate_and_orient(mesh, file);
  return volumes(mesh);
}

std::vector<double> volumes_of_casting(const std::string& file, int n_bodies) {
  CastingGeometry geometry;
  for (int i = 1; i <= n_bodies; ++i) geometry.sizes.push_back({"body_" + std::to_string(i), 4e-3, 2e-3});
  RawMesh mesh = mesh_casting({file, 1e-3}, geometry, 0);
  validate_and_orient(mesh, file);
  return volumes(mesh);
}

::testing::Matcher<double> about(double volume) {
  return ::testing::DoubleNear(volume, 1e-6 * volume);
}

TEST(ClosedSolids, OneBodyIsMeshedWithoutSizesToo) {
  const std::string file = write_faces("one", {{{0, 0, 0}, {20, 10, 5}}});
  EXPECT_THAT(volumes_of_plain_mesh(file), ElementsAre(about(1000)));
}

TEST(ClosedSolids, BodiesApartAreTwo) {
  const std::string file = write_faces("apart", {{{0, 0, 0}, {20, 20, 20}}, {{30, 0, 0}, {10, 20, 20}}});
  EXPECT_THAT(volumes_of_casting(file, 2), ElementsAre(about(4000), about(8000)));
  EXPECT_THAT(volumes_of_plain_mesh(file), ElementsAre(about(4000), about(8000)));
}

TEST(ClosedSolids, BodiesThatShareAFaceAreTwo) {
  const std::string file = write_faces("touch", {{{0, 0, 0}, {20, 20, 20}}, {{20, 0, 0}, {10, 20, 20}}});
  EXPECT_THAT(volumes_of_casting(file, 2), ElementsAre(about(4000), about(8000)));
}

TEST(ClosedSolids, ABodyOnPartOfAFaceOfAnotherIsOne) {
  const std::string file = write_faces("foot", {{{0, 0, 0}, {20, 20, 20}}, {{5, 5, 20}, {10, 10, 10}}});
  EXPECT_THAT(volumes_of_casting(file, 2), ElementsAre(about(1000), about(8000)));
}

TEST(ClosedSolids, ARowOfThreeIsThree) {
  const std::string file =
      write_faces("row", {{{0, 0, 0}, {10, 20, 20}}, {{10, 0, 0}, {20, 20, 20}}, {{30, 0, 0}, {30, 20, 20}}});
  EXPECT_THAT(volumes_of_casting(file, 3), ElementsAre(about(4000), about(8000), about(12000)));
}

TEST(ClosedSolids, ACoreInItsCavityIsABody) {
  const Solid core{{10, 10, 10}, {10, 10, 10}};
  const std::string file = write_faces("core", {{{0, 0, 0}, {30, 30, 30}}, core, core});
  EXPECT_THAT(volumes_of_casting(file, 2), ElementsAre(about(1000), about(26000)));
  EXPECT_THAT(volumes_of_plain_mesh(file), ElementsAre(about(1000), about(26000)));
}

TEST(ClosedSolids, ACavityIsNone) {
  const std::string file = write_faces("cavity", {{{0, 0, 0}, {30, 30, 30}}, {{10, 10, 10}, {10, 10, 10}}});
  EXPECT_THAT(volumes_of_casting(file, 1), ElementsAre(about(26000)));
}

TEST(ClosedSolids, RoundFacesMeetThemselves) {
  const std::string file =
      write_faces("round", {{{0, 0, 0}, {20, 20, 20}, true}, {{40, 0, 0}, {20, 20, 20}, true}});
  const std::vector<double> found = volumes_of_casting(file, 2);
  ASSERT_EQ(found.size(), 2u);
  for (const double volume : found) EXPECT_NEAR(volume, 2000 * std::acos(-1.0), 0.05 * 6283);
}

TEST(ClosedSolids, FacesOfOneOfTwoThatDoNotCloseAreRefused) {
  const std::string file = write_faces("open", {{{0, 0, 0}, {20, 20, 20}}, {{30, 0, 0}, {10, 20, 20}}}, true);
  try {
    volumes_of_casting(file, 1);
    FAIL() << "an open body was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(std::string(e.what()), HasSubstr("do not close"));
  }
}

}  // namespace
