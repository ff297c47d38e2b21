/// PETSc objects with owners: each handle destroys its object when it goes out of scope.
#pragma once

#include <petscksp.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace solidus::petsc {

/// Turns an error code of PETSc into an exception (our bug or exhausted memory, never the user's input:
/// solver failures are reported through convergence reasons).
inline void check(PetscErrorCode code, const char* what) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc failed in ") + what + ": " + (text ? text : "unknown error"));
}

/// Owns one PETSc object. Objects that outlive PetscFinalize are left to it.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Handle {
 public:
  Handle() = default;
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator Object() const { return object_; }  // NOLINT: passes as the PETSc type
  /// For PETSc's creating calls.
  Object* out() {
    reset();
    return &object_;
  }
  void reset() {
    if (!object_) return;
    PetscBool finalized = PETSC_FALSE;
    PetscFinalized(&finalized);
    if (!finalized) destroy(&object_);
    object_ = nullptr;
  }

 private:
  Object object_ = nullptr;
};

using MatHandle = Handle<Mat, MatDestroy>;
using VecHandle = Handle<Vec, VecDestroy>;
using KspHandle = Handle<KSP, KSPDestroy>;
using NullSpaceHandle = Handle<MatNullSpace, MatNullSpaceDestroy>;

}  // namespace solidus::petsc
