/// Copies the values of this process between PETSc's vectors and arrays.
#pragma once

#include <petscvec.h>

#include <algorithm>
#include <span>

#include "numbers/index_casts.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::petsc {

inline void put(std::span<const double> from, Vec to) {
  double* values = nullptr;
  check(VecGetArrayWrite(to, &values), "VecGetArrayWrite");
  std::copy(from.begin(), from.end(), values);
  check(VecRestoreArrayWrite(to, &values), "VecRestoreArrayWrite");
}

inline void get(Vec from, std::span<double> to) {
  const double* values = nullptr;
  check(VecGetArrayRead(from, &values), "VecGetArrayRead");
  std::copy_n(values, to.size(), to.data());
  check(VecRestoreArrayRead(from, &values), "VecRestoreArrayRead");
}

/// Calls f(x, y) with the values of both, of which y's are to be written.
template <class Function>
void with_values(Vec x, Vec y, Function&& f) {
  PetscInt n = 0, m = 0;
  check(VecGetLocalSize(x, &n), "VecGetLocalSize");
  check(VecGetLocalSize(y, &m), "VecGetLocalSize");
  const double* from = nullptr;
  double* to = nullptr;
  check(VecGetArrayRead(x, &from), "VecGetArrayRead");
  check(VecGetArray(y, &to), "VecGetArray");
  f(std::span<const double>(from, as_size(n)), std::span<double>(to, as_size(m)));
  check(VecRestoreArray(y, &to), "VecRestoreArray");
  check(VecRestoreArrayRead(x, &from), "VecRestoreArrayRead");
}

}  // namespace solidus::petsc
