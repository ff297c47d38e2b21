#include "mechanics/mixed_solver.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/function_matrix.hpp"
#include "algebra/petsc_handles.hpp"
#include "base/profile.hpp"
#include "base/stopwatch.hpp"

namespace solidus::mechanics {

namespace {

/// Degrees of freedom of both fields; above, a factorisation in three dimensions fills up.
constexpr GlobalIndex k_direct_limit_3d = 40000;
/// Up to so many it takes over where multigrid fails.
constexpr GlobalIndex k_rescue_limit = 200000;
/// With a factorisation, whatever the forcing term: a step of flexible GMRES costs a hundredth of it.
constexpr double k_direct_tolerance = 1e-8, k_direct_tightening = 1e-2;
/// Against the divergence, in parts of 2Ĝ: with it A has the stiffness of Poisson's ratio 1/4.
constexpr double k_augmentation = 1.0 / 3.0 + 0.5;

/// Of the iteration on the reduced residual.
constexpr int k_max_rounds = 4;
constexpr double k_safety = 0.5, k_tightest_round = 1e-4, k_loosest_round = 0.3;
constexpr double k_correction = 1e-3;  ///< accuracy of the pressure that goes with a displacement

double norm(std::span<const double> a) {
  double squares = 0;
  for (const double value : a) squares += value * value;
  return std::sqrt(algebra::global_sum(squares));
}

}  // namespace

bool factorises(algebra::SolverKind kind, const mesh::Mesh& mesh, int components) {
  if (kind != algebra::SolverKind::automatic) return kind == algebra::SolverKind::direct;
  return mesh.dimension == 2 || mesh.n_global_nodes * (components + 1) < k_direct_limit_3d;
}

struct MixedSolver::Petsc {
  algebra::MatHandle assembled;                   ///< the nest as one matrix, for the factorisation
  std::unique_ptr<algebra::FunctionMatrix> free;  ///< saddle_

  void assemble(Mat nest);
};

/// A conversion in place counts as another pattern on several processes, and MUMPS would analyse it anew.
void MixedSolver::Petsc::assemble(Mat nest) {
  using algebra::check;
  if (!assembled) {
    check(MatConvert(nest, MATAIJ, MAT_INITIAL_MATRIX, assembled.out()), "MatConvert");
    return;
  }
  algebra::MatHandle values;
  check(MatConvert(nest, MATAIJ, MAT_INITIAL_MATRIX, values.out()), "MatConvert");
  check(MatCopy(values, assembled, SAME_NONZERO_PATTERN), "MatCopy");
}

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
      petsc_(std::make_unique<Petsc>()) {
  make_solver(options.direct || !SaddlePreconditioner::serves(displacement));
  for (MixedKernel* kernel : pressure.kernels()) kernel->set_augmentation(direct_ ? 0.0 : k_augmentation);
  augmented_ = !direct_;
}

MixedSolver::~MixedSolver() = default;

void MixedSolver::make_solver(bool direct) {
  direct_ = direct;
  petsc_->assembled.reset();
  solver_.emplace(algebra::KrylovOptions{
      .prefix = "mechanics_mixed_",
      .preconditioner = direct ? algebra::Preconditioner::factorisation : algebra::Preconditioner::given,
      .definite = false,
      .symmetric = options_.symmetric});
  tightening_ = direct ? k_direct_tightening : 1;
  if (direct) {
    preconditioner_.reset();  // the factors need its memory
    return;
  }
  preconditioner_.emplace(mesh_, displacement_.block_size(), options_.symmetric);
  if (!schur_) schur_ = pressure_.make_matrix();
  saddle_.emplace(mesh_, matrix_, pressure_, ghosts_);
  solver_->use([this](std::span<const double> r, std::span<double> z) {
    on_whole(r, z, [this] { preconditioner_->apply(*saddle_, whole_in_, whole_out_); });
  });
  petsc_->free = std::make_unique<algebra::FunctionMatrix>(
      static_cast<std::int64_t>(saddle_->n_free()), [this](std::span<const double> x, std::span<double> y) {
        on_whole(x, y, [this] { saddle_->multiply(whole_in_, whole_out_); });
      });
}

/// y = f(x), both of the free degrees of freedom, for an f from whole_in_ to whole_out_.
template <class Function>
void MixedSolver::on_whole(std::span<const double> x, std::span<double> y, Function&& f) {
  whole_in_.resize(right_.size());
  whole_out_.resize(right_.size());
  saddle_->expand(x, whole_in_);
  f();
  saddle_->restrict_to_free(whole_out_, y);
}

/// Solves for the right-hand side residual_; the solution goes to direction_.
algebra::LinearReport MixedSolver::solve_once(double absolute) {
  if (direct_) return solver_->solve(residual_, direction_, 0.0, absolute);
  free_in_.resize(saddle_->n_free());
  free_out_.resize(saddle_->n_free());
  saddle_->restrict_to_free(residual_, free_in_);
  const algebra::LinearReport report = solver_->solve(free_in_, free_out_, 0.0, absolute);
  saddle_->expand(free_out_, direction_);
  return report;
}

/// y = K x, zero where prescribed.
void MixedSolver::multiply(std::span<const double> x, std::span<double> y) {
  if (direct_) return solver_->multiply(x, y);
  free_in_.resize(saddle_->n_free());
  saddle_->multiply(x, y);
  saddle_->restrict_to_free(y, free_in_);
  saddle_->expand(free_in_, y);
}

bool MixedSolver::factorisation_serves() const {
  return mesh_.n_global_nodes * (displacement_.block_size() + pressure_.fields()) < k_rescue_limit;
}

void MixedSolver::assemble() {
  if (matrix_.set_zero()) reset();
  compliance_->set_zero();
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_saddle(pressure_.unit(), matrix_);
}

algebra::LinearReport MixedSolver::solve(algebra::BlockMatrix&, std::span<const double> b,
                                         std::span<double> x, double forcing) {
  set_operators();
  return solve_again(b, x, forcing);
}

void MixedSolver::set_operators() {
  const profile::Part set_up("solver set-up");
  const Stopwatch watch(seconds_setup_);
  if (direct_) {
    Mat nest = matrix_.matrix(1, 1);
    petsc_->assemble(nest);
    solver_->set(operator_.with(nest), petsc_->assembled);
    return;
  }
  const double scale = pressure_.unit() * pressure_.unit();
  schur_->set_zero();
  for (const MixedKernel* kernel : pressure_.kernels()) {
    kernel->add_compliance(-scale, *schur_);
    kernel->add_mass(-scale, *schur_);
  }
  preconditioner_->set_schur(schur_->matrix());
  solver_->set(petsc_->free->matrix(), petsc_->free->matrix());
  preconditioner_->set_up(displacement_);
}

algebra::LinearReport MixedSolver::solve_again(std::span<const double> b, std::span<double> x,
                                               double forcing) {
  algebra::LinearReport report = attempt(b, forcing);
  if (!report.converged && !direct_ && factorisation_serves()) {
    make_solver(true);
    set_operators();
    const int spent = report.iterations;
    report = attempt(b, forcing);
    report.iterations += spent;
  }
  const auto all = std::span<const double>(solution_);
  std::copy_n(all.begin(), b.size(), x.begin());
  pressure_.expect(all.first(b.size()), all.subspan(b.size()));
  return report;
}

algebra::LinearReport MixedSolver::attempt(std::span<const double> b, double forcing) {
  const Stopwatch watch(seconds_solve_);
  right_.assign(b.begin(), b.end());
  right_.resize(b.size() + static_cast<std::size_t>(mesh_.n_owned_nodes * pressure_.fields()), 0.0);
  solution_.assign(right_.size(), 0.0);
  return solve_to(direct_ ? std::min(k_direct_tolerance, options_.relative_tolerance)
                          : std::max(forcing, options_.relative_tolerance),
                  b);
}

/// Until ‖r_u + B (C+S)⁻¹ r_p‖ <= relative ‖b‖.
algebra::LinearReport MixedSolver::solve_to(double relative, std::span<const double> b) {
  const double goal = relative * norm(b);
  algebra::LinearReport report;
  residual_ = right_;
  direction_.resize(right_.size());
  for (int round = 0;; ++round) {
    const algebra::LinearReport part = solve_once(goal * tightening_);
    report.iterations += part.iterations;
    report.converged = part.converged;
    report.reason = part.reason;
    for (std::size_t i = 0; i < solution_.size(); ++i) solution_[i] += direction_[i];
    const double reduced = reduced_residual();
    if (!part.converged || !(reduced > goal) || round == k_max_rounds) return report;
    tightening_ *= std::clamp(k_safety * goal / reduced, k_tightest_round, k_loosest_round);
  }
}

/// Of the present solution, whose pressure becomes the one that goes with its displacement; leaves the whole
/// residual in residual_.
double MixedSolver::reduced_residual() {
  const std::size_t n = right_.size() - static_cast<std::size_t>(mesh_.n_owned_nodes * pressure_.fields());
  const auto subtract = [this](std::span<const double> x) {
    multiply(x, direction_);
    for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] -= direction_[i];
  };
  residual_ = right_;
  subtract(solution_);
  std::vector<double> correction(right_.size(), 0.0);
  const std::span<double> of_pressure = std::span(correction).subspan(n);
  pressure_.solve_linear(std::span<const double>(residual_).subspan(n), of_pressure, k_correction);
  for (std::size_t i = n; i < correction.size(); ++i) correction[i] = -correction[i];
  for (std::size_t i = n; i < correction.size(); ++i) solution_[i] += correction[i];
  subtract(correction);
  return norm(std::span<const double>(residual_).first(n));
}

/// What the operator has and the assembled matrix has not: the projection, and less augmentation.
void MixedSolver::add_terms(std::span<const double> x, std::span<double> y) {
  const auto n = static_cast<std::size_t>(mesh_.n_owned_nodes * displacement_.block_size());
  pressure_.add_projection_to(x.subspan(n), 1.0, y.subspan(n));
  if (!augmented_) return;
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
  make_solver(!augmented_);
}

std::size_t MixedSolver::bytes() const {
  return matrix_.bytes() + compliance_->bytes() + (schur_ ? schur_->bytes() : 0) +
         (preconditioner_ ? preconditioner_->bytes() : 0);
}

}  // namespace solidus::mechanics
