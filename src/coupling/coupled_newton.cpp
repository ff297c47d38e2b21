#include "coupling/coupled_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coupling/contact_states.hpp"
#include "coupling/coupled_saddle_solver.hpp"
#include "coupling/longest_way.hpp"
#include "heat/thermal_parts.hpp"
#include "mechanics/mechanical_failure.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::coupling {

namespace {

constexpr int k_plain_steps = 4;         ///< before equilibrium is looked at
constexpr double k_stalls = 0.1;         ///< a residual above this share of the one before
constexpr int k_full_steps = 15;         ///< before steps are halved for more than their numbers' sake
constexpr std::size_t k_remembered = 5;  ///< residuals that a step may rise to
constexpr int k_halvings = 8;
constexpr double k_loosest = 1e-2;  ///< forcing term: assembly costs as much as ten linear iterations
/// A step of the displacements, relative to their motion, and heat out of balance, relative to the heat
/// moved, above which neither counts as rounding.
constexpr double k_rounding_step = 1e-8, k_rounding_heat = 1e-6;
constexpr int k_lost = 3;  ///< iterates without an equilibrium before the iteration ends
/// The residual of an iterate that cannot be evaluated.
constexpr CoupledResidual k_nowhere{std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};
constexpr double k_far_off = 1e6;  ///< a residual that rises so much even after halving ends the iteration

/// Whether heat has gained less than a digit in each of two iterations.
bool heat_stalls(const std::vector<CoupledResidual>& residuals) {
  const std::size_t n = residuals.size();
  return n >= 3 && residuals[n - 1].heat > k_stalls * residuals[n - 2].heat &&
         residuals[n - 2].heat > k_stalls * residuals[n - 3].heat;
}

/// Sets ∂r_Θ/∂u and ∂r_Θ/∂p to zero.
void drop_heat_of_motion(linear::CoupledMatrix& matrix) {
  constexpr linear::CoupledMatrix::Slot k_scrap = -1;  // the first one
  const std::size_t n = (matrix.displacement().columns().size() + 1) * as_size(matrix.fields());
  std::fill_n(matrix.heat_by_displacement(k_scrap), n * as_size(matrix.components()), 0.0);
  if (matrix.pressures() > 0)
    std::fill_n(matrix.heat_by_pressure(k_scrap), n * as_size(matrix.pressures()), 0.0);
}

}  // namespace

double CoupledResidual::size() const {
  return std::hypot(force, heat);
}

CoupledNewton::CoupledNewton(const Phases& phases, linear::CoupledSolverKind solver)
    : phases_(phases),
      mechanics_(*phases.mechanics),
      thermal_(std::make_unique<heat::ThermalIteration>(*phases.heat)),
      matrix_(mechanics_.mesh(), mechanics_.system().matrix(), phases.heat->parts().system->matrix(),
              mechanics_.system().saddle() != nullptr ? &mechanics_.system().saddle()->matrix() : nullptr),
      ghosts_(mechanics_.mesh()) {
  // The solver depends on the elements: those with a pressure make a saddle point, others two fields. Kernels
  // are bound to both matrices.
  const mesh::Mesh& mesh = mechanics_.mesh();
  const double tolerance = mechanics_.bodies().options.linear_tolerance;
  if (mechanics_.bodies().pressure != nullptr)
    solver_ = std::make_unique<CoupledSaddleSolver>(mesh, matrix_, *mechanics_.bodies().pressure, ghosts_,
                                                    solver, tolerance);
  else
    solver_ =
        std::make_unique<linear::CoupledSolver>(mesh, mechanics_.bodies().components, solver, tolerance);
  for (const auto& block : mechanics_.bodies().blocks) {
    auto& kernel = dynamic_cast<mechanics::CoupledKernel&>(*block);
    kernel.bind_heat(phases.heat->parts().system->matrix());
    kernels_.push_back(&kernel);
  }
  const auto n_owned = as_size(mesh.n_owned_nodes);
  force_.resize(mechanics_.bodies().n_residuals());
  work_.owned_step.resize(force_.size());
  work_.step_u.resize(mesh.x.size() * as_size(mechanics_.bodies().components + matrix_.pressures()));
  work_.step_t.resize(mesh.x.size());
  work_.further.resize(n_owned);
  work_.scratch.resize(std::max(force_.size(), n_owned));
}

std::size_t CoupledNewton::n_owned_displacements() const {
  return work_.further.size() * as_size(mechanics_.bodies().components);
}

CoupledResidual CoupledNewton::evaluate(const mechanics::MechanicalState& old,
                                        const mechanics::MechanicalPass& pass, std::span<const double> x) {
  // The residual of both fields at one iterate: contact and mechanics at its temperatures, then heat with the
  // deformation that mechanics has found.
  release_deformation();
  mechanics_.equations().prepare(old, pass);
  set_contact_temperatures();
  for (contact::ContactPair* pair : phases_.contacts)
    pair->update(x.first(mechanics_.bodies().n_displacements()));
  progress_.reference = mechanics_.equations().residual(x, force_);
  const std::vector<char>& fixed = mechanics_.system().matrix().fixed();
  const std::span<double> of_displacement = std::span(force_).first(n_owned_displacements());
  for (std::size_t i = 0; i < of_displacement.size(); ++i)
    if (fixed[i]) of_displacement[i] = 0;
  mechanics_.system().matrix().constraints().sum(of_displacement);
  double squares = 0;
  for (const double r : force_) squares += r * r;
  progress_.norm = std::sqrt(parallel::global_sum(squares));

  mechanics_.bodies().finish(old, x, history_, nullptr, nullptr, nullptr, &deformation_);
  if (phases_.structural != nullptr) phases_.structural->set_deformation(deformation_);
  thermal_->equations().evaluate();
  return present();
}

void CoupledNewton::release_deformation() {
  deformation_.clear();
  if (phases_.structural != nullptr) phases_.structural->release();
}

void CoupledNewton::set_contact_temperatures() {
  for (contact::ContactPair* pair : phases_.contacts) pair->set_temperature(thermal_->state().temperature);
}

CoupledResidual CoupledNewton::present() const {
  const auto ratio = [](double norm, double reference) { return reference > 0 ? norm / reference : norm; };
  return {ratio(progress_.norm, progress_.reference),
          ratio(thermal_->equations().imbalance().unbalanced, thermal_->equations().imbalance().moved)};
}

double CoupledNewton::goal() const {
  const linear::NewtonOptions& options = mechanics_.bodies().options.newton;
  return std::max({options.tolerance * progress_.reference, options.absolute_tolerance,
                   mechanics_.equations().round_off()});
}

bool CoupledNewton::balanced() const {
  return progress_.norm <= goal() && (thermal_->equations().converged() || heat_is_rounding());
}

bool CoupledNewton::heat_is_rounding() const {
  return progress_.norm <= goal() && progress_.next_step <= k_rounding_step &&
         thermal_->equations().imbalance().unbalanced <=
             std::min(2 * progress_.shifted_heat, k_rounding_heat * thermal_->equations().imbalance().moved);
}

bool CoupledNewton::converged() const {
  const double allowed = mechanics_.bodies().options.newton.step_tolerance;
  return balanced() && (allowed <= 0 || progress_.next_step <= allowed ||
                        progress_.norm <= mechanics_.equations().round_off());
}

linear::CoupledMatrix& CoupledNewton::assemble(const mechanics::MechanicalState& old,
                                               std::span<const double> x, int iteration) {
  // Tangents of both fields; if contact has changed the graph of heat, kernels are bound again.
  mechanics_.equations().tangent(x);
  if (phases_.heat->parts().follow_graph())
    for (mechanics::CoupledKernel* kernel : kernels_)
      kernel->bind_heat(phases_.heat->parts().system->matrix());
  if (matrix_.set_zero()) solver_->reset();
  thermal_->equations().assemble(iteration);
  const mechanics::NodalPressure* const pressure = mechanics_.bodies().pressure.get();
  const mechanics::CoupledIterate at{
      .form = phases_.structural != nullptr ? std::optional(phases_.structural->form()) : std::nullopt,
      .old_u = old.displacement,
      .u = x.first(mechanics_.bodies().n_displacements()),
      .temperature = thermal_->state().temperature,
      .pressure_unit = pressure != nullptr ? pressure->unit() : 1};
  for (mechanics::CoupledKernel* kernel : kernels_) kernel->add_coupling(at, matrix_);
  for (const contact::ContactPair* pair : phases_.contacts)
    pair->parts().heat.add_coupling(thermal_->state().temperature, matrix_);
  return matrix_;
}

void CoupledNewton::multiply_heat(std::span<const double> x, std::span<double> heat) {
  matrix_.multiply_heat(x, heat);
  if (matrix_.pressures() == 0) return;
  const std::span<double> part = std::span(work_.scratch).first(heat.size());
  matrix_.multiply_heat_of_pressure(x.subspan(mechanics_.bodies().n_displacements()), part);
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] += part[i];
}

void CoupledNewton::multiply(std::span<const double> x, std::span<const double> temperature,
                             std::span<double> force, std::span<double> heat) {
  // The product of the whole coupled matrix, block by block: forces by temperature and displacement, volume
  // by both, heat by temperature and motion.
  const std::span<const double> u = x.first(mechanics_.bodies().n_displacements()), p = x.subspan(u.size());
  const std::span<double> of_u = force.first(n_owned_displacements()), of_p = force.subspan(of_u.size());
  const std::span<double> part = std::span(work_.scratch).first(force.size());
  matrix_.multiply_force(temperature, part.first(of_u.size()));
  if (matrix_.pressures() == 0) {
    matrix_.displacement().multiply(u, of_u);
  } else {
    matrix_.multiply_volume(temperature, part.subspan(of_u.size()));
    matrix_.saddle()->multiply(u, p, of_u, of_p);
    mechanics::add_projection(*mechanics_.bodies().pressure, p.first(of_p.size()), 1.0, of_p);
  }
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += part[i];
  for (double& value : of_p) value = -value;  // the monotone form
  matrix_.temperature().multiply(temperature, heat);
  std::vector<double> of_motion(heat.size());
  multiply_heat(x, of_motion);
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] += of_motion[i];
}

void CoupledNewton::spread(std::span<const double> owned, std::span<double> x) const {
  const std::size_t n_u = n_owned_displacements();
  std::copy_n(owned.begin(), n_u, x.begin());
  ghosts_.update(x.first(mechanics_.bodies().n_displacements()), mechanics_.bodies().components);
  if (mechanics_.bodies().pressure == nullptr) return;
  const std::span<double> p = x.subspan(mechanics_.bodies().n_displacements());
  std::copy(owned.begin() + static_cast<std::ptrdiff_t>(n_u), owned.end(), p.begin());
  ghosts_.update(p, mechanics_.bodies().pressure->fields().n_fields);
}

linear::FieldWeights CoupledNewton::weights() {
  const std::span<const double> heat = thermal_->equations().right_hand_side();
  double squares[2] = {0, 0};
  for (std::size_t i = 0; i < heat.size(); ++i) {
    work_.step_t[i] = heat[i] / *matrix_.temperature().diagonal_block(as_index(i));
    squares[0] += heat[i] * heat[i];
  }
  ghosts_.update(work_.step_t, 1);
  const std::span<double> caused = std::span(work_.scratch).first(force_.size());
  matrix_.multiply_force(work_.step_t, caused.first(n_owned_displacements()));
  if (matrix_.pressures() > 0) matrix_.multiply_volume(work_.step_t, caused.subspan(n_owned_displacements()));
  for (const double f : caused) squares[1] += f * f;
  const double of_heat = std::sqrt(parallel::global_sum(squares[0]));
  const double of_force = std::max(progress_.norm, std::sqrt(parallel::global_sum(squares[1])));
  return {of_force > 0 ? 1.0 / of_force : 1.0, of_heat > 0 ? 1.0 / of_heat : 1.0};
}

double CoupledNewton::forcing_term(linear::Forcing& forcing, const linear::FieldWeights& weights) const {
  const linear::FieldWeights in_use = solver_->in_use(weights);
  // In the norm of the linear solver.
  const double force = in_use.force * progress_.norm, heat = in_use.heat / weights.heat;
  const auto left = [](double norm, double goal) { return goal > 0 ? norm / goal : 1.0; };
  const double force_left = left(progress_.norm, goal()),
               heat_left = left(
                   thermal_->equations().imbalance().unbalanced,
                   thermal_->equations().imbalance().tolerance * thermal_->equations().imbalance().moved);
  return forcing.next(std::max(force_left, heat_left),
                      std::min(force / force_left, heat / heat_left) / std::hypot(force, heat));
}

bool CoupledNewton::find_direction(linear::Forcing& forcing, CoupledReport& report, std::string& failure) {
  const linear::FieldWeights scales = weights();
  const double eta = forcing_term(forcing, scales);
  for (double& r : force_) r = -r;
  const linear::LinearReport linear =
      solver_->solve(matrix_, force_, thermal_->equations().right_hand_side(), scales, work_.owned_step,
                     std::span(work_.step_t).first(work_.further.size()), eta);
  for (double& r : force_) r = -r;
  report.linear_iterations += linear.iterations;
  if (!linear.converged) {
    failure = linear.reason;
    return false;
  }
  const std::vector<char>& fixed = mechanics_.system().matrix().fixed();
  const std::span<double> owned_u = std::span(work_.owned_step).first(n_owned_displacements());
  for (std::size_t i = 0; i < owned_u.size(); ++i)
    if (fixed[i]) owned_u[i] = 0;
  mechanics_.system().matrix().constraints().share(owned_u);
  spread(work_.owned_step, work_.step_u);
  multiply_heat(work_.step_u, work_.further);
  progress_.shifted_heat = 0;
  if (progress_.norm <= goal()) {
    double sum = 0;
    for (const double heat : work_.further) sum += std::abs(heat);
    progress_.shifted_heat = parallel::global_sum(sum);
  }
  thermal_->equations().set_direction(work_.step_t, work_.further);
  return true;
}

CoupledResidual CoupledNewton::evaluate_at(double alpha, const mechanics::MechanicalState& old,
                                           const mechanics::MechanicalPass& pass, std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = work_.start_u[i] + alpha * work_.step_u[i];
  thermal_->equations().move(alpha);
  const auto& temperature = thermal_->state().temperature;
  const double coldest =
      temperature.empty() ? 1.0 : *std::min_element(temperature.begin(), temperature.end());
  if (!(parallel::global_min(coldest) > 0)) return k_nowhere;
  // Where iterates are kept in equilibrium, forces are solved for at the trial temperatures. Too many without
  // any equilibrium end the attempt.
  if (progress_.in_equilibrium) {
    const bool whole = tangent_ == Tangent::whole;
    if (!whole) x = work_.start_u;  // in equilibrium with the temperatures there
    set_contact_temperatures();
    if (!equilibrate(old, pass, x)) {
      if (++progress_.lost > k_lost)
        mechanics::reject(mechanics_, "iterates of both fields have no equilibrium", x);
      if (!whole) return k_nowhere;  // else the step is accepted as it is
    }
  }
  return evaluate(old, pass, x);
}

bool CoupledNewton::equilibrate(const mechanics::MechanicalState& old, mechanics::MechanicalPass pass,
                                std::vector<double>& x) {
  // Equilibrium at the temperatures of the iterate, by the mechanical phase itself, from the iterate's
  // displacements and pressures.
  mechanics::MechanicalState iterate = old;
  const auto n_u = static_cast<std::ptrdiff_t>(mechanics_.bodies().n_displacements());
  iterate.displacement.assign(x.begin(), x.begin() + n_u);
  if (mechanics_.bodies().pressure != nullptr) {
    iterate.pressure.assign(x.begin() + n_u, x.end());
    for (double& p : iterate.pressure) p *= mechanics_.bodies().pressure->unit();
  }
  pass.iterate = &iterate;
  release_deformation();
  if (tangent_ == Tangent::without_heat_of_motion)
    for (contact::ContactPair* pair : phases_.contacts)
      pair->parts().forces.term().stabilisation().hold(k_firm_hold);
  try {
    mechanics_.solve(old, iterate, pass);
    x = mechanics_.bodies().start(old, pass);
    return true;
  } catch (const StepRejected&) {
    return false;
  }
}

double CoupledNewton::move(const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
                           std::vector<double>& x, const CoupledReport& report) {
  // A step is accepted if the residual stays below the largest of the last few iterations.
  work_.start_u = x;
  double highest = 0;
  const std::size_t n = report.residuals.size();
  for (std::size_t i = n > k_remembered ? n - k_remembered : 0; i < n; ++i)
    highest = std::max(highest, report.residuals[i].size());
  const bool full = tangent_ == Tangent::whole && report.iterations <= k_full_steps;
  double alpha = factor_of_longest_way(mechanics_.mesh(),
                                       std::span(work_.step_u).first(mechanics_.bodies().n_displacements()),
                                       mechanics_.bodies().components);
  double best = alpha, least = std::numeric_limits<double>::infinity();
  // Steps are halved until one is acceptable; else the best one is taken, unless it is far worse.
  for (int k = 0; k <= k_halvings; ++k, alpha *= 0.5) {
    const double size = evaluate_at(alpha, old, pass, x).size();
    if (std::isfinite(size) && (full || size <= highest || balanced())) return alpha;
    if (std::isfinite(size) && size < least) {
      least = size;
      best = alpha;
    }
  }
  if (!(least <= k_far_off * highest)) return 0;
  evaluate_at(best, old, pass, x);
  return best;
}

CoupledReport CoupledNewton::solve(const mechanics::MechanicalState& old, mechanics::MechanicalPass& pass,
                                   std::vector<double>& x) {
  // The first attempt uses the whole tangent. If it fails, both fields are set back and the second one leaves
  // the heat of the motion out.
  const std::vector<double> start = x;
  const heat::ThermalState thermal_start = thermal_->state();
  tangent_ = Tangent::whole;
  try {
    return iterate(old, pass, x);
  } catch (StepRejected& first) {
    logging::debug("both fields: a second attempt after: {}", first.reason());
    x = start;
    thermal_->restart(thermal_start);
    tangent_ = Tangent::without_heat_of_motion;
    try {
      return iterate(old, pass, x);
    } catch (const StepRejected&) {
      first.append(", nor in a second attempt");
    }
    throw;
  }
}

CoupledReport CoupledNewton::iterate(const mechanics::MechanicalState& old, mechanics::MechanicalPass& pass,
                                     std::vector<double>& x) {
  // Without the heat of motion the tangent is not exact, and more iterations are allowed.
  const bool whole = tangent_ == Tangent::whole;
  const int most = std::max(mechanics_.bodies().options.newton.max_iterations,
                            phases_.heat->parts().options.max_iterations);
  const int max_iterations = whole ? most : 2 * most;
  // The state of the iteration starts again: no equilibrium between iterates is asked for but in the second
  // attempt, and no iteration has been lost yet.
  pass.iterate_temperature = thermal_->state().temperature;
  CoupledReport report;
  linear::Forcing forcing(mechanics_.bodies().options.newton.inexact, k_loosest);
  progress_.in_equilibrium = !whole;
  progress_.lost = 0;
  progress_.next_step = std::numeric_limits<double>::infinity();
  progress_.shifted_heat = 0;
  // In the second attempt every iterate is an equilibrium at its temperatures, the first one included.
  if (progress_.in_equilibrium) {
    set_contact_temperatures();
    if (!equilibrate(old, pass, x))
      mechanics::reject(mechanics_, "no equilibrium at the temperatures of the start", x);
  }
  CoupledResidual residual = evaluate(old, pass, x);
  // Each iteration judges the residual, assembles the tangent, finds a direction and moves along it.
  while (true) {
    report.residuals.push_back(residual);
    if (!std::isfinite(residual.size())) mechanics::reject(mechanics_, "the residual is not a number", x);
    if (!heat_stalls(report.residuals)) progress_.shifted_heat = 0;
    if (converged()) return report;
    if (report.iterations == max_iterations) {
      const std::string reason = "no convergence in " + std::to_string(max_iterations) + " iterations";
      if (!thermal_->equations().converged()) thermal_->reject(reason);
      mechanics::reject(mechanics_, reason, x);
    }
    assemble(old, x, report.iterations);
    if (!whole) drop_heat_of_motion(matrix_);
    std::string failure;
    const bool found = find_direction(forcing, report, failure);
    ++report.iterations;
    // Where some plain steps have not lowered the residual much, later iterates are brought into equilibrium
    // before they are judged.
    if (report.iterations > k_plain_steps &&
        residual.size() > k_stalls * report.residuals[report.residuals.size() - 2].size())
      progress_.in_equilibrium = true;
    if (!found) mechanics::reject(mechanics_, "linear solver: " + failure, x, Failure::linear_solver);
    // The step length follows from the line search; a direction along which nothing falls ends the attempt.
    const double alpha = move(old, pass, x, report);
    if (alpha == 0) mechanics::reject(mechanics_, "no step along Newton's direction lowers the residual", x);
    report.shortest_step = std::min(report.shortest_step, alpha);
    for (double& value : work_.step_u) value *= alpha;
    // The next step is estimated as the one just taken times the contraction of the residual. It is what
    // converged() compares with the tolerance of displacement.
    const double contraction = alpha == 1 ? std::min(1.0, present().size() / residual.size()) : 1.0;
    progress_.next_step = contraction * mechanics_.equations().relative_step(old, x, work_.step_u);
    residual = present();
  }
}

}  // namespace solidus::coupling
