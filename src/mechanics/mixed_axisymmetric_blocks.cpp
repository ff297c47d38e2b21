#include "mechanics/mixed_shapes.hpp"

namespace solidus::mechanics {

template <>
std::unique_ptr<BlockKernel> make_mixed_block<AnalysisKind::axisymmetric>(const mesh::Mesh& mesh,
                                                                          const mesh::Block& block,
                                                                          const material::Material& material,
                                                                          Mapping mapping,
                                                                          Stabilisation stabilisation) {
  return make_mixed_block_of_shape<3, AnalysisKind::axisymmetric>(mesh::Shape::tri3, mesh, block, material,
                                                                  mapping, stabilisation);
}

}  // namespace solidus::mechanics
