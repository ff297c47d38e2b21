#include "mechanics/mechanical_phase.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/errors.hpp"
#include "base/profile.hpp"
#include "base/stopwatch.hpp"
#include "mechanics/absent_block.hpp"
#include "mechanics/block_kernel.hpp"
#include "mechanics/loads.hpp"
#include "mechanics/mixed_solver.hpp"

namespace solidus::mechanics {

namespace {

/// Forces that a strain of this size would cause count as round-off: the criterion of a body without load.
constexpr double k_round_off_strain = 1e-13;
/// Of the linear solver: Newmark's first step takes a_0 for exact.
constexpr double k_initial_acceleration = 1e-13;

/// At the points of a block with this history.
BlockHistory no_stress(const BlockHistory& history) {
  constexpr int k_components = 6;
  BlockHistory stress{k_components, history.n_points, {}};
  if (history.n_components == 0) return stress;  // of a block that takes no part
  const std::size_t n_points = history.values.size() / static_cast<std::size_t>(history.n_components);
  stress.values.assign(n_points * k_components, Lane(0.0));
  return stress;
}

}  // namespace

MechanicalPhase::MechanicalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                                 const std::vector<material::Material>& materials,
                                 std::span<const double> initial_temperature, Conditions conditions,
                                 MechanicsOptions options, std::vector<algebra::Contribution*> contributions)
    : mesh_(mesh),
      kind_(kind),
      materials_(materials),
      components_(displacement_components(kind)),
      options_(std::move(options)),
      contributions_(std::move(contributions)),
      presence_(mesh, conditions.absent_bodies),
      loads_(std::make_unique<Loads>(mesh, kind, std::move(conditions), presence_)),
      ghosts_(mesh),
      balance_(mesh, presence_, components_),
      initial_temperature_(initial_temperature.begin(), initial_temperature.end()) {
  assert(materials.size() == mesh.bodies.size() && initial_temperature.size() == mesh.x.size());
  create_blocks(materials);
  if (options_.dynamics) {
    std::vector<double> density;
    for (std::size_t b = 0; b < materials.size(); ++b)
      density.push_back(presence_.body(static_cast<int>(b)) ? materials[b].density : 0.0);
    inertia_ = std::make_unique<InertialForces>(mesh, kind, components_, density, *options_.dynamics);
    inertial_.resize(static_cast<std::size_t>(mesh.n_owned_nodes * components_));
  }
  find_weight(loads_->conditions().gravity);
  loads_->add_constant(weight_);

  for (const auto& block : blocks_) options_.symmetric = options_.symmetric && block->symmetric();
  create_pressure();
  create_matrix();
  create_solver();
  forces_.resize(mesh.x.size() * static_cast<std::size_t>(components_));
  external_.resize(static_cast<std::size_t>(mesh.n_owned_nodes * components_));
  reactions_.assign(external_.size(), 0.0);
}

MechanicalPhase::~MechanicalPhase() = default;

void MechanicalPhase::create_blocks(const std::vector<material::Material>& materials) {
  for (const mesh::Block& block : mesh_.blocks) {
    const material::Material& material = materials[static_cast<std::size_t>(block.body)];
    if (!presence_.body(block.body)) {
      blocks_.push_back(std::make_unique<AbsentBlock>(mesh_, block, kind_, material));
      continue;
    }
    plastic_ = plastic_ || material.flow.has_value();
    const bool mixed =
        options_.mapping != Mapping::simultaneous && is_mixed(block, material, options_.simplices);
    blocks_.push_back(
        mixed ? make_mixed_kernel(mesh_, block, kind_, material, options_.mapping, options_.stabilisation)
              : make_block_kernel(mesh_, block, kind_, material, options_.mapping, options_.b_bar));
  }
}

std::vector<double> MechanicalPhase::nodal_mass() const {
  std::vector<double> mass(mesh_.x.size(), 0.0);
  if (inertia_) {
    // The weight of the very same masses: a free body falls as one.
    const std::vector<double> ones(mesh_.x.size(), 1.0);
    inertia_->mass().multiply(ones, 1, std::span(mass).first(static_cast<std::size_t>(mesh_.n_owned_nodes)));
    return mass;
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    blocks_[b]->add_nodal_volume(materials_[static_cast<std::size_t>(mesh_.blocks[b].body)].density, mass);
  return mass;
}

void MechanicalPhase::find_weight(const std::array<double, 3>& gravity) {
  const std::vector<double> mass = nodal_mass();
  const auto n = static_cast<std::size_t>(components_);
  weight_.resize(mass.size() * n);
  for (std::size_t node = 0; node < mass.size(); ++node)
    for (std::size_t i = 0; i < n; ++i) weight_[node * n + i] = mass[node] * gravity[i];
}

/// What the elements of bodies that have gone need is given back.
void MechanicalPhase::remove_bodies(const algebra::Presence& presence) {
  if (inertia_) throw std::invalid_argument("bodies can leave in quasi-statics only");
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const mesh::Block& block = mesh_.blocks[b];
    if (presence.body(block.body) && !presence_.body(block.body))
      throw std::invalid_argument("a body that has gone cannot come back");
    if (presence.body(block.body) || !presence_.body(block.body)) continue;
    blocks_[b] =
        std::make_unique<AbsentBlock>(mesh_, block, kind_, materials_[static_cast<std::size_t>(block.body)]);
  }
  presence_ = presence;
  balance_ = BodyBalance(mesh_, presence_, components_);
}

algebra::NodeGraph MechanicalPhase::graph() const {
  algebra::NodeGraph graph(mesh_);
  if (!presence_.complete()) {
    std::vector<char> absent(mesh_.x.size());
    for (std::size_t i = 0; i < absent.size(); ++i) absent[i] = !presence_.node(static_cast<Index>(i));
    graph.leave_out(std::move(absent));
  }
  for (const mesh::Block& block : mesh_.blocks)
    if (presence_.body(block.body)) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const algebra::Contribution* contribution : contributions_) contribution->add_to_graph(graph);
  return graph;
}

void MechanicalPhase::create_matrix() {
  matrix_ = std::make_unique<algebra::BlockMatrix>(mesh_, components_, graph());
  matrix_->set_fixed(loads_->fixed());
  matrix_->tie(loads_->ties());
  bind();
}

void MechanicalPhase::bind() {
  for (const auto& block : blocks_) block->bind(*matrix_);
  if (inertia_) inertia_->bind(*matrix_);
  for (algebra::Contribution* contribution : contributions_) contribution->bind(*matrix_);
}

/// Without mixed elements there is none.
void MechanicalPhase::create_pressure() {
  const bool any = std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) {
    return dynamic_cast<const MixedKernel*>(block.get()) != nullptr;
  });
  pressure_.reset();
  if (!any) return;  // every process has every block
  if (options_.solver == algebra::SolverKind::jacobi || options_.solver == algebra::SolverKind::incomplete)
    throw InputError({}, "this solver of mechanics cannot find the pressure of mixed triangles or tetrahedra",
                     "\"automatic\", \"direct\" or \"multigrid\", or simplices = \"displacement\"");
  std::vector<std::array<double, 3>> body_force;
  if (options_.stabilisation == Stabilisation::algebraic) {
    if (inertia_) throw std::invalid_argument("algebraic sub-scales are for quasi-statics");
    for (const material::Material& material : materials_) {
      body_force.push_back(loads_->conditions().gravity);
      for (double& f : body_force.back()) f *= material.density;
    }
  }
  pressure_ =
      std::make_unique<PressureEquation>(mesh_, components_, materials_, blocks_, std::move(body_force),
                                         factorises(options_.solver, mesh_, components_));
}

void MechanicalPhase::create_solver() {
  mixed_solver_ = nullptr;
  if (pressure_) {
    auto solver = std::make_unique<MixedSolver>(
        mesh_, *matrix_, *pressure_, ghosts_,
        MixedSolverOptions{.direct = factorises(options_.solver, mesh_, components_),
                           .symmetric = options_.symmetric,
                           .relative_tolerance = options_.linear_tolerance});
    mixed_solver_ = solver.get();
    solver_ = std::move(solver);
    return;
  }
  auto solver = std::make_unique<algebra::LinearSolver>(
      mesh_, algebra::LinearSolverOptions{.prefix = "mechanics_",
                                          .kind = options_.solver,
                                          .symmetric = options_.symmetric,
                                          .relative_tolerance = options_.linear_tolerance});
  solver->use_rigid_body_modes(components_);
  solver_ = std::move(solver);
}

void MechanicalPhase::set_conditions(Conditions conditions, std::span<const double> start) {
  const algebra::Presence presence(mesh_, conditions.absent_bodies);
  auto loads = std::make_unique<Loads>(mesh_, kind_, std::move(conditions), presence, start);
  const bool same_matrix = presence == presence_ && !algebra::any_process(loads->ties() != loads_->ties());
  if (presence != presence_) {
    remove_bodies(presence);
    find_weight(loads->conditions().gravity);
  }
  loads->add_constant(weight_);
  loads_ = std::move(loads);
  create_pressure();
  if (same_matrix && !pressure_) {
    matrix_->set_fixed(loads_->fixed());
    solver_->forget();
  } else {
    create_matrix();
    create_solver();
  }
}

MechanicalState MechanicalPhase::initial_state() {
  MechanicalState state;
  state.displacement.assign(forces_.size(), 0.0);
  for (const auto& block : blocks_) state.history.push_back(block->initial_history());
  if (pressure_) state.pressure = pressure_->pressure();
  if (options_.integration == TimeIntegration::two_step) state.before = state.history;
  if (inertia_) set_in_motion(state);
  return state;
}

/// M a_0 = f_ext(0) − f_int(0): without displacement, at Θ_0, there is no stress.
void MechanicalPhase::set_in_motion(MechanicalState& state) {
  state.velocity = inertia_->initial_velocity();
  loads_->prescribe_rate(0, state.velocity);
  matrix_->ties().share(std::span(state.velocity).first(external_.size()));
  ghosts_.update(state.velocity, components_);

  loads_->evaluate(0, external_);
  std::vector<double> net(external_.size(), 0.0);
  for (algebra::Contribution* contribution : contributions_)
    contribution->add_residual(state.displacement, net);
  std::vector<double> free(net.size());
  for (std::size_t i = 0; i < net.size(); ++i) {
    net[i] -= external_[i];
    free[i] = loads_->fixed()[i] != 0 ? 0.0 : -net[i];
  }
  matrix_->ties().sum(free);
  matrix_->set_zero();
  inertia_->mass().add_to(*matrix_, 1.0);
  // Scaled by its diagonal a mass matrix is well conditioned on every mesh (Wathen 1987).
  algebra::LinearSolver solver(
      mesh_,
      {.prefix = "mass_", .kind = algebra::SolverKind::jacobi, .relative_tolerance = k_initial_acceleration});
  state.acceleration.assign(forces_.size(), 0.0);
  const std::span<double> owned = std::span(state.acceleration).first(net.size());
  const algebra::LinearReport report = solver.solve(*matrix_, free, owned);
  if (!report.converged) throw StepRejected("mechanics: no initial acceleration, " + report.reason);
  for (std::size_t i = 0; i < owned.size(); ++i)
    if (loads_->fixed()[i] != 0) owned[i] = 0;
  matrix_->ties().share(owned);
  ghosts_.update(state.acceleration, components_);

  if (!inertia_->motion().remembers()) return;
  state.net_force.assign(forces_.size(), 0.0);
  state.load.assign(forces_.size(), 0.0);
  std::copy(net.begin(), net.end(), state.net_force.begin());
  std::copy(external_.begin(), external_.end(), state.load.begin());
  for (const BlockHistory& history : state.history) state.stress.push_back(no_stress(history));
}

/// The first step, and one that grows beyond what the two-step method stands, are backward Euler steps.
material::TimeStep MechanicalPhase::time_step(const MechanicalState& old, double dt) const {
  const bool two_step = options_.integration == TimeIntegration::two_step && old.dt_before > 0 &&
                        dt <= material::k_largest_growth * old.dt_before;
  return two_step ? material::TimeStep::two_step(dt, old.dt_before) : material::TimeStep::backward_euler(dt);
}

/// Hands the blocks temperatures, the state at t_n and the start of the effective step.
void MechanicalPhase::prepare(const MechanicalState& old, const MechanicalPass& pass) {
  const profile::Part part("properties");
  const material::TimeStep step = time_step(old, pass.dt);
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
  const bool keeps = keeps_stress_ && !remembers;
  if (remembers) stress_ = old.stress;  // of the right size
  if (keeps) {
    no_stress_.clear();
    for (const BlockHistory& history : old.history) no_stress_.push_back(no_stress(history));
    stress_ = no_stress_;
  }
  double stiffness = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    stiffness += blocks_[b]->prepare(
        {.temperature = pass.temperature,
         .pass_temperature = pass.iterate_temperature.empty() ? pass.temperature : pass.iterate_temperature,
         .initial_temperature = initial_temperature_,
         .held_displacement = held.displacement,
         .held_history = &held.history[b],
         .old_history = &old.history[b],
         .start_history = extrapolates ? &start_[b] : &old.history[b],
         .dt = pass.dt,
         .effective_dt = step.dt,
         .old_stress = remembers ? &old.stress[b]
                       : keeps   ? &no_stress_[b]
                                 : nullptr,
         .new_stress = remembers || keeps ? &stress_[b] : nullptr,
         .stress_share = remembers ? inertia_->motion().work_share : 1,
         .work = pass.work});
  if (pressure_) pressure_->begin(held.pressure);
  stress_at_work_ = pass.work;
  residual_is_known_ = false;
  round_off_ = k_round_off_strain * std::sqrt(algebra::global_sum(stiffness));
  if (inertia_) round_off_ += inertia_->round_off();
}

double MechanicalPhase::residual(std::span<const double> x, std::span<double> r) {
  const bool known = residual_is_known_ && std::equal(x.begin(), x.end(), x_.begin(), x_.end());
  if (!algebra::any_process(!known)) {
    std::copy(residual_.begin(), residual_.end(), r.begin());
    return balance_.reference();
  }
  const Stopwatch watch(seconds_residual_);
  const profile::Part part("law and forces");
  x_.assign(x.begin(), x.end());
  std::fill(forces_.begin(), forces_.end(), 0.0);
  balance_.begin();
  const bool found = !pressure_ || pressure_->solve(x);
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    balance_.add_internal(mesh_.blocks[b].body, blocks_[b]->add_forces(x, forces_));
  // Newton's iteration takes what is not a number for a step too far.
  if (!found) std::fill(forces_.begin(), forces_.end(), std::numeric_limits<double>::quiet_NaN());
  std::fill(r.begin(), r.end(), 0.0);
  {
    const profile::Part of_contact("contact");
    for (algebra::Contribution* contribution : contributions_) contribution->add_residual(x, r);
  }
  balance_.add_exchanged(r);
  balance_.add_exchanged(external_);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += forces_[i] - external_[i];
  if (inertia_) {
    inertia_->force(x, inertial_);
    balance_.add_exchanged(inertial_);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += inertial_[i];
  }
  add_residual_to_balance(r);
  residual_.assign(r.begin(), r.end());
  residual_is_known_ = true;
  return balance_.reference();
}

/// What keeps a face plane are forces that the body exchanges, like those of a support; their sum is
/// residual.
void MechanicalPhase::add_residual_to_balance(std::span<const double> r) {
  if (matrix_->ties().empty()) {
    balance_.add_residual(r, loads_->fixed(), loads_->supported());
    return;
  }
  std::vector<double> holding(r.size(), 0.0), rest(r.begin(), r.end());
  for (const auto& group : loads_->ties())
    for (const Index entry : group) {
      const auto at = static_cast<std::size_t>(entry);
      if (at < r.size()) holding[at] = r[at];
    }
  matrix_->ties().sum(rest);
  balance_.add_exchanged(holding);
  balance_.add_residual(rest, loads_->fixed(), loads_->supported());
}

algebra::BlockMatrix& MechanicalPhase::tangent() {
  const Stopwatch watch(seconds_assembly_);
  const profile::Part part("assembly");
  if (algebra::graph_outdated(contributions_)) {
    matrix_->set_graph(graph());
    solver_->reset();
    bind();
  }
  matrix_->set_zero();
  for (const auto& block : blocks_) block->add_tangent(x_, *matrix_);
  if (inertia_) inertia_->add_tangent(*matrix_);
  const profile::Part of_contact("contact");
  for (algebra::Contribution* contribution : contributions_) contribution->add_tangent(x_, *matrix_);
  if (mixed_solver_ != nullptr) mixed_solver_->assemble();
  return *matrix_;
}

PhaseReport MechanicalPhase::solve(const MechanicalState& old, MechanicalState& trial,
                                   const MechanicalPass& pass) {
  begin(old, pass);
  algebra::NewtonOptions newton_options = options_.newton;
  newton_options.absolute_tolerance = std::max(newton_options.absolute_tolerance, round_off_);
  if (pass.newton_steps > 0) newton_options.max_iterations = pass.newton_steps;
  std::vector<double> x = start(old, pass);
  look_ahead(pass, x);
  PhaseReport report;
  report.newton = algebra::newton(*this, *solver_, ghosts_, components_, x, newton_options);
  const bool may_end = pass.newton_steps > 0 && report.newton.out_of_iterations;
  if (!report.newton.converged && !may_end) reject(report.newton.reason, x);
  report.work = conclude(old, pass, std::move(x), trial);
  return report;
}

double MechanicalPhase::unbalanced(std::span<const double> x) {
  std::vector<double> r(external_.size());
  residual(x, r);
  for (std::size_t i = 0; i < r.size(); ++i)
    if (loads_->fixed()[i] != 0) r[i] = 0;
  matrix_->ties().sum(r);
  double squares = 0;
  for (const double value : r) squares += value * value;
  return std::sqrt(algebra::global_sum(squares));
}

void MechanicalPhase::look_ahead(const MechanicalPass& pass, std::vector<double>& x) {
  if (!algebra::any_process(!pass.guess.empty())) return;
  std::vector<double> guess(pass.guess.begin(), pass.guess.end());
  loads_->prescribe(pass.time, guess);
  const double here = unbalanced(x);
  if (here <= round_off_) return;
  const double there = unbalanced(guess);
  if (there < here) x = std::move(guess);
}

void MechanicalPhase::begin(const MechanicalState& old, const MechanicalPass& pass) {
  assert(old.displacement.size() == forces_.size() && old.history.size() == blocks_.size() && pass.dt > 0);
  loads_->evaluate(pass.time, external_);
  if (inertia_) inertia_->begin(old, pass.dt);
  prepare(old, pass);
}

std::vector<double> MechanicalPhase::start(const MechanicalState& old, const MechanicalPass& pass) const {
  std::vector<double> x = pass.iterate != nullptr ? pass.iterate->displacement : old.displacement;
  if (!pass.start.empty()) x.assign(pass.start.begin(), pass.start.end());
  loads_->prescribe(pass.time, x);
  return x;
}

void MechanicalPhase::rest(const MechanicalState& state, std::span<const double> temperature) {
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    blocks_[b]->rest({.temperature = temperature,
                      .pass_temperature = temperature,
                      .initial_temperature = initial_temperature_,
                      .held_displacement = state.displacement,
                      .held_history = &state.history[b],
                      .old_history = &state.history[b],
                      .start_history = &state.history[b],
                      .dt = 1,
                      .effective_dt = 1});
}

void MechanicalPhase::reject(const std::string& reason, std::span<const double> x) {
  if (const std::string failure = law_failure(x); !failure.empty())
    throw StepRejected("mechanics: a constitutive law asks for a smaller step", failure);
  throw StepRejected("mechanics: " + reason, worst_place(x));
}

BlockWork MechanicalPhase::finish(const MechanicalState& old, std::span<const double> x,
                                  std::vector<BlockHistory>& history) {
  const profile::Part part("history");
  BlockWork total;
  history.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    history[b].n_components = old.history[b].n_components;
    history[b].n_points = old.history[b].n_points;
    if (presence_.body(mesh_.blocks[b].body))
      history[b].values.resize(old.history[b].values.size());
    else  // of the layout that a checkpoint knows
      history[b].values.assign(old.history[b].values.size(), Lane(0.0));
    const BlockWork work = blocks_[b]->finish(old.displacement, x, history[b]);
    total.internal_work += work.internal_work;
    total.stabilisation_work += work.stabilisation_work;
    total.dissipation += work.dissipation;
    total.plastic_dissipation += work.plastic_dissipation;
    total.plastic_work += work.plastic_work;
    total.least_dissipation = std::min(total.least_dissipation, work.least_dissipation);
    total.largest_dissipation = std::max(total.largest_dissipation, work.largest_dissipation);
  }
  return total;
}

MechanicalWork MechanicalPhase::conclude(const MechanicalState& old, const MechanicalPass& pass,
                                         std::vector<double> x, MechanicalState& trial) {
  MechanicalState next;
  // Most of a state is its history: the storage of the one that is overwritten serves again.
  if (&trial != &old) next.history = std::move(trial.history);
  const BlockWork total = finish(old, x, next.history);
  const MechanicalWork work = measure(old, x, total, next);
  next.displacement = std::move(x);
  next.stress = std::move(stress_);
  if (pressure_) next.pressure = pressure_->pressure();
  if (options_.integration == TimeIntegration::two_step) {
    next.before = old.history;
    next.dt_before = pass.dt;
  }
  trial = std::move(next);
  return work;
}

/// Works and energies at the solution; with inertia also the motion of the next state.
MechanicalWork MechanicalPhase::measure(const MechanicalState& old, std::span<const double> x,
                                        const BlockWork& sums, MechanicalState& next) {
  // The residual at the solution: internal + contributions + inertia − loads, the support force where fixed.
  // Newton's iteration ends with it.
  std::vector<double> r(external_.size());
  residual(x, r);
  double local[9] = {0,
                     0,
                     0,
                     sums.internal_work,
                     sums.dissipation,
                     sums.plastic_dissipation,
                     sums.plastic_work,
                     0,
                     sums.stabilisation_work};
  if (stress_at_work_ != StressAtWork::kept) kept_ = {external_, r};
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double increment = x[i] - old.displacement[i];
    reactions_[i] = loads_->fixed()[i] ? r[i] : 0.0;
    local[0] += kept_.external[i] * increment;
    local[loads_->fixed()[i] ? 1 : 2] += kept_.residual[i] * increment;
  }
  if (inertia_) {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= inertial_[i];
    residual_is_known_ = false;  // inertial_ becomes another force
    const MotionWork motion = inertia_->conclude(x, r, external_, loads_->fixed(), next);
    // The support force of t_{n+1}, not the method's mean over the step.
    inertia_->mass().multiply(next.acceleration, components_, inertial_);
    for (std::size_t i = 0; i < r.size(); ++i)
      if (loads_->fixed()[i] != 0) reactions_[i] = r[i] + inertial_[i];
    local[0] = motion.external;
    local[1] = motion.support;
    local[7] = motion.kinetic;
    local[8] += motion.numerical;
  }
  double all[9];
  MPI_Allreduce(local, all, 9, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return {.external_work = all[0],
          .support_work = all[1],
          .residual_work = all[2],
          .internal_work = all[3],
          .dissipation = all[4],
          .plastic_dissipation = all[5],
          .plastic_work = all[6],
          .least_dissipation = algebra::global_min(sums.least_dissipation),
          .largest_dissipation = algebra::global_max(sums.largest_dissipation),
          .kinetic = all[7],
          .numerical = all[8]};
}

std::vector<double> MechanicalPhase::applied_forces() const {
  std::vector<double> force(residual_.size());
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = forces_[i] - residual_[i];
  return force;
}

std::string MechanicalPhase::worst_place(std::span<const double> x) {
  std::vector<double> r(external_.size());
  residual(x, r);
  matrix_->ties().sum(r);
  struct {
    double value;
    int rank;
  } worst{-1.0, 0}, winner{};
  MPI_Comm_rank(PETSC_COMM_WORLD, &worst.rank);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double size = std::isfinite(r[i]) ? std::abs(r[i]) : HUGE_VAL;
    if (loads_->fixed()[i] || size <= worst.value) continue;
    worst.value = size;
    entry = i;
  }
  MPI_Allreduce(&worst, &winner, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  char text[160] = {};
  if (winner.rank == worst.rank && !r.empty()) {
    const std::size_t node = entry / static_cast<std::size_t>(components_);
    const mesh::Point& p = mesh_.x[node];
    const auto end = fmt::format_to_n(text, sizeof text - 1,
                                      "node {} at ({:.6g}, {:.6g}, {:.6g}) m: unbalanced force {:.4g} N",
                                      mesh_.input_node[node], p[0], p[1], p[2], r[entry]);
    *end.out = '\0';
  }
  MPI_Bcast(text, sizeof text, MPI_CHAR, winner.rank, PETSC_COMM_WORLD);
  return text;
}

/// The first element whose law finds no state at x, of the lowest process that has one; empty without any.
std::string MechanicalPhase::law_failure(std::span<const double> x) const {
  std::string text;
  for (std::size_t b = 0; b < blocks_.size() && text.empty(); ++b) {
    text = blocks_[b]->failure(x);
    if (!text.empty())
      text = fmt::format("body '{}', {}", mesh_.bodies[static_cast<std::size_t>(mesh_.blocks[b].body)].name,
                         text);
  }
  int rank = 0, n_processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  const int mine = text.empty() ? n_processes : rank;
  int first = n_processes;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
  if (first == n_processes) return {};
  auto size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, first, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, first, PETSC_COMM_WORLD);
  return text;
}

std::vector<ElementFields> MechanicalPhase::element_fields() const {
  std::vector<ElementFields> fields;
  for (const auto& block : blocks_) fields.push_back(block->fields());
  return fields;
}

double MechanicalPhase::seconds_solver() const {
  return solver_->seconds_setup() + solver_->seconds_solve() + (pressure_ ? pressure_->seconds() : 0.0);
}

std::size_t MechanicalPhase::bytes() const {
  std::size_t total =
      matrix_->bytes() + (forces_.capacity() + x_.capacity() + external_.capacity()) * sizeof(double);
  for (const auto& block : blocks_) total += block->bytes();
  if (inertia_) total += inertia_->bytes();
  if (pressure_) total += pressure_->bytes() + mixed_solver_->bytes();
  return total;
}

}  // namespace solidus::mechanics
