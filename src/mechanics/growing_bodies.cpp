/// A block that comes is the kernel of its elements in a GrowingBlock; its state begins with the nodes'
/// place.
#include "mechanics/growing_bodies.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mechanics/elements/absent_block.hpp"
#include "mechanics/elements/growing_block.hpp"
#include "mechanics/extension.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

const GrowingBlock* growing(const MechanicalBodies& bodies, std::size_t block) {
  return dynamic_cast<const GrowingBlock*>(bodies.blocks[block].get());
}

/// Blocks that are not there yet, [block].
std::vector<char> waiting(const MechanicalBodies& bodies) {
  std::vector<char> all(bodies.blocks.size());
  for (std::size_t b = 0; b < all.size(); ++b) {
    const GrowingBlock* const block = growing(bodies, b);
    all[b] = block != nullptr && !block->there() ? 1 : 0;
  }
  return all;
}

/// Gives the elements of a block the history with which they begin, and their nodes the solid fraction that
/// they have.
void begin_history(const MechanicalBodies& bodies, std::size_t b, const BirthMoment& birth,
                   std::span<const double> fraction, MechanicalState& state) {
  const PhaseFields phases = bodies.nodal_phases.evaluate(b, {birth.temperature, birth.plateau_share}, {});
  state.history[b] = growing(bodies, b)->born_at({state.displacement, birth.temperature, phases.straining});
  if (b < state.elements.size()) state.elements[b].reset();
  // With the two-step method the history before the last is that of a body at rest, too.
  if (!state.before.empty()) state.before[b] = state.history[b];
  if (state.solid_fraction.empty()) return;
  const BodyFields& fields = bodies.nodal_phases.fields();
  const int field = fields.of_body[as_size(bodies.mesh.blocks[b].body)];
  for (const Index node : bodies.mesh.blocks[b].nodes) {
    const auto place = as_size(node * fields.n_fields + field);
    state.solid_fraction[place] = fraction[place];
  }
}

}  // namespace

bool follow_elements(MechanicalBodies& bodies) {
  std::vector<int> there;
  for (const mesh::ElementBlock& block : bodies.mesh.blocks) there.push_back(block.nodes.empty() ? 0 : 1);
  processes::largest(std::span(there));
  bool changed = false;
  std::shared_ptr<SinceBirth> fields;  // of the blocks that wait from here on
  for (std::size_t b = 0; b < there.size(); ++b) {
    const mesh::ElementBlock& block = bodies.mesh.blocks[b];
    auto* const comes = dynamic_cast<GrowingBlock*>(bodies.blocks[b].get());
    if (comes != nullptr && there[b] != 0 && !comes->there()) {
      comes->come(block);
      changed = true;
    }
    // Bodies that only conduct heat have no kernel that could come.
    if (comes != nullptr || there[b] != 0 || dynamic_cast<AbsentBlock*>(bodies.blocks[b].get()) != nullptr)
      continue;
    if (!fields) fields = std::make_shared<SinceBirth>(bodies.mesh.x.size(), bodies.components);
    bodies.blocks[b] =
        std::make_unique<GrowingBlock>(block.shape, bodies.components, std::move(bodies.blocks[b]), fields);
    changed = true;
  }
  return changed;
}

bool grows(const MechanicalBodies& bodies) {
  for (std::size_t b = 0; b < bodies.blocks.size(); ++b)
    if (growing(bodies, b) != nullptr) return true;
  return false;
}

void grow(MechanicalPhase& phase, MechanicalConditions conditions, const BirthMoment& birth,
          MechanicalState* state) {
  const MechanicalBodies& bodies = phase.bodies();
  if (bodies.inertia) throw std::invalid_argument("bodies grow in quasi-statics only");
  const linear::ActiveSet before = bodies.active;
  std::vector<char> born = waiting(bodies);
  phase.set_conditions(std::move(conditions), {});
  if (state == nullptr) return;
  for (std::size_t b = 0; b < born.size(); ++b)
    if (born[b] != 0 && !growing(bodies, b)->there()) born[b] = 0;
  // Nodes first: elements are born where their nodes come to lie. The heat that comes is a jump, over which
  // the two-step method must not extrapolate: it begins anew.
  state->dt_before = 0;
  extend_displacement(bodies, before, born, birth.time, state->displacement);
  const std::vector<double> fraction =
      bodies.nodal_phases.solid_fraction({birth.temperature, birth.plateau_share});
  for (std::size_t b = 0; b < born.size(); ++b)
    if (born[b] != 0) begin_history(bodies, b, birth, fraction, *state);
}

}  // namespace solidus::mechanics
