/// The phase is put together here: kernels of the blocks, matrix with what is tied, pressure, solver. The
/// steps are in mechanical_step.cpp, messages in mechanical_failure.cpp.
#include "mechanics/mechanical_phase.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "material/external_law.hpp"
#include "mechanics/elements/absent_block.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/growing_bodies.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/loads/melt_stiffness.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "mechanics/state/stress_history.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

namespace {

/// Tolerance of the linear solver: Newmark's first step takes a_0 for exact.
constexpr double k_initial_acceleration = 1e-13;

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
    : bodies_(mesh, kind, materials, initial_temperature, std::move(conditions), std::move(options),
              std::move(contributions)),
      system_(bodies_),
      equations_(bodies_, system_) {
  assert(materials.size() == mesh.bodies.size() && initial_temperature.size() == mesh.x.size());
  create_blocks(materials);
  // Weight is constant through the run and goes to the constant loads. The modulus of a melt follows from the
  // head of its body.
  find_weight(bodies_.loads->conditions().gravity);
  bodies_.loads->add_constant(bodies_.weight);
  bodies_.melt = melt_moduli(mesh, bodies_.kind, materials, bodies_.active, bodies_.loads->conditions());

  // The matrix is symmetric only if every block is; pressure, matrix and solver are made in this order
  // because each asks the one before.
  for (const auto& block : bodies_.blocks)
    bodies_.options.symmetric = bodies_.options.symmetric && block->symmetric();
  create_pressure();
  system_.create();
}

void MechanicalPhase::create_blocks(const std::vector<material::Material>& materials) {
  for (const mesh::ElementBlock& block : bodies_.mesh.blocks) {
    const material::Material& material = materials[as_size(block.body)];
    if (!bodies_.active.body(block.body)) {
      bodies_.blocks.push_back(std::make_unique<AbsentBlock>());
      continue;
    }
    bodies_.plastic = bodies_.plastic || material.flow.has_value() || external_law(material) != nullptr;
    bodies_.blocks.push_back(make_block(bodies_.blocks.size()));
  }
}

/// The kernel of a block with the stress that it starts with.
std::unique_ptr<BlockKernel> MechanicalPhase::make_block(std::size_t b) {
  const mesh::ElementBlock& block = bodies_.mesh.blocks[b];
  const material::Material& material = bodies_.material(block.body);
  const MechanicsOptions& options = bodies_.options;
  auto kernel = make_kernel(bodies_.mesh, block, bodies_.kind, material, options);
  if (options.initial_stress.empty() || options.initial_stress[b].empty()) return kernel;
  const std::vector<double>& temperature = bodies_.initial_temperature;
  const StepStart start{.temperature = temperature,
                        .pass_temperature = temperature,
                        .initial_temperature = temperature,
                        .old_displacement = {},
                        .held_displacement = {},
                        .held_history = nullptr,
                        .old_history = nullptr,
                        .start_history = nullptr,
                        .dt = 1,
                        .effective = material::TimeStep::backward_euler(1),
                        .phases = bodies_.nodal_phases.evaluate(b, {temperature, {}}, {})};
  if (!kernel->set_initial_stress(start, options.initial_stress[b]))
    throw InputError({}, "the law of '" + material.name + "' cannot start with a stress",
                     "a material of the built-in laws");
  return kernel;
}

/// The mean stress around each node, [local node][field].
std::vector<double> MechanicalPhase::initial_pressure() {
  const NodalPressure& pressure = *bodies_.pressure;
  std::vector<double> sum(pressure.absent().size(), 0.0), weight(sum.size(), 0.0);
  const MechanicsOptions& options = bodies_.options;
  if (options.initial_stress.empty()) return sum;
  const BodyFields& fields = pressure.fields();
  for (std::size_t b = 0; b < bodies_.blocks.size(); ++b) {
    const std::vector<double>& stress = options.initial_stress[b];
    if (stress.empty() || dynamic_cast<MixedKernel*>(bodies_.blocks[b].get()) == nullptr) continue;
    const mesh::ElementBlock& block = bodies_.mesh.blocks[b];
    const int field = fields.of_body[as_size(block.body)];
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < mesh::node_count(block.shape); ++a) {
        const auto at = as_size(block.element(e)[a] * pressure.fields().n_fields + field);
        const double* s = stress.data() + 6 * as_size(e);
        sum[at] += (s[0] + s[1] + s[2]) / 3;
        weight[at] += 1;
      }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (weight[i] > 0) sum[i] /= weight[i];
  bodies_.ghosts.update(sum, pressure.fields().n_fields);
  return sum;
}

std::vector<double> MechanicalPhase::nodal_mass() const {
  std::vector<double> mass(bodies_.mesh.x.size(), 0.0);
  if (bodies_.inertia) {
    // The weight of the very same masses: a free body falls as one.
    const std::vector<double> ones(bodies_.mesh.x.size(), 1.0);
    bodies_.inertia->mass().multiply(ones, 1, std::span(mass).first(as_size(bodies_.mesh.n_owned_nodes)));
    return mass;
  }
  for (std::size_t b = 0; b < bodies_.blocks.size(); ++b)
    bodies_.blocks[b]->add_nodal_volume(bodies_.materials[as_size(bodies_.mesh.blocks[b].body)].density,
                                        mass);
  return mass;
}

void MechanicalPhase::find_weight(const std::array<double, 3>& gravity) {
  const std::vector<double> mass = nodal_mass();
  const auto n = as_size(bodies_.components);
  bodies_.weight.resize(mass.size() * n);
  for (std::size_t node = 0; node < mass.size(); ++node)
    for (std::size_t i = 0; i < n; ++i) bodies_.weight[node * n + i] = mass[node] * gravity[i];
}

/// Frees the memory of the elements of removed bodies. Bodies that come back get new kernels.
void MechanicalPhase::remove_bodies(const linear::ActiveSet& active) {
  if (bodies_.inertia) throw std::invalid_argument("bodies can leave in quasi-statics only");
  for (std::size_t b = 0; b < bodies_.blocks.size(); ++b) {
    const mesh::ElementBlock& block = bodies_.mesh.blocks[b];
    if (active.body(block.body) == bodies_.active.body(block.body)) continue;
    if (active.body(block.body)) {
      bodies_.blocks[b] = make_block(b);
      continue;
    }
    bodies_.blocks[b] = std::make_unique<AbsentBlock>();
  }
  bodies_.active = active;
  bodies_.balance = BodyBalance(bodies_.mesh, bodies_.active, bodies_.components);
}

/// Without mixed elements there is none.
void MechanicalPhase::create_pressure() {
  const bool any = std::any_of(bodies_.blocks.begin(), bodies_.blocks.end(), [](const auto& block) {
    return dynamic_cast<const MixedKernel*>(block.get()) != nullptr;
  });
  // States hold the fields: they stay when bodies leave.
  std::optional<BodyFields> fields;
  if (bodies_.pressure) fields = bodies_.pressure->fields();
  bodies_.pressure.reset();
  if (!any) return;  // every process has every block
  if (bodies_.options.solver == linear::SolverKind::jacobi ||
      bodies_.options.solver == linear::SolverKind::incomplete)
    throw InputError({}, "this solver of mechanics cannot find the pressure of mixed triangles or tetrahedra",
                     "\"automatic\", \"direct\" or \"multigrid\", or simplices = \"displacement\"");
  const bool orthogonal = bodies_.options.stabilisation == Stabilisation::orthogonal;
  if (!orthogonal && bodies_.inertia)
    throw std::invalid_argument("algebraic sub-scales are for quasi-statics");
  if (!fields) fields = body_fields(bodies_.mesh, bodies_.materials, mixed_blocks(bodies_.blocks));
  bodies_.pressure =
      std::make_unique<NodalPressure>(bodies_.mesh, std::move(*fields), bodies_.blocks, orthogonal);
  bodies_.set_body_force(0);
}

void MechanicalPhase::set_conditions(MechanicalConditions conditions, std::span<const double> start) {
  // New conditions may change which bodies are active and which unknowns are tied: only then the matrix has
  // to be made again. Of bodies that grow elements may have come.
  const bool other_elements = follow_elements(bodies_);
  const linear::ActiveSet active(bodies_.mesh, conditions.absent_bodies);
  auto loads = std::make_unique<Loads>(bodies_.mesh, bodies_.kind, std::move(conditions), active, start,
                                       densities(bodies_.materials));
  const bool same_matrix =
      !other_elements && active == bodies_.active &&
      !parallel::any_process(loads->constraint_groups() != bodies_.loads->constraint_groups());
  // Bodies that have gone take their weight along.
  if (other_elements || active != bodies_.active) {
    remove_bodies(active);
    find_weight(loads->conditions().gravity);
  }
  loads->add_constant(bodies_.weight);
  // The melt of a body that grows has the modulus of the whole body.
  if (!grows(bodies_))
    bodies_.melt =
        melt_moduli(bodies_.mesh, bodies_.kind, bodies_.materials, bodies_.active, loads->conditions());
  bodies_.loads = std::move(loads);
  create_pressure();
  // With the same matrix fixed rows change, and the solver forgets what it knew.
  if (same_matrix && !bodies_.pressure) {
    system_.set_fixed();
  } else {
    system_.create();
  }
}

MechanicalState MechanicalPhase::initial_state() {
  MechanicalState state;
  state.displacement.assign(bodies_.n_displacements(), 0.0);
  for (const auto& block : bodies_.blocks) state.history.push_back(block->initial_history());
  if (bodies_.pressure) state.pressure = initial_pressure();
  state.solid_fraction = bodies_.nodal_phases.initial_solid_fraction();
  if (bodies_.options.integration == TimeIntegration::two_step) state.before = state.history;
  if (bodies_.inertia) set_in_motion(state);
  return state;
}

/// M a_0 = f_ext(0) − f_int(0): without displacement, at Θ_0, there is no stress.
void MechanicalPhase::set_in_motion(MechanicalState& state) {
  state.velocity = bodies_.inertia->initial_velocity();
  bodies_.loads->prescribe_rate(0, state.velocity);
  system_.matrix().constraints().share(std::span(state.velocity).first(bodies_.n_forces()));
  bodies_.ghosts.update(state.velocity, bodies_.components);

  std::vector<double> external(bodies_.n_forces());
  bodies_.loads->evaluate(0, external);
  std::vector<double> net(external.size(), 0.0);
  for (linear::Contribution* contribution : bodies_.contributions)
    contribution->add_residual(state.displacement, net);
  std::vector<double> free(net.size());
  for (std::size_t i = 0; i < net.size(); ++i) {
    net[i] -= external[i];
    free[i] = bodies_.loads->fixed()[i] != 0 ? 0.0 : -net[i];
  }
  system_.matrix().constraints().sum(free);
  system_.matrix().set_zero();
  bodies_.inertia->mass().add_to(system_.matrix(), 1.0);
  // Scaled by its diagonal a mass matrix is well conditioned on every mesh (Wathen 1987).
  linear::LinearSolver solver(
      bodies_.mesh,
      {.prefix = "mass_", .kind = linear::SolverKind::jacobi, .relative_tolerance = k_initial_acceleration});
  state.acceleration.assign(bodies_.n_displacements(), 0.0);
  const std::span<double> owned = std::span(state.acceleration).first(net.size());
  const linear::LinearReport report = solver.solve(system_.matrix(), free, owned);
  if (!report.converged)
    throw StepRejected("mechanics: no initial acceleration, " + report.reason, {}, Failure::linear_solver);
  for (std::size_t i = 0; i < owned.size(); ++i)
    if (bodies_.loads->fixed()[i] != 0) owned[i] = 0;
  system_.matrix().constraints().share(owned);
  bodies_.ghosts.update(state.acceleration, bodies_.components);

  if (!bodies_.inertia->motion().remembers()) return;
  state.net_force.assign(bodies_.n_displacements(), 0.0);
  state.load.assign(bodies_.n_displacements(), 0.0);
  std::copy(net.begin(), net.end(), state.net_force.begin());
  std::copy(external.begin(), external.end(), state.load.begin());
  for (const BlockHistory& history : state.history) state.stress.push_back(no_stress(history));
}

std::size_t MechanicalPhase::bytes() const {
  std::size_t total = system_.bytes() + equations_.bytes() + bodies_.nodal_phases.bytes();
  for (const auto& block : bodies_.blocks) total += block->bytes();
  if (bodies_.inertia) total += bodies_.inertia->bytes();
  if (bodies_.pressure) total += bodies_.pressure->bytes();
  return total;
}

}  // namespace solidus::mechanics
