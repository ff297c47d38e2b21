#include "linear/krylov_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <petscksp.h>

#include <vector>

#include "parallel/petsc_handles.hpp"
#include "system/processes.hpp"

namespace solidus::linear {
namespace {

/// A saddle point of n forces and n pressures, with weak diagonal entries of the forces: pivots are found
/// far from where an analysis of the pattern expects them.
petsc::MatHandle saddle_point(PetscInt n) {
  petsc::MatHandle matrix;
  petsc::check(MatCreateSeqAIJ(PETSC_COMM_SELF, 2 * n, 2 * n, 24, nullptr, matrix.out()), "MatCreateSeqAIJ");
  const auto add = [&](PetscInt i, PetscInt j, double value) {
    petsc::check(MatSetValue(matrix, i, j, value, ADD_VALUES), "MatSetValue");
    if (i != j) petsc::check(MatSetValue(matrix, j, i, value, ADD_VALUES), "MatSetValue");
  };
  for (PetscInt i = 0; i < n; ++i) {
    add(i, i, 1e-14);
    add(n + i, n + i, 0.0);
    for (PetscInt k = 0; k < 10; ++k) add(i, n + (7 * i + 31 * k * k + 3 * k) % n, 1.0 / double(1 + k));
  }
  petsc::check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  return matrix;
}

TEST(KrylovSolver, FactorsThatNeedMoreWorkspaceThanForeseenGetIt) {
  const int n_processes = processes::count();
  if (n_processes > 1) GTEST_SKIP() << "a matrix of one process";
  constexpr PetscInt n = 600;
  petsc::check(PetscOptionsSetValue(nullptr, "-tight_mat_mumps_icntl_14", "0"), "PetscOptionsSetValue");
  const petsc::MatHandle matrix = saddle_point(n);
  KrylovSolver solver({.prefix = "tight_", .symmetric = true});
  const std::vector<double> b(2 * n, 1.0);
  std::vector<double> x(2 * n), product(2 * n);
  solver.set(matrix, matrix);
  const LinearReport report = solver.solve(b, x, 1e-8);
  ASSERT_TRUE(report.converged) << report.reason;
  solver.multiply(x, product);
  for (std::size_t i = 0; i < b.size(); ++i) EXPECT_NEAR(product[i], 1.0, 1e-6);
  char value[32] = "";
  petsc::check(
      PetscOptionsGetString(nullptr, nullptr, "-tight_mat_mumps_icntl_14", value, sizeof value, nullptr),
      "PetscOptionsGetString");
  EXPECT_STRNE(value, "0") << "the first attempt did; the matrix does not test what it is to test";
}

}  // namespace
}  // namespace solidus::linear
