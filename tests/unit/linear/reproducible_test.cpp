/// Iterative solvers give the same bits in every run on the same number of processes, in whatever order
/// messages arrive. Here they arrive in many orders: processes wait at random before they send.
#include <gtest/gtest.h>

#include <memory>

#include "../../late_messages.hpp"
#include "linear/coupled_solver.hpp"
#include "linear/linear_solver.hpp"
#include "multigrid/multigrid.hpp"
#include "springs.hpp"

namespace solidus::linear {
namespace {

using test::expect_same_bits;
using test::Springs;

std::vector<double> solution(Springs& springs, SolverKind kind) {
  LinearSolver solver(springs.grid.mesh, {.prefix = "test_", .kind = kind, .relative_tolerance = 1e-10});
  solver.use_rigid_body_modes(2);
  std::vector<double> x(springs.n_owned());
  const LinearReport report = solver.solve(springs.matrix, springs.pattern(0.7), x);
  EXPECT_TRUE(report.converged) << report.reason;
  return x;
}

TEST(Reproducible, MultigridOfBlocks) {
  Springs springs(40);
  expect_same_bits([&] { return solution(springs, SolverKind::multigrid); });
}

TEST(Reproducible, MultigridOfTiedUnknowns) {
  Springs springs(40);
  springs.matrix.constrain({springs.side()});
  expect_same_bits([&] { return solution(springs, SolverKind::multigrid); });
}

// With so few iterations our multigrid gives up and PETSc's comes to the rescue; it gives up too, and what it
// leaves is the same.
TEST(Reproducible, MultigridThatComesToTheRescue) {
  Springs springs(40);
  expect_same_bits([&] {
    LinearSolver solver(
        springs.grid.mesh,
        {.prefix = "test_", .kind = SolverKind::multigrid, .relative_tolerance = 1e-10, .max_iterations = 3});
    solver.use_rigid_body_modes(2);
    std::vector<double> x(springs.n_owned());
    EXPECT_EQ(solver.solve(springs.matrix, springs.pattern(0.7), x).iterations, 6);
    return x;
  });
}

TEST(Reproducible, IncompleteFactors) {
  Springs springs(40);
  expect_same_bits([&] { return solution(springs, SolverKind::incomplete); });
}

TEST(Reproducible, SmallFactorisation) {
  Springs springs(40);
  expect_same_bits([&] { return solution(springs, SolverKind::direct); });
}

/// Displacements with a temperature at every node: springs that swell, and conduction.
struct BothFields {
  Springs springs{40};
  std::unique_ptr<BlockMatrix> conduction;
  std::unique_ptr<CoupledMatrix> coupled;

  explicit BothFields(bool tied) {
    NodeGraph graph(springs.grid.mesh);
    graph.add_cliques(springs.grid.quads, 4);
    conduction = std::make_unique<BlockMatrix>(springs.grid.mesh, 1, std::move(graph));
    if (tied) springs.matrix.constrain({springs.side()});
    coupled = std::make_unique<CoupledMatrix>(springs.grid.mesh, springs.matrix, *conduction);
    const std::span<const std::int64_t> start = springs.matrix.row_start();
    for (Index row = 0; row < springs.grid.mesh.n_owned_nodes; ++row)
      for (BlockMatrix::Slot s = start[Springs::at(row)]; s < start[Springs::at(row) + 1]; ++s) {
        const Index column = springs.matrix.columns()[Springs::at(s)];
        *conduction->block(conduction->slot(row, column)) = row == column ? 9 : -1;
        for (int i = 0; i < 2; ++i) {
          coupled->force_by_temperature(s)[i] = row == column ? 0.02 : 0.01;
          coupled->heat_by_displacement(s)[i] = row == column ? 0.01 : -0.02;
        }
      }
  }
};

TEST(Reproducible, SolversOfBothFields) {
  for (const bool tied : {false, true}) {
    BothFields both(tied);
    for (const CoupledSolverKind kind : {CoupledSolverKind::field_split, CoupledSolverKind::direct})
      expect_same_bits([&] {
        CoupledSolver solver(both.springs.grid.mesh, 2, kind, 1e-10);
        const std::size_t n = both.springs.n_owned();
        std::vector<double> force = both.springs.pattern(0.7), x(n + n / 2);
        both.springs.matrix.constraints().sum(force);
        const std::vector<double> heat(n / 2, 1.0);
        const LinearReport report = solver.solve(*both.coupled, force, heat, {1.0, 0.5},
                                                 std::span(x).first(n), std::span(x).subspan(n));
        EXPECT_TRUE(report.converged) << report.reason;
        EXPECT_LT(report.iterations, 40);
        return x;
      });
  }
}

// As above: with so few iterations our multigrid gives up, PETSc's takes over and gives up too.
TEST(Reproducible, FieldSplitWhereMultigridGivesUp) {
  BothFields both(false);
  const std::size_t n = both.springs.n_owned();
  std::vector<double> b = both.springs.pattern(0.7);
  b.resize(n + n / 2, 1.0);
  expect_same_bits([&] {
    LinearSolver solver(both.springs.grid.mesh, {.prefix = "test_",
                                                 .kind = SolverKind::field_split,
                                                 .symmetric = false,
                                                 .relative_tolerance = 1e-12,
                                                 .max_iterations = 3});
    solver.use_rigid_body_modes(2);
    solver.use_blocks_of_first_field(both.springs.matrix, 1.0);
    std::vector<double> x(b.size());
    EXPECT_EQ(solver.solve(both.coupled->matrix(1.0, 1.0), b, x).iterations, 6);
    return x;
  });
}

}  // namespace
}  // namespace solidus::linear
