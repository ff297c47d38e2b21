/// A square PETSc operator (shell matrix) that is applied by a function.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "parallel/petsc_types.hpp"

namespace solidus::linear {

class FunctionMatrix {
 public:
  /// y = A x on owned entries. Collective.
  using Function = std::function<void(std::span<const double> x, std::span<double> y)>;
  /// @param n_owned  rows and columns of this process. Collective.
  FunctionMatrix(std::int64_t n_owned, Function function);
  ~FunctionMatrix();
  FunctionMatrix(const FunctionMatrix&) = delete;
  FunctionMatrix& operator=(const FunctionMatrix&) = delete;

  /// Owned by this object.
  Mat matrix() const;

 private:
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::linear
