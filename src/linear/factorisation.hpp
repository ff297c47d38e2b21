/// Factorisation by MUMPS as a preconditioner of PETSc.
#pragma once

#include <string>

#include "numbers/types.hpp"
#include "parallel/petsc_types.hpp"

namespace solidus::linear {

/// MUMPS in a PC. A small matrix is factorised by every process for itself: faster than by all of them
/// together, which for so few unknowns wait for each other, and with the same bits in every run.
class Factorisation {
 public:
  /// @param workspace  MUMPS ICNTL(14), per cent beyond what the analysis foresees
  explicit Factorisation(int workspace) : workspace_(workspace) {}
  /// @param prefix      of PETSc's options
  /// @param n_unknowns  of all processes
  /// Before KSPSetFromOptions. Collective.
  void set_type(PC pc, const std::string& prefix, bool symmetric, GlobalIndex n_unknowns);
  /// After a failure, whether it is worth another attempt: MUMPS may need more workspace than its analysis
  /// foresaw, as pivoting is not known beforehand. Then it gets it. Collective.
  bool try_again(KSP ksp, Mat matrix);
  /// After try_again() has found no other way, in words, why there are no factors. Collective.
  std::string failure(Mat matrix) const;
  /// A new matrix, or one that has been factorised.
  void begin() { attempts_ = 0; }

 private:
  int workspace_;
  std::string option_;  ///< that sets it
  int attempts_ = 0;
  bool lacks_workspace_ = false;  ///< in the last failure
};

/// The multiplications and additions that MUMPS foresees for the factors of a matrix, from its pattern alone:
/// the same for any values. An analysis costs a tenth of the factors or less. Collective.
double foreseen_operations(Mat matrix, bool symmetric);

}  // namespace solidus::linear
