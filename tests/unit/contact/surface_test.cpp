#include "contact/surface.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.hpp"
#include "bodies.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

TEST(ContactSurface, HasItsFacesWholeOnEveryProcessInOneOrder) {
  const mesh::Mesh mesh = test::two_blocks(Shape::hex8);
  const ContactSurface surface(mesh, "lower_top");
  EXPECT_EQ(surface.n_faces(), 9);
  EXPECT_EQ(surface.all_nodes().size(), 16u);
  EXPECT_NEAR(surface.measure(), 0.06, 1e-15);
  // A checksum of places in order: the same on every process.
  double checksum = 0;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Point centre = surface.reference_face(f).at({});
    checksum += (f + 1) * (centre[0] + 10 * centre[1]);
  }
  double highest = checksum, lowest = checksum;
  MPI_Allreduce(MPI_IN_PLACE, &highest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
  EXPECT_EQ(highest, lowest);
}

TEST(ContactSurface, LooksOutOfItsBody) {
  for (Shape shape : {Shape::tri3, Shape::quad8, Shape::tet10, Shape::hex8}) {
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto last = static_cast<std::size_t>(mesh.dimension - 1);
    const ContactSurface lower(mesh, "lower_top"), upper(mesh, "upper_bottom");
    for (Index f = 0; f < lower.n_faces(); ++f)
      EXPECT_NEAR(lower.reference_face(f).normal(reference_centre(lower.shape(f)))[last], 1, 1e-14);
    for (Index f = 0; f < upper.n_faces(); ++f)
      EXPECT_NEAR(upper.reference_face(f).normal(reference_centre(upper.shape(f)))[last], -1, 1e-14);
  }
}

TEST(ContactSurface, MovesWithTheDisplacement) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  const ContactSurface surface(mesh, "lower_top");
  const auto u = test::nodal_field(mesh, 2, [](const Point& x, bool) {
    return std::vector{0.5 * x[0], 0.2};
  });
  const Point before = surface.reference_face(0).at({}), after = surface.current_face(0, u, 2).at({});
  EXPECT_NEAR(after[0], 1.5 * before[0], 1e-15);
  EXPECT_NEAR(after[1], before[1] + 0.2, 1e-15);
}

TEST(AveragedNormals, SmoothABentSurfaceButNotASharpEdge) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  const ContactSurface surface(mesh, "lower_top");
  // Bends the line y = 0.1 at its node x = 0.12 by the angle whose tangent is `slope`.
  const auto normals = [&](double slope) {
    const auto u = test::nodal_field(mesh, 2, [&](const Point& x, bool) {
      return std::vector{0.0, slope * std::max(0.0, x[0] - 0.12)};
    });
    std::vector<double> at_bend;  // angles from the vertical
    const auto all = surface.averaged_normals(u, 2, 0.6);
    std::size_t i = 0;
    for (Index f = 0; f < surface.n_faces(); ++f)
      for (Index node : surface.nodes(f)) {
        if (std::abs(mesh.x[static_cast<std::size_t>(node)][0] - 0.12) < 1e-9)
          at_bend.push_back(-std::atan2(all[i][0], all[i][1]));
        ++i;
      }
    return at_bend;
  };
  for (double angle : normals(0.2)) EXPECT_NEAR(angle, 0.5 * std::atan(0.2), 1e-12);
  auto sharp = normals(2);
  std::sort(sharp.begin(), sharp.end());
  ASSERT_EQ(sharp.size(), 2u);
  EXPECT_NEAR(sharp[0], 0, 1e-14);
  EXPECT_NEAR(sharp[1], std::atan(2), 1e-14);
}

TEST(ContactSurface, ThatDoesNotExistIsTheUsersError) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  EXPECT_THROW(ContactSurface(mesh, "upper_botom"), InputError);
}

}  // namespace
}  // namespace solidus::contact
