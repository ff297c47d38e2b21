/// The viscoplastic law in the kernels of the splits and in those of the simultaneous scheme, which are
/// derived from them: in one file, so that what they share is compiled once.
#include "mechanics/coupled_shapes.hpp"
#include "mechanics/plane_blocks.hpp"

namespace solidus::mechanics {

template <>
std::unique_ptr<BlockKernel> make_block<material::Viscoplastic, AnalysisKind::axisymmetric>(
    const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material, bool b_bar) {
  return make_plane_block<material::Viscoplastic, AnalysisKind::axisymmetric>(mesh, block, material, b_bar);
}

template <>
std::unique_ptr<BlockKernel> make_coupled_block<AnalysisKind::axisymmetric>(
    const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material, bool b_bar) {
  return make_coupled_plane_block<AnalysisKind::axisymmetric>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
