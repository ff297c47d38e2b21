#include "mechanics/solid_blocks.hpp"

namespace solidus::mechanics {

template <>
std::unique_ptr<BlockKernel> make_block<material::Isentropic, AnalysisKind::solid>(
    const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material, bool b_bar) {
  return make_solid_block<material::Isentropic>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
