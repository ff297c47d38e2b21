#include "linear/incomplete_cholesky.hpp"

#include <gtest/gtest.h>

#include <petscsys.h>

#include <array>
#include <cmath>
#include <string>

#include "grid.hpp"
#include "linear/linear_solver.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {
namespace {

using test::Grid;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Heat content and conduction between the nodes of each quad; the first column of nodes is prescribed.
struct Heat {
  Grid grid;
  BlockMatrix matrix;

  Heat(int n, double content, BlockMatrix::Storage storage = BlockMatrix::Storage::upper)
      : grid(n, n), matrix(grid.mesh, 1, graph(grid), storage) {
    std::vector<char> fixed(grid.mesh.x.size(), 0);
    for (Index node = 0; node < grid.mesh.n_nodes(); ++node) fixed[at(node)] = grid.global(node) % n == 0;
    matrix.set_fixed(fixed);
    const auto slots = matrix.clique_slots(grid.quads, 4);
    for (std::size_t q = 0; q < slots.size(); q += 16)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          *matrix.block(slots[q + 4 * a + b]) += a == b ? 3 + content : -1.0;
  }
  static NodeGraph graph(const Grid& grid) {
    NodeGraph g(grid.mesh);
    g.add_cliques(grid.quads, 4);
    return g;
  }
  std::vector<double> right() const {
    std::vector<double> b(at(grid.mesh.n_owned_nodes));
    for (std::size_t i = 0; i < b.size(); ++i)
      b[i] =
          matrix.fixed()[i] ? 0.0 : std::sin(0.7 * static_cast<double>(grid.global(static_cast<Index>(i))));
    return b;
  }
};

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

LinearReport solved(Heat& heat, std::vector<double>& x, const std::string& prefix = "test_") {
  LinearSolver solver(heat.grid.mesh,
                      {.prefix = prefix, .kind = SolverKind::incomplete, .relative_tolerance = 1e-10});
  return solver.solve(heat.matrix, heat.right(), x);
}

// A row of nodes has a tridiagonal matrix, whose factors have no fill: nothing is left out on one process.
TEST(IncompleteCholesky, WithoutFillTheFactorsAreExact) {
  Grid grid(40, 1);
  if (parallel::any_process(grid.mesh.n_owned_nodes != 40))
    GTEST_SKIP() << "each process has factors of its own rows";
  std::vector<Index> pairs;
  for (Index i = 0; i + 1 < 40; ++i) pairs.insert(pairs.end(), {i, i + 1});
  NodeGraph graph(grid.mesh);
  graph.add_cliques(pairs, 2);
  BlockMatrix matrix(grid.mesh, 1, std::move(graph), BlockMatrix::Storage::upper);
  const auto slots = matrix.clique_slots(pairs, 2);
  for (std::size_t p = 0; p < slots.size(); ++p)
    *matrix.block(slots[p]) += p % 4 == 0 || p % 4 == 3 ? 1.5 : -1.0;
  std::vector<double> x(40), b(40), z(40);
  for (std::size_t i = 0; i < 40; ++i) x[i] = std::cos(static_cast<double>(i));
  matrix.multiply(x, b);
  IncompleteCholesky factors;
  factors.set_up(matrix);
  factors.apply(b, z);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_NEAR(z[i], x[i], 1e-5);
}

TEST(IncompleteCholesky, IsSymmetricAndPositive) {
  Heat heat(20, 0.1);
  for (const auto fill : {IncompleteCholesky::Fill::pattern, IncompleteCholesky::Fill::diagonal}) {
    IncompleteCholesky factors;
    factors.set_up(heat.matrix, fill);
    const std::vector<double> r = heat.right();
    std::vector<double> s(r), to_r(r.size()), to_s(r.size());
    for (std::size_t i = 0; i < s.size(); ++i) s[i] *= std::cos(static_cast<double>(i));
    factors.apply(r, to_r);
    factors.apply(s, to_s);
    EXPECT_GT(product(r, to_r), 0);
    EXPECT_NEAR(product(s, to_r), product(r, to_s), 1e-5 * std::sqrt(product(r, to_r) * product(s, to_s)));
  }
}

// (D + L) D⁻¹ (D + Lᵀ) has the diagonal of the matrix where rows bear their fill, d_i = a_ii − Σ a_ki²/d_k:
// here by its definition, on a matrix so dominant that nothing goes to the diagonal besides.
TEST(IncompleteCholesky, OnTheDiagonalAloneHasTheEntriesOfTheMatrix) {
  Heat heat(8, 20.0);
  if (parallel::any_process(heat.grid.mesh.n_owned_nodes != 64))
    GTEST_SKIP() << "each process has factors of its own rows";
  IncompleteCholesky factors;
  factors.set_up(heat.matrix, IncompleteCholesky::Fill::diagonal);
  std::vector<double> r = heat.right(), z(64);
  factors.apply(r, z);
  // The same by whole rows of the matrix with its fixed rows and columns.
  std::vector<std::vector<double>> a(64, std::vector<double>(64, 0.0));
  for (std::size_t column = 0; column < 64; ++column) {
    std::vector<double> unit(64, 0.0), product(64);
    unit[column] = 1;
    heat.matrix.multiply(unit, product);
    for (std::size_t row = 0; row < 64; ++row)
      if (!heat.matrix.fixed()[row] && !heat.matrix.fixed()[column]) a[row][column] = product[row];
  }
  std::vector<double> d(64, 1.0), y(r);
  for (std::size_t i = 0; i < 64; ++i) {
    if (heat.matrix.fixed()[i]) continue;
    d[i] = a[i][i];
    for (std::size_t k = 0; k < i; ++k) d[i] -= a[k][i] * a[k][i] / d[k];
  }
  for (std::size_t i = 0; i < 64; ++i) {
    for (std::size_t k = 0; k < i; ++k) y[i] -= a[i][k] * y[k];
    y[i] /= d[i];
  }
  for (std::size_t i = 64; i-- > 0;)
    for (std::size_t k = i + 1; k < 64; ++k) y[i] -= a[i][k] * y[k] / d[i];
  for (std::size_t i = 0; i < 64; ++i) {
    if (!heat.matrix.fixed()[i]) EXPECT_NEAR(z[i], y[i], 1e-6 * std::abs(y[i]) + 1e-9);
  }
}

// 9 and 13 iterations on one process where a step is short against the time in which heat crosses an element.
TEST(IncompleteCholesky, OnTheDiagonalAloneTakesHalfAsManyIterationsAgainAtMost) {
  Heat heat(60, 1.0);
  std::array<int, 2> iterations{};
  std::array<std::vector<double>, 2> x;
  for (const bool keep : {true, false}) {
    LinearSolver solver(heat.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::incomplete, .relative_tolerance = 1e-10});
    solver.keep_fill(keep);
    x[keep].resize(heat.right().size());
    const LinearReport report = solver.solve(heat.matrix, heat.right(), x[keep]);
    ASSERT_TRUE(report.converged) << report.reason;
    iterations[keep] = report.iterations;
    RecordProperty(keep ? "pattern" : "diagonal", report.iterations);
  }
  EXPECT_LE(iterations[false], 1.5 * iterations[true] + 1);
  const double scale = std::sqrt(product(x[1], x[1]) / 3600);
  for (std::size_t i = 0; i < x[0].size(); ++i) EXPECT_NEAR(x[0][i], x[1][i], 1e-8 * scale);
}

/// A matrix with positive entries off its diagonal that is positive definite by little, as capacities of
/// quadratic elements at their integration points are: the sum of squares of differences of neighbours'
/// means. Pivots of its factors without fill are negative without a shift of the diagonal.
TEST(IncompleteCholesky, OfAMatrixWithPositiveEntriesBesideTheDiagonalStaysPositive) {
  constexpr int n = 30;
  Grid grid(n, n);
  BlockMatrix matrix(grid.mesh, 1, Heat::graph(grid), BlockMatrix::Storage::upper);
  const auto slots = matrix.clique_slots(grid.quads, 4);
  constexpr std::array<std::array<double, 4>, 2> forms = {{{1, 1, 1, 1}, {1, 1, -1, 1}}};
  for (std::size_t q = 0; q < slots.size(); q += 16)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) {
        double entry = a == b ? 1e-3 : 0.0;
        for (const auto& form : forms) entry += form[a] * form[b];
        *matrix.block(slots[q + 4 * a + b]) += entry;
      }
  IncompleteCholesky factors;
  factors.set_up(matrix);
  std::vector<double> r(at(grid.mesh.n_owned_nodes)), z(r.size());
  for (int k = 0; k < 20; ++k) {
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] = std::sin((0.3 + k) * static_cast<double>(grid.global(static_cast<Index>(i))));
    factors.apply(r, z);
    EXPECT_GT(product(r, z), 0);
    EXPECT_LT(product(z, z), 1e6 * product(r, r));
  }
}

// A whole matrix is PETSc's.
TEST(IncompleteCholesky, SolvesAsPetscsFactorsDoInAsManyIterations) {
  for (const double content : {10.0, 0.1}) {
    Heat half(50, content), whole(50, content, BlockMatrix::Storage::whole);
    std::vector<double> x(half.right().size()), reference(x.size());
    const std::size_t bytes = half.matrix.bytes();
    const LinearReport ours = solved(half, x), petscs = solved(whole, reference);
    EXPECT_LT(half.matrix.bytes() - bytes, bytes / 4);  // no copy for PETSc, which needs more than half of it
    ASSERT_TRUE(ours.converged) << ours.reason;
    EXPECT_LE(ours.iterations, petscs.iterations + 2);
    const double scale = std::sqrt(product(reference, reference) / 2500);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], reference[i], 1e-8 * scale);
  }
}

// An option of PETSc's Krylov solvers makes PETSc solve, with the same factors.
TEST(ConjugateGradients, GoTheWayOfPetscs) {
  PetscOptionsSetValue(nullptr, "-asked_ksp_type", "cg");
  for (const double content : {10.0, 0.1, 1e-3}) {
    Heat heat(50, content);
    std::vector<double> x(heat.right().size()), reference(x.size());
    const LinearReport ours = solved(heat, x), petscs = solved(heat, reference, "asked_");
    ASSERT_TRUE(ours.converged && petscs.converged) << ours.reason << petscs.reason;
    EXPECT_EQ(ours.iterations, petscs.iterations);
    const double scale = std::sqrt(product(reference, reference) / 2500);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], reference[i], 1e-9 * scale);
  }
  PetscOptionsClearValue(nullptr, "-asked_ksp_type");
}

TEST(ConjugateGradients, SayWhyTheyFail) {
  Heat heat(20, 0.1);
  std::vector<double> x(heat.right().size());
  LinearSolver hasty(
      heat.grid.mesh,
      {.prefix = "test_", .kind = SolverKind::incomplete, .relative_tolerance = 1e-10, .max_iterations = 2});
  const LinearReport early = hasty.solve(heat.matrix, heat.right(), x);
  EXPECT_FALSE(early.converged);
  EXPECT_EQ(early.reason, "too many iterations");
  EXPECT_EQ(early.iterations, 2);
  for (Index node = 0; node < heat.grid.mesh.n_owned_nodes; ++node) *heat.matrix.diagonal_block(node) *= -1;
  EXPECT_FALSE(solved(heat, x).converged);
  const std::vector<double> nothing(x.size(), 0.0);
  EXPECT_TRUE(LinearSolver(heat.grid.mesh, {.prefix = "test_", .kind = SolverKind::incomplete})
                  .solve(heat.matrix, nothing, x)
                  .converged);
  EXPECT_EQ(x, nothing);
}

TEST(IncompleteCholesky, TheNextMatrixGetsNewFactorsAndTheSameOneKeepsThem) {
  Heat heat(30, 1.0);
  LinearSolver solver(heat.grid.mesh,
                      {.prefix = "test_", .kind = SolverKind::incomplete, .relative_tolerance = 1e-10});
  std::vector<double> x(heat.right().size()), again(x.size());
  const LinearReport first = solver.solve(heat.matrix, heat.right(), x);
  const LinearReport same = solver.solve_again(heat.right(), again, 0);
  EXPECT_EQ(x, again);
  EXPECT_EQ(first.iterations, same.iterations);
  for (Index node = 0; node < heat.grid.mesh.n_owned_nodes; ++node) *heat.matrix.diagonal_block(node) *= 50;
  const LinearReport strong = solver.solve(heat.matrix, heat.right(), x);
  ASSERT_TRUE(strong.converged) << strong.reason;
  EXPECT_LT(strong.iterations, first.iterations);
}

// 38 and 39; without fill on the diagonals 60 and 100.
TEST(IncompleteCholesky, IterationsGrowWithTheRootOfTheSideOfTheMesh) {
  if (parallel::any_process(Grid(4, 4).mesh.n_owned_nodes != 16)) return;  // factors of a process's own rows
  const auto iterations = [](int n) {
    Heat heat(n, 1e-3);
    std::vector<double> x(heat.right().size());
    return solved(heat, x).iterations;
  };
  const int coarse = iterations(60), fine = iterations(120);
  RecordProperty("coarse", coarse);
  RecordProperty("fine", fine);
  EXPECT_LE(fine, std::sqrt(2.0) * coarse);
}

// Each process has factors of its own rows, which know of the others by a share of the entries across the
// border on their diagonals: 37 and 39 iterations on two and three processes, 23 on one; without that share
// 55 and 58.
TEST(IncompleteCholesky, PartsOfTheProcessesKnowOfEachOther) {
  Heat heat(120, 1e-2);
  std::vector<double> x(heat.right().size());
  const LinearReport report = solved(heat, x);
  RecordProperty("iterations", report.iterations);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_LE(report.iterations, 44);
}

}  // namespace
}  // namespace solidus::linear
