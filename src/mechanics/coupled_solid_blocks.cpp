#include "mechanics/coupled_shapes.hpp"

namespace solidus::mechanics {

template <>
std::unique_ptr<BlockKernel> make_coupled_block<AnalysisKind::solid>(const mesh::Mesh& mesh,
                                                                     const mesh::Block& block,
                                                                     const material::Material& material,
                                                                     bool b_bar) {
  return make_coupled_solid_block(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
