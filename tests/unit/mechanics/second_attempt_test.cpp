/// The second attempt of Newton's iteration for equilibrium (mechanics/held_equilibrium.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "body.hpp"
#include "linear/linear_solver.hpp"
#include "mechanics/held_equilibrium.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double k_reach = 1e-2, k_stiffness = 1e6, k_lift = 12 * k_reach;  // [m], [N/m], [m]

/// Springs below the nodes of a surface that stiffen as they are pressed, as asperities do: they push with
/// k l exp(−u_y/l), and have lost their stiffness where the body is lifted off them.
class Asperities final : public linear::Contribution {
 public:
  explicit Asperities(const mesh::Mesh& mesh) {
    for (const Index node : mesh.surfaces.at("bottom").nodes)
      if (node < mesh.n_owned_nodes) rows_.push_back(2 * static_cast<std::size_t>(node) + 1);
  }
  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix&) override {}
  void add_residual(std::span<const double> x, std::span<double> r) override {
    for (const std::size_t y : rows_) r[y] -= force(x[y]);
  }
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override {
    double lowest = 1e300;
    for (const std::size_t y : rows_) {
      matrix.diagonal_block(static_cast<Index>(y / 2))[3] += force(x[y]) / k_reach;
      lowest = std::min(lowest, x[y]);
    }
    places.push_back(parallel::global_min(lowest));
  }
  double pushes(std::span<const double> x) const {
    double sum = 0;
    for (const std::size_t y : rows_) sum += force(x[y]);
    return parallel::global_sum(sum);
  }
  std::vector<double> places;  ///< of the lowest node, in each tangent [m]

 private:
  static double force(double u) { return k_stiffness * k_reach * std::exp(-u / k_reach); }
  std::vector<std::size_t> rows_;
};

/// A block of a square metre that such springs alone hold against its weight, and that is lifted.
class LiftedBlock : public ::testing::Test {
 protected:
  LiftedBlock() {
    block_.hold("left", 0);
    block_.conditions.gravity = {0, -10, 0};
  }
  mechanics::MechanicalReport solve() {
    const auto phase = block_.phase();
    const mechanics::MechanicalState old = phase->initial_state();
    state_ = old;
    std::vector<double> start(block_.mesh.x.size() * 2, 0.0);
    for (std::size_t y = 1; y < start.size(); y += 2) start[y] = k_lift;
    return phase->solve(old, state_, {.time = 1, .dt = 1, .temperature = block_.temperature, .start = start});
  }
  std::string failure() {
    try {
      solve();
    } catch (const StepRejected& rejected) {
      return rejected.reason();
    }
    return {};
  }
  test::Body block_{
      {.shape = mesh::Shape::quad4}, AnalysisKind::plane_strain, test::elastic_material(1e8, 0.0)};
  mechanics::MechanicalState state_;
};

TEST_F(LiftedBlock, ComesDownInShortStepsWhereWholeOnesGoFarIntoTheOtherBody) {
  Asperities springs(block_.mesh);
  block_.contributions = {&springs};
  const mechanics::MechanicalReport report = solve();
  ASSERT_TRUE(report.newton.converged);
  const double weight = 7800 * 10 * 1.0;
  EXPECT_NEAR(springs.pushes(state_.displacement), weight, 1e-8 * weight) << "forces know no held tangent";

  // The first attempt is lost with its first step; the second one sets out again.
  const auto again = std::find(springs.places.begin() + 1, springs.places.end(), k_lift);
  ASSERT_NE(again, springs.places.end());
  const double longest = 0.01 * std::sqrt(2.0);
  for (auto at = again + 1; at != springs.places.end(); ++at)
    EXPECT_LE(std::abs(*at - *(at - 1)), longest * (1 + 1e-9));
  EXPECT_GE(springs.places.end() - again, 9) << "twelve reaches in steps of 1.4";
  EXPECT_GE(report.newton.iterations, static_cast<int>(springs.places.size())) << "of both attempts";
}

/// A skin below the nodes of a surface that gives way as it is pressed, as one does that flows: it pushes
/// with k l (√(1 + 2 g/l) − 1) where it is pressed in by g, and not at all where the body is off it.
class SoftSkin final : public linear::Contribution {
 public:
  explicit SoftSkin(const mesh::Mesh& mesh) {
    for (const Index node : mesh.surfaces.at("bottom").nodes)
      if (node < mesh.n_owned_nodes) rows_.push_back(2 * static_cast<std::size_t>(node) + 1);
  }
  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix&) override {}
  void add_residual(std::span<const double> x, std::span<double> r) override {
    for (const std::size_t y : rows_) r[y] -= k_skin * k_depth * (root(x[y]) - 1);
  }
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override {
    for (const std::size_t y : rows_)
      if (x[y] < 0) matrix.diagonal_block(static_cast<Index>(y / 2))[3] += k_skin / root(x[y]);
  }
  double pushes(std::span<const double> x) const {
    double sum = 0;
    for (const std::size_t y : rows_) sum += k_skin * k_depth * (root(x[y]) - 1);
    return parallel::global_sum(sum);
  }

 private:
  static constexpr double k_skin = 1e10, k_depth = 1e-5;  // [N/m], [m]
  static double root(double u) { return std::sqrt(1 + 2 * std::max(-u, 0.0) / k_depth); }
  std::vector<std::size_t> rows_;
};

// Its nodes are off the skin and pressed in by augmentations. What Newton's iteration takes off has no
// stiffness left but that of the block, a hundredth of the skin's, and goes in again as far as a step may.
TEST_F(LiftedBlock, RestsOnASoftSkinOnceTheTangentHoldsWhatCameOffAndNotByShortStepsAlone) {
  SoftSkin skin(block_.mesh);
  block_.contributions = {&skin};
  const auto phase = block_.phase();
  const mechanics::MechanicalState old = phase->initial_state();
  std::vector<double> start(block_.mesh.x.size() * 2, 0.0);
  for (std::size_t n = 0; n < block_.mesh.x.size(); ++n) {
    const mesh::Point& x = block_.mesh.x[n];
    if (x[1] < 1e-9) start[2 * n + 1] = std::abs(x[0] - 0.5) > 0.25 ? 0.01 : -0.01;
  }
  const mechanics::MechanicalPass pass{.time = 1, .dt = 1, .temperature = block_.temperature, .start = start};
  linear::LinearSolver solver(phase->mesh(), {.prefix = "mechanics_", .kind = linear::SolverKind::direct});
  const parallel::GhostExchange ghosts(phase->mesh());
  const std::vector<int> fields{2};
  const auto attempt = [&](double held) {
    phase->equations().begin(old, pass);
    std::vector<double> x = phase->bodies().start(old, pass);
    const linear::NewtonReport report =
        mechanics::attempt_again(*phase, old, solver, ghosts, fields, x, block_.options.newton, held);
    EXPECT_EQ(report.converged, held > 0);
    return std::pair(report.iterations, skin.pushes(x));
  };
  attempt(0);
  const auto [iterations, pushes] = attempt(1);
  const double weight = 7800 * 10 * 1.0;
  EXPECT_NEAR(pushes, weight, 1e-8 * weight);

  mechanics::MechanicalState next = old;
  const mechanics::MechanicalReport report = phase->solve(old, next, pass);
  EXPECT_TRUE(report.newton.converged);
  EXPECT_GT(report.newton.iterations, iterations) << "of both attempts";
}

TEST_F(LiftedBlock, ThatNothingHoldsIsRejectedWithTheReasonOfTheFirstAttempt) {
  Asperities springs(block_.mesh);
  block_.contributions = {&springs};
  block_.conditions.gravity = {0, 10, 0};  // up: springs do not pull
  EXPECT_THAT(failure(), HasSubstr(", nor in a second attempt"));
}

TEST_F(LiftedBlock, WithoutContactHasNoSecondAttempt) {
  const std::string reason = failure();
  EXPECT_THAT(reason, HasSubstr("mechanics: "));
  EXPECT_THAT(reason, Not(HasSubstr("second attempt")));
}

}  // namespace
}  // namespace solidus
