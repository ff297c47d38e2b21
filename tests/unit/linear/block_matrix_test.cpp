#include "linear/block_matrix.hpp"

#include <gtest/gtest.h>
#include <petscmat.h>

#include <algorithm>
#include <cmath>

#include "grid.hpp"
#include "linear/dense.hpp"
#include "linear/lane_slots.hpp"
#include "numbers/simd.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::linear {
namespace {

using test::Grid;

/// An entry of an element matrix that depends on global numbers only: symmetric, and the same on every
/// process.
double entry(GlobalIndex row, int a, GlobalIndex column, int b) {
  const double i = static_cast<double>(2 * row + a), j = static_cast<double>(2 * column + b);
  return std::cos(i + j) + (i == j ? 5.0 : 0.0);
}

/// A full matrix of 2 × 2 blocks, nx · ny in a row.
struct Reference : dense::Matrix {
  explicit Reference(int n) : Matrix(static_cast<std::size_t>(n), static_cast<std::size_t>(n)), size(n) {}
  double& operator()(int i, int j) {
    return Matrix::operator()(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  double operator()(int i, int j) const {
    return Matrix::operator()(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  int size;
};

Reference sum_of_elements(int nx, int ny) {
  Reference m(2 * nx * ny);
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const int n[4] = {j * nx + i, j * nx + i + 1, (j + 1) * nx + i + 1, (j + 1) * nx + i};
      for (int p : n)
        for (int q : n)
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) m(2 * p + a, 2 * q + b) += entry(p, a, q, b);
    }
  return m;
}

using Storage = BlockMatrix::Storage;

BlockMatrix assembled(const Grid& grid, Storage storage = Storage::whole) {
  NodeGraph graph(grid.mesh);
  graph.add_cliques(grid.quads, 4);
  return BlockMatrix(grid.mesh, 2, std::move(graph), storage);
}

/// Whether all of a matrix is kept or the half of it.
class BlockMatrices : public testing::TestWithParam<Storage> {
 protected:
  BlockMatrix assembled(const Grid& grid) const { return linear::assembled(grid, GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Storage, BlockMatrices, testing::Values(Storage::whole, Storage::upper),
                         [](const auto& of) { return of.param == Storage::whole ? "whole" : "upper"; });

void fill(const Grid& grid, BlockMatrix& matrix) {
  matrix.set_zero();
  const auto slots = matrix.clique_slots(grid.quads, 4);
  for (std::size_t e = 0; e < grid.quads.size() / 4; ++e)
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < 4; ++q) {
        double* block = matrix.block(slots[(e * 4 + p) * 4 + q]);
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            block[2 * a + b] +=
                entry(grid.global(grid.quads[4 * e + p]), a, grid.global(grid.quads[4 * e + q]), b);
      }
}

/// Compares the rows that this process has in PETSc's matrix.
void expect_equal(Mat matrix, const Reference& reference) {
  PetscInt first = 0, last = 0;
  MatGetOwnershipRange(matrix, &first, &last);
  for (PetscInt i = first; i < last; ++i) {
    std::vector<double> row(static_cast<std::size_t>(reference.size));
    PetscInt n = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    MatGetRow(matrix, i, &n, &columns, &values);
    for (PetscInt k = 0; k < n; ++k) row[static_cast<std::size_t>(columns[k])] = values[k];
    MatRestoreRow(matrix, i, &n, &columns, &values);
    for (int j = 0; j < reference.size; ++j)
      EXPECT_NEAR(row[static_cast<std::size_t>(j)], reference(i, j), 1e-14) << "row " << i;
  }
}

TEST(NodeGraph, RowsHoldEachNeighbourOnceAndTheDiagonal) {
  const Grid grid(3, 3);
  NodeGraph graph(grid.mesh);
  graph.add_cliques(grid.quads, 4);
  graph.add_cliques(grid.quads, 4);
  std::vector<std::int64_t> start;
  std::vector<Index> columns;
  graph.compress(start, columns);
  ASSERT_EQ(start.size(), static_cast<std::size_t>(grid.mesh.n_owned_nodes) + 1);
  for (Index row = 0; row < grid.mesh.n_owned_nodes; ++row) {
    const GlobalIndex g = grid.global(row);
    const auto span = [](GlobalIndex i) { return i == 1 ? 3 : 2; };
    EXPECT_EQ(start[static_cast<std::size_t>(row) + 1] - start[static_cast<std::size_t>(row)],
              span(g % 3) * span(g / 3));
  }
}

TEST(NodeGraph, LongRowsHoldEachNeighbourOnceHoweverOftenItComes) {
  const Grid grid(20, 10);
  NodeGraph graph(grid.mesh);
  std::vector<Index> all(grid.mesh.x.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>((7 * i) % all.size());
  for (int pass = 0; pass < 20; ++pass) {
    graph.add_cliques(all, static_cast<int>(all.size()));
    std::reverse(all.begin(), all.end());
  }
  std::vector<std::int64_t> start;
  std::vector<Index> columns;
  graph.compress(start, columns);
  std::sort(all.begin(), all.end());
  ASSERT_EQ(columns.size(), all.size() * static_cast<std::size_t>(grid.mesh.n_owned_nodes));
  for (std::size_t row = 0; row + 1 < start.size(); ++row)
    EXPECT_TRUE(std::equal(all.begin(), all.end(), columns.begin() + start[row])) << "row " << row;
}

TEST(NodeGraph, NodesWithoutElementsKeepTheirDiagonal) {
  const Grid grid(2, 2);
  std::vector<std::int64_t> start;
  std::vector<Index> columns;
  NodeGraph(grid.mesh).compress(start, columns);
  EXPECT_EQ(columns.size(), static_cast<std::size_t>(grid.mesh.n_owned_nodes));
}

TEST_P(BlockMatrices, EqualsTheDenseSumOfElementMatrices) {
  const Grid grid(4, 5);
  BlockMatrix matrix = assembled(grid);
  for (int pass = 0; pass < 2; ++pass) {  // the second pass reuses the pattern
    fill(grid, matrix);
    expect_equal(matrix.matrix(), sum_of_elements(4, 5));
  }
}

TEST_P(BlockMatrices, LaneSlotsScatterTheSameMatrix) {
  const Grid grid(4, 5);
  BlockMatrix matrix = assembled(grid);
  const auto n = static_cast<Index>(grid.quads.size() / 4);
  const std::size_t n_batches = (static_cast<std::size_t>(n) + k_lanes - 1) / k_lanes;
  std::vector<Index> nodes(n_batches * 4 * k_lanes);
  for (std::size_t e = 0; e < n_batches * k_lanes; ++e)  // padding repeats the last element
    for (std::size_t p = 0; p < 4; ++p)
      nodes[(e / k_lanes * 4 + p) * k_lanes + e % k_lanes] =
          grid.quads[std::min(e, static_cast<std::size_t>(n) - 1) * 4 + p];
  const LaneSlots slots(matrix, nodes, 4, n);
  matrix.set_zero();
  for (std::size_t batch = 0; batch < n_batches; ++batch)
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < 4; ++q)
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
          double* block = matrix.block(slots.of(static_cast<Index>(batch))[(p * 4 + q) * k_lanes + lane]);
          const GlobalIndex row = grid.global(nodes[(batch * 4 + p) * k_lanes + lane]);
          const GlobalIndex column = grid.global(nodes[(batch * 4 + q) * k_lanes + lane]);
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) block[2 * a + b] += entry(row, a, column, b);
        }
  expect_equal(matrix.matrix(), sum_of_elements(4, 5));
}

TEST_P(BlockMatrices, FixedRowsAndColumnsBecomeTheIdentityTimesTheMeanDiagonal) {
  const Grid grid(4, 5);
  BlockMatrix matrix = assembled(grid);
  fill(grid, matrix);
  std::vector<char> fixed(static_cast<std::size_t>(grid.mesh.n_nodes()) * 2, 0);
  const auto is_fixed = [](GlobalIndex node, int a) { return (node % 4 == 0 && a == 0) || node == 7; };
  for (Index node = 0; node < grid.mesh.n_nodes(); ++node)
    for (int a = 0; a < 2; ++a)
      fixed[static_cast<std::size_t>(2 * node + a)] = is_fixed(grid.global(node), a) ? 1 : 0;
  matrix.set_fixed(fixed);

  Reference reference = sum_of_elements(4, 5);
  double sum = 0;
  int n = 0;
  for (int i = 0; i < reference.size; ++i)
    if (!is_fixed(i / 2, i % 2)) sum += reference(i, i), ++n;
  for (int i = 0; i < reference.size; ++i) {
    if (!is_fixed(i / 2, i % 2)) continue;
    for (int j = 0; j < reference.size; ++j) reference(i, j) = reference(j, i) = 0;
    reference(i, i) = sum / n;
  }
  for (int pass = 0; pass < 2; ++pass)
    expect_equal(matrix.matrix(), reference);  // masking leaves our own values alone
  matrix.set_fixed(std::vector<char>(fixed.size(), 0));
  expect_equal(matrix.matrix(), sum_of_elements(4, 5));
}

TEST_P(BlockMatrices, MultiplyEqualsTheDenseProduct) {
  const Grid grid(4, 5);
  BlockMatrix matrix = assembled(grid);
  fill(grid, matrix);
  const Reference reference = sum_of_elements(4, 5);
  std::vector<double> x(40), y(40);
  for (std::size_t i = 0; i < 40; ++i) x[i] = std::sin(3.0 * static_cast<double>(i));
  dense::add_product(1, reference.all(), x, y);
  std::vector<double> local(static_cast<std::size_t>(grid.mesh.n_nodes()) * 2),
      product(static_cast<std::size_t>(grid.mesh.n_owned_nodes) * 2);
  for (Index node = 0; node < grid.mesh.n_nodes(); ++node)
    for (int a = 0; a < 2; ++a)
      local[static_cast<std::size_t>(2 * node + a)] = x[static_cast<std::size_t>(2 * grid.global(node) + a)];
  matrix.multiply(local, product);
  for (Index node = 0; node < grid.mesh.n_owned_nodes; ++node)
    for (int a = 0; a < 2; ++a)
      EXPECT_NEAR(product[static_cast<std::size_t>(2 * node + a)],
                  y[static_cast<std::size_t>(2 * grid.global(node) + a)], 1e-12);
}

TEST(BlockMatrix, HalfOfASymmetricMatrixTakesLittleMoreThanHalfTheBlocks) {
  const Grid grid(20, 20);
  const BlockMatrix whole = assembled(grid), upper = assembled(grid, Storage::upper);
  const auto n = static_cast<std::size_t>(grid.mesh.n_owned_nodes);
  std::size_t ghosts = 0;
  for (const Index column : whole.columns()) ghosts += column >= grid.mesh.n_owned_nodes;
  EXPECT_EQ(2 * (upper.columns().size() - ghosts), whole.columns().size() - ghosts + n);
  EXPECT_LT(upper.bytes(), whole.bytes());
}

TEST(BlockMatrix, CountsItsMemory) {
  const Grid grid(4, 5);
  const BlockMatrix matrix = assembled(grid);
  EXPECT_GT(matrix.bytes(), static_cast<std::size_t>(grid.mesh.n_owned_nodes) * 4 * sizeof(double));
}

TEST(GhostExchange, GhostsReceiveTheOwnersValues) {
  const Grid grid(4, 5);
  const parallel::GhostExchange ghosts(grid.mesh);
  EXPECT_EQ(ghosts.n_owned_nodes(), grid.mesh.n_owned_nodes);
  for (int components : {1, 3}) {
    std::vector<double> values(static_cast<std::size_t>(grid.mesh.n_nodes() * components), -1.0);
    for (Index node = 0; node < grid.mesh.n_owned_nodes; ++node)
      for (int a = 0; a < components; ++a)
        values[static_cast<std::size_t>(node * components + a)] =
            static_cast<double>(10 * grid.global(node) + a);
    ghosts.update(values, components);
    for (Index node = 0; node < grid.mesh.n_nodes(); ++node)
      for (int a = 0; a < components; ++a)
        EXPECT_EQ(values[static_cast<std::size_t>(node * components + a)],
                  static_cast<double>(10 * grid.global(node) + a));
  }
}

TEST(Sums, AreTakenOverAllProcesses) {
  const int rank = processes::rank(), size = processes::count();
  EXPECT_EQ(parallel::global_sum(rank + 1.0), 0.5 * size * (size + 1));
  EXPECT_EQ(parallel::global_max(rank), size - 1.0);
  EXPECT_EQ(parallel::global_min(rank), 0.0);
  EXPECT_TRUE(parallel::any_process(rank == size - 1));
  EXPECT_FALSE(parallel::any_process(false));
  EXPECT_TRUE(std::isnan(parallel::global_sum(rank == 0 ? std::nan("") : 1.0)));
}

}  // namespace
}  // namespace solidus::linear
