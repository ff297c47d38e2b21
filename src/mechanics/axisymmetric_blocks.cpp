#include "mechanics/block_makers.hpp"
#include "mechanics/plane_blocks.hpp"

namespace solidus::mechanics {

std::unique_ptr<BlockKernel> make_axisymmetric_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                                     const material::Material& material, bool b_bar) {
  return make_plane_block<material::Viscoelastic, AnalysisKind::axisymmetric>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
