#include "linear/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "grid.hpp"

namespace solidus::linear {
namespace {

using test::Grid;

/// A chain of springs over the quads' edges, to ground through f(x): r_i = Σ_j (x_i − x_j) + f(x_i) − load.
class SpringGrid : public NonlinearSystem {
 public:
  using Function = std::function<double(double)>;
  SpringGrid(const Grid& grid, Function f, Function df, double load)
      : grid_(grid),
        f_(std::move(f)),
        df_(std::move(df)),
        load_(load),
        matrix_(grid.mesh, 1, graph()),
        slots_(matrix_.clique_slots(grid.quads, 4)) {}

  double residual(std::span<const double> x, std::span<double> r) override {
    ++evaluations;
    std::fill(r.begin(), r.end(), 0.0);
    for (std::size_t e = 0; e < grid_.quads.size(); e += 4)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) {
          const auto row = static_cast<std::size_t>(grid_.quads[e + a]),
                     other = static_cast<std::size_t>(grid_.quads[e + b]);
          if (row < r.size()) r[row] += x[row] - x[other];
        }
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += f_(x[i]) - load_;
    return std::sqrt(static_cast<double>(grid_.mesh.n_global_nodes)) * load_;
  }
  BlockMatrix& tangent(std::span<const double> x) override {
    ++tangents;
    matrix_.set_zero();
    for (std::size_t e = 0; e < grid_.quads.size() / 4; ++e)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) {
          *matrix_.block(slots_[(e * 4 + a) * 4 + a]) += 1;
          *matrix_.block(slots_[(e * 4 + a) * 4 + b]) -= 1;
        }
    for (Index i = 0; i < grid_.mesh.n_owned_nodes; ++i)
      *matrix_.diagonal_block(i) += df_(x[static_cast<std::size_t>(i)]);
    return matrix_;
  }
  void accept(std::span<const double>, std::span<const double>, double alpha) override {
    steps.push_back(alpha);
  }
  BlockMatrix& matrix() { return matrix_; }
  int evaluations = 0, tangents = 0;
  std::vector<double> steps;

 private:
  NodeGraph graph() const {
    NodeGraph g(grid_.mesh);
    g.add_cliques(grid_.quads, 4);
    return g;
  }
  const Grid& grid_;
  Function f_, df_;
  double load_;
  BlockMatrix matrix_;
  std::vector<BlockMatrix::Slot> slots_;
  std::vector<double> x_;
};

std::vector<char> fix(const Grid& grid, GlobalIndex which) {
  std::vector<char> fixed(static_cast<std::size_t>(grid.mesh.n_nodes()), 0);
  for (Index i = 0; i < grid.mesh.n_nodes(); ++i)
    fixed[static_cast<std::size_t>(i)] = grid.global(i) == which ? 1 : 0;
  return fixed;
}

SpringGrid cubic(const Grid& grid) {
  return SpringGrid(
      grid, [](double x) { return x * x * x; }, [](double x) { return 3 * x * x; }, 8.0);
}

NewtonReport run(const Grid& grid, SpringGrid& system, std::vector<double>& x, NewtonOptions options,
                 SolverKind kind = SolverKind::direct) {
  LinearSolver solver(grid.mesh, {.prefix = "test_", .kind = kind, .relative_tolerance = 1e-12});
  constexpr int components[] = {1};
  return newton(system, solver, parallel::GhostExchange(grid.mesh), components, x, options);
}

TEST(Newton, ConvergesQuadratically) {
  const Grid grid(5, 6);
  SpringGrid system = cubic(grid);
  system.matrix().set_fixed(fix(grid, 7));
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
  const NewtonReport report =
      run(grid, system, x, {.tolerance = 1e-13, .line_search = false, .chords = false});
  ASSERT_TRUE(report.converged) << report.reason;
  // The exponent p of |r_{k+1}| = c |r_k|^p from three residuals in a row, above round-off.
  const auto& r = report.residuals;
  std::size_t k = r.size() - 1;
  while (r[k] < 1e-14) --k;
  ASSERT_GE(k, 2u);
  const double p = std::log(r[k] / r[k - 1]) / std::log(r[k - 1] / r[k - 2]);
  EXPECT_GT(p, 1.8);
  EXPECT_LT(p, 2.3);
}

/// Springs that leave next to nothing but a load in balance with the ground, wherever they are: a residual
/// of 1e-6 for a displacement that is off by one.
class SoftSprings : public SpringGrid {
 public:
  explicit SoftSprings(const Grid& grid)
      : SpringGrid(
            grid, [](double x) { return k_load + k_stiffness * (x - 1); }, [](double) { return k_stiffness; },
            k_load) {}
  double relative_step(std::span<const double> x, std::span<const double> d) override {
    double of_x = 0, of_d = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      of_x += x[i] * x[i];
      of_d += d[i] * d[i];
    }
    return std::sqrt(parallel::global_sum(of_d) / parallel::global_sum(of_x));
  }

 private:
  static constexpr double k_load = 1, k_stiffness = 1e-6;
};

TEST(Newton, ForcesInBalanceDoNotEndItWhereTheDisplacementIsFarOff) {
  const Grid grid(5, 6);
  const auto solve = [&](double step_tolerance, double absolute) {
    SoftSprings system(grid);
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
    const NewtonReport report =
        run(grid, system, x,
            {.tolerance = 1e-3, .absolute_tolerance = absolute, .step_tolerance = step_tolerance});
    EXPECT_TRUE(report.converged) << report.reason;
    return std::pair(x.front(), report.iterations);
  };
  EXPECT_EQ(solve(0, 0), std::pair(0.0, 0));  // the residual alone
  const auto [x, iterations] = solve(1e-2, 0);
  EXPECT_NEAR(x, 1, 1e-6);
  EXPECT_EQ(iterations, 1);
  EXPECT_EQ(solve(1e-2, 1e-3).second, 0);  // rounding is no reason for a step
}

TEST(Newton, TheEffortOfASolutionIsThatOfTheDefaultsWhateverToleranceIsAskedFor) {
  const Grid grid(5, 6);
  const auto solve = [&](double tolerance) {
    SpringGrid system = cubic(grid);
    system.matrix().set_fixed(fix(grid, 7));
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
    return run(grid, system, x, {.tolerance = tolerance, .line_search = false, .chords = false});
  };
  const NewtonReport loose = solve(1e-2), usual = solve(NewtonOptions{}.effort_tolerance),
                     tight = solve(1e-13);
  EXPECT_EQ(loose.effort, loose.iterations);
  EXPECT_EQ(usual.effort, usual.iterations);
  EXPECT_EQ(tight.effort, usual.effort);
  EXPECT_LT(loose.effort, usual.effort);
  EXPECT_LT(tight.effort, tight.iterations);
}

TEST(Newton, AStartOutOfBalanceByLessThanRoundingIsLeftWhereForcesAreMuchMore) {
  const Grid grid(5, 6);
  const auto iterations = [&](double absolute) {
    SoftSprings system(grid);
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
    const NewtonReport report =
        run(grid, system, x, {.tolerance = 1e-9, .absolute_tolerance = absolute, .step_tolerance = 1e-2});
    EXPECT_TRUE(report.converged) << report.reason;
    return report.iterations;
  };
  // The load on 30 nodes is 5.5, the residual at the start 5.5e-6.
  EXPECT_EQ(iterations(1e-4), 1);
  EXPECT_EQ(iterations(1e-2), 0);
}

TEST(Newton, FixedValuesStayAndGhostsAreUpToDate) {
  const Grid grid(5, 6);
  SpringGrid system = cubic(grid);
  system.matrix().set_fixed(fix(grid, 7));
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
  ASSERT_TRUE(run(grid, system, x, {.tolerance = 1e-12}).converged);
  for (Index i = 0; i < grid.mesh.n_nodes(); ++i)
    if (grid.global(i) == 7) {
      EXPECT_EQ(x[static_cast<std::size_t>(i)], 1.5);
    }
  std::vector<double> again = x;
  parallel::GhostExchange(grid.mesh).update(again, 1);
  EXPECT_EQ(again, x);
}

TEST(Newton, SolverKindsAgree) {
  const Grid grid(9, 8);
  std::vector<double> reference;
  for (SolverKind kind :
       {SolverKind::automatic, SolverKind::direct, SolverKind::multigrid, SolverKind::jacobi}) {
    SpringGrid system = cubic(grid);
    system.matrix().set_fixed(fix(grid, 30));
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
    ASSERT_TRUE(run(grid, system, x, {.tolerance = 1e-11}, kind).converged);
    if (reference.empty()) reference = x;
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], reference[i], 1e-9);
  }
}

TEST(Newton, InexactStepsEndWithinTheToleranceAndTakeFewerLinearIterations) {
  const Grid grid(9, 8);
  const auto solve = [&](bool inexact, SolverKind kind, std::vector<double>& x) {
    SpringGrid system = cubic(grid);
    system.matrix().set_fixed(fix(grid, 30));
    x.assign(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
    const NewtonReport report = run(grid, system, x, {.tolerance = 1e-8, .inexact = inexact}, kind);
    EXPECT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.residuals.back(), 1e-8);
    return report;
  };
  for (const SolverKind kind : {SolverKind::multigrid, SolverKind::jacobi}) {
    std::vector<double> exact, inexact;
    const NewtonReport far = solve(false, kind, exact), near = solve(true, kind, inexact);
    EXPECT_LT(near.linear_iterations, far.linear_iterations);
    // The reference is the norm of a load of 8 at every node, the tangent is 3 x² or more with x about 2.
    const double reference = 8 * std::sqrt(72.0);
    for (std::size_t i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(inexact[i], exact[i], 2 * 1e-8 * reference / 6.75);
  }
}

TEST(Newton, DirectSolversKnowNoInexactSteps) {
  const Grid grid(5, 6);
  std::vector<double> results[2];
  for (const bool inexact : {false, true}) {
    SpringGrid system = cubic(grid);
    system.matrix().set_fixed(fix(grid, 7));
    std::vector<double>& x = results[inexact ? 1 : 0];
    x.assign(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
    ASSERT_TRUE(run(grid, system, x, {.tolerance = 1e-10, .inexact = inexact}).converged);
  }
  EXPECT_EQ(results[0], results[1]);
}

/// arctan saturates: the plain iteration overshoots further each time once |x| > 1.39 (its classical limit).
SpringGrid saturating(const Grid& grid) {
  return SpringGrid(
      grid, [](double x) { return 50 * std::atan(x); }, [](double x) { return 50 / (1 + x * x); }, 1.0);
}

TEST(Newton, LineSearchRescuesAProblemThatThePlainIterationDivergesOn) {
  const Grid grid(4, 4);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 3.0);
  SpringGrid plain = saturating(grid), searched = saturating(grid);
  std::vector<double> y = x;
  const NewtonReport without = run(grid, plain, x, {.tolerance = 1e-10, .line_search = false});
  EXPECT_FALSE(without.converged);
  EXPECT_FALSE(without.reason.empty());
  const NewtonReport with = run(grid, searched, y, {.tolerance = 1e-10});
  ASSERT_TRUE(with.converged) << with.reason;
  EXPECT_NEAR(y[0], std::tan(1.0 / 50), 1e-9);
  EXPECT_EQ(searched.steps.size(), static_cast<std::size_t>(with.iterations));
}

/// Energy ¼x⁴ − ½x² of every node: a maximum at 0, minima at ±1.
TEST(Newton, AStepThatLeadsUphillIsTakenBackwardsWhereThatIsAskedFor) {
  const Grid grid(4, 4);
  const auto two_wells = [&grid] {
    return SpringGrid(
        grid, [](double x) { return x * x * x - x; }, [](double x) { return 3 * x * x - 1; }, 0.0);
  };
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.2), y = x;
  SpringGrid plain = two_wells(), descending = two_wells();
  const NewtonReport uphill = run(grid, plain, x, {.absolute_tolerance = 1e-10});
  const NewtonReport downhill = run(grid, descending, y, {.absolute_tolerance = 1e-10, .descends = true});
  ASSERT_TRUE(uphill.converged && downhill.converged) << uphill.reason << downhill.reason;
  EXPECT_NEAR(x[0], 0.0, 1e-9);
  EXPECT_NEAR(y[0], 1.0, 1e-9);
}

TEST(Newton, ALinearProblemTakesOneSolveAndTwoResiduals) {
  const Grid grid(4, 4);
  SpringGrid system(
      grid, [](double x) { return 2 * x; }, [](double) { return 2.0; }, 6.0);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
  const NewtonReport report = run(grid, system, x, {.tolerance = 1e-10});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(system.evaluations, 2);
  EXPECT_NEAR(x[0], 3.0, 1e-12);
}

/// From a start near the solution the first step contracts by ρ = 3e-3 to r₁ = 7e-6, so that one with the
/// same tangent leaves 2ρ r₁ = 4e-8: enough for a tolerance of 1e-6, not for 1e-8.
TEST(Newton, ATangentThatWillDoServesTwice) {
  const Grid grid(4, 4);
  const auto solve = [&](double tolerance) {
    SpringGrid system = cubic(grid);
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 2.0 * (1 + 1e-3));
    const NewtonReport report = run(grid, system, x, {.tolerance = tolerance});
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.iterations, 2);
    EXPECT_NEAR(x[0], 2.0, tolerance);
    return system.tangents;
  };
  EXPECT_EQ(solve(1e-6), 1);
  EXPECT_EQ(solve(1e-8), 2);
}

// The ground is soft up to x = 0.5 and stiff beyond. The first step lands so close to the solution that the
// tangent before seems to do once more, but it is 1e4 times too soft there: such a step throws x far beyond
// the solution.
TEST(Newton, ATangentThatNoLongerServesIsReplaced) {
  constexpr double k_stiff = 1e4, k_solution = 1 - 1e-8;
  const Grid grid(5, 6);
  SpringGrid system(
      grid, [](double x) { return x <= 0.5 ? x : 1 + k_stiff * (x - k_solution); },
      [](double x) { return x <= 0.5 ? 1.0 : k_stiff; }, 1);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
  const NewtonReport report = run(grid, system, x, {.tolerance = 1e-6});
  ASSERT_TRUE(report.converged) << report.reason;
  for (std::size_t k = 1; k < report.residuals.size(); ++k)
    EXPECT_LE(report.residuals[k], report.residuals[k - 1]) << "iteration " << k;
  for (const double value : x) EXPECT_NEAR(value, k_solution, 1e-11);
  EXPECT_EQ(system.steps.size(), 2U) << "the step that did not serve is taken back";
}

// The rounding of a stiff body next to a soft one may be more than the tolerance allows of the soft one's
// forces.
TEST(Newton, AResidualThatCountsAsRoundingIsBroughtDownFurtherWhereForcesAreFarAboveItAndItFalls) {
  const Grid grid(5, 6);
  const auto left = [&](double absolute, double tolerance = 1e-16) {
    SpringGrid system = cubic(grid);  // of forces of 44 in all
    std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.5);
    const NewtonReport report =
        run(grid, system, x, {.tolerance = tolerance, .absolute_tolerance = absolute});
    EXPECT_TRUE(report.converged) << report.reason;
    EXPECT_LT(report.iterations, 12);
    return report.residuals.back();
  };
  EXPECT_LT(left(1e-2), 1e-13);
  EXPECT_GT(left(1e-1), 1e-13) << "forces are hardly more";
  EXPECT_GT(left(1e-2, 1e-5), 1e-9) << "the usual tolerance takes it as it is";
}

TEST(Newton, NoLoadConvergesAtOnce) {
  const Grid grid(4, 4);
  SpringGrid system(
      grid, [](double x) { return x; }, [](double) { return 1.0; }, 0.0);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
  const NewtonReport report = run(grid, system, x, {});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
}

TEST(Newton, StepsIntoNotANumberAreShortened) {
  const Grid grid(4, 4);
  // log is undefined beyond zero; the first full step from 5 lands at a negative value.
  SpringGrid system(
      grid, [](double x) { return 10 + std::log(x); }, [](double x) { return 1 / x; }, 10.0);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 5.0);
  const NewtonReport report = run(grid, system, x, {.tolerance = 1e-10});
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(x[0], 1.0, 1e-8);
}

TEST(Newton, NotANumberAtTheStartIsReportedOnEveryProcess) {
  const Grid grid(4, 4);
  SpringGrid system = cubic(grid);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 1.0);
  for (Index i = 0; i < grid.mesh.n_nodes(); ++i)
    if (grid.global(i) == 0) x[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
  const NewtonReport report = run(grid, system, x, {});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.reason, "the residual is not a number");
}

TEST(Newton, ASingularMatrixIsReportedNotThrown) {
  const Grid grid(4, 4);
  SpringGrid system(
      grid, [](double) { return 0.0; }, [](double) { return 0.0; }, 1.0);
  std::vector<double> x(static_cast<std::size_t>(grid.mesh.n_nodes()), 0.0);
  for (SolverKind kind : {SolverKind::direct, SolverKind::jacobi}) {
    const NewtonReport report = run(grid, system, x, {.max_iterations = 3}, kind);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.reason.empty());
  }
}

}  // namespace
}  // namespace solidus::linear
