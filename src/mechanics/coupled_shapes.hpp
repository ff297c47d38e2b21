/// Makes coupled kernels: the element shapes that they exist for.
#pragma once

#include <stdexcept>

#include "mechanics/coupled_block.hpp"

namespace solidus::mechanics {

/// Makes the kernel of a block of a two-dimensional analysis.
template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_coupled_plane_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                                      const material::Material& material, bool b_bar) {
  switch (block.shape) {
    case mesh::Shape::tri3:
      return std::make_unique<CoupledBlock<3, kind, false>>(mesh, block, material);
    case mesh::Shape::tri6:
      return std::make_unique<CoupledBlock<6, kind, false>>(mesh, block, material);
    case mesh::Shape::quad4:
      if (b_bar) return std::make_unique<CoupledBlock<4, kind, true>>(mesh, block, material);
      return std::make_unique<CoupledBlock<4, kind, false>>(mesh, block, material);
    case mesh::Shape::quad8:
      if (b_bar) return std::make_unique<CoupledBlock<8, kind, true>>(mesh, block, material);
      return std::make_unique<CoupledBlock<8, kind, false>>(mesh, block, material);
    default:
      throw std::invalid_argument("a two-dimensional analysis has no elements of this shape");
  }
}

/// Makes the kernel of a block of a three-dimensional analysis.
inline std::unique_ptr<BlockKernel> make_coupled_solid_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                                             const material::Material& material, bool b_bar) {
  constexpr AnalysisKind kind = AnalysisKind::solid;
  switch (block.shape) {
    case mesh::Shape::tet4:
      return std::make_unique<CoupledBlock<4, kind, false>>(mesh, block, material);
    case mesh::Shape::tet10:
      return std::make_unique<CoupledBlock<10, kind, false>>(mesh, block, material);
    case mesh::Shape::hex8:
      if (b_bar) return std::make_unique<CoupledBlock<8, kind, true>>(mesh, block, material);
      return std::make_unique<CoupledBlock<8, kind, false>>(mesh, block, material);
    case mesh::Shape::hex20:
      if (b_bar) return std::make_unique<CoupledBlock<20, kind, true>>(mesh, block, material);
      return std::make_unique<CoupledBlock<20, kind, false>>(mesh, block, material);
    default:
      throw std::invalid_argument("a three-dimensional analysis has no elements of this shape");
  }
}

}  // namespace solidus::mechanics
