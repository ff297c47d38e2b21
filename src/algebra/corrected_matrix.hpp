/// A PETSc operator y = A x + f(x): an assembled matrix and a term that has too wide a stencil to be
/// assembled.
#pragma once

#include <petscmat.h>

#include <functional>
#include <memory>
#include <span>

namespace solidus::algebra {

class CorrectedMatrix {
 public:
  /// y += f(x) on owned degrees of freedom. Collective.
  using Term = std::function<void(std::span<const double> x, std::span<double> y)>;
  explicit CorrectedMatrix(Term term);
  ~CorrectedMatrix();
  CorrectedMatrix(const CorrectedMatrix&) = delete;
  CorrectedMatrix& operator=(const CorrectedMatrix&) = delete;

  /// The operator with this A, which must live as long as it is used; owned by this object.
  Mat with(Mat assembled);

 private:
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::algebra
