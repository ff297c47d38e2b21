/// The elements are those of the laws, with a plain elastic material: rows of old nodes and of what is
/// prescribed are taken out, and the rest is solved by conjugate gradients.
#include "mechanics/extension.hpp"

#include <algorithm>
#include <utility>

#include "linear/linear_solver.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/loads/loads.hpp"
#include "numbers/index_casts.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

/// Tolerance of the residual; only displayed values depend on it.
constexpr double k_tolerance = 1e-10;
constexpr double k_some_temperature = 300;  ///< the elastic material has no table of it [K]

material::Material elastic() {
  material::Material material;
  material.name = "extension";
  material.density = 1;
  material.conductivity = Table(1.0);
  material.specific_heat = Table(1.0);
  material.young_modulus = Table(1.0);
  material.poisson_ratio = Table(0.0);
  material.expansion = Table(0.0);
  return material;
}

/// Nodes of the blocks that are born, [local node].
std::vector<char> nodes_without(const MechanicalBodies& bodies, const std::vector<char>& born) {
  std::vector<double> touched(bodies.mesh.x.size(), 0.0);
  for (std::size_t b = 0; b < born.size(); ++b)
    if (born[b] != 0)
      for (const Index node : bodies.mesh.blocks[b].nodes) touched[as_size(node)] = 1;
  bodies.ghosts.update(touched, 1);
  std::vector<char> without(touched.size());
  std::ranges::transform(touched, without.begin(), [](double t) { return t == 0 ? 1 : 0; });
  return without;
}

/// The stiffness of the elements that are born; others have no entries.
void assemble(const MechanicalBodies& bodies, const std::vector<char>& born, linear::BlockMatrix& matrix) {
  const material::Material material = elastic();
  const std::vector<double> temperature(bodies.mesh.x.size(), k_some_temperature),
      rest(bodies.n_displacements(), 0.0);
  for (std::size_t b = 0; b < born.size(); ++b) {
    if (born[b] == 0) continue;
    const auto kernel = make_block_kernel(bodies.mesh, bodies.mesh.blocks[b], bodies.kind, material,
                                          Mapping::isothermal, bodies.options.b_bar);
    const BlockHistory history = kernel->initial_history();
    kernel->bind(matrix);
    kernel->prepare({.temperature = temperature,
                     .pass_temperature = temperature,
                     .initial_temperature = temperature,
                     .old_displacement = rest,
                     .held_displacement = rest,
                     .held_history = &history,
                     .old_history = &history,
                     .start_history = &history,
                     .dt = 1,
                     .effective = material::TimeStep::backward_euler(1)});
    kernel->add_tangent(rest, matrix);
  }
}

/// Gives the new nodes of faces that stay plane the displacement of the others.
/// @param fresh  of degrees of freedom, [local node][component]; those that are given become false
void follow_plane_faces(const MechanicalBodies& bodies, std::vector<char>& fresh, std::vector<double>& u) {
  const std::vector<std::vector<Index>>& groups = bodies.loads->constraint_groups();
  // The sum and the number of what is there, over all processes: each owned entry once.
  std::vector<double> sums(2 * groups.size(), 0.0);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Index entry : groups[g])
      if (as_size(entry) < bodies.n_forces() && fresh[as_size(entry)] == 0) {
        sums[2 * g] += u[as_size(entry)];
        sums[2 * g + 1] += 1;
      }
  processes::sum(std::span(sums));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (sums[2 * g + 1] == 0) continue;
    for (const Index entry : groups[g])
      if (fresh[as_size(entry)] != 0) {
        u[as_size(entry)] = sums[2 * g] / sums[2 * g + 1];
        fresh[as_size(entry)] = 0;
      }
  }
}

}  // namespace

void extend_displacement(const MechanicalBodies& bodies, const linear::ActiveSet& before,
                         const std::vector<char>& born, double time, std::vector<double>& displacement) {
  const auto n = as_size(bodies.components);
  // New free nodes are unknown; prescribed displacements and those of older nodes are known.
  std::vector<double> u = displacement, prescribed = displacement;
  bodies.loads->prescribe(time, prescribed);
  std::vector<char> fresh(u.size(), 0);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const auto node = static_cast<Index>(i / n);
    if (before.node(node) || !bodies.active.node(node)) continue;
    if (bodies.loads->fixed()[i] != 0)
      u[i] = prescribed[i];
    else
      fresh[i] = 1;
  }
  follow_plane_faces(bodies, fresh, u);
  if (parallel::any_process(std::ranges::count(fresh, char{1}) > 0)) {
    linear::NodeGraph graph(bodies.mesh);
    graph.leave_out(nodes_without(bodies, born));
    for (std::size_t b = 0; b < born.size(); ++b)
      if (born[b] != 0)
        graph.add_cliques(bodies.mesh.blocks[b].nodes, mesh::node_count(bodies.mesh.blocks[b].shape));
    linear::BlockMatrix matrix(bodies.mesh, bodies.components, std::move(graph));
    std::vector<char> fixed(fresh.size());
    std::ranges::transform(fresh, fixed.begin(), [](char f) { return f == 0 ? 1 : 0; });
    matrix.set_fixed(fixed);
    assemble(bodies, born, matrix);
    // K Δu = −K u on the free rows.
    std::vector<double> load(bodies.n_forces()), step(load.size(), 0.0);
    matrix.multiply(u, load);
    for (std::size_t i = 0; i < load.size(); ++i) load[i] = fresh[i] != 0 ? -load[i] : 0.0;
    linear::LinearSolver solver(
        bodies.mesh,
        {.prefix = "extension_", .kind = linear::SolverKind::jacobi, .relative_tolerance = k_tolerance});
    if (const linear::LinearReport report = solver.solve(matrix, load, step); !report.converged)
      logging::warn(
          "the displacement of new nodes at t = {:g} s is not exact ({}): stresses do not depend on it", time,
          report.reason);
    for (std::size_t i = 0; i < step.size(); ++i)
      if (fresh[i] != 0) u[i] += step[i];
  }
  bodies.ghosts.update(u, bodies.components);
  displacement = std::move(u);
}

}  // namespace solidus::mechanics
