/// Which nodes and faces are there with the bodies that are.
#include "algebra/presence.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include "../mesh/split_block.hpp"
#include "algebra/parallel.hpp"

namespace solidus {
namespace {

constexpr double k_plane = 0.2;

mesh::Mesh bodies(mesh::Shape shape) {
  mesh::RawMesh raw;
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0)
    raw = mesh::dimension(shape) == 3 ? test::split_block(shape, {0.4, 0.2, 0.2}, {4, 2, 2}, k_plane)
                                      : test::split_block(shape, {0.4, 0.2}, {4, 2}, k_plane);
  return mesh::distribute(raw, {"left", "right"}, {});
}

/// Faces that some process counts.
double counted(const mesh::Surface& surface) {
  double n = 0;
  for (const mesh::Block& faces : surface.faces) n += faces.n_counted;
  return algebra::global_sum(n);
}

class Presence : public ::testing::TestWithParam<mesh::Shape> {};

TEST_P(Presence, OfEverybodyIsThatOfEveryNodeAndFace) {
  const mesh::Mesh mesh = bodies(GetParam());
  const algebra::Presence presence(mesh);
  EXPECT_TRUE(presence.complete());
  for (Index i = 0; i < mesh.n_nodes(); ++i) EXPECT_TRUE(presence.node(i));
  EXPECT_EQ(counted(presence.part(mesh, mesh.surfaces.at("x_min"))), counted(mesh.surfaces.at("x_min")));
}

TEST_P(Presence, GhostsIncludedNodesAreThereWithABodyThatTouchesThem) {
  const mesh::Mesh mesh = bodies(GetParam());
  const algebra::Presence presence(mesh, std::vector<std::string>{"left"});
  EXPECT_FALSE(presence.complete());
  EXPECT_FALSE(presence.body(0));
  EXPECT_TRUE(presence.body(1));
  for (Index i = 0; i < mesh.n_nodes(); ++i)
    EXPECT_EQ(presence.node(i), mesh.x[static_cast<std::size_t>(i)][0] > k_plane - 1e-9);
}

// The face between the two belongs to the first of them; it is there with either.
TEST_P(Presence, AFaceIsThereWithABodyOnEitherSide) {
  const mesh::Mesh mesh = bodies(GetParam());
  const mesh::Surface& between = mesh.surfaces.at("between");
  for (const char* gone : {"left", "right"}) {
    const algebra::Presence presence(mesh, std::vector<std::string>{gone});
    EXPECT_EQ(counted(presence.part(mesh, between)), counted(between)) << gone;
    const bool left = gone == std::string("left");
    EXPECT_EQ(counted(presence.part(mesh, mesh.surfaces.at("x_min"))),
              left ? 0 : counted(mesh.surfaces.at("x_min")));
    for (const mesh::Block& faces : between.faces) EXPECT_EQ(presence.reversed(faces), left);
    const double both = counted(mesh.surfaces.at("y_min"));
    EXPECT_EQ(counted(presence.part(mesh, mesh.surfaces.at("y_min"))), both / 2) << gone;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Presence,
                         ::testing::Values(mesh::Shape::quad4, mesh::Shape::tri6, mesh::Shape::tet4,
                                           mesh::Shape::hex20));

TEST(Presences, AnUnknownBodyIsOurMistake) {
  const mesh::Mesh mesh = bodies(mesh::Shape::quad4);
  EXPECT_THROW(algebra::Presence(mesh, std::vector<std::string>{"core"}), std::invalid_argument);
}

}  // namespace
}  // namespace solidus
