#include "linear/block_multigrid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/linear_solver.hpp"
#include "multigrid/aggregation.hpp"
#include "multigrid/compact_rows.hpp"
#include "parallel/parallel.hpp"
#include "springs.hpp"
#include "system/log.hpp"

namespace solidus::linear {
namespace {

using test::Grid;
using test::Springs;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

TEST(BlockMultigrid, TheNumberOfIterationsHardlyGrowsWithTheMesh) {
  std::vector<int> iterations;
  for (const int n : {20, 40, 80}) {
    Springs springs(n);
    LinearSolver solver(springs.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-8});
    solver.use_rigid_body_modes(2);
    std::vector<double> x(springs.n_owned());
    const LinearReport report = solver.solve(springs.matrix, springs.pattern(0.7), x);
    ASSERT_TRUE(report.converged) << report.reason;
    iterations.push_back(report.iterations);
  }
  EXPECT_LE(iterations.back(), 25);
  EXPECT_LE(iterations.back(), 2 * iterations.front());
}

// Functions of aggregates reach over the seams: rough ones there cost half as many iterations again.
TEST(BlockMultigrid, TheNumberOfIterationsHardlyGrowsWithTheProcesses) {
  Springs springs(60);
  LinearSolver solver(springs.grid.mesh,
                      {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-8});
  solver.use_rigid_body_modes(2);
  std::vector<double> x(springs.n_owned());
  const LinearReport report = solver.solve(springs.matrix, springs.pattern(0.7), x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_LE(report.iterations, 12);  // measured: 10 on one, two, three and four
}

// Bodies that only conduct: each of their nodes was an aggregate of its own on every level, so that nearly
// all of them came to the coarsest one, which every process factorises.
TEST(BlockMultigrid, NodesWithoutUnknownsHaveNoPlaceOnCoarseLevels) {
  for (const int n_columns : {0, 1, 12}) {
    Springs springs(60, [=](int i, int) { return i < n_columns; });
    BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
    multigrid.set_up(springs.matrix);
    EXPECT_LE(multigrid.coarsest_rows(), n_columns == 0 ? 0 : 60);
    LinearSolver solver(springs.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-8});
    solver.use_rigid_body_modes(2);
    std::vector<double> x(springs.n_owned());
    const std::vector<double> b = springs.pattern(0.7);
    const LinearReport report = solver.solve(springs.matrix, b, x);
    ASSERT_TRUE(report.converged) << n_columns << ": " << report.reason;
    EXPECT_LE(report.iterations, 15);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_TRUE(!springs.matrix.fixed()[i] || x[i] == 0) << i;
  }
}

// In a casting in its mould most nodes have no unknown of mechanics: cycles passed over them all the same.
TEST(BlockMultigrid, RowsWithoutUnknownsAreLeftOut) {
  Springs springs(30, [](int i, int) { return i < 12; });
  const parallel::GhostExchange ghosts(springs.grid.mesh);
  const auto n_owned = static_cast<std::size_t>(springs.grid.mesh.n_owned_nodes);
  springs.matrix.constrained([&] {
    const multigrid::MatrixView whole{2, springs.matrix.row_start(), springs.matrix.columns(),
                                      springs.matrix.block(0), nullptr};
    multigrid::Numbering numbering{springs.grid.mesh.n_owned_nodes, springs.grid.mesh.first_owned, {}};
    numbering.ghosts.assign(springs.grid.mesh.global_node.begin() + numbering.n_owned,
                            springs.grid.mesh.global_node.end());
    const auto fixed = std::span(springs.matrix.fixed()).first(2 * n_owned);
    ASSERT_TRUE(multigrid::worth_compacting(2, fixed));
    const multigrid::CompactRows left = multigrid::compact(whole, numbering, fixed);
    EXPECT_EQ(parallel::global_sum(static_cast<double>(left.rows.size())),
              11 * 30);  // the first column is held

    // The same product with a vector that both number in their own way.
    const auto value = [](GlobalIndex row, int c) {
      return std::sin(0.3 * static_cast<double>(2 * row + c));
    };
    std::vector<double> x(2 * springs.grid.mesh.x.size(), 0.0);
    for (std::size_t i = 0; i < left.rows.size(); ++i)
      for (int c = 0; c < 2; ++c)
        x[static_cast<std::size_t>(2 * left.rows[i] + c)] =
            value(left.numbering.first + static_cast<GlobalIndex>(i), c);
    ghosts.update(x, 2);
    std::vector<double> y(2 * n_owned);
    springs.matrix.multiply(x, y);
    const multigrid::MatrixView view{2, left.start, left.column, left.value.data(), nullptr};
    for (std::size_t i = 0; i < left.rows.size(); ++i) {
      double sum[2] = {0, 0};
      view.each(static_cast<Index>(i), [&](Index column, std::int64_t slot, bool) {
        const GlobalIndex row =
            column < left.numbering.n_owned
                ? left.numbering.first + column
                : left.numbering.ghosts[static_cast<std::size_t>(column - left.numbering.n_owned)];
        for (int r = 0; r < 2; ++r)
          for (int c = 0; c < 2; ++c) sum[r] += view.block(slot)[2 * r + c] * value(row, c);
      });
      for (int r = 0; r < 2; ++r)
        EXPECT_NEAR(sum[r], y[static_cast<std::size_t>(2 * left.rows[i] + r)], 1e-12);
    }
  });

  // Rows that were left out are those of a diagonal matrix: nothing of them reaches the others.
  BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
  multigrid.set_up(springs.matrix);
  std::vector<double> b = springs.pattern(0.7), z(b.size()), other(b.size());
  multigrid.apply(b, z);
  double diagonal = 1;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (springs.matrix.fixed()[i]) {
      EXPECT_EQ(z[i], 0);
      b[i] = 2;
    }
  multigrid.apply(b, other);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (springs.matrix.fixed()[i]) {
      diagonal = 2 / other[i];
    } else {
      EXPECT_EQ(z[i], other[i]);
    }
  }
  EXPECT_TRUE(std::isfinite(diagonal) && diagonal > 0) << diagonal;
}

// Small bodies of their own, held at one end, which have become one aggregate each where the large one still
// has hundreds: they are solved on the coarsest level, as their rigid motions have stiffness among
// themselves.
TEST(BlockMultigrid, SmallBodiesBesideALargeOneCostNothing) {
  const auto of_bar = [](int i) { return i >= 84; };
  Springs springs(
      90, [&](int i, int j) { return i < 80 || (of_bar(i) && j % 5 < 2); }, BlockMatrix::Storage::whole,
      [](int i, int) { return i == 89; });
  BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
  multigrid.set_up(springs.matrix);
  EXPECT_GE(multigrid.coarsest_rows(), 18);
  LinearSolver solver(springs.grid.mesh,
                      {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-8});
  solver.use_rigid_body_modes(2);
  std::vector<double> x(springs.n_owned());
  const LinearReport report = solver.solve(springs.matrix, springs.pattern(0.7), x);
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_LE(report.iterations, 25);
}

// More than a thousand little bodies, each on a soft spring and an aggregate of its own: no process shall
// factorise them all. That is reported, and conjugate gradients still converge.
TEST(BlockMultigrid, ACoarsestLevelThatIsTooLargeToBeFactorisedIsSmoothed) {
  constexpr int k_columns = 120;
  for (const int width : {3, 12}) {  // 1 600 bodies of 2 × 2 nodes, 100 of 11 × 11
    Springs springs(k_columns, [&](int i, int j) { return i % width < width - 1 && j % width < width - 1; });
    for (Index node = 0; node < springs.grid.mesh.n_owned_nodes; ++node)
      for (const std::size_t entry : {0U, 3U})
        springs.matrix.block(springs.matrix.slot(node, node))[entry] += 0.01;
    logging::clear_warnings();
    BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
    multigrid.set_up(springs.matrix);
    const bool large = width == 3;
    EXPECT_EQ(multigrid.factorises(), !large);
    EXPECT_EQ(multigrid.coarsest_rows() > BlockMultigrid::k_most_factorised, large);
    EXPECT_EQ(logging::warnings().size(), large ? 1U : 0U);
    LinearSolver solver(springs.grid.mesh,
                        {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-8});
    solver.use_rigid_body_modes(2);
    std::vector<double> x(springs.n_owned());
    const LinearReport report = solver.solve(springs.matrix, springs.pattern(0.7), x);
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.iterations, 25);
  }
}

TEST(BlockMultigrid, TheCycleIsSymmetricAndPositive) {
  Springs springs(30);
  BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
  multigrid.set_up(springs.matrix);
  EXPECT_GE(multigrid.levels(), 2);
  const std::vector<double> r = springs.pattern(0.7), s = springs.pattern(1.9);
  std::vector<double> to_r(r.size()), to_s(s.size());
  multigrid.apply(r, to_r);
  multigrid.apply(s, to_s);
  const double scale = std::sqrt(product(r, to_r) * product(s, to_s));
  EXPECT_GT(product(r, to_r), 0);
  EXPECT_NEAR(product(s, to_r), product(r, to_s), 1e-5 * scale);  // single precision
  EXPECT_GT(multigrid.bytes(), 0U);
}

// Half of the blocks says as much as all of them: the same hierarchy, whose products round otherwise.
TEST(BlockMultigrid, HalfOfASymmetricMatrixMakesTheSameCycle) {
  Springs whole(30), half(
                         30, [](int, int) { return true; }, BlockMatrix::Storage::upper);
  const std::vector<double> r = whole.pattern(0.7);
  std::vector<double> unsymmetric(r.size()), symmetric(r.size()), of_half(r.size());
  const auto cycle = [&](Springs& springs, bool is_symmetric, std::vector<double>& z) {
    BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, is_symmetric);
    multigrid.set_up(springs.matrix);
    multigrid.apply(r, z);
    return multigrid.bytes();
  };
  const std::size_t bytes = cycle(whole, false, unsymmetric);
  EXPECT_LT(cycle(whole, true, symmetric), bytes);
  EXPECT_LT(cycle(half, true, of_half), bytes);
  const double scale = std::sqrt(product(symmetric, symmetric) / static_cast<double>(r.size()));
  for (std::size_t i = 0; i < r.size(); ++i) {
    EXPECT_NEAR(symmetric[i], unsymmetric[i], 1e-4 * scale);
    EXPECT_NEAR(of_half[i], symmetric[i], 1e-4 * scale);
  }
}

TEST(BlockMultigrid, TheSameMatrixMakesTheSameBits) {
  Springs springs(30);
  const std::vector<double> r = springs.pattern(0.7);
  std::vector<double> first(r.size()), second(r.size());
  for (auto* z : {&first, &second}) {
    BlockMultigrid multigrid(springs.grid.mesh, 2, rigid_body_modes, true);
    multigrid.set_up(springs.matrix);
    multigrid.apply(r, *z);
  }
  EXPECT_EQ(first, second);
}

TEST(BlockMultigrid, RigidMotionsOfTheCoarseLevelsAreThoseOfTheFineOne) {
  const Grid grid(12, 12);
  Springs springs(12);
  springs.matrix.set_fixed(std::vector<char>(springs.grid.mesh.x.size() * 2, 0));
  const mesh::Mesh& mesh = springs.grid.mesh;
  const multigrid::NearNullSpace modes = rigid_body_modes(mesh, 2);
  const multigrid::Numbering numbering{
      mesh.n_owned_nodes,
      mesh.first_owned,
      {mesh.global_node.begin() + mesh.n_owned_nodes, mesh.global_node.end()}};
  const multigrid::MatrixView a{2, springs.matrix.row_start(), springs.matrix.columns(),
                                springs.matrix.block(0)};
  const multigrid::Coarsening next = multigrid::coarsen(
      a, numbering, parallel::RowExchange(numbering.n_owned, numbering.first, numbering.ghosts), modes.values,
      3, {}, multigrid::inverse_diagonal(a), 2.0);
  std::vector<double> coarse(next.near_null);
  coarse.resize(static_cast<std::size_t>(next.numbering.n_local()) * 9);
  parallel::GhostExchange(next.numbering.n_owned, next.numbering.first, next.numbering.ghosts)
      .update(coarse, 9);

  // P times the coarse modes is what the smoothing leaves of rigid motions: all of them, as they cost
  // nothing.
  const multigrid::BlockRows<float>& p = next.interpolation;
  for (Index row = 0; row < mesh.n_owned_nodes; ++row)
    for (int i = 0; i < 2; ++i)
      for (int mode = 0; mode < 3; ++mode) {
        double sum = 0;
        for (std::int64_t s = p.start[Springs::at(row)]; s < p.start[Springs::at(row) + 1]; ++s) {
          const Index column = p.column[static_cast<std::size_t>(s)];
          for (int k = 0; k < 3; ++k)
            sum += static_cast<double>(p.block(s)[i * 3 + k]) *
                   coarse[static_cast<std::size_t>((column * 3 + k) * 3 + mode)];
        }
        EXPECT_NEAR(sum, modes.values[static_cast<std::size_t>((row * 2 + i) * 3 + mode)], 1e-5);
      }
  // And so they cost nothing there: the rows of Pᵀ A P take coarse rigid motions to zero, ghosts included.
  const multigrid::BlockRows<double>& m = next.matrix;
  double largest = 0;
  for (const double value : m.value) largest = std::max(largest, std::abs(value));
  for (Index row = 0; row < m.n_rows(); ++row)
    for (int i = 0; i < 3; ++i)
      for (int mode = 0; mode < 3; ++mode) {
        double sum = 0;
        for (std::int64_t s = m.start[Springs::at(row)]; s < m.start[Springs::at(row) + 1]; ++s)
          for (int k = 0; k < 3; ++k)
            sum +=
                m.block(s)[i * 3 + k] *
                coarse[static_cast<std::size_t>((m.column[static_cast<std::size_t>(s)] * 3 + k) * 3 + mode)];
        EXPECT_NEAR(sum, 0, 1e-5 * largest * 3);  // single precision, some three nodes to a side
      }
}

}  // namespace
}  // namespace solidus::linear
