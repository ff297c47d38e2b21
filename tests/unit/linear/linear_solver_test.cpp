#include "linear/linear_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid.hpp"
#include "linear/dense.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {
namespace {

using test::Grid;

/// Diagonally dominant; `skew` makes it unsymmetric.
double entry(GlobalIndex i, GlobalIndex j, double skew) {
  if (i == j) return 10.0 + static_cast<double>(i % 3);
  return -1.0 / static_cast<double>(1 + i + j) + (i < j ? skew : -skew);
}

struct System {
  Grid grid{5, 6};
  BlockMatrix matrix;
  dense::Matrix entries{30, 30};
  std::vector<double> solution, b, x;

  System() : matrix(grid.mesh, 1, graph(grid)), b(owned()), x(owned()) {}
  std::size_t owned() const { return static_cast<std::size_t>(grid.mesh.n_owned_nodes); }
  static NodeGraph graph(const Grid& grid) {
    NodeGraph g(grid.mesh);
    g.add_cliques(grid.quads, 4);
    return g;
  }
  static bool coupled(int i, int j) { return std::abs(i % 5 - j % 5) <= 1 && std::abs(i / 5 - j / 5) <= 1; }

  double& at(int i, int j) { return entries(static_cast<std::size_t>(i), static_cast<std::size_t>(j)); }

  void fill(double factor, double skew) {
    entries = dense::Matrix(30, 30);
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j < 30; ++j)
        if (coupled(i, j)) at(i, j) = factor * entry(i, j, skew);
    std::vector<double> rhs(30);
    for (std::size_t i = 0; i < 30; ++i) rhs[i] = std::sin(1.0 + static_cast<double>(i));
    const auto [q, r] = dense::orthogonal_factors(entries.all());
    solution.resize(30);
    dense::multiply_transposed(q.all(), rhs, solution);
    dense::solve_upper(r, {solution.data(), 30, 1, 30});
    for (Index row = 0; row < grid.mesh.n_owned_nodes; ++row) {
      const auto i = static_cast<int>(grid.global(row));
      b[static_cast<std::size_t>(row)] = rhs[static_cast<std::size_t>(i)];
      for (Index column = 0; column < grid.mesh.n_nodes(); ++column) {
        const auto j = static_cast<int>(grid.global(column));
        if (coupled(i, j)) *matrix.block(matrix.slot(row, column)) = at(i, j);
      }
    }
  }
  double error() const {
    double worst = 0;
    for (Index row = 0; row < grid.mesh.n_owned_nodes; ++row)
      worst = std::max(worst, std::abs(x[static_cast<std::size_t>(row)] -
                                       solution[static_cast<std::size_t>(grid.global(row))]));
    double largest = 0;
    for (const double value : solution) largest = std::max(largest, std::abs(value));
    return parallel::global_max(worst) / largest;
  }
};

TEST(LinearSolver, EveryKindSolvesSymmetricAndUnsymmetricSystemsAgainAndAgain) {
  for (bool symmetric : {true, false})
    for (SolverKind kind : {SolverKind::direct, SolverKind::multigrid, SolverKind::jacobi}) {
      System system;
      LinearSolver solver(
          system.grid.mesh,
          {.prefix = "test_", .kind = kind, .symmetric = symmetric, .relative_tolerance = 1e-12});
      for (double factor : {1.0, 1.1, 250.0}) {  // the last one makes a kept hierarchy useless
        system.fill(factor, symmetric ? 0.0 : 0.4);
        const LinearReport report = solver.solve(system.matrix, system.b, system.x);
        EXPECT_TRUE(report.converged) << report.reason;
        EXPECT_LT(system.error(), 1e-10);
      }
      EXPECT_GT(solver.seconds().sum(), 0.0);
    }
}

TEST(LinearSolver, ASingularMatrixIsReportedAndTheNextOneSolved) {
  for (bool symmetric : {true, false}) {
    System system;
    LinearSolver solver(system.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::direct, .symmetric = symmetric});
    system.fill(1.0, 0.0);
    EXPECT_TRUE(solver.solve(system.matrix, system.b, system.x).converged);
    system.fill(0.0, 0.0);
    const LinearReport singular = solver.solve(system.matrix, system.b, system.x);
    EXPECT_FALSE(singular.converged);
    EXPECT_THAT(singular.reason, ::testing::HasSubstr("singular"));
    system.fill(1.0, 0.0);
    EXPECT_TRUE(solver.solve(system.matrix, system.b, system.x).converged);
    EXPECT_LT(system.error(), 1e-10);
  }
}

TEST(LinearSolver, RowsFarAboveTheirRightHandSideAreSolvedThoughRoundingLeavesAResidual) {
  System system;
  system.fill(1.0, 0.4);
  for (Index row = 0; row < system.grid.mesh.n_owned_nodes; ++row) {
    const auto i = static_cast<int>(system.grid.global(row));
    double sum = 0;
    for (int j = 0; j < 30; ++j) sum += system.at(i, j);
    if (i % 2 == 0) {
      system.b[static_cast<std::size_t>(row)] = sum;
      continue;
    }
    *system.matrix.block(system.matrix.slot(row, row)) -= sum;
    for (Index column = 0; column < system.grid.mesh.n_nodes(); ++column)
      if (System::coupled(i, static_cast<int>(system.grid.global(column))))
        *system.matrix.block(system.matrix.slot(row, column)) *= 1e18;
  }
  std::fill(system.solution.begin(), system.solution.end(), 1.0);
  LinearSolver solver(system.grid.mesh, {.prefix = "test_", .kind = SolverKind::direct, .symmetric = false});
  const LinearReport report = solver.solve(system.matrix, system.b, system.x);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_LT(system.error(), 1e-10);
}

TEST(LinearSolver, AFactorisationSaysWhyItFails) {
  for (bool symmetric : {true, false}) {
    System system;
    LinearSolver solver(system.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::direct, .symmetric = symmetric});
    for (int attempt = 0; attempt < 3; ++attempt) {
      system.fill(std::numeric_limits<double>::quiet_NaN(), 0.0);
      const LinearReport broken = solver.solve(system.matrix, system.b, system.x);
      EXPECT_FALSE(broken.converged);
      EXPECT_EQ(broken.reason, "the matrix has entries that are not numbers");
      system.fill(1.0, 0.0);
      EXPECT_TRUE(solver.solve(system.matrix, system.b, system.x).converged);
      EXPECT_LT(system.error(), 1e-10);
    }
  }
}

TEST(LinearSolver, IterativeSolversGoAsFarAsTheForcingTermButNotBelowTheirTolerance) {
  System system;
  system.fill(1.0, 0.0);
  LinearSolver solver(system.grid.mesh,
                      {.prefix = "test_", .kind = SolverKind::jacobi, .relative_tolerance = 1e-6});
  const auto residual_after = [&](double forcing) {
    EXPECT_TRUE(solver.solve(system.matrix, system.b, system.x, forcing).converged);
    std::vector<double> local(static_cast<std::size_t>(system.grid.mesh.n_nodes())), product(system.owned());
    std::copy(system.x.begin(), system.x.end(), local.begin());
    parallel::GhostExchange(system.grid.mesh).update(local, 1);
    system.matrix.multiply(local, product);
    double squares[2] = {0, 0};
    for (std::size_t i = 0; i < product.size(); ++i) {
      squares[0] += (system.b[i] - product[i]) * (system.b[i] - product[i]);
      squares[1] += system.b[i] * system.b[i];
    }
    return std::sqrt(parallel::global_sum(squares[0]) / parallel::global_sum(squares[1]));
  };
  const double loose = residual_after(1e-2), tightest = residual_after(1e-12), own = residual_after(0);
  EXPECT_LE(loose, 1e-2);
  EXPECT_GT(loose, 1e-5);
  EXPECT_LE(tightest, 1e-6);
  EXPECT_GT(tightest, 1e-9);
  EXPECT_EQ(own, tightest);
}

TEST(LinearSolver, TooFewIterationsAreReportedWithPetscsReason) {
  System system;
  system.fill(1.0, 0.0);
  LinearSolver solver(
      system.grid.mesh,
      {.prefix = "test_", .kind = SolverKind::jacobi, .relative_tolerance = 1e-14, .max_iterations = 2});
  const LinearReport report = solver.solve(system.matrix, system.b, system.x);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.reason, "DIVERGED_ITS");
}

TEST(LinearSolver, OptionsWithItsPrefixChangeTheSolver) {
  System system;
  system.fill(1.0, 0.0);
  PetscOptionsSetValue(nullptr, "-special_ksp_max_it", "1");
  LinearSolver solver(system.grid.mesh,
                      {.prefix = "special_", .kind = SolverKind::jacobi, .relative_tolerance = 1e-14});
  EXPECT_FALSE(solver.solve(system.matrix, system.b, system.x).converged);
  PetscOptionsClearValue(nullptr, "-special_ksp_max_it");
}

}  // namespace
}  // namespace solidus::linear
