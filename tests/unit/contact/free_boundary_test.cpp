// Points of a slave that leave the master over its free boundary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "contact/pair.hpp"
#include "contact/surfaces/master_mesh.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

constexpr double k_width = 0.3, k_depth = 1e-6;

/// The upper body, pressed on the lower one, lies `shift` to the side.
std::vector<double> moved(const mesh::Mesh& mesh, double shift) {
  const auto last = static_cast<std::size_t>(mesh.dimension - 1);
  return test::nodal_field(mesh, mesh.dimension, [&](const Point&, bool upper) {
    std::vector<double> at(static_cast<std::size_t>(mesh.dimension), 0.0);
    if (upper) at[0] = shift, at[last] = -k_depth;
    return at;
  });
}

/// Force between both bodies while the upper one lies `shift` to the side.
double force_at(ContactPair& pair, const mesh::Mesh& mesh, double shift) {
  const std::vector<double> u = moved(mesh, shift);
  const ContactState start = pair.parts().history.initial();
  pair.begin(start, {.time = 1, .dt = 1, .displacement = u});
  pair.update(u);
  return contact::sums(pair.view(), {}).force;
}

ContactParameters between_blocks(IntegrationRule rule) {
  ContactParameters spec;
  spec.name = "edge";
  spec.slave = "upper_bottom";
  spec.master = "lower_top";
  spec.formulation = Formulation::large_sliding;
  spec.integration = rule;
  spec.penalty = 1e10;
  spec.penalty_is_factor = false;
  return spec;
}

TEST(FreeBoundary, IsLeftLittleByLittle) {
  for (const Shape shape : {Shape::quad4, Shape::quad8, Shape::hex8, Shape::tet10})
    for (const bool smoothing : {false, true})
      for (const IntegrationRule rule : {IntegrationRule::nodal, IntegrationRule::gauss}) {
        const mesh::Mesh mesh = test::two_blocks(shape);
        ContactParameters spec = between_blocks(rule);
        spec.smoothing = smoothing;
        const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
        ContactPair pair(mesh, kind, std::move(spec));
        const double whole = force_at(pair, mesh, 0);
        ASSERT_GT(whole, 0);
        double before = whole, largest = 0;
        constexpr int k_moves = 200;
        for (int i = 1; i <= k_moves; ++i) {
          const double now = force_at(pair, mesh, 0.6 * k_width * i / k_moves);
          largest = std::max(largest, std::abs(now - before));
          before = now;
        }
        EXPECT_LT(before, 0.6 * whole) << mesh::name(shape);
        // A column of nodes that left at once would take a sixth of the force and more with it.
        EXPECT_LT(largest, 0.06 * whole) << mesh::name(shape) << (rule == IntegrationRule::nodal);
      }
}

// A body that slides off another one, evenly pressed: dissipation and ζ_c are those of the force along the
// way.
TEST(FreeBoundary, APointThatIsLeftInPartTakesItsShareOfSlipAndWear) {
  for (const Shape shape : {Shape::quad4, Shape::hex8})
    for (const IntegrationRule rule : {IntegrationRule::gauss, IntegrationRule::segments}) {
      const mesh::Mesh mesh = test::two_blocks(shape);
      ContactParameters spec = between_blocks(rule);
      spec.friction = FrictionParameters{};
      spec.friction->coefficient.terms = {Table(0.3)};
      spec.friction->tangential_penalty = 1e12;
      const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
      ContactPair pair(mesh, kind, std::move(spec));
      constexpr int k_moves = 60;
      constexpr double k_step = 0.6 * k_width / k_moves;
      ContactState state = pair.parts().history.initial();
      double way_times_force = 0, dissipated = 0, worn = 0;
      for (int i = 1; i <= k_moves; ++i) {
        const std::vector<double> from = moved(mesh, k_step * (i - 1));
        pair.begin(state, {.time = static_cast<double>(i), .dt = 1, .displacement = from});
        state = pair.update(moved(mesh, k_step * i));
        const ContactSums sums = contact::sums(pair.view(), {});
        EXPECT_GE(sums.dissipation, dissipated) << i;
        dissipated = sums.dissipation;
        way_times_force += k_step * sums.force;
      }
      const ContactKinematics& kinematics = pair.parts().geometry.kinematics();
      for (Index p = 0; p < kinematics.n_points(); ++p)
        if (const auto particle = kinematics.particle(p); particle.counted)
          worn += particle.area * state.points[static_cast<std::size_t>(p)].internal_variable;
      worn = parallel::global_sum(worn);
      // A point slips all the way but for the 3e-9 m that its spring takes up at first.
      EXPECT_NEAR(dissipated, 0.3 * way_times_force, 1e-6 * way_times_force) << mesh::name(shape);
      EXPECT_NEAR(worn, way_times_force, 1e-6 * way_times_force) << mesh::name(shape);
    }
}

TEST(FreeBoundary, HoldsAPointWhollyUpToAHundredthOfAFaceAndNotAtAllBeyondAnEighth) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  const ContactSurface surface(mesh, "lower_top");
  const MeshMaster master(2, surface, {.search_distance = 0.1, .rim = k_fading_rim});
  double end = 0, top = 0, size = 1;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Face face = surface.reference_face(f);
    for (std::size_t a = 0; a < 2; ++a)
      if (face.x[a][0] > end) end = face.x[a][0], top = face.x[a][1], size = distance(face.x[0], face.x[1]);
  }
  const auto covered = [&](double part) {
    const Partner p = master.find({end + part * size, top, 0}, {0, -1, 0}, -1);
    return p.face >= 0 ? p.covered : 0.0;
  };
  EXPECT_EQ(covered(-0.01), 1);
  EXPECT_EQ(covered(0.009), 1);
  EXPECT_NEAR(covered(0.0675), 0.5, 1e-9);
  EXPECT_GT(covered(0.124), 0);
  EXPECT_EQ(covered(0.126), 0);
}

}  // namespace
}  // namespace solidus::contact
