/// The phase is put together here: kernels of the blocks, matrix with what is tied, pressure, solver. The
/// steps are in mechanical_step.cpp, messages in mechanical_failure.cpp.
#include "mechanics/mechanical_phase.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "linear/block_multigrid.hpp"
#include "material/external_law.hpp"
#include "mechanics/elements/absent_block.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/loads/melt_stiffness.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "mechanics/state/stress_history.hpp"
#include "system/common_failure.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

namespace {

/// Tolerance of the linear solver: Newmark's first step takes a_0 for exact.
constexpr double k_initial_acceleration = 1e-13;

linear::LinearSolverOptions linear_options(const MechanicsOptions& options) {
  return {.prefix = "mechanics_",
          .kind = options.solver,
          .symmetric = options.symmetric,
          .relative_tolerance = options.linear_tolerance};
}

std::vector<double> densities(const std::vector<material::Material>& materials) {
  std::vector<double> density;
  for (const material::Material& material : materials) density.push_back(material.density);
  return density;
}

std::unique_ptr<BlockKernel> make_kernel(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                         AnalysisKind kind, const material::Material& material,
                                         const MechanicsOptions& options) {
  return is_mixed(block, material, options.simplices)
             ? make_mixed_kernel(mesh, block, kind, material, options.mapping, options.stabilisation)
             : make_block_kernel(mesh, block, kind, material, options.mapping, options.b_bar);
}

}  // namespace

MechanicalPhase::MechanicalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                                 const std::vector<material::Material>& materials,
                                 std::span<const double> initial_temperature, MechanicalConditions conditions,
                                 MechanicsOptions options, std::vector<linear::Contribution*> contributions)
    : mesh_(mesh),
      kind_(kind),
      materials_(materials),
      components_(displacement_components(kind)),
      options_(std::move(options)),
      contributions_(std::move(contributions)),
      active_(mesh, conditions.absent_bodies),
      loads_(std::make_unique<Loads>(mesh, kind, std::move(conditions), active_, std::span<const double>{},
                                     densities(materials))),
      ghosts_(mesh),
      balance_(mesh, active_, components_),
      initial_temperature_(initial_temperature.begin(), initial_temperature.end()),
      nodal_phases_(mesh, materials, initial_temperature) {
  assert(materials.size() == mesh.bodies.size() && initial_temperature.size() == mesh.x.size());
  // Sub-scales are algebraic in quasi-statics and orthogonal with inertia, unless the case says otherwise.
  if (options_.stabilisation == Stabilisation::automatic)
    options_.stabilisation = options_.dynamics ? Stabilisation::orthogonal : Stabilisation::algebraic;
  create_blocks(materials);
  // Inertia counts active bodies alone: an absent body has no mass.
  if (options_.dynamics) {
    std::vector<double> density;
    for (std::size_t b = 0; b < materials.size(); ++b)
      density.push_back(active_.body(static_cast<int>(b)) ? materials[b].density : 0.0);
    inertia_ = std::make_unique<InertialForces>(mesh, kind, components_, density, *options_.dynamics);
    inertial_.resize(static_cast<std::size_t>(mesh.n_owned_nodes * components_));
  }
  // Weight is constant through the run and goes to the constant loads. The modulus of a melt follows from the
  // head of its body.
  find_weight(loads_->conditions().gravity);
  loads_->add_constant(weight_);
  melt_ = melt_moduli(mesh, kind_, materials, active_, loads_->conditions());

  // The matrix is symmetric only if every block is; pressure, matrix and solver are made in this order
  // because each asks the one before.
  for (const auto& block : blocks_) options_.symmetric = options_.symmetric && block->symmetric();
  create_pressure();
  create_matrix();
  create_solver();
  forces_.resize(mesh.x.size() * static_cast<std::size_t>(components_));
  external_.resize(static_cast<std::size_t>(mesh.n_owned_nodes * components_));
}

MechanicalPhase::~MechanicalPhase() = default;

void MechanicalPhase::create_blocks(const std::vector<material::Material>& materials) {
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    const material::Material& material = materials[static_cast<std::size_t>(block.body)];
    if (!active_.body(block.body)) {
      blocks_.push_back(std::make_unique<AbsentBlock>());
      continue;
    }
    plastic_ = plastic_ || material.flow.has_value() || external_law(material) != nullptr;
    blocks_.push_back(make_block(blocks_.size()));
  }
}

/// The kernel of a block with the stress that it starts with.
std::unique_ptr<BlockKernel> MechanicalPhase::make_block(std::size_t b) {
  const mesh::ElementBlock& block = mesh_.blocks[b];
  const material::Material& material = materials_[static_cast<std::size_t>(block.body)];
  auto kernel = make_kernel(mesh_, block, kind_, material, options_);
  if (options_.initial_stress.empty() || options_.initial_stress[b].empty()) return kernel;
  const StepStart start{.temperature = initial_temperature_,
                        .pass_temperature = initial_temperature_,
                        .initial_temperature = initial_temperature_,
                        .old_displacement = {},
                        .held_displacement = {},
                        .held_history = nullptr,
                        .old_history = nullptr,
                        .start_history = nullptr,
                        .dt = 1,
                        .effective = material::TimeStep::backward_euler(1),
                        .phases = nodal_phases_.evaluate(b, {initial_temperature_, {}}, {})};
  if (!kernel->set_initial_stress(start, options_.initial_stress[b]))
    throw InputError({}, "the law of '" + material.name + "' cannot start with a stress",
                     "a material of the built-in laws");
  return kernel;
}

/// The mean stress around each node, [local node][field].
std::vector<double> MechanicalPhase::initial_pressure() {
  std::vector<double> sum(pressure_->absent().size(), 0.0), weight(sum.size(), 0.0);
  if (options_.initial_stress.empty()) return sum;
  const BodyFields& fields = pressure_->fields_of_bodies();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::vector<double>& stress = options_.initial_stress[b];
    if (stress.empty() || dynamic_cast<MixedKernel*>(blocks_[b].get()) == nullptr) continue;
    const mesh::ElementBlock& block = mesh_.blocks[b];
    const int field = fields.of_body[static_cast<std::size_t>(block.body)];
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < mesh::node_count(block.shape); ++a) {
        const auto at = static_cast<std::size_t>(block.element(e)[a] * pressure_->fields() + field);
        const double* s = stress.data() + 6 * static_cast<std::size_t>(e);
        sum[at] += (s[0] + s[1] + s[2]) / 3;
        weight[at] += 1;
      }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (weight[i] > 0) sum[i] /= weight[i];
  ghosts_.update(sum, pressure_->fields());
  return sum;
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

/// Frees the memory of the elements of removed bodies. Bodies that come back get new kernels.
void MechanicalPhase::remove_bodies(const linear::ActiveSet& active) {
  if (inertia_) throw std::invalid_argument("bodies can leave in quasi-statics only");
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const mesh::ElementBlock& block = mesh_.blocks[b];
    if (active.body(block.body) == active_.body(block.body)) continue;
    if (active.body(block.body)) {
      blocks_[b] = make_block(b);
      continue;
    }
    blocks_[b] = std::make_unique<AbsentBlock>();
  }
  active_ = active;
  balance_ = BodyBalance(mesh_, active_, components_);
}

linear::NodeGraph MechanicalPhase::graph() const {
  linear::NodeGraph graph(mesh_);
  // The coupled matrix of the simultaneous scheme has this pattern: what a body that only conducts takes
  // depends on the displacement of those that it touches.
  if (!active_.complete() && options_.mapping != Mapping::simultaneous) {
    std::vector<char> absent(mesh_.x.size());
    for (std::size_t i = 0; i < absent.size(); ++i) absent[i] = !active_.node(static_cast<Index>(i));
    graph.leave_out(std::move(absent));
  }
  for (const mesh::ElementBlock& block : mesh_.blocks)
    if (active_.body(block.body)) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const linear::Contribution* contribution : contributions_) contribution->add_to_graph(graph);
  return graph;
}

void MechanicalPhase::create_matrix() {
  using Storage = linear::BlockMatrix::Storage;
  Storage storage = Storage::whole;
  // The blocks that couple displacements with temperatures share the pattern of this matrix, so it is then
  // stored whole.
  if (options_.mapping != Mapping::simultaneous &&
      !parallel::any_process(!loads_->constraint_groups().empty())) {
    if (!pressure_)
      storage = linear::storage_for(linear_options(options_), mesh_, components_,
                                    linear::rigid_body_mode_count(components_));
    else if (options_.symmetric)
      storage = Storage::upper;
  }
  matrix_ = std::make_unique<linear::BlockMatrix>(mesh_, components_, graph(), storage);
  matrix_->set_fixed(loads_->fixed());
  matrix_->constrain(loads_->constraint_groups());
  bind();
}

void MechanicalPhase::bind() {
  for (const auto& block : blocks_) block->bind(*matrix_);
  if (inertia_) inertia_->bind(*matrix_);
  for (linear::Contribution* contribution : contributions_) contribution->bind(*matrix_);
}

/// Without mixed elements there is none.
void MechanicalPhase::create_pressure() {
  const bool any = std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) {
    return dynamic_cast<const MixedKernel*>(block.get()) != nullptr;
  });
  // States hold the fields: they stay when bodies leave.
  std::optional<BodyFields> fields;
  if (pressure_) fields = pressure_->fields_of_bodies();
  pressure_.reset();
  fields_.assign(1, components_);
  if (!any) return;  // every process has every block
  if (options_.solver == linear::SolverKind::jacobi || options_.solver == linear::SolverKind::incomplete)
    throw InputError({}, "this solver of mechanics cannot find the pressure of mixed triangles or tetrahedra",
                     "\"automatic\", \"direct\" or \"multigrid\", or simplices = \"displacement\"");
  const bool orthogonal = options_.stabilisation == Stabilisation::orthogonal;
  if (!orthogonal && inertia_) throw std::invalid_argument("algebraic sub-scales are for quasi-statics");
  if (!fields) fields = body_fields(mesh_, materials_, mixed_blocks(blocks_));
  pressure_ = std::make_unique<NodalPressure>(mesh_, std::move(*fields), blocks_, orthogonal);
  fields_.push_back(pressure_->fields());
  set_body_force(0);
}

/// Mixed elements need the force per volume itself, in addition to the nodal forces that it makes.
void MechanicalPhase::set_body_force(double time) {
  run_collectively([&] {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      auto* const kernel = dynamic_cast<MixedKernel*>(blocks_[b].get());
      if (kernel == nullptr) continue;
      const mesh::ElementBlock& block = mesh_.blocks[b];
      const double density = materials_[static_cast<std::size_t>(block.body)].density;
      std::vector<double> force(3 * static_cast<std::size_t>(block.size()));
      for (std::size_t i = 0; i < force.size(); ++i) force[i] = density * loads_->conditions().gravity[i % 3];
      loads_->add_body_forces(block, time, force);
      kernel->set_body_force(force);
    }
  });
}

std::size_t MechanicalPhase::n_unknowns() const {
  return n_displacements() + (pressure_ ? pressure_->absent().size() : 0);
}

std::size_t MechanicalPhase::n_residuals() const {
  return n_forces() +
         (pressure_ ? static_cast<std::size_t>(mesh_.n_owned_nodes * pressure_->fields()) : std::size_t{0});
}

void MechanicalPhase::create_solver() {
  if (solver_) seconds_before_ += solver_->seconds_setup() + solver_->seconds_solve();
  saddle_solver_ = nullptr;
  if (pressure_) {
    auto solver =
        std::make_unique<SaddleSolver>(mesh_, *matrix_, *pressure_, ghosts_,
                                       SaddleSolverOptions{.kind = options_.solver,
                                                           .symmetric = options_.symmetric,
                                                           .relative_tolerance = options_.linear_tolerance});
    saddle_solver_ = solver.get();
    solver_ = std::move(solver);
    return;
  }
  auto solver = std::make_unique<linear::LinearSolver>(mesh_, linear_options(options_));
  solver->use_rigid_body_modes(components_);
  solver_ = std::move(solver);
}

void MechanicalPhase::set_conditions(MechanicalConditions conditions, std::span<const double> start) {
  // New conditions may change which bodies are active and which unknowns are tied: only then the matrix has
  // to be made again.
  const linear::ActiveSet active(mesh_, conditions.absent_bodies);
  auto loads =
      std::make_unique<Loads>(mesh_, kind_, std::move(conditions), active, start, densities(materials_));
  const bool same_matrix =
      active == active_ && !parallel::any_process(loads->constraint_groups() != loads_->constraint_groups());
  // Bodies that have gone take their weight along.
  if (active != active_) {
    remove_bodies(active);
    find_weight(loads->conditions().gravity);
  }
  loads->add_constant(weight_);
  melt_ = melt_moduli(mesh_, kind_, materials_, active_, loads->conditions());
  loads_ = std::move(loads);
  create_pressure();
  // With the same matrix fixed rows change, and the solver forgets what it knew.
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
  if (pressure_) state.pressure = initial_pressure();
  state.solid_fraction = nodal_phases_.initial_solid_fraction();
  if (options_.integration == TimeIntegration::two_step) state.before = state.history;
  if (inertia_) set_in_motion(state);
  return state;
}

/// M a_0 = f_ext(0) − f_int(0): without displacement, at Θ_0, there is no stress.
void MechanicalPhase::set_in_motion(MechanicalState& state) {
  state.velocity = inertia_->initial_velocity();
  loads_->prescribe_rate(0, state.velocity);
  matrix_->constraints().share(std::span(state.velocity).first(external_.size()));
  ghosts_.update(state.velocity, components_);

  loads_->evaluate(0, external_);
  std::vector<double> net(external_.size(), 0.0);
  for (linear::Contribution* contribution : contributions_)
    contribution->add_residual(state.displacement, net);
  std::vector<double> free(net.size());
  for (std::size_t i = 0; i < net.size(); ++i) {
    net[i] -= external_[i];
    free[i] = loads_->fixed()[i] != 0 ? 0.0 : -net[i];
  }
  matrix_->constraints().sum(free);
  matrix_->set_zero();
  inertia_->mass().add_to(*matrix_, 1.0);
  // Scaled by its diagonal a mass matrix is well conditioned on every mesh (Wathen 1987).
  linear::LinearSolver solver(
      mesh_,
      {.prefix = "mass_", .kind = linear::SolverKind::jacobi, .relative_tolerance = k_initial_acceleration});
  state.acceleration.assign(forces_.size(), 0.0);
  const std::span<double> owned = std::span(state.acceleration).first(net.size());
  const linear::LinearReport report = solver.solve(*matrix_, free, owned);
  if (!report.converged)
    throw StepRejected("mechanics: no initial acceleration, " + report.reason, {}, Failure::linear_solver);
  for (std::size_t i = 0; i < owned.size(); ++i)
    if (loads_->fixed()[i] != 0) owned[i] = 0;
  matrix_->constraints().share(owned);
  ghosts_.update(state.acceleration, components_);

  if (!inertia_->motion().remembers()) return;
  state.net_force.assign(forces_.size(), 0.0);
  state.load.assign(forces_.size(), 0.0);
  std::copy(net.begin(), net.end(), state.net_force.begin());
  std::copy(external_.begin(), external_.end(), state.load.begin());
  for (const BlockHistory& history : state.history) state.stress.push_back(no_stress(history));
}

double MechanicalPhase::seconds_solver() const {
  return seconds_before_ + solver_->seconds_setup() + solver_->seconds_solve();
}

std::size_t MechanicalPhase::bytes() const {
  std::size_t total =
      matrix_->bytes() + (forces_.capacity() + x_.capacity() + external_.capacity()) * sizeof(double);
  for (const auto& block : blocks_) total += block->bytes();
  total += nodal_phases_.bytes();
  if (inertia_) total += inertia_->bytes();
  if (pressure_) total += pressure_->bytes() + saddle_solver_->bytes();
  return total;
}

}  // namespace solidus::mechanics
