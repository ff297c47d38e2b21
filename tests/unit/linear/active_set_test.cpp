/// The active set: nodes and faces that belong to the active bodies.
#include "linear/active_set.hpp"

#include <gtest/gtest.h>

#include "../mesh/split_block.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

constexpr double k_plane = 0.2;

mesh::Mesh bodies(mesh::Shape shape) {
  mesh::RawMesh raw;
  const int rank = processes::rank();
  if (rank == 0)
    raw = mesh::dimension(shape) == 3 ? test::split_block(shape, {0.4, 0.2, 0.2}, {4, 2, 2}, k_plane)
                                      : test::split_block(shape, {0.4, 0.2}, {4, 2}, k_plane);
  return mesh::distribute(raw, {"left", "right"}, {});
}

/// Faces that some process counts.
double counted(const mesh::Surface& surface) {
  double n = 0;
  for (const mesh::ElementBlock& faces : surface.faces) n += faces.n_counted;
  return parallel::global_sum(n);
}

class ActiveSet : public ::testing::TestWithParam<mesh::Shape> {};

TEST_P(ActiveSet, WithAllBodiesHoldsEveryNodeAndFace) {
  const mesh::Mesh mesh = bodies(GetParam());
  const linear::ActiveSet active(mesh);
  EXPECT_TRUE(active.complete());
  for (Index i = 0; i < mesh.n_nodes(); ++i) EXPECT_TRUE(active.node(i));
  EXPECT_EQ(counted(active.part(mesh, mesh.surfaces.at("x_min"))), counted(mesh.surfaces.at("x_min")));
}

TEST_P(ActiveSet, HoldsTheNodesOfActiveBodiesGhostsIncluded) {
  const mesh::Mesh mesh = bodies(GetParam());
  const linear::ActiveSet active(mesh, std::vector<std::string>{"left"});
  EXPECT_FALSE(active.complete());
  EXPECT_FALSE(active.body(0));
  EXPECT_TRUE(active.body(1));
  for (Index i = 0; i < mesh.n_nodes(); ++i)
    EXPECT_EQ(active.node(i), mesh.x[static_cast<std::size_t>(i)][0] > k_plane - 1e-9);
}

// The face between the two belongs to the first of them; it is there with either.
TEST_P(ActiveSet, HoldsAFaceWithAnActiveBodyOnEitherSide) {
  const mesh::Mesh mesh = bodies(GetParam());
  const mesh::Surface& between = mesh.surfaces.at("between");
  for (const char* gone : {"left", "right"}) {
    const linear::ActiveSet active(mesh, std::vector<std::string>{gone});
    EXPECT_EQ(counted(active.part(mesh, between)), counted(between)) << gone;
    const bool left = gone == std::string("left");
    EXPECT_EQ(counted(active.part(mesh, mesh.surfaces.at("x_min"))),
              left ? 0 : counted(mesh.surfaces.at("x_min")));
    for (const mesh::ElementBlock& faces : between.faces) EXPECT_EQ(active.reversed(faces), left);
    const double both = counted(mesh.surfaces.at("y_min"));
    EXPECT_EQ(counted(active.part(mesh, mesh.surfaces.at("y_min"))), both / 2) << gone;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ActiveSet,
                         ::testing::Values(mesh::Shape::quad4, mesh::Shape::tri6, mesh::Shape::tet4,
                                           mesh::Shape::hex20));

TEST(ActiveSets, AnUnknownBodyIsOurMistake) {
  const mesh::Mesh mesh = bodies(mesh::Shape::quad4);
  EXPECT_THROW(linear::ActiveSet(mesh, std::vector<std::string>{"core"}), std::invalid_argument);
}

}  // namespace
}  // namespace solidus
