#include "coupling/coupled_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coupling/contact_states.hpp"
#include "coupling/coupled_saddle_solver.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
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
/// Share of the mesh's diagonal that a node goes at most in an iteration. A body that rested on contact
/// alone, which the step before has opened, has next to no stiffness toward its mould: its step is metres
/// long, and surfaces that search for their partners (large sliding) would not find each other again.
constexpr double k_longest_way = 0.05;

/// The diagonal of the mesh's bounding box [m]. Collective.
double diagonal(const mesh::Mesh& mesh) {
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : mesh.x) low = std::min(low, x[i]), high = std::max(high, x[i]);
    const double size = parallel::global_max(high) - parallel::global_min(low);
    squares += size * size;
  }
  return std::sqrt(squares);
}

/// The longest way of a node [m]. Collective.
/// @param step  [local node][component]
double longest(std::span<const double> step, int components) {
  const auto n = static_cast<std::size_t>(components);
  double squares = 0;
  for (std::size_t i = 0; i + n <= step.size(); i += n) {
    double of_node = 0;
    for (std::size_t c = 0; c < n; ++c) of_node += step[i + c] * step[i + c];
    squares = std::max(squares, of_node);
  }
  return std::sqrt(parallel::global_max(squares));
}

/// Whether heat has gained less than a digit in each of two iterations.
bool heat_stalls(const std::vector<CoupledResidual>& residuals) {
  const std::size_t n = residuals.size();
  return n >= 3 && residuals[n - 1].heat > k_stalls * residuals[n - 2].heat &&
         residuals[n - 2].heat > k_stalls * residuals[n - 3].heat;
}

/// Sets ∂r_Θ/∂u and ∂r_Θ/∂p to zero.
void drop_heat_of_motion(linear::CoupledMatrix& matrix) {
  constexpr linear::CoupledMatrix::Slot k_scrap = -1;  // the first one
  const std::size_t n =
      (matrix.displacement().columns().size() + 1) * static_cast<std::size_t>(matrix.fields());
  std::fill_n(matrix.heat_by_displacement(k_scrap), n * static_cast<std::size_t>(matrix.components()), 0.0);
  if (matrix.pressures() > 0)
    std::fill_n(matrix.heat_by_pressure(k_scrap), n * static_cast<std::size_t>(matrix.pressures()), 0.0);
}

}  // namespace

double CoupledResidual::size() const {
  return std::hypot(force, heat);
}

CoupledNewton::CoupledNewton(const Phases& phases, linear::CoupledSolverKind solver)
    : phases_(phases),
      mechanics_(*phases.mechanics),
      thermal_(phases.heat->iteration()),
      matrix_(mechanics_.mesh(), mechanics_.matrix(), thermal_->matrix(),
              mechanics_.saddle() != nullptr ? &mechanics_.saddle()->matrix() : nullptr),
      ghosts_(mechanics_.mesh()) {
  // The solver depends on the elements: those with a pressure make a saddle point, others two fields. Kernels
  // are bound to both matrices.
  const mesh::Mesh& mesh = mechanics_.mesh();
  const double tolerance = mechanics_.options().linear_tolerance;
  if (mechanics_.pressure() != nullptr)
    solver_ = std::make_unique<CoupledSaddleSolver>(mesh, matrix_, *mechanics_.pressure(), ghosts_, solver,
                                                    tolerance);
  else
    solver_ = std::make_unique<linear::CoupledSolver>(mesh, mechanics_.components(), solver, tolerance);
  for (const auto& block : mechanics_.blocks()) {
    auto& kernel = dynamic_cast<mechanics::CoupledKernel&>(*block);
    kernel.bind_heat(thermal_->matrix());
    kernels_.push_back(&kernel);
  }
  const auto n_owned = static_cast<std::size_t>(mesh.n_owned_nodes);
  force_.resize(mechanics_.n_residuals());
  owned_step_.resize(force_.size());
  step_u_.resize(mesh.x.size() * static_cast<std::size_t>(mechanics_.components() + matrix_.pressures()));
  step_t_.resize(mesh.x.size());
  further_.resize(n_owned);
  work_.resize(std::max(force_.size(), n_owned));
}

std::size_t CoupledNewton::n_owned_displacements() const {
  return further_.size() * static_cast<std::size_t>(mechanics_.components());
}

CoupledResidual CoupledNewton::evaluate(const mechanics::MechanicalState& old,
                                        const mechanics::MechanicalPass& pass, std::span<const double> x) {
  // The residual of both fields at one iterate: contact and mechanics at its temperatures, then heat with the
  // deformation that mechanics has found.
  release_deformation();
  mechanics_.prepare(old, pass);
  set_contact_temperatures();
  for (contact::ContactPair* pair : phases_.contacts) pair->update(x.first(mechanics_.n_displacements()));
  reference_ = mechanics_.residual(x, force_);
  const std::vector<char>& fixed = mechanics_.matrix().fixed();
  const std::span<double> of_displacement = std::span(force_).first(n_owned_displacements());
  for (std::size_t i = 0; i < of_displacement.size(); ++i)
    if (fixed[i]) of_displacement[i] = 0;
  mechanics_.matrix().constraints().sum(of_displacement);
  double squares = 0;
  for (const double r : force_) squares += r * r;
  norm_ = std::sqrt(parallel::global_sum(squares));

  mechanics_.finish(old, x, history_, nullptr, nullptr, nullptr, &deformation_);
  if (phases_.structural != nullptr) phases_.structural->set_deformation(deformation_);
  thermal_->evaluate();
  return present();
}

void CoupledNewton::release_deformation() {
  deformation_.clear();
  if (phases_.structural != nullptr) phases_.structural->release();
}

void CoupledNewton::set_contact_temperatures() {
  for (contact::ContactPair* pair : phases_.contacts) pair->set_temperature(thermal_->temperature());
}

CoupledResidual CoupledNewton::present() const {
  const auto ratio = [](double norm, double reference) { return reference > 0 ? norm / reference : norm; };
  return {ratio(norm_, reference_), ratio(thermal_->unbalanced(), thermal_->moved())};
}

double CoupledNewton::goal() const {
  const linear::NewtonOptions& options = mechanics_.options().newton;
  return std::max({options.tolerance * reference_, options.absolute_tolerance, mechanics_.round_off()});
}

bool CoupledNewton::balanced() const {
  return norm_ <= goal() && (thermal_->converged() || heat_is_rounding());
}

bool CoupledNewton::heat_is_rounding() const {
  return norm_ <= goal() && next_step_ <= k_rounding_step &&
         thermal_->unbalanced() <= std::min(2 * shifted_heat_, k_rounding_heat * thermal_->moved());
}

bool CoupledNewton::converged() const {
  const double allowed = mechanics_.options().newton.step_tolerance;
  return balanced() && (allowed <= 0 || next_step_ <= allowed || norm_ <= mechanics_.round_off());
}

linear::CoupledMatrix& CoupledNewton::assemble(const mechanics::MechanicalState& old,
                                               std::span<const double> x, int iteration) {
  // Tangents of both fields; if contact has changed the graph of heat, kernels are bound again.
  mechanics_.tangent(x);
  if (thermal_->follow_graph())
    for (mechanics::CoupledKernel* kernel : kernels_) kernel->bind_heat(thermal_->matrix());
  if (matrix_.set_zero()) solver_->reset();
  thermal_->assemble(iteration);
  const mechanics::NodalPressure* const pressure = mechanics_.pressure();
  const mechanics::CoupledIterate at{
      .form = phases_.structural != nullptr ? std::optional(phases_.structural->form()) : std::nullopt,
      .old_u = old.displacement,
      .u = x.first(mechanics_.n_displacements()),
      .temperature = thermal_->temperature(),
      .pressure_unit = pressure != nullptr ? pressure->unit() : 1};
  for (mechanics::CoupledKernel* kernel : kernels_) kernel->add_coupling(at, matrix_);
  for (const contact::ContactPair* pair : phases_.contacts)
    pair->add_coupling(thermal_->temperature(), matrix_);
  return matrix_;
}

void CoupledNewton::multiply_heat(std::span<const double> x, std::span<double> heat) {
  matrix_.multiply_heat(x, heat);
  if (matrix_.pressures() == 0) return;
  const std::span<double> part = std::span(work_).first(heat.size());
  matrix_.multiply_heat_of_pressure(x.subspan(mechanics_.n_displacements()), part);
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] += part[i];
}

void CoupledNewton::multiply(std::span<const double> x, std::span<const double> temperature,
                             std::span<double> force, std::span<double> heat) {
  // The product of the whole coupled matrix, block by block: forces by temperature and displacement, volume
  // by both, heat by temperature and motion.
  const std::span<const double> u = x.first(mechanics_.n_displacements()), p = x.subspan(u.size());
  const std::span<double> of_u = force.first(n_owned_displacements()), of_p = force.subspan(of_u.size());
  const std::span<double> part = std::span(work_).first(force.size());
  matrix_.multiply_force(temperature, part.first(of_u.size()));
  if (matrix_.pressures() == 0) {
    matrix_.displacement().multiply(u, of_u);
  } else {
    matrix_.multiply_volume(temperature, part.subspan(of_u.size()));
    matrix_.saddle()->multiply(u, p, of_u, of_p);
    mechanics_.pressure()->add_projection_to(p.first(of_p.size()), 1.0, of_p);
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
  ghosts_.update(x.first(mechanics_.n_displacements()), mechanics_.components());
  if (mechanics_.pressure() == nullptr) return;
  const std::span<double> p = x.subspan(mechanics_.n_displacements());
  std::copy(owned.begin() + static_cast<std::ptrdiff_t>(n_u), owned.end(), p.begin());
  ghosts_.update(p, mechanics_.pressure()->fields());
}

linear::FieldWeights CoupledNewton::weights() {
  const std::span<const double> heat = thermal_->right_hand_side();
  double squares[2] = {0, 0};
  for (std::size_t i = 0; i < heat.size(); ++i) {
    step_t_[i] = heat[i] / *matrix_.temperature().diagonal_block(static_cast<Index>(i));
    squares[0] += heat[i] * heat[i];
  }
  ghosts_.update(step_t_, 1);
  const std::span<double> caused = std::span(work_).first(force_.size());
  matrix_.multiply_force(step_t_, caused.first(n_owned_displacements()));
  if (matrix_.pressures() > 0) matrix_.multiply_volume(step_t_, caused.subspan(n_owned_displacements()));
  for (const double f : caused) squares[1] += f * f;
  const double of_heat = std::sqrt(parallel::global_sum(squares[0]));
  const double of_force = std::max(norm_, std::sqrt(parallel::global_sum(squares[1])));
  return {of_force > 0 ? 1.0 / of_force : 1.0, of_heat > 0 ? 1.0 / of_heat : 1.0};
}

double CoupledNewton::forcing_term(linear::Forcing& forcing, const linear::FieldWeights& weights) const {
  const linear::FieldWeights in_use = solver_->in_use(weights);
  // In the norm of the linear solver.
  const double force = in_use.force * norm_, heat = in_use.heat / weights.heat;
  const auto left = [](double norm, double goal) { return goal > 0 ? norm / goal : 1.0; };
  const double force_left = left(norm_, goal()),
               heat_left = left(thermal_->unbalanced(), thermal_->tolerance() * thermal_->moved());
  return forcing.next(std::max(force_left, heat_left),
                      std::min(force / force_left, heat / heat_left) / std::hypot(force, heat));
}

bool CoupledNewton::find_direction(linear::Forcing& forcing, CoupledReport& report, std::string& failure) {
  const linear::FieldWeights scales = weights();
  const double eta = forcing_term(forcing, scales);
  for (double& r : force_) r = -r;
  const linear::LinearReport linear =
      solver_->solve(matrix_, force_, thermal_->right_hand_side(), scales, owned_step_,
                     std::span(step_t_).first(further_.size()), eta);
  for (double& r : force_) r = -r;
  report.linear_iterations += linear.iterations;
  if (!linear.converged) {
    failure = linear.reason;
    return false;
  }
  const std::vector<char>& fixed = mechanics_.matrix().fixed();
  const std::span<double> owned_u = std::span(owned_step_).first(n_owned_displacements());
  for (std::size_t i = 0; i < owned_u.size(); ++i)
    if (fixed[i]) owned_u[i] = 0;
  mechanics_.matrix().constraints().share(owned_u);
  spread(owned_step_, step_u_);
  multiply_heat(step_u_, further_);
  shifted_heat_ = 0;
  if (norm_ <= goal()) {
    double sum = 0;
    for (const double heat : further_) sum += std::abs(heat);
    shifted_heat_ = parallel::global_sum(sum);
  }
  thermal_->set_direction(step_t_, further_);
  return true;
}

CoupledResidual CoupledNewton::evaluate_at(double alpha, const mechanics::MechanicalState& old,
                                           const mechanics::MechanicalPass& pass, std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = start_u_[i] + alpha * step_u_[i];
  thermal_->move(alpha);
  const auto& temperature = thermal_->temperature();
  const double coldest =
      temperature.empty() ? 1.0 : *std::min_element(temperature.begin(), temperature.end());
  if (!(parallel::global_min(coldest) > 0)) return k_nowhere;
  // Where iterates are kept in equilibrium, forces are solved for at the trial temperatures. Too many without
  // any equilibrium end the attempt.
  if (in_equilibrium_) {
    const bool whole = tangent_ == Tangent::whole;
    if (!whole) x = start_u_;  // in equilibrium with the temperatures there
    set_contact_temperatures();
    if (!equilibrate(old, pass, x)) {
      if (++lost_ > k_lost) mechanics_.reject("iterates of both fields have no equilibrium", x);
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
  const auto n_u = static_cast<std::ptrdiff_t>(mechanics_.n_displacements());
  iterate.displacement.assign(x.begin(), x.begin() + n_u);
  if (mechanics_.pressure() != nullptr) {
    iterate.pressure.assign(x.begin() + n_u, x.end());
    for (double& p : iterate.pressure) p *= mechanics_.pressure()->unit();
  }
  pass.iterate = &iterate;
  release_deformation();
  if (tangent_ == Tangent::without_heat_of_motion)
    for (contact::ContactPair* pair : phases_.contacts) pair->stabilise(k_firm_hold);
  try {
    mechanics_.solve(old, iterate, pass);
    x = mechanics_.start(old, pass);
    return true;
  } catch (const StepRejected&) {
    return false;
  }
}

double CoupledNewton::move(const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
                           std::vector<double>& x, const CoupledReport& report) {
  // A step is accepted if the residual stays below the largest of the last few iterations.
  start_u_ = x;
  double highest = 0;
  const std::size_t n = report.residuals.size();
  for (std::size_t i = n > k_remembered ? n - k_remembered : 0; i < n; ++i)
    highest = std::max(highest, report.residuals[i].size());
  const bool full = tangent_ == Tangent::whole && report.iterations <= k_full_steps;
  const double way = longest(std::span(step_u_).first(mechanics_.n_displacements()), mechanics_.components());
  double alpha = 1;
  if (const double most = k_longest_way * diagonal(mechanics_.mesh()); way > most) alpha = most / way;
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
  const int most = std::max(mechanics_.options().newton.max_iterations, thermal_->max_iterations());
  const int max_iterations = whole ? most : 2 * most;
  // The state of the iteration starts again: no equilibrium between iterates is asked for but in the second
  // attempt, and no iteration has been lost yet.
  pass.iterate_temperature = thermal_->temperature();
  CoupledReport report;
  linear::Forcing forcing(mechanics_.options().newton.inexact, k_loosest);
  in_equilibrium_ = !whole;
  lost_ = 0;
  next_step_ = std::numeric_limits<double>::infinity();
  shifted_heat_ = 0;
  // In the second attempt every iterate is an equilibrium at its temperatures, the first one included.
  if (in_equilibrium_) {
    set_contact_temperatures();
    if (!equilibrate(old, pass, x)) mechanics_.reject("no equilibrium at the temperatures of the start", x);
  }
  CoupledResidual residual = evaluate(old, pass, x);
  // Each iteration judges the residual, assembles the tangent, finds a direction and moves along it.
  while (true) {
    report.residuals.push_back(residual);
    if (!std::isfinite(residual.size())) mechanics_.reject("the residual is not a number", x);
    if (!heat_stalls(report.residuals)) shifted_heat_ = 0;
    if (converged()) return report;
    if (report.iterations == max_iterations) {
      const std::string reason = "no convergence in " + std::to_string(max_iterations) + " iterations";
      if (!thermal_->converged()) thermal_->reject(reason);
      mechanics_.reject(reason, x);
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
      in_equilibrium_ = true;
    if (!found) mechanics_.reject("linear solver: " + failure, x, Failure::linear_solver);
    // The step length follows from the line search; a direction along which nothing falls ends the attempt.
    const double alpha = move(old, pass, x, report);
    if (alpha == 0) mechanics_.reject("no step along Newton's direction lowers the residual", x);
    report.shortest_step = std::min(report.shortest_step, alpha);
    for (double& value : step_u_) value *= alpha;
    // The next step is estimated as the one just taken times the contraction of the residual. It is what
    // converged() compares with the tolerance of displacement.
    const double contraction = alpha == 1 ? std::min(1.0, present().size() / residual.size()) : 1.0;
    next_step_ = contraction * mechanics_.relative_step(old, x, step_u_);
    residual = present();
  }
}

}  // namespace solidus::coupling
