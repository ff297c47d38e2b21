/// The shapes of three-dimensional analyses.
#pragma once

#include <stdexcept>

#include "mechanics/block_makers.hpp"
#include "mechanics/law_block.hpp"

namespace solidus::mechanics {

template <class Law>
std::unique_ptr<BlockKernel> make_solid_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                              const material::Material& material, bool b_bar) {
  constexpr AnalysisKind kind = AnalysisKind::solid;
  switch (block.shape) {
    case mesh::Shape::tet4:
      return std::make_unique<LawBlock<Law, 4, kind, false>>(mesh, block, material);
    case mesh::Shape::tet10:
      return std::make_unique<LawBlock<Law, 10, kind, false>>(mesh, block, material);
    case mesh::Shape::hex8:
      if (b_bar) return std::make_unique<LawBlock<Law, 8, kind, true>>(mesh, block, material);
      return std::make_unique<LawBlock<Law, 8, kind, false>>(mesh, block, material);
    case mesh::Shape::hex20:
      if (b_bar) return std::make_unique<LawBlock<Law, 20, kind, true>>(mesh, block, material);
      return std::make_unique<LawBlock<Law, 20, kind, false>>(mesh, block, material);
    default:
      throw std::invalid_argument("a three-dimensional analysis has no elements of this shape");
  }
}

}  // namespace solidus::mechanics
