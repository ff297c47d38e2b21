/// Residual and tangent of a step of the mechanical phase, and the works and energies at its solution.
#include "mechanics/mechanical_equations.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "mechanics/state/stress_history.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::mechanics {

namespace {

/// Forces that a strain of this size would cause count as round-off: the criterion of a body without load.
constexpr double k_round_off_strain = 1e-13;

}  // namespace

MechanicalEquations::MechanicalEquations(MechanicalBodies& bodies, MechanicalMatrix& system)
    : bodies_(bodies), system_(system) {
  const auto n_owned = as_size(bodies.mesh.n_owned_nodes * bodies.components);
  forces_.resize(bodies.n_displacements());
  external_.resize(n_owned);
  if (bodies.inertia) inertial_.resize(n_owned);
}

material::TimeStep time_step(const MechanicsOptions& options, const MechanicalState& old,
                             const MechanicalPass& pass) {
  const bool two_step = options.integration == TimeIntegration::two_step && old.dt_before > 0 &&
                        pass.dt <= material::k_largest_growth * old.dt_before;
  if (two_step) return material::TimeStep::two_step(pass.dt, old.dt_before);
  material::TimeStep step = material::TimeStep::backward_euler(pass.dt);
  step.extrapolated = pass.from_extrapolation;
  return step;
}

void MechanicalEquations::begin(const MechanicalState& old, const MechanicalPass& pass) {
  assert(old.displacement.size() == forces_.size() && old.history.size() == bodies_.blocks.size() &&
         pass.dt > 0);
  bodies_.loads->evaluate(pass.time, external_);
  if (bodies_.pressure && bodies_.loads->has_body_forces()) bodies_.set_body_force(pass.time);
  if (bodies_.inertia) bodies_.inertia->begin(old, pass.dt);
  prepare(old, pass);
}

/// Hands the blocks temperatures, the state at t_n and the start of the effective step.
void MechanicalEquations::prepare(const MechanicalState& old, const MechanicalPass& pass) {
  const profile::Part part("properties");
  // What the time integration makes of the step, and whether it starts from an extrapolated history.
  const material::TimeStep step = time_step(bodies_.options, old, pass);
  const MechanicalState& held = pass.iterate != nullptr ? *pass.iterate : old;
  const bool extrapolates = step.before != 0;
  if (extrapolates) {
    start_ = old.history;
    for (std::size_t b = 0; b < bodies_.blocks.size(); ++b) {
      PackVector<Lane>& start = start_[b].values;
      const PackVector<Lane>& before = old.before[b].values;
      for (std::size_t i = 0; i < start.size(); ++i)
        start[i] = Lane(step.now) * start[i] + Lane(step.before) * before[i];
    }
  }
  const bool remembers = bodies_.inertia && bodies_.inertia->motion().remembers();
  double stiffness = 0;
  // Each block gets all of that at once; what it returns is its stiffness, of which the rounding of the
  // residual follows.
  for (std::size_t b = 0; b < bodies_.blocks.size(); ++b)
    stiffness += bodies_.blocks[b]->prepare(
        {.temperature = pass.temperature,
         .pass_temperature = pass.iterate_temperature.empty() ? pass.temperature : pass.iterate_temperature,
         .initial_temperature = bodies_.initial_temperature,
         .old_displacement = old.displacement,
         .held_displacement = held.displacement,
         .held_history = &held.history[b],
         .old_history = &old.history[b],
         .start_history = extrapolates ? &start_[b] : &old.history[b],
         .dt = pass.dt,
         .effective = step,
         .old_stress = remembers ? &old.stress[b] : nullptr,
         .stress_share = remembers ? bodies_.inertia->motion().work_share : 1,
         .at_work = pass.at_work != nullptr ? &pass.at_work->stress[b] : nullptr,
         .phases = bodies_.nodal_phases.evaluate(b, fraction_place(pass), fractions_before(old, pass)),
         .melt = &bodies_.melt[as_size(bodies_.mesh.blocks[b].body)],
         .lead = pass.lead != nullptr && !(*pass.lead)[b].empty() ? &(*pass.lead)[b] : nullptr});
  if (bodies_.pressure) bodies_.pressure->begin();
  residual_is_known_ = false;
  round_off_ = k_round_off_strain * std::sqrt(parallel::global_sum(stiffness));
  if (bodies_.inertia) round_off_ += bodies_.inertia->round_off();
}

double MechanicalEquations::residual(std::span<const double> x, std::span<double> r) {
  // Newton's method asks for the residual at the same place twice (after a line search, say). If no process
  // has moved, the last one is given again.
  const bool known = residual_is_known_ && std::equal(x.begin(), x.end(), x_.begin(), x_.end());
  if (!parallel::any_process(!known)) {
    std::copy(residual_.begin(), residual_.end(), r.begin());
    return bodies_.balance.reference();
  }
  const Stopwatch watch(seconds_.residual);
  const profile::Part part("law and forces");
  x_.assign(x.begin(), x.end());
  std::fill(forces_.begin(), forces_.end(), 0.0);
  // Internal forces come first, with the norm of each body's forces for the convergence test.
  bodies_.balance.begin();
  const std::span<const double> u = x.first(bodies_.n_displacements());
  if (bodies_.pressure) bodies_.pressure->set(x.subspan(u.size()));
  for (std::size_t b = 0; b < bodies_.blocks.size(); ++b)
    bodies_.balance.add_internal(bodies_.mesh.blocks[b].body, bodies_.blocks[b]->add_forces(u, forces_));
  // Contact acts on the owned rows; what it exchanges is part of the scale of forces, as are loads and
  // supports.
  const std::span<double> net = r.first(bodies_.n_forces());
  std::fill(net.begin(), net.end(), 0.0);
  {
    const profile::Part of_contact("contact");
    for (linear::Contribution* contribution : bodies_.contributions) contribution->add_residual(u, net);
  }
  bodies_.balance.add_exchanged(net);
  bodies_.balance.add_exchanged(external_);
  for (std::size_t i = 0; i < net.size(); ++i) net[i] += forces_[i] - external_[i];
  // Inertia, where there is any, is a force like the others.
  if (bodies_.inertia) {
    bodies_.inertia->force(u, inertial_);
    bodies_.balance.add_exchanged(inertial_);
    for (std::size_t i = 0; i < net.size(); ++i) net[i] += inertial_[i];
  }
  add_residual_to_balance(net);
  // The rows of the pressure follow behind those of the displacement.
  if (bodies_.pressure) bodies_.pressure->residual(r.subspan(net.size()), bodies_.balance);
  residual_.assign(r.begin(), r.end());
  residual_is_known_ = true;
  return bodies_.balance.reference();
}

/// The forces that keep a face plane are exchanged with the body like those of a support; their sum is a
/// residual.
void MechanicalEquations::add_residual_to_balance(std::span<const double> r) {
  if (system_.matrix().constraints().empty()) {
    bodies_.balance.add_residual(r, bodies_.loads->fixed(), bodies_.loads->supported());
    return;
  }
  std::vector<double> holding(r.size(), 0.0), rest(r.begin(), r.end());
  for (const auto& group : bodies_.loads->constraint_groups())
    for (const Index entry : group) {
      const auto at = as_size(entry);
      if (at < r.size()) holding[at] = r[at];
    }
  system_.matrix().constraints().sum(rest);
  bodies_.balance.add_exchanged(holding);
  bodies_.balance.add_residual(rest, bodies_.loads->fixed(), bodies_.loads->supported());
}

double MechanicalEquations::relative_step(const MechanicalState& old, std::span<const double> x,
                                          std::span<const double> d) const {
  std::vector<double> increment(bodies_.n_forces());
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] = x[i] - old.displacement[i];
  return bodies_.balance.relative_step(d.first(increment.size()), increment);
}

linear::BlockMatrix& MechanicalEquations::tangent(std::span<const double> x) {
  const Stopwatch watch(seconds_.assembly);
  const profile::Part part("assembly");
  // If contact has met new partners, the graph of the matrix grows.
  system_.follow_graph();
  // Then every block, inertia and contact add their tangents.
  system_.matrix().set_zero();
  const std::span<const double> u = x.first(bodies_.n_displacements());
  for (const auto& block : bodies_.blocks) block->add_tangent(u, system_.matrix());
  if (bodies_.inertia) bodies_.inertia->add_tangent(system_.matrix());
  {
    const profile::Part of_contact("contact");
    for (linear::Contribution* contribution : bodies_.contributions)
      contribution->add_tangent(u, system_.matrix());
  }
  if (system_.saddle() != nullptr) system_.saddle()->assemble();
  return system_.matrix();
}

MechanicalReport MechanicalEquations::conclude(const MechanicalState& old, const MechanicalPass& pass,
                                               std::vector<double> x, MechanicalState& trial) {
  MechanicalState next;
  // Most of a state is its history: the storage of the one that is overwritten serves again.
  if (&trial != &old) {
    next.history = std::move(trial.history);
    next.elements = std::move(trial.elements);
  }
  const bool remembers = bodies_.inertia && bodies_.inertia->motion().remembers();
  if (remembers)
    next.stress = old.stress;  // of the right size
  else if (pass.stores_stress)
    for (const BlockHistory& history : old.history) next.stress.push_back(no_stress(history));
  std::vector<StressAtWork> at_work;
  StepDeformation deformation;
  const BlockWork total =
      bodies_.finish(old, x, next.history, next.stress.empty() ? nullptr : &next.stress,
                     pass.returns_at_work ? &at_work : nullptr, &next.elements, &deformation);
  MechanicalReport report = measure(old, pass, x, total, next);
  report.at_work.stress = std::move(at_work);
  report.deformation = std::move(deformation);
  x.resize(bodies_.n_displacements());
  next.displacement = std::move(x);
  next.solid_fraction = bodies_.nodal_phases.solid_fraction(fraction_place(pass));
  // If the last body with a pressure has been removed, the old values are kept, because checkpoints have room
  // for them.
  next.pressure = bodies_.pressure ? bodies_.pressure->pressure() : old.pressure;
  if (bodies_.options.integration == TimeIntegration::two_step) {
    next.before = old.history;
    next.dt_before = pass.dt;
  }
  trial = std::move(next);
  return report;
}

/// Forces, works and energies at the solution; with inertia also the motion of the next state.
MechanicalReport MechanicalEquations::measure(const MechanicalState& old, const MechanicalPass& pass,
                                              std::span<const double> x, const BlockWork& sums,
                                              MechanicalState& next) {
  // The residual at the solution: internal + contributions + inertia − loads, the support force where fixed.
  // Newton's iteration ends with it.
  std::vector<double> r(bodies_.n_residuals());
  residual(x, r);
  r.resize(bodies_.n_forces());
  x = x.first(bodies_.n_displacements());
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
    report.reactions[i] = bodies_.loads->fixed()[i] ? r[i] : 0.0;
    local[0] += external[i] * increment;
    local[bodies_.loads->fixed()[i] ? 1 : 2] += support[i] * increment;
  }
  if (bodies_.inertia) {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= inertial_[i];
    residual_is_known_ = false;  // inertial_ becomes another force
    const MotionWork motion = bodies_.inertia->conclude(x, r, external_, bodies_.loads->fixed(), next);
    // The support force of t_{n+1}, not the method's mean over the step.
    bodies_.inertia->mass().multiply(next.acceleration, bodies_.components, inertial_);
    for (std::size_t i = 0; i < r.size(); ++i)
      if (bodies_.loads->fixed()[i] != 0) report.reactions[i] = r[i] + inertial_[i];
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

std::size_t MechanicalEquations::bytes() const {
  return (forces_.capacity() + x_.capacity() + external_.capacity()) * sizeof(double);
}

}  // namespace solidus::mechanics
