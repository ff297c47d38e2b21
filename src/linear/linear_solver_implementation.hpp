/// The PETSc objects of a linear solver and our own preconditioners in it; included by the files of
/// linear_solver.hpp alone.
#pragma once

#include <petscksp.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linear/block_multigrid.hpp"
#include "linear/conjugate_gradients.hpp"
#include "linear/factorisation.hpp"
#include "linear/incomplete_cholesky.hpp"
#include "linear/linear_solver.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

inline constexpr int k_first_workspace = 35;  ///< of MUMPS, per cent

/// Whether the preconditioner is ours: not where the user asks PETSc for one, and not for tied unknowns.
bool is_ours(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size, int modes);
/// The same of incomplete factors.
bool is_our_factor(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size);

/// The values of a vector on this process, while the object lives.
class ReadArray {
 public:
  explicit ReadArray(Vec of) : vector_(of) {
    petsc::check(VecGetArrayRead(of, &values_), "VecGetArrayRead");
    petsc::check(VecGetLocalSize(of, &n_), "VecGetLocalSize");
  }
  ~ReadArray() { VecRestoreArrayRead(vector_, &values_); }
  ReadArray(const ReadArray&) = delete;
  ReadArray& operator=(const ReadArray&) = delete;
  std::span<const double> values() const { return {values_, as_size(n_)}; }

 private:
  Vec vector_;
  const double* values_ = nullptr;
  PetscInt n_ = 0;
};

class WriteArray {
 public:
  explicit WriteArray(Vec of) : vector_(of) {
    petsc::check(VecGetArrayWrite(of, &values_), "VecGetArrayWrite");
    petsc::check(VecGetLocalSize(of, &n_), "VecGetLocalSize");
  }
  ~WriteArray() { VecRestoreArrayWrite(vector_, &values_); }
  WriteArray(const WriteArray&) = delete;
  WriteArray& operator=(const WriteArray&) = delete;
  std::span<double> values() const { return {values_, as_size(n_)}; }

 private:
  Vec vector_;
  double* values_ = nullptr;
  PetscInt n_ = 0;
};

/// Multigrid of a matrix whose rows have another scale.
struct ScaledMultigrid {
  BlockMultigrid* multigrid = nullptr;
  double scale = 1;

  void apply(std::span<const double> r, std::span<double> z) const {
    multigrid->apply(r, z);
    for (double& value : z) value /= scale;
  }
};

/// Vectors of a solve that take the caller's arrays for their own until the end of the scope.
class PlacedArrays {
 public:
  PlacedArrays(Vec b, std::span<const double> of_b, Vec x, std::span<double> of_x) : b_(b), x_(x) {
    petsc::check(VecPlaceArray(b, of_b.data()), "VecPlaceArray");
    petsc::check(VecPlaceArray(x, of_x.data()), "VecPlaceArray");
  }
  ~PlacedArrays() {
    VecResetArray(b_);
    VecResetArray(x_);
  }
  PlacedArrays(const PlacedArrays&) = delete;
  PlacedArrays& operator=(const PlacedArrays&) = delete;

 private:
  Vec b_, x_;
};

struct LinearSolver::Implementation {
  const mesh::Mesh& mesh;
  LinearSolverOptions options;
  petsc::KspHandle ksp;
  petsc::VecHandle b, x, residual, correction;  ///< b and x without arrays of their own for `shell`
  int rigid_components = 0;  ///< of displacements whose rigid-body modes cost no energy; zero: no such
  SolverKind kind = SolverKind::automatic;  ///< as asked for; PETSc options may choose another one
  bool reuse_hierarchy = false;  ///< the preconditioner is set up again only when iterations have grown
  double first_rate = 0;         ///< iterations per digit with the hierarchy just set up
  double tightest = 0;           ///< relative tolerance
  bool stale = true;             ///< set up again at the next solve
  Factorisation factorisation{k_first_workspace};
  Mat matrix = nullptr;  ///< whose operators the solver holds; owned by the BlockMatrix, or `shell`
  // Multigrid and incomplete factors of our own, which need no copy of the matrix in PETSc.
  std::unique_ptr<BlockMultigrid> multigrid;
  ScaledMultigrid of_first_field;
  bool split_failed = false;  ///< with multigrid of our own; GAMG takes over until forget()
  std::unique_ptr<IncompleteCholesky> incomplete;
  IncompleteCholesky::Fill fill = IncompleteCholesky::Fill::pattern;
  std::unique_ptr<ConjugateGradients> gradients;  ///< with them; null: PETSc's Krylov solver runs
  BlockMatrix* blocks = nullptr;
  petsc::MatHandle shell;  ///< multiplies by the blocks
  std::optional<parallel::GhostExchange> ghosts;
  std::vector<double> local;  ///< work, [local node][component]
  /// From where multigrid of our own has failed until forget(): a factorisation, or PETSc's multigrid.
  std::unique_ptr<LinearSolver> rescue;
  bool petsc_multigrid = false;  ///< of such a rescue
  double seconds_setup = 0, seconds_solve = 0;

  Implementation(const mesh::Mesh& m, LinearSolverOptions o) : mesh(m), options(std::move(o)) {}
  bool multigrid_of_blocks(const BlockMatrix& a) const;
  bool factor_of_blocks(const BlockMatrix& a) const;
  bool factorisation_serves(const BlockMatrix& a) const;
  bool gradients_of_blocks() const;
  LinearReport solve_by_gradients(std::span<const double> right, std::span<double> solution, double forcing);
  void create_shell(BlockMatrix& a);
  void multiply(Vec in, Vec out);
  void create(Mat a);
  /// Krylov method and preconditioner of `kind`.
  void set_method(Mat a, PC pc);
  void create_multigrid(PC pc);
  bool splits_blocks() const;
  void create_split(Mat a, PC pc);
  void create_vectors(Mat a);
  void create_factor(PC pc);
  void attach_modes(Mat a) const;
  bool is_direct() const;
  void set_tolerance(double forcing);
  KSPConvergedReason run(Vec rhs, Vec solution, int& iterations);
  void judge_hierarchy(Vec rhs, int n, bool failed);
  bool refine(LinearReport& report);
  bool try_again();
};

}  // namespace solidus::linear
