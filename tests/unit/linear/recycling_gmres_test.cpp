/// GMRES that keeps its slow directions (recycling_gmres.hpp).
#include "linear/recycling_gmres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::linear {
namespace {

constexpr int k_unknowns = 400;  ///< over all processes

/// D + a cyclic shift, unsymmetric: `slow` of the unknowns have a diagonal of 1e-4 and less, the others lie
/// between 1 and 2. Each process has every size-th unknown.
struct Problem {
  std::vector<double> diagonal, right;
  int rank = 0, size = 1;

  explicit Problem(int slow, double change = 0) {
    rank = processes::rank();
    size = processes::count();
    for (int i = rank; i < k_unknowns; i += size) {
      diagonal.push_back(i < slow ? 1e-4 / (1 + i) : 1 + 0.5 * (1 + std::sin(0.7 * i + change)));
      right.push_back(std::cos(0.3 * i + change));
    }
  }
  /// Neighbours within the process are coupled, slow unknowns with others too.
  void multiply(std::span<const double> x, std::span<double> y) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = diagonal[i] * x[i] + (i > 0 && diagonal[i] > 0.5 ? 0.2 * x[i - 1] : 0.0);
  }
  double relative_residual(const std::vector<double>& x) const {
    std::vector<double> y(x.size());
    multiply(x, y);
    double residual = 0, whole = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      residual += std::pow(right[i] - y[i], 2);
      whole += right[i] * right[i];
    }
    return std::sqrt(parallel::global_sum(residual) / parallel::global_sum(whole));
  }
};

void use(RecyclingGmres& solver, const Problem& problem) {
  solver.set(
      [&problem](std::span<const double> x, std::span<double> y) { problem.multiply(x, y); },
      [](std::span<const double> r, std::span<double> z) { std::copy(r.begin(), r.end(), z.begin()); });
}

LinearReport solve(RecyclingGmres& solver, const Problem& problem, double relative = 1e-8) {
  std::vector<double> x(problem.right.size(), 1.0);
  const LinearReport report = solver.solve(problem.right, x, relative);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_LE(problem.relative_residual(x), 1.02 * relative);
  return report;
}

TEST(RecyclingGmres, SlowDirectionsOfOneSystemCostTheNextOneLittle) {
  const Problem first(8), second(8, 0.01), none(0, 0.01);
  RecyclingGmres solver, plain;
  use(solver, first);
  const int before = solve(solver, first).iterations;
  use(solver, second);
  const int after = solve(solver, second).iterations;
  use(plain, none);
  const int without = solve(plain, none).iterations;
  EXPECT_LE(after, without + 20);
  EXPECT_GT(before, 2 * after);
}

TEST(RecyclingGmres, ShortCyclesConvergeBecauseSlowDirectionsStayFromCycleToCycle) {
  const Problem problem(12);
  RecyclingGmres recycling({.directions = 30, .kept = 16, .worthwhile = 10}),
      restarted({.directions = 30, .kept = 0, .worthwhile = 10});
  use(recycling, problem);
  use(restarted, problem);
  EXPECT_LT(2 * solve(recycling, problem).iterations, solve(restarted, problem).iterations);
}

TEST(RecyclingGmres, WhatIsForgottenGivesTheSameBitsAsANewSolver) {
  const Problem problem(8);
  RecyclingGmres old, young;
  use(old, problem);
  use(young, problem);
  std::vector<double> x(problem.right.size()), y(x.size());
  old.solve(problem.right, x, 1e-6);
  old.forget();
  old.solve(problem.right, x, 1e-6);
  young.solve(problem.right, y, 1e-6);
  EXPECT_EQ(x, y);
}

TEST(RecyclingGmres, ARightHandSideOfZeroTakesNoIteration) {
  Problem problem(3);
  problem.right.assign(problem.right.size(), 0.0);
  RecyclingGmres solver;
  use(solver, problem);
  std::vector<double> x(problem.right.size(), 1.0);
  const LinearReport report = solver.solve(problem.right, x, 1e-8);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(x, std::vector<double>(x.size(), 0.0));
}

TEST(RecyclingGmres, ANumberThatIsNoneEndsTheSolveAndSaysSo) {
  const Problem problem(3);
  RecyclingGmres solver;
  solver.set(
      [](std::span<const double>, std::span<double> y) { std::fill(y.begin(), y.end(), std::nan("")); },
      [](std::span<const double> r, std::span<double> z) { std::copy(r.begin(), r.end(), z.begin()); });
  std::vector<double> x(problem.right.size());
  const LinearReport report = solver.solve(problem.right, x, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.reason, "DIVERGED_NANORINF");
}

}  // namespace
}  // namespace solidus::linear
