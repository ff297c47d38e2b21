/// A shell matrix of PETSc whose product is a function.
#include "linear/function_matrix.hpp"

#include <petscmat.h>

#include <utility>

#include "parallel/petsc_vectors.hpp"

namespace solidus::linear {

namespace {

PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  FunctionMatrix::Function* function = nullptr;
  petsc::check(MatShellGetContext(shell, static_cast<void*>(&function)), "MatShellGetContext");
  petsc::with_values(x, y, *function);
  return 0;
}

}  // namespace

struct FunctionMatrix::Petsc {
  Function function;
  petsc::MatHandle shell;
};

FunctionMatrix::FunctionMatrix(std::int64_t n_owned, Function function) : petsc_(std::make_unique<Petsc>()) {
  petsc_->function = std::move(function);
  const auto n = static_cast<PetscInt>(n_owned);
  petsc::check(MatCreateShell(PETSC_COMM_WORLD, n, n, PETSC_DETERMINE, PETSC_DETERMINE, &petsc_->function,
                              petsc_->shell.out()),
               "MatCreateShell");
  petsc::check(MatShellSetOperation(petsc_->shell, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)),
               "MatShellSetOperation");
}

FunctionMatrix::~FunctionMatrix() = default;

Mat FunctionMatrix::matrix() const {
  return petsc_->shell;
}

}  // namespace solidus::linear
