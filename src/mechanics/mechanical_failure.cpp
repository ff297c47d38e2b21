/// Describes where and why a step of the mechanical phase fails, for messages.
#include "mechanics/mechanical_failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/equilibrium_rejected.hpp"
#include "mechanics/loads/loads.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

/// The first body that has this local node.
std::string body_of(const mesh::Mesh& mesh, Index node) {
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body >= 0 && std::find(block.nodes.begin(), block.nodes.end(), node) != block.nodes.end())
      return mesh.bodies[as_size(block.body)].name;
  return {};
}

/// LastIterate::flowing at x.
std::vector<double> flowing_shares(const MechanicalBodies& bodies, std::span<const double> x) {
  // Flowing and whole volume of each body, in pairs for one sum over processes.
  std::vector<double> sums(2 * bodies.mesh.bodies.size(), 0.0);
  for (std::size_t b = 0; b < bodies.blocks.size(); ++b) {
    const FlowingVolume volume = bodies.blocks[b]->flowing(x.first(bodies.n_displacements()));
    const auto body = as_size(bodies.mesh.blocks[b].body);
    sums[2 * body] += volume.flowing;
    sums[2 * body + 1] += volume.all;
  }
  processes::sum(sums);
  std::vector<double> shares;
  for (std::size_t body = 0; body < bodies.mesh.bodies.size(); ++body)
    shares.push_back(sums[2 * body + 1] > 0 ? sums[2 * body] / sums[2 * body + 1] : 0.0);
  return shares;
}

std::string worst_place(MechanicalPhase& phase, std::span<const double> x) {
  const MechanicalBodies& bodies = phase.bodies();
  // The largest unbalanced force at a free entry, over all processes, is told with its node, body and place.
  std::vector<double> r(bodies.n_residuals());
  phase.equations().residual(x, r);
  r.resize(bodies.n_forces());
  phase.system().matrix().constraints().sum(r);
  // A residual that is not a number is the worst of all.
  double worst = -1;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double size = std::isfinite(r[i]) ? std::abs(r[i]) : HUGE_VAL;
    if (bodies.loads->fixed()[i] || size <= worst) continue;
    worst = size;
    entry = i;
  }
  // The process that has it composes the text, which all others get.
  const int owner = processes::find_largest(worst).rank;
  std::string text;
  if (owner == processes::rank() && !r.empty()) {
    const std::size_t node = entry / as_size(bodies.components);
    const mesh::Point& p = bodies.mesh.x[node];
    text = fmt::format("node {} of body '{}' at ({:.6g}, {:.6g}, {:.6g}) m: unbalanced force {:.4g} N",
                       bodies.mesh.input_node[node], body_of(bodies.mesh, as_index(node)), p[0], p[1], p[2],
                       r[entry]);
  }
  processes::broadcast(text, owner);
  return text;
}

/// The first point whose law finds no state at x, of the lowest process that has one.
LawFailure law_failure(const MechanicalBodies& bodies, std::span<const double> x) {
  // The first block with a failure is enough: the others mostly fail for the same reason.
  LawFailure found;
  for (std::size_t b = 0; b < bodies.blocks.size() && found.text.empty(); ++b) {
    found = bodies.blocks[b]->failure(x.first(bodies.n_displacements()));
    if (!found.text.empty())
      found.text = fmt::format("body '{}', {}", bodies.mesh.bodies[as_size(bodies.mesh.blocks[b].body)].name,
                               found.text);
  }
  // The lowest process that has one tells it to all, so that every process reports the same.
  const int first = processes::least(found.text.empty() ? processes::count() : processes::rank());
  if (first == processes::count()) return {};
  processes::broadcast(found.text, first);
  processes::broadcast(std::span(&found.temperature, 1), first);
  return found;
}

}  // namespace

void reject(MechanicalPhase& phase, const std::string& reason, std::span<const double> x, Failure failure) {
  const MechanicalBodies& bodies = phase.bodies();
  const std::span<const double> u = x.first(bodies.n_displacements());
  const LawFailure of_law = law_failure(bodies, x);
  LastIterate last{{u.begin(), u.end()}, flowing_shares(bodies, x), of_law.temperature, {}};
  if (!of_law.text.empty())
    throw EquilibriumRejected("mechanics: a constitutive law asks for a smaller step", of_law.text,
                              Failure::law, std::move(last));
  throw EquilibriumRejected("mechanics: " + reason, worst_place(phase, x), failure, std::move(last));
}

}  // namespace solidus::mechanics
