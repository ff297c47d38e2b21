#include "contact/surfaces/surface.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "bodies.hpp"
#include "contact/surfaces/surface_curvature.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

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
  EXPECT_EQ(parallel::global_max(checksum), parallel::global_min(checksum));
}

/// Two quarter rings or half a barrel: blocks bent about an axis, radius k_inner + height.
constexpr double k_inner = 0.1;
mesh::Mesh bent_blocks(Shape shape) {
  mesh::TwoBlocks blocks = test::standard_blocks(shape);
  blocks.lower_divisions[0] = 6;
  blocks.upper_divisions[0] = 5;
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  const auto last = static_cast<std::size_t>(mesh::dimension(shape) - 1);
  for (Point& x : raw.x) {
    const double angle = 0.5 * std::numbers::pi * (1 - x[0] / 0.3), radius = k_inner + x[last];
    x = {radius * std::cos(angle), radius * std::sin(angle), last == 2 ? -x[1] : 0.0};
  }
  return test::distribute_blocks(raw);
}

TEST(SurfaceCurvature, OfCylindersIsOneOverTheirRadiusSeenFromBothSides) {
  for (const Shape shape : {Shape::quad4, Shape::quad8, Shape::tri3, Shape::hex8, Shape::hex20}) {
    const mesh::Mesh mesh = bent_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    const double radius = k_inner + 0.1;
    for (const auto& [name, sign] : {std::pair{"lower_top", 1.0}, std::pair{"upper_bottom", -1.0}}) {
      const ContactSurface surface(mesh, name);
      for (const SurfaceCurvature& c : surface_curvatures(surface, kind, 0.6)) {
        // Facets of 15 and 18 degrees, whose centres lie below the arc.
        EXPECT_NEAR((c.first + c.second) * radius, sign, 0.04) << mesh::name(shape);
        EXPECT_NEAR(std::min(std::abs(c.first), std::abs(c.second)), 0, 1e-9 / radius) << mesh::name(shape);
      }
    }
  }
  const mesh::Mesh plane = test::two_blocks(Shape::hex8);
  for (const SurfaceCurvature& c :
       surface_curvatures(ContactSurface(plane, "lower_top"), AnalysisKind::solid, 0.6)) {
    EXPECT_EQ(c.first, 0);
    EXPECT_EQ(c.second, 0);
  }
}

TEST(SurfaceCurvature, MakesOfAGapThePlaneOneOfTheSameResistance) {
  const double inner = 0.05, outer = 0.08, gap = outer - inner;
  const SurfaceCurvature cylinder{1 / inner, 0}, hole{-1 / outer, 0}, ball{1 / inner, 1 / inner},
      cavity{-1 / outer, -1 / outer}, plane{};
  EXPECT_NEAR(cylinder.plane_gap(gap), inner * std::log(outer / inner), 1e-15);
  EXPECT_NEAR(hole.plane_gap(gap), outer * std::log(outer / inner), 1e-15);
  EXPECT_NEAR(ball.plane_gap(gap), gap * inner / outer, 1e-15);
  EXPECT_NEAR(cavity.plane_gap(gap), gap * outer / inner, 1e-15);
  EXPECT_EQ(plane.plane_gap(gap), gap);
  EXPECT_EQ(cylinder.plane_gap(-1e-4), -1e-4);
  for (const SurfaceCurvature& c : {cylinder, hole, ball, cavity, SurfaceCurvature{30, -7}}) {
    const double h = 1e-6;
    EXPECT_NEAR(c.plane_gap_slope(gap), (c.plane_gap(gap + h) - c.plane_gap(gap - h)) / (2 * h), 1e-7);
  }
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
