/// One way to destroy each kind of object, and the text of an error of PETSc.
#include "parallel/petsc_handles.hpp"

#include <petscksp.h>

#include <stdexcept>
#include <string>

namespace solidus::petsc {

namespace {

template <class Object>
void destroy_with(PetscErrorCode (*destroy)(Object*), Object& object) {
  PetscBool finalized = PETSC_FALSE;
  PetscFinalized(&finalized);
  if (!finalized) destroy(&object);
  object = nullptr;
}

}  // namespace

void fail(int code, const char* what) {
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc failed in ") + what + ": " + (text ? text : "unknown error"));
}

void destroy(Mat& object) {
  destroy_with(MatDestroy, object);
}
void destroy(Vec& object) {
  destroy_with(VecDestroy, object);
}
void destroy(KSP& object) {
  destroy_with(KSPDestroy, object);
}
void destroy(MatNullSpace& object) {
  destroy_with(MatNullSpaceDestroy, object);
}

}  // namespace solidus::petsc
