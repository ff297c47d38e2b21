/// As the saddle solver of mechanics with the temperatures as a third block: block triangular
/// preconditioning from the temperatures up, or factors of the assembled matrix.
#include "coupling/coupled_saddle_solver.hpp"

#include <algorithm>
#include <cassert>

#include "linear/automatic_solver.hpp"
#include "numbers/index_casts.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::coupling {

namespace {

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
  return as_size(mesh_.n_owned_nodes) * as_size(matrix_.components());
}

std::size_t CoupledSaddleSolver::n_pressures() const {
  return as_size(mesh_.n_owned_nodes) * as_size(matrix_.pressures());
}

void CoupledSaddleSolver::reset() {
  find_unknowns();
  make_solver(factorises());
}

void CoupledSaddleSolver::find_unknowns() {
  unknowns_.emplace(mesh_, matrix_, pressure_.absent(), ghosts_);
  work_.right.resize(unknowns_->size());
  work_.solution.resize(unknowns_->size());
  copy_.reset();
  const auto n_local = mesh_.x.size();
  work_.whole.resize(n_displacements() + n_pressures() + as_size(mesh_.n_owned_nodes));
  work_.product.resize(work_.whole.size());
  work_.part.resize(work_.whole.size());
  work_.local_u.resize(n_local * as_size(matrix_.components()));
  work_.local_p.resize(n_local * as_size(matrix_.pressures()));
  work_.local_t.resize(n_local);
}

bool CoupledSaddleSolver::factorises() const {
  return !mechanics::SaddlePreconditioner::serves(matrix_.displacement()) ||
         linear::factorises_coupled(kind_, {mesh_.dimension, unknowns_->n_global()}, true);
}

void CoupledSaddleSolver::make_solver(bool direct) {
  // What the other kind of solver held is let go first, since both together may not fit into
  // memory.
  outer_.direct = direct;
  hierarchy_.renew();
  copy_.reset();
  const auto product = [this](std::span<const double> x, std::span<double> y) { multiply(x, y); };
  saddle_.reset();
  heat_.solver.reset();
  // A factorisation of the assembled matrix; the product adds the projection of the stabilisation.
  if (direct) {
    outer_.iterative.reset();
    outer_.factorised.emplace(linear::KrylovOptions{.prefix = "coupled_", .symmetric = false});
    outer_.matrix =
        std::make_unique<linear::FunctionMatrix>(static_cast<std::int64_t>(unknowns_->size()), product);
    return;
  }
  outer_.factorised.reset();
  outer_.matrix.reset();
  // The matrix of displacements is whole, symmetric or not.
  saddle_.emplace(mesh_, *matrix_.saddle(), pressure_, ghosts_, false);
  heat_.solver.emplace(mesh_, linear::LinearSolverOptions{.prefix = "coupled_temperature_",
                                                          .kind = linear::SolverKind::incomplete,
                                                          .symmetric = false,
                                                          .relative_tolerance = k_temperature_tolerance});
  outer_.iterative.emplace();
  outer_.iterative->set(product,
                        [this](std::span<const double> r, std::span<double> z) { precondition(r, z); });
}

void CoupledSaddleSolver::set_up() {
  const profile::Part part("solver set-up");
  // Either a factorisation of the whole matrix, or the Schur complement and, when stiffness has grown, a new
  // hierarchy.
  if (outer_.direct) {
    Mat assembled = copy_.copy(mesh_, matrix_, *unknowns_, weights_.force, weights_.heat);
    outer_.factorised->set(pressure_.projection() != nullptr ? outer_.matrix->matrix() : assembled,
                           assembled);
    return;
  }
  saddle_->set_up_schur();
  if (hierarchy_.stale_for(matrix_.displacement())) {
    saddle_->set_up_displacement();
    hierarchy_.made_for(matrix_.displacement());
  }
  heat_.changed = true;
  outer_.iterative->operator_changed();
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
  unknowns_->expand(x, work_.whole);
  std::copy_n(work_.whole.begin(), n_u, work_.local_u.begin());
  std::copy_n(work_.whole.begin() + static_cast<std::ptrdiff_t>(n_u), n_p, work_.local_p.begin());
  std::copy(work_.whole.begin() + static_cast<std::ptrdiff_t>(n_u + n_p), work_.whole.end(),
            work_.local_t.begin());
  ghosts_.update(work_.local_u, matrix_.components());
  ghosts_.update(work_.local_p, matrix_.pressures());
  ghosts_.update(work_.local_t, 1);
  const auto of_u = [&](std::vector<double>& v) { return std::span(v).first(n_u); };
  const auto of_p = [&](std::vector<double>& v) { return std::span(v).subspan(n_u, n_p); };
  const auto of_t = [&](std::vector<double>& v) { return std::span(v).subspan(n_u + n_p); };
  const auto add_part = [&] {
    for (std::size_t i = 0; i < work_.product.size(); ++i) work_.product[i] += work_.part[i];
  };
  // Each block of the matrix adds its product, and the rows are weighted as the right-hand side is.
  matrix_.saddle()->multiply(work_.local_u, work_.local_p, of_u(work_.product), of_p(work_.product));
  mechanics::add_projection(pressure_, of_p(work_.whole), 1.0, of_p(work_.product));
  matrix_.temperature().multiply(work_.local_t, of_t(work_.product));
  matrix_.multiply_force(work_.local_t, of_u(work_.part));
  matrix_.multiply_volume(work_.local_t, of_p(work_.part));
  // Heat by displacement is added before `work_.part` is reused for heat by pressure.
  matrix_.multiply_heat(work_.local_u, of_t(work_.part));
  add_part();
  std::fill_n(work_.part.begin(), n_u + n_p, 0.0);
  matrix_.multiply_heat_of_pressure(work_.local_p, of_t(work_.part));
  add_part();
  weight(work_.product, false);
  unknowns_->restrict_to(work_.product, y);
}

void CoupledSaddleSolver::find_temperatures(std::span<const double> heat, std::span<double> temperature) {
  // An approximate direction suffices for a preconditioner: the report is not used.
  if (heat_.changed)
    heat_.solver->solve(matrix_.temperature(), heat, temperature, k_temperature_tolerance);
  else
    heat_.solver->solve_again(heat, temperature, k_temperature_tolerance);
  heat_.changed = false;
}

void CoupledSaddleSolver::precondition(std::span<const double> r, std::span<double> z) {
  const std::size_t n_u = n_displacements(), n_p = n_pressures();
  // Temperatures first; their forces go over to the right-hand side of displacements and pressures.
  unknowns_->expand(r, work_.whole);
  weight(work_.whole, true);
  const std::span<double> temperature = std::span(work_.product).subspan(n_u + n_p);
  find_temperatures(std::span<const double>(work_.whole).subspan(n_u + n_p), temperature);
  std::copy(temperature.begin(), temperature.end(), work_.local_t.begin());
  ghosts_.update(work_.local_t, 1);
  matrix_.multiply_force(work_.local_t, std::span(work_.part).first(n_u));
  matrix_.multiply_volume(work_.local_t, std::span(work_.part).subspan(n_u, n_p));
  for (std::size_t i = 0; i < n_u + n_p; ++i) work_.whole[i] -= work_.part[i];
  // Nothing where there is no unknown.
  unknowns_->restrict_to(work_.whole, z);
  unknowns_->expand(z, work_.whole);
  saddle_->apply(std::span<const double>(work_.whole).first(n_u + n_p),
                 std::span(work_.product).first(n_u + n_p));
  unknowns_->restrict_to(work_.product, z);
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
  unknowns_->restrict_to(whole, work_.right);
  set_up();
  linear::LinearReport report;
  // As in the saddle solver of mechanics: an old hierarchy that fails is renewed, then a
  // factorisation is tried.
  for (bool again = true; again;) {
    again = false;
    const double relative =
        outer_.direct ? std::min(k_direct_tolerance, tightest_) : std::max(forcing, tightest_);
    const int spent = report.iterations;
    report = outer_.direct ? outer_.factorised->solve(work_.right, work_.solution, relative)
                           : outer_.iterative->solve(work_.right, work_.solution, relative);
    if (!outer_.direct) {
      const bool was_new = hierarchy_.stale();
      hierarchy_.judge(report, relative);
      again = !report.converged && (!was_new || unknowns_->n_global() < linear::k_saddle_rescue_limit);
      if (again && was_new) make_solver(true);
      if (again) set_up();
    }
    report.iterations += spent;
  }
  unknowns_->expand(work_.solution, whole);
  std::copy_n(whole.begin(), u.size(), u.begin());
  std::copy(whole.begin() + static_cast<std::ptrdiff_t>(u.size()), whole.end(), temperature.begin());
  return report;
}

}  // namespace solidus::coupling
