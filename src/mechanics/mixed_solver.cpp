#include "mechanics/mixed_solver.hpp"

#include <algorithm>

#include "algebra/petsc_handles.hpp"

namespace solidus::mechanics {

namespace {

/// Degrees of freedom of both fields; above, a factorisation in three dimensions fills up.
constexpr GlobalIndex k_direct_limit_3d = 40000;
/// Of flexible GMRES with a factorisation, whatever the forcing term: a step of it costs a hundredth of the
/// factorisation, and what it leaves in r_p comes back as a force κ/2Ĝ times as large.
constexpr double k_direct_tolerance = 1e-10;
/// Against the divergence, in parts of 2Ĝ: with it A has the stiffness of Poisson's ratio 1/4.
constexpr double k_augmentation = 1.0 / 3.0 + 0.5;

}  // namespace

bool factorises(algebra::SolverKind kind, const mesh::Mesh& mesh, int components) {
  if (kind != algebra::SolverKind::automatic) return kind == algebra::SolverKind::direct;
  return mesh.dimension == 2 || mesh.n_global_nodes * (components + 1) < k_direct_limit_3d;
}

struct MixedSolver::Petsc {
  algebra::MatHandle assembled;  ///< the nest as one matrix, for the factorisation
};

MixedSolver::MixedSolver(const mesh::Mesh& mesh, algebra::BlockMatrix& displacement,
                         PressureEquation& pressure, const algebra::GhostExchange& ghosts,
                         MixedSolverOptions options)
    : mesh_(mesh),
      displacement_(displacement),
      pressure_(pressure),
      ghosts_(ghosts),
      options_(options),
      compliance_(pressure.make_matrix()),
      matrix_(mesh, displacement, *compliance_),
      operator_([this](std::span<const double> x, std::span<double> y) { add_terms(x, y); }),
      solver_({.prefix = "mechanics_mixed_",
               .preconditioner =
                   options.direct ? algebra::Preconditioner::factorisation : algebra::Preconditioner::saddle,
               .definite = false,
               .symmetric = options.symmetric}),
      petsc_(std::make_unique<Petsc>()) {
  for (MixedKernel* kernel : pressure.kernels())
    kernel->set_augmentation(options.direct ? 0.0 : k_augmentation);
  if (options.direct) return;
  solver_.use_rigid_body_modes(mesh, displacement.block_size());
  schur_ = pressure.make_matrix();
}

MixedSolver::~MixedSolver() = default;

void MixedSolver::assemble() {
  if (matrix_.set_zero()) reset();
  compliance_->set_zero();
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_saddle(pressure_.unit(), matrix_);
}

algebra::LinearReport MixedSolver::solve(algebra::BlockMatrix&, std::span<const double> b,
                                         std::span<double> x, double forcing) {
  using algebra::check;
  Mat preconditioner = matrix_.matrix(1, 1), schur = nullptr;
  if (options_.direct) {
    const MatReuse reuse = petsc_->assembled ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX;
    Mat assembled = petsc_->assembled;
    check(MatConvert(preconditioner, MATAIJ, reuse,
                     reuse == MAT_REUSE_MATRIX ? &assembled : petsc_->assembled.out()),
          "MatConvert");
    preconditioner = petsc_->assembled;
  } else {
    const double scale = pressure_.unit() * pressure_.unit();
    schur_->set_zero();
    for (const MixedKernel* kernel : pressure_.kernels()) {
      kernel->add_compliance(-scale, *schur_);
      kernel->add_mass(-scale, *schur_);
    }
    schur = schur_->matrix();
  }
  solver_.set(operator_.with(preconditioner), preconditioner, schur);
  return solve_again(b, x, forcing);
}

algebra::LinearReport MixedSolver::solve_again(std::span<const double> b, std::span<double> x,
                                               double forcing) {
  right_.assign(b.begin(), b.end());
  right_.resize(b.size() + static_cast<std::size_t>(mesh_.n_owned_nodes * pressure_.fields()), 0.0);
  solution_.resize(right_.size());
  const algebra::LinearReport report =
      solver_.solve(right_, solution_,
                    options_.direct ? std::min(k_direct_tolerance, options_.relative_tolerance)
                                    : std::max(forcing, options_.relative_tolerance));
  const auto all = std::span<const double>(solution_);
  std::copy_n(all.begin(), b.size(), x.begin());
  pressure_.expect(all.first(b.size()), all.subspan(b.size()));
  return report;
}

/// What the operator has and the assembled matrix has not: the projection, and less augmentation.
void MixedSolver::add_terms(std::span<const double> x, std::span<double> y) {
  const auto n = static_cast<std::size_t>(mesh_.n_owned_nodes * displacement_.block_size());
  pressure_.add_projection_to(x.subspan(n), 1.0, y.subspan(n));
  if (options_.direct) return;
  const std::vector<char>& fixed = displacement_.fixed();
  swelling_.resize(fixed.size());
  pull_.assign(fixed.size(), 0.0);
  for (std::size_t i = 0; i < n; ++i) swelling_[i] = fixed[i] ? 0.0 : x[i];
  const std::span<double> owned = std::span(swelling_).first(n), pull = std::span(pull_).first(n);
  displacement_.ties().share(owned);
  ghosts_.update(swelling_, displacement_.block_size());
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_divergence(-1.0, swelling_, pull_);
  for (std::size_t i = 0; i < n; ++i)
    if (fixed[i]) pull[i] = 0;
  displacement_.ties().sum(pull);
  for (std::size_t i = 0; i < n; ++i) y[i] += pull[i];
}

void MixedSolver::forget() {
  reset();
  pressure_.forget();
}

void MixedSolver::reset() {
  solver_.reset();
  petsc_->assembled.reset();
}

std::size_t MixedSolver::bytes() const {
  return matrix_.bytes() + compliance_->bytes() + (schur_ ? schur_->bytes() : 0);
}

}  // namespace solidus::mechanics
