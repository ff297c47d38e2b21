/// Loads, work, contributions and failures of the mechanical phase.
#include <gtest/gtest.h>

#include <limits>

#include "body.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Solved;

Body cube(Shape shape = Shape::hex8) {
  return Body({.shape = shape, .cells = {2, 2, 2}, .size = {1, 1, 1}, .distortion = 0.1}, AnalysisKind::solid,
              test::elastic_material(2e9, 0.3));
}

/// The sum of the support forces in a direction over all processes.
double reaction(const Solved& solved, int component) {
  double sum = 0;
  for (std::size_t i = static_cast<std::size_t>(component); i < solved.report.reactions.size(); i += 3)
    sum += solved.report.reactions[i];
  return parallel::global_sum(sum);
}

void stand(Body& body) {
  for (int i = 0; i < 3; ++i) body.hold("bottom", i);
}

TEST(Loads, SupportsCarryTheWeight) {
  for (Shape shape : {Shape::tet4, Shape::tet10, Shape::hex8, Shape::hex20}) {
    Body body = cube(shape);
    stand(body);
    body.conditions.gravity = {0, -9.81, 0};
    const Solved solved(body);
    EXPECT_NEAR(reaction(solved, 1), 7800 * 9.81, 1e-9 * 7800 * 9.81);
    EXPECT_NEAR(reaction(solved, 0), 0, 1e-9 * 7800 * 9.81);
  }
}

TEST(Loads, PressureActsAgainstTheOutwardNormalAndTractionAlongTheAxes) {
  Body body = cube();
  stand(body);
  body.conditions.pressures.push_back({"right", Table({0, 2}, {0, 6e5})});  // 3e5 at t = 1
  body.conditions.tractions.push_back({"top", {Table(1e4), Table(-2e4), Table(3e4)}});
  const Solved solved(body);
  EXPECT_NEAR(reaction(solved, 0), 3e5 - 1e4, 1e-4);
  EXPECT_NEAR(reaction(solved, 1), 2e4, 1e-4);
  EXPECT_NEAR(reaction(solved, 2), -3e4, 1e-4);
}

TEST(Loads, PressureOnATubeActsOnTheWholeCircumference) {
  test::Lattice lattice{.shape = Shape::quad4, .cells = {2, 3, 1}, .size = {0.1, 0.5, 1}};
  lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.2, x[1], 0}; };
  Body body(lattice, AnalysisKind::axisymmetric, test::elastic_material(2e9, 0.3));
  body.hold("bottom", 1);
  body.conditions.pressures.push_back({"top", 1e6});
  const Solved solved(body);
  double sum = 0;
  for (std::size_t i = 1; i < solved.report.reactions.size(); i += 2) sum += solved.report.reactions[i];
  const double area = std::acos(-1.0) * (0.3 * 0.3 - 0.2 * 0.2);
  EXPECT_NEAR(parallel::global_sum(sum), 1e6 * area, 1e-9 * 1e6 * area);
}

TEST(Loads, NodesOnTheAxisStayThereWithoutBeingTold) {
  Body body({.shape = Shape::quad4, .cells = {3, 3, 1}}, AnalysisKind::axisymmetric,
            test::elastic_material(2e9, 0.3));
  body.hold("bottom", 1);
  body.conditions.pressures.push_back({"top", 1e6});
  const Solved solved(body);
  for (Index node : body.mesh.surfaces.at("left").nodes) EXPECT_EQ(solved.u(body, node, 0), 0.0);
}

TEST(Loads, AnUnknownGroupIsTheUsersError) {
  Body body = cube();
  body.hold("botom", 0);
  try {
    body.phase();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("botom"), std::string::npos);
  }
}

TEST(Phase, SupportsFollowTheirTable) {
  Body body = cube();
  stand(body);
  body.hold("top", 1, Table({0, 1, 2}, {0, 1e-3, -1e-3}));
  Solved solved(body);
  for (double time : {1.0, 1.5, 2.0}) {
    if (time > 1) solved.step(body, time, 0.5);
    for (Index node : body.mesh.surfaces.at("top").nodes)
      EXPECT_EQ(solved.u(body, node, 1), Table({0, 1, 2}, {0, 1e-3, -1e-3}).value(time));
  }
}

TEST(Phase, WorkOfLoadsAndSupportsIsTheWorkOfTheStresses) {
  Body body = cube();
  stand(body);
  body.conditions.gravity = {0, -9.81, 0};
  body.hold("top", 1, Table({0, 1}, {0, 1e-3}));
  body.conditions.pressures.push_back({"right", 3e5});
  const Solved solved(body);
  const auto& work = solved.report.work;
  EXPECT_NE(work.external_work, 0);
  EXPECT_GT(work.support_work, 0);
  EXPECT_NEAR(work.internal_work, work.external_work + work.support_work, 1e-9 * work.internal_work);
}

TEST(Phase, WithoutLoadItConvergesAtOnce) {
  Body body = cube();
  stand(body);
  const Solved solved(body);
  EXPECT_EQ(solved.report.newton.iterations, 0);
  for (double u : solved.state.displacement) EXPECT_EQ(u, 0.0);
}

TEST(Phase, ALinearStepTakesOneSolveAndTheNextOneNone) {
  Body body = cube();
  stand(body);
  body.conditions.gravity = {0, -9.81, 0};
  Solved solved(body);
  EXPECT_EQ(solved.report.newton.iterations, 1);
  solved.step(body, 2.0, 1.0);
  EXPECT_EQ(solved.report.newton.iterations, 0);
}

TEST(Phase, AGuessIsTheStartWhereItIsNearerToEquilibriumAndOnlyThere) {
  Body body = cube();
  stand(body);
  body.conditions.gravity = {0, -9.81, 0};
  const Solved solved(body);
  const auto from_guess = [&](double factor) {
    const auto phase = body.phase();
    const mechanics::MechanicalState old = phase->initial_state();
    mechanics::MechanicalState next;
    std::vector<double> guess = solved.state.displacement;
    for (double& u : guess) u *= factor;
    const int iterations =
        phase->solve(old, next, {.time = 1, .dt = 1, .temperature = body.temperature, .guess = guess})
            .newton.iterations;
    for (std::size_t i = 0; i < guess.size(); ++i)
      EXPECT_NEAR(next.displacement[i], solved.state.displacement[i], 1e-15);
    return iterations;
  };
  EXPECT_EQ(from_guess(1), 0);
  EXPECT_EQ(from_guess(0.9), 1);
  EXPECT_EQ(from_guess(100), 1);
}

TEST(Phase, SolversAgree) {
  std::vector<double> reference;
  for (auto kind : {linear::SolverKind::direct, linear::SolverKind::multigrid, linear::SolverKind::jacobi,
                    linear::SolverKind::incomplete}) {
    Body body = cube(Shape::tet4);
    stand(body);
    body.conditions.gravity = {0, -9.81, 0};
    body.options.solver = kind;
    body.options.linear_tolerance = 1e-12;
    body.options.newton.inexact = false;  // Newton's tolerance is not what is compared
    const Solved solved(body);
    if (reference.empty()) reference = solved.state.displacement;
    for (std::size_t i = 0; i < reference.size(); ++i)
      EXPECT_NEAR(solved.state.displacement[i], reference[i], 1e-9 * 4e-5);  // of the largest
  }
}

TEST(Phase, InexactStepsEndWithinNewtonsTolerance) {
  std::vector<double> exact;
  for (const bool inexact : {false, true}) {
    Body body = cube(Shape::tet4);
    stand(body);
    body.conditions.gravity = {0, -9.81, 0};
    body.options.solver = linear::SolverKind::jacobi;
    body.options.newton.tolerance = 1e-6;
    body.options.newton.inexact = inexact;
    const Solved solved(body);
    EXPECT_LE(solved.report.newton.residuals.back(), 1e-6);
    if (!inexact) {
      exact = solved.state.displacement;
      continue;
    }
    // A linear body would take one exact solve.
    EXPECT_GT(solved.report.newton.iterations, 1);
    // Forces that are 1e-6 of the weight, on a body of a few elements.
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(solved.state.displacement[i], exact[i], 1e-5 * 4e-5);
  }
}

/// Springs to ground at every node in y; NaN when told.
class Springs : public linear::Contribution {
 public:
  explicit Springs(double stiffness) : stiffness_(stiffness) {}
  void add_to_graph(linear::NodeGraph&) const override {}
  void bind(const linear::BlockMatrix& matrix) override { n_ = matrix.block_size(); }
  void add_residual(std::span<const double> x, std::span<double> r) override {
    for (std::size_t i = 1; i < r.size(); i += static_cast<std::size_t>(n_)) r[i] += stiffness_ * x[i];
  }
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override {
    for (Index node = 0; static_cast<std::size_t>(node) < x.size() / static_cast<std::size_t>(n_); ++node)
      if (node < n_owned) matrix.diagonal_block(node)[n_ + 1] += stiffness_;
  }
  Index n_owned = 0;

 private:
  double stiffness_;
  int n_ = 3;
};

TEST(Phase, ContributionsCarryLoad) {
  Body body = cube();
  Springs springs(1e6);
  springs.n_owned = body.mesh.n_owned_nodes;
  body.contributions = {&springs};
  body.hold("body", 0);
  body.hold("body", 2);
  body.conditions.gravity = {0, -9.81, 0};
  const Solved solved(body);
  double force = 0;
  for (Index node = 0; node < body.mesh.n_owned_nodes; ++node) force -= 1e6 * solved.u(body, node, 1);
  EXPECT_NEAR(parallel::global_sum(force), 7800 * 9.81, 1e-8 * 7800 * 9.81);
}

TEST(Phase, AFailureIsRejectedOnEveryProcessWithItsPlaceAndLeavesTheTrialAlone) {
  Body body = cube();
  Springs springs(std::numeric_limits<double>::quiet_NaN());
  springs.n_owned = body.mesh.n_owned_nodes;
  body.contributions = {&springs};
  stand(body);
  body.conditions.gravity = {0, -9.81, 0};
  const auto phase = body.phase();
  const auto old = phase->initial_state();
  mechanics::MechanicalState trial;
  trial.displacement = {42.0};
  try {
    phase->solve(old, trial, body.temperature, 1, 1);
    FAIL() << "no rejection";
  } catch (const StepRejected& rejected) {
    EXPECT_EQ(rejected.reason().rfind("mechanics: ", 0), 0u);
    EXPECT_EQ(rejected.where().rfind("node ", 0), 0u);
  }
  EXPECT_EQ(trial.displacement, std::vector<double>{42.0});
}

TEST(Phase, TheSameStepFromTheSameStateGivesTheSameBits) {
  Body body = cube();
  stand(body);
  body.conditions.gravity = {0, -9.81, 0};
  // MUMPS on several processes adds in the order in which messages come.
  body.options.solver = linear::SolverKind::multigrid;
  const auto phase = body.phase();
  const auto old = phase->initial_state();
  mechanics::MechanicalState first, second;
  phase->solve(old, first, body.temperature, 1, 1);
  phase->solve(old, second, body.temperature, 1, 1);
  EXPECT_EQ(first.displacement, second.displacement);
}

}  // namespace
}  // namespace solidus
