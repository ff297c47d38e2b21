/// PETSc objects with owners: each handle destroys its object when it goes out of scope. No header of PETSc
/// is needed to hold one.
#pragma once

#include <utility>

#include "parallel/petsc_types.hpp"

namespace solidus::petsc {

/// Throws that PETSc failed in the call `what` with this error code.
[[noreturn]] void fail(int code, const char* what);

/// Turns an error code of PETSc into an exception (our bug or exhausted memory, never the user's input:
/// solver failures are reported through convergence reasons).
inline void check(int code, const char* what) {
  if (code != 0) fail(code, what);
}

/// Destroys an object and sets its name to null. Objects that outlive PetscFinalize are left to it.
void destroy(Mat& object);
void destroy(Vec& object);
void destroy(KSP& object);
void destroy(MatNullSpace& object);

/// Owns one PETSc object.
template <class Object>
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
    if (object_ != nullptr) destroy(object_);
  }

 private:
  Object object_ = nullptr;
};

using MatHandle = Handle<Mat>;
using VecHandle = Handle<Vec>;
using KspHandle = Handle<KSP>;
using NullSpaceHandle = Handle<MatNullSpace>;

}  // namespace solidus::petsc
