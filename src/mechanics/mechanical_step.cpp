/// A step of the mechanical phase: residual, tangent, solution, works and energies.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/held_equilibrium.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "mechanics/state/stress_history.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::mechanics {

namespace {

/// Forces that a strain of this size would cause count as round-off: the criterion of a body without load.
constexpr double k_round_off_strain = 1e-13;

/// Equilibrium at the end of a step from `old`, for Newton's method.
class Equilibrium final : public linear::NonlinearSystem {
 public:
  Equilibrium(MechanicalPhase& phase, const MechanicalState& old) : phase_(phase), old_(old) {}
  double residual(std::span<const double> x, std::span<double> r) override { return phase_.residual(x, r); }
  linear::BlockMatrix& tangent(std::span<const double> x) override { return phase_.tangent(x); }
  double relative_step(std::span<const double> x, std::span<const double> d) override {
    return phase_.relative_step(old_, x, d);
  }

 private:
  MechanicalPhase& phase_;
  const MechanicalState& old_;
};

}  // namespace

/// The first step, and one that grows beyond the limit of stability of the two-step method, are backward
/// Euler steps.
material::TimeStep MechanicalPhase::time_step(const MechanicalState& old, const MechanicalPass& pass) const {
  const bool two_step = options_.integration == TimeIntegration::two_step && old.dt_before > 0 &&
                        pass.dt <= material::k_largest_growth * old.dt_before;
  if (two_step) return material::TimeStep::two_step(pass.dt, old.dt_before);
  material::TimeStep step = material::TimeStep::backward_euler(pass.dt);
  step.extrapolated = pass.from_extrapolation;
  return step;
}

/// Hands the blocks temperatures, the state at t_n and the start of the effective step.
void MechanicalPhase::prepare(const MechanicalState& old, const MechanicalPass& pass) {
  const profile::Part part("properties");
  // What the time integration makes of the step, and whether it starts from an extrapolated history.
  const material::TimeStep step = time_step(old, pass);
  const MechanicalState& held = pass.iterate != nullptr ? *pass.iterate : old;
  const bool extrapolates = step.before != 0;
  if (extrapolates) {
    start_ = old.history;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      PackVector<Lane>& start = start_[b].values;
      const PackVector<Lane>& before = old.before[b].values;
      for (std::size_t i = 0; i < start.size(); ++i)
        start[i] = Lane(step.now) * start[i] + Lane(step.before) * before[i];
    }
  }
  const bool remembers = inertia_ && inertia_->motion().remembers();
  double stiffness = 0;
  // Each block gets all of that at once; what it returns is its stiffness, of which the rounding of the
  // residual follows.
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    stiffness += blocks_[b]->prepare(
        {.temperature = pass.temperature,
         .pass_temperature = pass.iterate_temperature.empty() ? pass.temperature : pass.iterate_temperature,
         .initial_temperature = initial_temperature_,
         .old_displacement = old.displacement,
         .held_displacement = held.displacement,
         .held_history = &held.history[b],
         .old_history = &old.history[b],
         .start_history = extrapolates ? &start_[b] : &old.history[b],
         .dt = pass.dt,
         .effective = step,
         .old_stress = remembers ? &old.stress[b] : nullptr,
         .stress_share = remembers ? inertia_->motion().work_share : 1,
         .at_work = pass.at_work != nullptr ? &pass.at_work->stress[b] : nullptr,
         .phases = nodal_phases_.evaluate(b, fraction_place(pass), fractions_before(old, pass)),
         .melt = &melt_[static_cast<std::size_t>(mesh_.blocks[b].body)],
         .lead = pass.lead != nullptr && !(*pass.lead)[b].empty() ? &(*pass.lead)[b] : nullptr});
  if (pressure_) pressure_->begin();
  residual_is_known_ = false;
  round_off_ = k_round_off_strain * std::sqrt(parallel::global_sum(stiffness));
  if (inertia_) round_off_ += inertia_->round_off();
}

std::vector<double> MechanicalPhase::mean_solid_fraction(const MechanicalState& old,
                                                         const MechanicalPass& pass) const {
  return nodal_phases_.mean_solid_fraction(fractions_before(old, pass), fraction_place(pass));
}

double MechanicalPhase::residual(std::span<const double> x, std::span<double> r) {
  // Newton's method asks for the residual at the same place twice (after a line search, say). If no process
  // has moved, the last one is given again.
  const bool known = residual_is_known_ && std::equal(x.begin(), x.end(), x_.begin(), x_.end());
  if (!parallel::any_process(!known)) {
    std::copy(residual_.begin(), residual_.end(), r.begin());
    return balance_.reference();
  }
  const Stopwatch watch(seconds_residual_);
  const profile::Part part("law and forces");
  x_.assign(x.begin(), x.end());
  std::fill(forces_.begin(), forces_.end(), 0.0);
  // Internal forces come first, with the norm of each body's forces for the convergence test.
  balance_.begin();
  const std::span<const double> u = x.first(n_displacements());
  if (pressure_) pressure_->set(x.subspan(u.size()));
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    balance_.add_internal(mesh_.blocks[b].body, blocks_[b]->add_forces(u, forces_));
  // Contact acts on the owned rows; what it exchanges is part of the scale of forces, as are loads and
  // supports.
  const std::span<double> net = r.first(n_forces());
  std::fill(net.begin(), net.end(), 0.0);
  {
    const profile::Part of_contact("contact");
    for (linear::Contribution* contribution : contributions_) contribution->add_residual(u, net);
  }
  balance_.add_exchanged(net);
  balance_.add_exchanged(external_);
  for (std::size_t i = 0; i < net.size(); ++i) net[i] += forces_[i] - external_[i];
  // Inertia, where there is any, is a force like the others.
  if (inertia_) {
    inertia_->force(u, inertial_);
    balance_.add_exchanged(inertial_);
    for (std::size_t i = 0; i < net.size(); ++i) net[i] += inertial_[i];
  }
  add_residual_to_balance(net);
  // The rows of the pressure follow behind those of the displacement.
  if (pressure_) pressure_->residual(r.subspan(net.size()), balance_);
  residual_.assign(r.begin(), r.end());
  residual_is_known_ = true;
  return balance_.reference();
}

/// The forces that keep a face plane are exchanged with the body like those of a support; their sum is a
/// residual.
void MechanicalPhase::add_residual_to_balance(std::span<const double> r) {
  if (matrix_->constraints().empty()) {
    balance_.add_residual(r, loads_->fixed(), loads_->supported());
    return;
  }
  std::vector<double> holding(r.size(), 0.0), rest(r.begin(), r.end());
  for (const auto& group : loads_->constraint_groups())
    for (const Index entry : group) {
      const auto at = static_cast<std::size_t>(entry);
      if (at < r.size()) holding[at] = r[at];
    }
  matrix_->constraints().sum(rest);
  balance_.add_exchanged(holding);
  balance_.add_residual(rest, loads_->fixed(), loads_->supported());
}

double MechanicalPhase::relative_step(const MechanicalState& old, std::span<const double> x,
                                      std::span<const double> d) const {
  std::vector<double> increment(n_forces());
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] = x[i] - old.displacement[i];
  return balance_.relative_step(d.first(increment.size()), increment);
}

linear::BlockMatrix& MechanicalPhase::tangent(std::span<const double> x) {
  const Stopwatch watch(seconds_assembly_);
  const profile::Part part("assembly");
  // If contact has met new partners, the graph of the matrix grows, and everything bound to it is bound
  // again.
  if (linear::graph_outdated(contributions_)) {
    matrix_->set_graph(graph());
    solver_->reset();
    bind();
  }
  // Then every block, inertia and contact add their tangents.
  matrix_->set_zero();
  const std::span<const double> u = x.first(n_displacements());
  for (const auto& block : blocks_) block->add_tangent(u, *matrix_);
  if (inertia_) inertia_->add_tangent(*matrix_);
  {
    const profile::Part of_contact("contact");
    for (linear::Contribution* contribution : contributions_) contribution->add_tangent(u, *matrix_);
  }
  if (saddle_solver_ != nullptr) saddle_solver_->assemble();
  return *matrix_;
}

MechanicalReport MechanicalPhase::solve(const MechanicalState& old, MechanicalState& trial,
                                        const MechanicalPass& pass) {
  begin(old, pass);
  Equilibrium equilibrium(*this, old);
  // No tolerance below the rounding of the forces, and no more iterations than the pass allows.
  linear::NewtonOptions newton_options = options_.newton;
  newton_options.absolute_tolerance = std::max(newton_options.absolute_tolerance, round_off_);
  if (pass.newton_steps > 0) newton_options.max_iterations = pass.newton_steps;
  if (pressure_ && pass.iterate == nullptr && pass.start.empty()) pressure_->release_pores();
  std::vector<double> x = start(old, pass);
  const bool guessed = try_guess(pass, x);
  MechanicalReport report;
  report.newton = linear::newton(equilibrium, *solver_, ghosts_, fields_, x, newton_options);
  if (guessed && !report.newton.converged) {
    // A guess may lift a body off its support, which leaves a singular tangent.
    const linear::NewtonReport from_guess = std::move(report.newton);
    x = start(old, pass);
    report.newton = linear::newton(equilibrium, *solver_, ghosts_, fields_, x, newton_options);
    report.newton.add_solves(from_guess);
  }
  // With contact a second attempt goes another way from the start; without it Newton's answer is kept.
  if (!report.newton.converged && pass.newton_steps == 0 && !contributions_.empty()) {
    const linear::NewtonReport failed = std::move(report.newton);
    x = start(old, pass);
    report.newton = attempt_again(*this, old, *solver_, ghosts_, fields_, x, newton_options);
    if (!report.newton.converged) report.newton.reason = failed.reason + ", nor in a second attempt";
    report.newton.add_solves(failed);
  }
  // Further elements may have filled with pores, which changes the equations: they are solved again until
  // none has.
  for (int iteration = 1;
       report.newton.converged && pressure_ &&
       pressure_->fill_pores(std::span<const double>(x).subspan(n_displacements()), iteration);
       ++iteration) {
    const linear::NewtonReport before = std::move(report.newton);
    residual_is_known_ = false;
    report.newton = linear::newton(equilibrium, *solver_, ghosts_, fields_, x, newton_options);
    report.newton.add_solves(before);
  }
  const bool may_end = pass.newton_steps > 0 && report.newton.out_of_iterations;
  if (!report.newton.converged && !may_end)
    reject(report.newton.reason, x,
           report.newton.no_direction ? Failure::linear_solver : Failure::equilibrium);
  MechanicalReport concluded = conclude(old, pass, std::move(x), trial);
  concluded.newton = std::move(report.newton);
  return concluded;
}

double MechanicalPhase::unbalanced(std::span<const double> x) {
  std::vector<double> r(n_residuals());
  residual(x, r);
  for (std::size_t i = 0; i < n_forces(); ++i)
    if (loads_->fixed()[i] != 0) r[i] = 0;
  matrix_->constraints().sum(std::span(r).first(n_forces()));
  double squares = 0;
  for (const double value : r) squares += value * value;
  return std::sqrt(parallel::global_sum(squares));
}

bool MechanicalPhase::try_guess(const MechanicalPass& pass, std::vector<double>& x) {
  if (!parallel::any_process(!pass.guess.empty())) return false;
  std::vector<double> guess = x;
  std::copy(pass.guess.begin(), pass.guess.end(), guess.begin());
  // The guess keeps prescribed displacements. It is taken only if it lowers the unbalanced forces.
  loads_->prescribe(pass.time, std::span(guess).first(n_displacements()));
  if (pressure_ && !pass.guessed_pressure.empty())
    pressure_->to_unknowns(pass.guessed_pressure, std::span(guess).subspan(n_displacements()));
  const double here = unbalanced(x);
  if (here <= round_off_) return false;
  const double there = unbalanced(guess);
  if (!(there < here)) return false;
  x = std::move(guess);
  return true;
}

void MechanicalPhase::begin(const MechanicalState& old, const MechanicalPass& pass) {
  assert(old.displacement.size() == forces_.size() && old.history.size() == blocks_.size() && pass.dt > 0);
  loads_->evaluate(pass.time, external_);
  if (pressure_ && loads_->has_body_forces()) set_body_force(pass.time);
  if (inertia_) inertia_->begin(old, pass.dt);
  prepare(old, pass);
}

std::vector<double> MechanicalPhase::start(const MechanicalState& old, const MechanicalPass& pass) const {
  const MechanicalState& from = pass.iterate != nullptr ? *pass.iterate : old;
  std::vector<double> x(n_unknowns());
  const std::span<const double> u =
      pass.start.empty() ? std::span<const double>(from.displacement) : pass.start;
  std::copy(u.begin(), u.end(), x.begin());
  loads_->prescribe(pass.time, std::span(x).first(u.size()));
  if (pressure_) pressure_->to_unknowns(from.pressure, std::span(x).subspan(u.size()));
  return x;
}

BlockWork MechanicalPhase::finish(const MechanicalState& old, std::span<const double> x,
                                  std::vector<BlockHistory>& history, std::vector<BlockHistory>* stress,
                                  std::vector<StressAtWork>* at_work,
                                  std::vector<SharedElementValues>* elements, StepDeformation* deformation) {
  const profile::Part part("history");
  // What the last iterate has found becomes history, block by block. Storage that is there already is
  // overwritten.
  const std::span<const double> u = x.first(n_displacements());
  BlockWork total;
  history.resize(blocks_.size());
  if (at_work != nullptr) at_work->resize(blocks_.size());
  if (elements != nullptr) elements->resize(blocks_.size());
  if (deformation != nullptr) deformation->resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    history[b].n_components = old.history[b].n_components;
    history[b].n_points = old.history[b].n_points;
    // Blocks of absent bodies keep the layout that a checkpoint expects, with zeros.
    if (active_.body(mesh_.blocks[b].body)) {
      history[b].values.resize(old.history[b].values.size());
    } else {  // of the layout that a checkpoint knows
      history[b].values.assign(old.history[b].values.size(), Lane(0.0));
      if (elements != nullptr) (*elements)[b].reset();
    }
    total += blocks_[b]->finish(old.displacement, u,
                                {.history = history[b],
                                 .stress = stress != nullptr ? &(*stress)[b] : nullptr,
                                 .at_work = at_work != nullptr ? &(*at_work)[b] : nullptr,
                                 .elements = elements != nullptr ? &(*elements)[b] : nullptr,
                                 .deformation = deformation != nullptr ? &(*deformation)[b] : nullptr});
  }
  return total;
}

MechanicalReport MechanicalPhase::conclude(const MechanicalState& old, const MechanicalPass& pass,
                                           std::vector<double> x, MechanicalState& trial) {
  MechanicalState next;
  // Most of a state is its history: the storage of the one that is overwritten serves again.
  if (&trial != &old) {
    next.history = std::move(trial.history);
    next.elements = std::move(trial.elements);
  }
  const bool remembers = inertia_ && inertia_->motion().remembers();
  if (remembers)
    next.stress = old.stress;  // of the right size
  else if (pass.stores_stress)
    for (const BlockHistory& history : old.history) next.stress.push_back(no_stress(history));
  std::vector<StressAtWork> at_work;
  StepDeformation deformation;
  const BlockWork total = finish(old, x, next.history, next.stress.empty() ? nullptr : &next.stress,
                                 pass.returns_at_work ? &at_work : nullptr, &next.elements, &deformation);
  MechanicalReport report = measure(old, pass, x, total, next);
  report.at_work.stress = std::move(at_work);
  report.deformation = std::move(deformation);
  x.resize(n_displacements());
  next.displacement = std::move(x);
  next.solid_fraction = nodal_phases_.solid_fraction(fraction_place(pass));
  // If the last body with a pressure has been removed, the old values are kept, because checkpoints have room
  // for them.
  next.pressure = pressure_ ? pressure_->pressure() : old.pressure;
  if (options_.integration == TimeIntegration::two_step) {
    next.before = old.history;
    next.dt_before = pass.dt;
  }
  trial = std::move(next);
  return report;
}

/// Forces, works and energies at the solution; with inertia also the motion of the next state.
MechanicalReport MechanicalPhase::measure(const MechanicalState& old, const MechanicalPass& pass,
                                          std::span<const double> x, const BlockWork& sums,
                                          MechanicalState& next) {
  // The residual at the solution: internal + contributions + inertia − loads, the support force where fixed.
  // Newton's iteration ends with it.
  std::vector<double> r(n_residuals());
  residual(x, r);
  r.resize(n_forces());
  x = x.first(n_displacements());
  MechanicalReport report;
  report.reactions.resize(r.size());
  report.applied.resize(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) report.applied[i] = forces_[i] - r[i];
  double local[10] = {0,
                      0,
                      0,
                      sums.internal_work,
                      sums.dissipation,
                      sums.plastic_dissipation,
                      sums.plastic_work,
                      0,
                      sums.stabilisation_work,
                      sums.inelastic_entropy};
  if (pass.returns_at_work) report.at_work = {{}, external_, r};
  const std::span<const double> external = pass.at_work != nullptr ? pass.at_work->external : external_;
  const std::span<const double> support = pass.at_work != nullptr ? pass.at_work->residual : r;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double increment = x[i] - old.displacement[i];
    report.reactions[i] = loads_->fixed()[i] ? r[i] : 0.0;
    local[0] += external[i] * increment;
    local[loads_->fixed()[i] ? 1 : 2] += support[i] * increment;
  }
  if (inertia_) {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= inertial_[i];
    residual_is_known_ = false;  // inertial_ becomes another force
    const MotionWork motion = inertia_->conclude(x, r, external_, loads_->fixed(), next);
    // The support force of t_{n+1}, not the method's mean over the step.
    inertia_->mass().multiply(next.acceleration, components_, inertial_);
    for (std::size_t i = 0; i < r.size(); ++i)
      if (loads_->fixed()[i] != 0) report.reactions[i] = r[i] + inertial_[i];
    local[0] = motion.external;
    local[1] = motion.support;
    local[7] = motion.kinetic;
    local[8] += motion.numerical;
  }
  processes::sum(local);
  report.work = {.external_work = local[0],
                 .support_work = local[1],
                 .residual_work = local[2],
                 .internal_work = local[3],
                 .dissipation = local[4],
                 .plastic_dissipation = local[5],
                 .plastic_work = local[6],
                 .inelastic_entropy = local[9],
                 .least_dissipation = parallel::global_min(sums.least_dissipation),
                 .largest_dissipation = parallel::global_max(sums.largest_dissipation),
                 .kinetic = local[7],
                 .numerical = local[8]};
  return report;
}

}  // namespace solidus::mechanics
