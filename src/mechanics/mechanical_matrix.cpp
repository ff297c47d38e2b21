#include "mechanics/mechanical_matrix.hpp"

#include <utility>

#include "linear/block_multigrid.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/loads/inertial_forces.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_solver.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

namespace {

linear::LinearSolverOptions linear_options(const MechanicsOptions& options) {
  return {.prefix = "mechanics_",
          .kind = options.solver,
          .symmetric = options.symmetric,
          .relative_tolerance = options.linear_tolerance};
}

}  // namespace

MechanicalMatrix::MechanicalMatrix(MechanicalBodies& bodies) : bodies_(bodies) {}

MechanicalMatrix::~MechanicalMatrix() = default;

void MechanicalMatrix::create() {
  fields_.assign(1, bodies_.components);
  if (bodies_.pressure) fields_.push_back(bodies_.pressure->fields().n_fields);
  create_matrix();
  create_solver();
}

/// Other supports change the factors, not the pattern.
void MechanicalMatrix::set_fixed() {
  matrix_->set_fixed(bodies_.loads->fixed());
  solver_->forget();
}

// Everything that is bound to the matrix is bound again.
void MechanicalMatrix::follow_graph() {
  if (!linear::graph_outdated(bodies_.contributions)) return;
  matrix_->set_graph(graph());
  solver_->reset();
  bind();
}

linear::NodeGraph MechanicalMatrix::graph() const {
  linear::NodeGraph graph(bodies_.mesh);
  // The coupled matrix of the simultaneous scheme has this pattern: what a body that only conducts takes
  // depends on the displacement of those that it touches.
  if (!bodies_.active.complete() && bodies_.options.mapping != Mapping::simultaneous) {
    std::vector<char> absent(bodies_.mesh.x.size());
    for (std::size_t i = 0; i < absent.size(); ++i) absent[i] = !bodies_.active.node(as_index(i));
    graph.leave_out(std::move(absent));
  }
  // Nodes of an element are coupled with each other, and those of a contact with its opposite faces.
  for (const mesh::ElementBlock& block : bodies_.mesh.blocks)
    if (bodies_.active.body(block.body)) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const linear::Contribution* contribution : bodies_.contributions) contribution->add_to_graph(graph);
  return graph;
}

void MechanicalMatrix::create_matrix() {
  using Storage = linear::BlockMatrix::Storage;
  Storage storage = Storage::whole;
  // The blocks that couple displacements with temperatures share the pattern of this matrix, so it is then
  // stored whole.
  if (bodies_.options.mapping != Mapping::simultaneous &&
      !parallel::any_process(!bodies_.loads->constraint_groups().empty())) {
    if (!bodies_.pressure)
      storage = linear::storage_for(linear_options(bodies_.options), bodies_.mesh, bodies_.components,
                                    linear::rigid_body_mode_count(bodies_.components));
    else if (bodies_.options.symmetric)
      storage = Storage::upper;
  }
  matrix_ = std::make_unique<linear::BlockMatrix>(bodies_.mesh, bodies_.components, graph(), storage);
  matrix_->set_fixed(bodies_.loads->fixed());
  matrix_->constrain(bodies_.loads->constraint_groups());
  bind();
}

void MechanicalMatrix::bind() {
  for (const auto& block : bodies_.blocks) block->bind(*matrix_);
  if (bodies_.inertia) bodies_.inertia->bind(*matrix_);
  for (linear::Contribution* contribution : bodies_.contributions) contribution->bind(*matrix_);
}

void MechanicalMatrix::create_solver() {
  // Saddle points of mixed elements have a solver of their own; displacements alone use the rigid motions as
  // the coarsest modes of multigrid.
  if (solver_) seconds_before_ += solver_->seconds().sum();
  saddle_ = nullptr;
  if (bodies_.pressure) {
    auto solver = std::make_unique<SaddleSolver>(
        bodies_.mesh, *matrix_, *bodies_.pressure, bodies_.ghosts,
        SaddleSolverOptions{.kind = bodies_.options.solver,
                            .symmetric = bodies_.options.symmetric,
                            .relative_tolerance = bodies_.options.linear_tolerance});
    saddle_ = solver.get();
    solver_ = std::move(solver);
    return;
  }
  auto solver = std::make_unique<linear::LinearSolver>(bodies_.mesh, linear_options(bodies_.options));
  solver->use_rigid_body_modes(bodies_.components);
  solver_ = std::move(solver);
}

double MechanicalMatrix::seconds() const {
  return seconds_before_ + solver_->seconds().sum();
}

std::size_t MechanicalMatrix::bytes() const {
  return matrix_->bytes() + (saddle_ != nullptr ? saddle_->bytes() : 0);
}

}  // namespace solidus::mechanics
