/// Linear solvers: defaults by measurement, PETSc options to change them (prefixes heat_, mechanics_).
#pragma once

#include <memory>
#include <span>
#include <string>

#include "linear/block_matrix.hpp"
#include "parallel/petsc_types.hpp"

namespace solidus::linear {

enum class SolverKind {
  automatic,   ///< the default of the phase and size (docs/reference/case_file.md)
  direct,      ///< MUMPS, LDLᵀ for symmetric matrices
  multigrid,   ///< CG + multigrid (GMRES when unsymmetric), GAMG for tied unknowns
  jacobi,      ///< CG + Jacobi
  incomplete,  ///< CG + incomplete Cholesky, on each process for itself (GMRES + incomplete LU when
               ///< unsymmetric); that of incomplete_cholesky.hpp where half of the matrix is kept
  field_split  ///< FGMRES, blocks of a MATNEST one after the other: multigrid on the first, incomplete LU on
               ///< the second
};

struct LinearSolverOptions {
  std::string prefix;  ///< "heat_", "mechanics_"
  SolverKind kind = SolverKind::automatic;
  bool symmetric = true;
  bool transient_heat = false;        ///< diagonally strong: a cheap preconditioner serves
  double relative_tolerance = 1e-10;  ///< the tightest; iterative solvers only
  int max_iterations = 2000;
};

/// Returns how a matrix without multi-point constraints is stored for such a solver: half of a symmetric
/// matrix suffices for the preconditioners that need no copy of it (multigrid.hpp, incomplete_cholesky.hpp).
/// @param modes  of multigrid
BlockMatrix::Storage storage_for(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size,
                                 int modes);

struct LinearReport {
  int iterations = 0;
  bool converged = true;
  std::string reason;  ///< PETSc's words when it did not converge
};

/// Time that a linear solver has taken [s].
struct SolverSeconds {
  double setup = 0, solve = 0;
  double sum() const { return setup + solve; }
};

/// Interface that Newton's method requires of a solver of K d = −r.
class TangentSolver {
 public:
  virtual ~TangentSolver() = default;
  /// Solves A x = b on owned degrees of freedom. Collective.
  /// @param forcing  ‖b − A x‖/‖b‖ that will do (forcing.hpp)
  virtual LinearReport solve(BlockMatrix& a, std::span<const double> b, std::span<double> x,
                             double forcing) = 0;
  /// Solves with the matrix of the last solve(), as it was then. Collective.
  virtual LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing) = 0;
  /// Sets everything up again at the next solve, so that it depends on the matrix alone (checkpoints).
  virtual void forget() = 0;
  /// The next matrix has another pattern: nothing stays.
  virtual void reset() = 0;
  /// Spent so far.
  virtual SolverSeconds seconds() const = 0;
};

class LinearSolver : public TangentSolver {
 public:
  LinearSolver(const mesh::Mesh& mesh, LinearSolverOptions options);
  ~LinearSolver() override;
  /// Rigid-body modes for multigrid from the coordinates of the owned nodes (mechanics).
  void use_rigid_body_modes(int components);
  /// Whether incomplete factors of our own keep the fill that has a place in the pattern, as they do unless
  /// this says otherwise, or change the diagonal alone (incomplete_cholesky.hpp). Holds for the next set-up.
  void keep_fill(bool keep);
  /// Gives a field split the blocks of its first field, which must have no constraints: multigrid.hpp then
  /// replaces GAMG. To be called before every solve; the blocks must outlive it.
  /// @param scale  the rows of the matrix that is solved over those of the blocks
  void use_blocks_of_first_field(BlockMatrix& blocks, double scale);
  /// Solves A x = b on owned degrees of freedom; keeps the analysis (direct) or hierarchy (multigrid, until
  /// iterations have grown by half) between calls. Collective.
  /// @param forcing  ‖b − A x‖/‖b‖ that will do (forcing.hpp); where it is below the relative tolerance, that
  ///                 one holds. Iterative solvers only
  LinearReport solve(BlockMatrix& a, std::span<const double> b, std::span<double> x,
                     double forcing = 0) override;
  /// The same of a PETSc matrix; the rigid-body modes are those of its first block where it is a MATNEST.
  LinearReport solve(Mat matrix, std::span<const double> b, std::span<double> x, double forcing = 0);
  /// Solves with the matrix of the last solve(), as it was then: its factorisation or hierarchy serves again.
  /// Collective.
  LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing = 0) override;
  /// The next solve sets the preconditioner up.
  bool stale() const;
  void forget() override;
  void reset() override;
  SolverSeconds seconds() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::linear
