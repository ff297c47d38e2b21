/// Two bodies pressed together and sheared, whose friction sticks, turn together as one rigid body.
///
/// Every node follows y = Q (X + u) + d. The traction's components on the master stay, so the force of the
/// current configuration turns along: R(θ) = Q R(0), whatever the angle. The forces on the two bodies cancel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_rubbing.hpp"

namespace solidus {
namespace {

using contact::Point;
using contact::Tensor;
using mesh::Shape;

/// Rotation by an angle about an axis of unit length.
Tensor rotation(const Point& a, double angle) {
  Tensor q{};
  contact::add_scaled(q, std::cos(angle), contact::identity());
  contact::add_outer(q, 1 - std::cos(angle), a, a);
  const double s = std::sin(angle);
  const Tensor cross{{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}}};
  contact::add_scaled(q, s, cross);
  return q;
}

struct Bodies {
  Shape shape;
  bool curved, smoothing;
  contact::IntegrationRule rule = contact::IntegrationRule::gauss;
};

class StickingFriction : public ::testing::TestWithParam<Bodies> {
 protected:
  /// Blocks of the setup; curved: bent over a circle, faceted.
  static mesh::Mesh blocks() {
    const Bodies setup = GetParam();
    const bool flat = mesh::dimension(setup.shape) == 2;
    mesh::RawMesh raw = test::raw_blocks(test::standard_blocks(setup.shape), setup.shape);
    if (setup.curved)
      for (auto& x : raw.x) {
        const double angle = 2 * (x[0] - 0.15), r = 0.5 + x[flat ? 1 : 2];
        x[0] = r * std::sin(angle);
        x[flat ? 1 : 2] = r * std::cos(angle);
      }
    return test::distribute_blocks(raw);
  }
};

TEST_P(StickingFriction, TurnsWithTheBodies) {
  const mesh::Mesh mesh = blocks();
  const bool flat = mesh.dimension == 2;
  contact::ContactParameters spec = test::rubbing(test::coulomb(10), 1e11);
  spec.smoothing = GetParam().smoothing;
  spec.integration = GetParam().rule;
  spec.stabilisation = 0;
  contact::ContactPair pair(mesh, flat ? AnalysisKind::plane_strain : AnalysisKind::solid, spec);
  const Point axis = flat ? Point{0, 0, 1} : Point{2.0 / 7, -3.0 / 7, 6.0 / 7};
  const auto n = static_cast<std::size_t>(mesh.dimension);
  // The bodies overlap by 1 mm and are sheared by less; then everything turns by θ and moves along.
  const auto moved = [&](double share, double angle) {
    const Tensor q = rotation(axis, angle);
    return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
      Point y = x;
      if (upper) {
        y[0] += 4e-4 * share;
        if (!flat) y[1] -= 3e-4 * share;
        y[n - 1] -= 1e-3;
      }
      const Point turned = contact::times(q, y);
      std::vector<double> u(n);
      for (std::size_t i = 0; i < n; ++i) u[i] = turned[i] - x[i] + 0.2 * angle;
      return u;
    });
  };
  contact::ContactState state = pair.parts().history.initial();
  std::vector<double> displacement(mesh.x.size() * n, 0.0);
  double time = 0;
  const auto go = [&](const std::vector<double>& to) {
    pair.begin(state, {.time = time + 1, .dt = 1, .displacement = displacement, .temperature = {}});
    pair.update(to);
    // Forces of the phase on both bodies cancel.
    std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes) * n, 0.0);
    pair.parts().forces.term().add_residual(to, r);
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double s = 0;
      for (std::size_t k = i; k < r.size(); k += n) {
        s += r[k];
        size += std::abs(r[k]);
      }
      sum += std::abs(parallel::global_sum(s));
    }
    EXPECT_LT(sum, 1e-12 * parallel::global_sum(size));
    state = pair.state();
    displacement = to;
    time += 1;
  };
  go(moved(0, 0));
  go(moved(1, 0));
  const contact::ContactSums start = contact::sums(pair.view(), {});
  EXPECT_GT(start.friction, 0.1 * start.force);
  EXPECT_EQ(start.sticking_points, start.closed_points);
  double worst = 0;
  for (const double degrees : {10.0, 55.0, 130.0, 215.0, 300.0, 360.0, 170.0, -80.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    go(moved(1, angle));
    const contact::ContactSums sums = contact::sums(pair.view(), {});
    EXPECT_EQ(sums.sticking_points, start.sticking_points);
    EXPECT_NEAR(sums.friction, start.friction, 1e-10 * start.friction);
    EXPECT_NEAR(sums.force, start.force, 1e-10 * start.force);
    EXPECT_EQ(sums.work, 0);
    const Point expected = contact::times(rotation(axis, angle), start.resultant);
    const double defect = contact::norm(contact::subtract(sums.resultant, expected));
    EXPECT_LT(defect, 1e-10 * contact::norm(start.resultant));
    worst = std::max(worst, defect / contact::norm(start.resultant));
  }
  RecordProperty("defect", fmt::format("{:.1e}", worst));
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, StickingFriction,
    ::testing::Values(Bodies{Shape::quad4, false, false}, Bodies{Shape::quad4, true, false},
                      Bodies{Shape::quad4, true, true}, Bodies{Shape::quad8, true, false},
                      Bodies{Shape::hex8, false, false}, Bodies{Shape::hex8, true, false},
                      Bodies{Shape::hex8, true, true}, Bodies{Shape::tet10, true, false},
                      Bodies{Shape::quad4, true, false, contact::IntegrationRule::segments},
                      Bodies{Shape::quad8, true, true, contact::IntegrationRule::segments},
                      Bodies{Shape::hex8, true, false, contact::IntegrationRule::segments}),
    [](const auto& setup) {
      return std::string(mesh::name(setup.param.shape)) + (setup.param.curved ? "Curved" : "Flat") +
             (setup.param.smoothing ? "Smooth" : "") +
             (setup.param.rule == contact::IntegrationRule::segments ? "Segments" : "");
    });

}  // namespace
}  // namespace solidus
