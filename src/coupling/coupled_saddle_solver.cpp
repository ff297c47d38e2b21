/// As the saddle solver of mechanics with the temperatures as a third block: block triangular
/// preconditioning from the temperatures up, or factors of the assembled matrix.
#include "coupling/coupled_saddle_solver.hpp"

#include <algorithm>
#include <cassert>

#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::coupling {

namespace {

/// Unknowns up to which a factorisation is the default in three dimensions. Of 5 300 unknowns of tetrahedra
/// that flow a step takes 0.68 s with it and 0.08 s with GMRES.
constexpr GlobalIndex k_direct_limit_3d = 3000;
/// Up to so many unknowns a factorisation takes over where GMRES fails.
constexpr GlobalIndex k_rescue_limit = 200000;
/// With a factorisation, whatever the forcing term: a step of flexible GMRES costs a hundredth of it.
constexpr double k_direct_tolerance = 1e-8;
/// The relative residual of solves with K_ΘΘ in the preconditioner: an iteration of them costs a hundredth of
/// the cycle on the displacements.
constexpr double k_temperature_tolerance = 1e-2;

}  // namespace

CoupledSaddleSolver::CoupledSaddleSolver(const mesh::Mesh& mesh, linear::CoupledMatrix& matrix,
                                         mechanics::NodalPressure& pressure,
                                         const parallel::GhostExchange& ghosts,
                                         linear::CoupledSolverKind kind, double relative_tolerance)
    : mesh_(mesh),
      matrix_(matrix),
      pressure_(pressure),
      ghosts_(ghosts),
      kind_(kind),
      tightest_(relative_tolerance) {
  reset();
}

std::size_t CoupledSaddleSolver::n_displacements() const {
  return static_cast<std::size_t>(mesh_.n_owned_nodes) * static_cast<std::size_t>(matrix_.components());
}

std::size_t CoupledSaddleSolver::n_pressures() const {
  return static_cast<std::size_t>(mesh_.n_owned_nodes) * static_cast<std::size_t>(matrix_.pressures());
}

void CoupledSaddleSolver::reset() {
  find_unknowns();
  make_solver(factorises());
}

void CoupledSaddleSolver::find_unknowns() {
  unknowns_.emplace(mesh_, matrix_, pressure_.absent(), ghosts_);
  right_.resize(unknowns_->size());
  solution_.resize(unknowns_->size());
  copy_.reset();
  const auto n_local = mesh_.x.size();
  whole_.resize(n_displacements() + n_pressures() + static_cast<std::size_t>(mesh_.n_owned_nodes));
  product_.resize(whole_.size());
  part_.resize(whole_.size());
  local_u_.resize(n_local * static_cast<std::size_t>(matrix_.components()));
  local_p_.resize(n_local * static_cast<std::size_t>(matrix_.pressures()));
  local_t_.resize(n_local);
}

bool CoupledSaddleSolver::factorises() const {
  return !mechanics::SaddlePreconditioner::serves(matrix_.displacement()) ||
         linear::is_direct(kind_, mesh_.dimension, unknowns_->n_global(), k_direct_limit_3d);
}

void CoupledSaddleSolver::make_solver(bool direct) {
  // What the other kind of solver held is let go first, since both together may not fit into
  // memory.
  direct_ = direct;
  hierarchy_.renew();
  copy_.reset();
  const auto product = [this](std::span<const double> x, std::span<double> y) { multiply(x, y); };
  saddle_.reset();
  temperatures_.reset();
  // A factorisation of the assembled matrix; the product adds the projection of the stabilisation.
  if (direct) {
    iterative_.reset();
    factorised_.emplace(linear::KrylovOptions{.prefix = "coupled_", .symmetric = false});
    operator_ =
        std::make_unique<linear::FunctionMatrix>(static_cast<std::int64_t>(unknowns_->size()), product);
    return;
  }
  factorised_.reset();
  operator_.reset();
  // The matrix of displacements is whole, symmetric or not.
  saddle_.emplace(mesh_, *matrix_.saddle(), pressure_, ghosts_, false);
  temperatures_.emplace(mesh_, linear::LinearSolverOptions{.prefix = "coupled_temperature_",
                                                           .kind = linear::SolverKind::incomplete,
                                                           .symmetric = false,
                                                           .relative_tolerance = k_temperature_tolerance});
  iterative_.emplace();
  iterative_->set(product, [this](std::span<const double> r, std::span<double> z) { precondition(r, z); });
}

void CoupledSaddleSolver::set_up() {
  const profile::Part part("solver set-up");
  // Either a factorisation of the whole matrix, or the Schur complement and, when stiffness has grown, a new
  // hierarchy.
  if (direct_) {
    Mat assembled = copy_.copy(mesh_, matrix_, *unknowns_, weights_.force, weights_.heat);
    factorised_->set(pressure_.orthogonal() ? operator_->matrix() : assembled, assembled);
    return;
  }
  saddle_->set_up_schur();
  if (hierarchy_.stale_for(matrix_.displacement())) {
    saddle_->set_up_displacement();
    hierarchy_.made_for(matrix_.displacement());
  }
  new_temperatures_ = true;
  iterative_->operator_changed();
}

void CoupledSaddleSolver::weight(std::span<double> whole, bool divide) const {
  const std::size_t n_mechanical = n_displacements() + n_pressures();
  const double force = divide ? 1 / weights_.force : weights_.force,
               heat = divide ? 1 / weights_.heat : weights_.heat;
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i] *= i < n_mechanical ? force : heat;
}

void CoupledSaddleSolver::multiply(std::span<const double> x, std::span<double> y) {
  // The vector holds free unknowns alone: it is expanded to displacements, pressures and temperatures, whose
  // ghosts are then brought up to date.
  const std::size_t n_u = n_displacements(), n_p = n_pressures();
  unknowns_->expand(x, whole_);
  std::copy_n(whole_.begin(), n_u, local_u_.begin());
  std::copy_n(whole_.begin() + static_cast<std::ptrdiff_t>(n_u), n_p, local_p_.begin());
  std::copy(whole_.begin() + static_cast<std::ptrdiff_t>(n_u + n_p), whole_.end(), local_t_.begin());
  ghosts_.update(local_u_, matrix_.components());
  ghosts_.update(local_p_, matrix_.pressures());
  ghosts_.update(local_t_, 1);
  const auto of_u = [&](std::vector<double>& v) { return std::span(v).first(n_u); };
  const auto of_p = [&](std::vector<double>& v) { return std::span(v).subspan(n_u, n_p); };
  const auto of_t = [&](std::vector<double>& v) { return std::span(v).subspan(n_u + n_p); };
  const auto add_part = [&] {
    for (std::size_t i = 0; i < product_.size(); ++i) product_[i] += part_[i];
  };
  // Each block of the matrix adds its product, and the rows are weighted as the right-hand side is.
  matrix_.saddle()->multiply(local_u_, local_p_, of_u(product_), of_p(product_));
  pressure_.add_projection_to(of_p(whole_), 1.0, of_p(product_));
  matrix_.temperature().multiply(local_t_, of_t(product_));
  matrix_.multiply_force(local_t_, of_u(part_));
  matrix_.multiply_volume(local_t_, of_p(part_));
  // Heat by displacement is added before `part_` is reused for heat by pressure.
  matrix_.multiply_heat(local_u_, of_t(part_));
  add_part();
  std::fill_n(part_.begin(), n_u + n_p, 0.0);
  matrix_.multiply_heat_of_pressure(local_p_, of_t(part_));
  add_part();
  weight(product_, false);
  unknowns_->restrict_to(product_, y);
}

void CoupledSaddleSolver::find_temperatures(std::span<const double> heat, std::span<double> temperature) {
  // An approximate direction suffices for a preconditioner: the report is not used.
  if (new_temperatures_)
    temperatures_->solve(matrix_.temperature(), heat, temperature, k_temperature_tolerance);
  else
    temperatures_->solve_again(heat, temperature, k_temperature_tolerance);
  new_temperatures_ = false;
}

void CoupledSaddleSolver::precondition(std::span<const double> r, std::span<double> z) {
  const std::size_t n_u = n_displacements(), n_p = n_pressures();
  // Temperatures first; their forces go over to the right-hand side of displacements and pressures.
  unknowns_->expand(r, whole_);
  weight(whole_, true);
  const std::span<double> temperature = std::span(product_).subspan(n_u + n_p);
  find_temperatures(std::span<const double>(whole_).subspan(n_u + n_p), temperature);
  std::copy(temperature.begin(), temperature.end(), local_t_.begin());
  ghosts_.update(local_t_, 1);
  matrix_.multiply_force(local_t_, std::span(part_).first(n_u));
  matrix_.multiply_volume(local_t_, std::span(part_).subspan(n_u, n_p));
  for (std::size_t i = 0; i < n_u + n_p; ++i) whole_[i] -= part_[i];
  // Nothing where there is no unknown.
  unknowns_->restrict_to(whole_, z);
  unknowns_->expand(z, whole_);
  saddle_->apply(std::span<const double>(whole_).first(n_u + n_p), std::span(product_).first(n_u + n_p));
  unknowns_->restrict_to(product_, z);
}

linear::LinearReport CoupledSaddleSolver::solve([[maybe_unused]] linear::CoupledMatrix& a,
                                                std::span<const double> force, std::span<const double> heat,
                                                linear::FieldWeights weights, std::span<double> u,
                                                std::span<double> temperature, double forcing) {
  assert(&a == &matrix_);
  const Stopwatch watch(seconds_);
  weights_ = weights;
  // From the monotone form to the symmetric one.
  std::vector<double> whole(force.begin(), force.end());
  for (std::size_t i = n_displacements(); i < whole.size(); ++i) whole[i] = -whole[i];
  whole.insert(whole.end(), heat.begin(), heat.end());
  weight(whole, false);
  // Right-hand sides are summed already: those of followers are zero.
  unknowns_->restrict_to(whole, right_);
  set_up();
  linear::LinearReport report;
  // As in the saddle solver of mechanics: an old hierarchy that fails is renewed, then a
  // factorisation is tried.
  for (bool again = true; again;) {
    again = false;
    const double relative = direct_ ? std::min(k_direct_tolerance, tightest_) : std::max(forcing, tightest_);
    const int spent = report.iterations;
    report = direct_ ? factorised_->solve(right_, solution_, relative)
                     : iterative_->solve(right_, solution_, relative);
    if (!direct_) {
      const bool was_new = hierarchy_.stale();
      hierarchy_.judge(report, relative);
      again = !report.converged && (!was_new || unknowns_->n_global() < k_rescue_limit);
      if (again && was_new) make_solver(true);
      if (again) set_up();
    }
    report.iterations += spent;
  }
  unknowns_->expand(solution_, whole);
  std::copy_n(whole.begin(), u.size(), u.begin());
  std::copy(whole.begin() + static_cast<std::ptrdiff_t>(u.size()), whole.end(), temperature.begin());
  return report;
}

}  // namespace solidus::coupling
