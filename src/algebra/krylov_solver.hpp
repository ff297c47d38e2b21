/// Krylov's methods on an operator that is preconditioned by another, assembled matrix
/// (function_matrix.hpp): conjugate gradients where both are positive definite, else flexible GMRES.
#pragma once

#include <petscksp.h>

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "algebra/linear_solver.hpp"

namespace solidus::algebra {

/// What is done with the assembled matrix.
enum class Preconditioner {
  factorisation,  ///< MUMPS
  given           ///< that of use()
};

struct KrylovOptions {
  std::string prefix;  ///< of PETSc's options
  Preconditioner preconditioner = Preconditioner::factorisation;
  bool definite = true;   ///< positive
  bool symmetric = true;  ///< the preconditioning matrix
  int max_iterations = 500;
};

class KrylovSolver {
 public:
  explicit KrylovSolver(KrylovOptions options);
  ~KrylovSolver();
  /// Of Preconditioner::given: z ≈ A⁻¹ r on owned degrees of freedom. Collective.
  using Cycle = std::function<void(std::span<const double> r, std::span<double> z)>;
  void use(Cycle cycle);

  /// From here on the operator and what preconditions it, set up at the next solve.
  void set(Mat op, Mat preconditioner);
  /// Solves to ‖b − A x‖ <= max(relative ‖b‖, absolute) from x = 0, on owned degrees of freedom. Collective.
  LinearReport solve(std::span<const double> b, std::span<double> x, double relative, double absolute = 0);
  /// y = A x with the operator of set(), on owned degrees of freedom. Collective.
  void multiply(std::span<const double> x, std::span<double> y);
  /// The next matrices have another pattern, or nothing of the past shall count.
  void reset();
  double seconds_setup() const;
  double seconds_solve() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::algebra
