/// Renewed bodies lose displacements and pressures at their nodes and the history of their elements, and
/// get the solid fraction with which they were poured.
#include "mechanics/new_bodies.hpp"

#include "mechanics/elements/block_kernel.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

std::vector<char> nodes_of_bodies(const mesh::Mesh& mesh, const std::vector<char>& bodies) {
  std::vector<char> marked(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (bodies[as_size(block.body)] != 0)
      for (const Index node : block.nodes) marked[as_size(node)] = 1;
  return marked;
}

void renew_nodes(const mesh::Mesh& mesh, const std::vector<char>& bodies, MechanicalState& state) {
  const std::vector<char> marked = nodes_of_bodies(mesh, bodies);
  for (std::vector<double>* field : {&state.displacement, &state.pressure}) {
    const std::size_t width = marked.empty() ? 0 : field->size() / marked.size();
    for (std::size_t i = 0; i < marked.size(); ++i)
      if (marked[i] != 0)
        for (std::size_t k = 0; k < width; ++k) (*field)[i * width + k] = 0;
  }
}

void renew_history(const MechanicalPhase& phase, const std::vector<char>& bodies, MechanicalState& state) {
  for (std::size_t b = 0; b < phase.mesh().blocks.size(); ++b) {
    if (bodies[as_size(phase.mesh().blocks[b].body)] == 0) continue;
    if (!phase.bodies().active.body(phase.mesh().blocks[b].body)) continue;  // it only conducts heat
    // A history of its own, no stress, and the solid fraction with which it was poured.
    state.history[b] = phase.bodies().blocks[b]->initial_history();
    if (b < state.elements.size()) state.elements[b].reset();
    // With the two-step method the history before the last is that of a body at rest, too.
    if (!state.before.empty()) state.before[b] = state.history[b];
    if (state.solid_fraction.empty()) continue;
    const std::vector<double>& poured = phase.bodies().nodal_phases.initial_solid_fraction();
    const BodyFields& fields = phase.bodies().nodal_phases.fields();
    const auto field = fields.of_body[as_size(phase.mesh().blocks[b].body)];
    for (const Index node : phase.mesh().blocks[b].nodes) {
      const auto place = as_size(node * fields.n_fields + field);
      state.solid_fraction[place] = poured[place];
    }
  }
}

void spread_heat_as_stored(const MechanicalPhase& phase, bool closed) {
  const std::vector<mesh::ElementBlock>& blocks = phase.mesh().blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    phase.bodies().blocks[b]->spread_heat_as_stored(
        closed || phase.bodies().material(blocks[b].body).changes_isothermally()
            ? mesh::nodal_weights(phase.mesh(), blocks[b], phase.bodies().kind)
            : mesh::basis_integrals(phase.mesh(), blocks[b], phase.bodies().kind));
}

}  // namespace solidus::mechanics
