#include "algebra/corrected_matrix.hpp"

#include <utility>

#include "algebra/petsc_vectors.hpp"

namespace solidus::algebra {

namespace {

struct Parts {
  CorrectedMatrix::Term term;
  Mat assembled = nullptr;
};

PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  Parts* parts = nullptr;
  check(MatShellGetContext(shell, &parts), "MatShellGetContext");
  check(MatMult(parts->assembled, x, y), "MatMult");
  with_values(x, y, parts->term);
  return 0;
}

}  // namespace

struct CorrectedMatrix::Petsc {
  Parts parts;
  MatHandle shell;
};

CorrectedMatrix::CorrectedMatrix(Term term) : petsc_(std::make_unique<Petsc>()) {
  petsc_->parts.term = std::move(term);
}

CorrectedMatrix::~CorrectedMatrix() = default;

Mat CorrectedMatrix::with(Mat assembled) {
  petsc_->parts.assembled = assembled;
  if (!petsc_->shell) {
    PetscInt m = 0, n = 0;
    check(MatGetLocalSize(assembled, &m, &n), "MatGetLocalSize");
    check(MatCreateShell(PETSC_COMM_WORLD, m, n, PETSC_DETERMINE, PETSC_DETERMINE, &petsc_->parts,
                         petsc_->shell.out()),
          "MatCreateShell");
    using Function = void (*)();
    check(MatShellSetOperation(petsc_->shell, MATOP_MULT, reinterpret_cast<Function>(multiply)),
          "MatShellSetOperation");
  }
  return petsc_->shell;
}

}  // namespace solidus::algebra
