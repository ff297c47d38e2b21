/// Flexible GMRES on an operator that is preconditioned by the factors (MUMPS) of another, assembled matrix
/// (function_matrix.hpp): the same one, or one that lacks a part which couples too many unknowns.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "linear/linear_solver.hpp"
#include "parallel/petsc_types.hpp"

namespace solidus::linear {

struct KrylovOptions {
  std::string prefix;     ///< of PETSc's options
  bool symmetric = true;  ///< the preconditioning matrix
  int max_iterations = 500;
};

class KrylovSolver {
 public:
  explicit KrylovSolver(KrylovOptions options);
  ~KrylovSolver();

  /// Sets the operator and its preconditioner, which is set up at the next solve.
  void set(Mat op, Mat preconditioner);
  /// Sets another operator, which the factors of the last solve() precondition as they are.
  void set_operator(Mat op);
  /// Solves to ‖b − A x‖ <= max(relative ‖b‖, absolute) from x = 0, on owned degrees of freedom. Collective.
  /// @param at_most  iterations, after which it is given up; zero: those of the options
  LinearReport solve(std::span<const double> b, std::span<double> x, double relative, double absolute = 0,
                     int at_most = 0);
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

}  // namespace solidus::linear
