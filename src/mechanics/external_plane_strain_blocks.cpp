#include "mechanics/external_block_law.hpp"
#include "mechanics/plane_blocks.hpp"

namespace solidus::mechanics {

template <>
std::unique_ptr<BlockKernel> make_block<ExternalBlockLaw, AnalysisKind::plane_strain>(
    const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material, bool b_bar) {
  return make_plane_block<ExternalBlockLaw, AnalysisKind::plane_strain>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
