/// The tangent of both fields where contact puts its numbers: in a matrix whose pattern changes, in rows of
/// bodies without mechanics, and of points with many nodes.
#include <gtest/gtest.h>

#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/face.hpp"
#include "rubbing_blocks.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using mesh::Shape;
using test::noise;
using test::Rubbing;
using test::RubbingBlocks;

/// The larger error along a change of the displacement, `still` left out, and of the temperature.
void expect_exact(test::Iterate& iterate, const mesh::Mesh& mesh, double tolerance,
                  const std::string& still = {}) {
  for (const bool moves : {true, false}) {
    std::vector<double> du = noise(mesh, mesh.dimension, 2.1, moves ? 1e-7 : 0);
    if (!still.empty()) test::keep_still(mesh, still, du);
    const auto error = iterate.tangent_errors(du, noise(mesh, 1, 1.9, moves ? 0 : 10), 4e-3);
    EXPECT_LT(error.force, tolerance) << moves;
    EXPECT_LT(error.heat, tolerance) << moves;
  }
}

// Places of 0.3 m round by 1e-16 of it, over steps of 4e-10 m: 1e-7 of the slopes; curvature is less.
constexpr double k_rounding = 2e-7;

TEST(CoupledTangentOfContact, StaysExactInAMatrixWithANewPattern) {
  const mesh::Mesh mesh =
      test::distribute_blocks(test::raw_blocks({{0.3, 0.1}, {0.3, 0.2}, {12, 2}, {3, 2}, 0}, Shape::quad4));
  RubbingBlocks b(mesh, {.formulation = Formulation::large_sliding}, false);
  test::Iterate iterate(b, 1.0);
  const std::vector<double> rubbed = test::rubbed(mesh);
  // The upper block goes to the left, so that every point slips, and is squeezed.
  const auto moved = [&](double squeeze) {
    std::vector<double> u = test::nodal_field(mesh, 2, [&](const mesh::Point& x, bool upper) {
      return std::vector<double>{upper ? -1e-4 - squeeze * x[0] : 0.0, 0.0};
    });
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += rubbed[i];
    return u;
  };
  iterate.move(moved(0));
  expect_exact(iterate, mesh, k_rounding);
  const int pattern = b.mechanics->system().matrix().pattern();
  // Points on the left keep their partners, those on the right leave them by 90 mm for others.
  iterate.move(moved(0.3));
  EXPECT_GT(b.mechanics->system().matrix().pattern(), pattern);
  expect_exact(iterate, mesh, 5 * k_rounding);  // forces of a strain of 0.3 round too
}

TEST(CoupledTangentOfContact, KnowsWhatABodyThatOnlyConductsTakesByTheDisplacementOfTheOther) {
  for (const char* absent : {"lower", "upper"})
    for (const auto formulation : {Formulation::small_sliding, Formulation::large_sliding}) {
      SCOPED_TRACE(absent);
      RubbingBlocks b(Rubbing{.formulation = formulation}, false, absent);
      test::Iterate iterate(b);
      iterate.move(test::rubbed(b.mesh, absent));
      const contact::ContactSums sums = contact::sums(b.pair->view(), {});
      EXPECT_GT(sums.closed_points, 0);
      EXPECT_LT(sums.closed_points, sums.points);
      expect_exact(iterate, b.mesh, k_rounding, absent);
    }
}

TEST(CoupledTangentOfContact, HasRoomForTheNodesOfAveragedNormals) {
  for (const Shape shape : {Shape::hex8, Shape::hex20}) {
    SCOPED_TRACE(mesh::name(shape));
    RubbingBlocks b(
        {.shape = shape, .formulation = Formulation::large_sliding, .smoothing = true, .twist = 0.5}, false);
    test::Iterate iterate(b);
    iterate.move(test::rubbed(b.mesh));
    std::size_t most = 0;
    for (Index p = 0; p < b.pair->parts().partners.n_points(); ++p)
      most = std::max(most, b.pair->parts().partners.nodes_of(p).size());
    EXPECT_GT(parallel::global_max(static_cast<double>(most)), 2 * contact::k_max_face_nodes);
    expect_exact(iterate, b.mesh, k_rounding);
  }
}

// A point that a multiplier presses conducts as a closed one in both equations of its temperature, although a
// gap of the size of the tolerance is left.
TEST(CoupledTangentOfContact, StaysExactWhereAMultiplierPressesPointsWithAGap) {
  for (const auto variable :
       {contact::InternalVariable::normal_work, contact::InternalVariable::frictional_work}) {
    RubbingBlocks b({.variable = variable, .multiplies = true}, false);
    test::Iterate iterate(b);
    std::vector<double> u = test::rubbed(b.mesh);
    iterate.move(u);
    b.pair->parts().augmentations.augment(contact::AugmentedBy::means);
    const std::vector<double> lifted =
        test::nodal_field(b.mesh, b.mesh.dimension, [&](const mesh::Point&, bool upper) {
          return std::vector<double>{0.0, upper ? 3e-6 : 0.0};
        });
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += lifted[i];
    iterate.move(u);
    double with_gap = 0;
    for (const contact::ContactPointState& point : b.pair->state().points)
      if (point.pressure > 0 && point.penetration < 0) ++with_gap;
    EXPECT_GT(parallel::global_sum(with_gap), 0);
    expect_exact(iterate, b.mesh, k_rounding);
  }
}

// Points that have slid over the rim of their master weigh less the farther they are beyond it.
TEST(CoupledTangentOfContact, KnowsThatPointsBeyondTheRimWeighLess) {
  for (const Shape shape : {Shape::quad4, Shape::quad8, Shape::hex8})
    for (const bool smoothing : {false, true}) {
      SCOPED_TRACE(std::string(mesh::name(shape)) + (smoothing ? ", averaged normals" : ""));
      RubbingBlocks b({.shape = shape, .formulation = Formulation::large_sliding, .smoothing = smoothing},
                      false);
      test::Iterate iterate(b);
      // The outermost points are beyond by 0.13 of half a face of the master.
      const double shift = b.mesh.dimension == 2 ? 0.0152 : 0.0234;
      std::vector<double> u = test::rubbed(b.mesh);
      const std::vector<double> to_the_left =
          test::nodal_field(b.mesh, b.mesh.dimension, [&](const mesh::Point&, bool upper) {
            std::vector<double> v(static_cast<std::size_t>(b.mesh.dimension), 0.0);
            if (upper) v[0] = -shift;
            return v;
          });
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += to_the_left[i];
      iterate.move(u);
      double least = 1;
      const contact::ContactKinematics& kinematics = b.pair->parts().geometry.kinematics();
      const auto* sliding = dynamic_cast<const contact::SlidingKinematics*>(&kinematics);
      ASSERT_NE(sliding, nullptr);
      for (const contact::Partner& met : sliding->points().table().partner)
        if (met.face >= 0) least = std::min(least, met.covered);
      EXPECT_LT(parallel::global_min(least), 0.7);
      expect_exact(iterate, b.mesh, 5 * k_rounding);
      b.pair->parts().forces.term().follow_weights(false);
      const auto error =
          iterate.tangent_errors(noise(b.mesh, b.mesh.dimension, 2.1, 1e-7), noise(b.mesh, 1, 1.9, 0), 4e-3);
      EXPECT_GT(error.force, 10 * k_rounding) << "what the tangent lacks without";
    }
}

}  // namespace
}  // namespace solidus
