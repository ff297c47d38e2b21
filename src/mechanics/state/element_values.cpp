/// Values lie block by block, as the kernels have written them.
#include "mechanics/state/element_values.hpp"

#include "mechanics/state/mechanical_state.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

std::vector<double> element_field(const mesh::Mesh& mesh, const MechanicalState& state, ElementField which) {
  const auto n = as_size(component_count(which));
  std::size_t n_elements = 0, first = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) n_elements += as_size(block.size());
  std::vector<double> values(n_elements * n, 0.0);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const std::size_t size = as_size(mesh.blocks[b].size()) * n;
    if (b < state.elements.size() && state.elements[b])
      state.elements[b]->get(which, std::span(values).subspan(first, size));
    first += size;
  }
  return values;
}

}  // namespace solidus::mechanics
