#include "mechanics/block_kernel.hpp"

#include "mechanics/block_makers.hpp"

namespace solidus::mechanics {

std::unique_ptr<BlockKernel> make_block_kernel(const mesh::Mesh& mesh, const mesh::Block& block,
                                               AnalysisKind kind, const material::Material& material,
                                               bool b_bar) {
  switch (kind) {
    case AnalysisKind::plane_strain:
      return make_plane_strain_block(mesh, block, material, b_bar);
    case AnalysisKind::axisymmetric:
      return make_axisymmetric_block(mesh, block, material, b_bar);
    case AnalysisKind::solid:
      break;
  }
  return make_solid_block(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
