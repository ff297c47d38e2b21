/// The shapes of two-dimensional analyses.
#pragma once

#include <stdexcept>

#include "mechanics/block_makers.hpp"
#include "mechanics/law_block.hpp"

namespace solidus::mechanics {

template <class Law, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_plane_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                              const material::Material& material, bool b_bar) {
  switch (block.shape) {
    case mesh::Shape::tri3:
      return std::make_unique<LawBlock<Law, 3, kind, false>>(mesh, block, material);
    case mesh::Shape::tri6:
      return std::make_unique<LawBlock<Law, 6, kind, false>>(mesh, block, material);
    case mesh::Shape::quad4:
      if (b_bar) return std::make_unique<LawBlock<Law, 4, kind, true>>(mesh, block, material);
      return std::make_unique<LawBlock<Law, 4, kind, false>>(mesh, block, material);
    case mesh::Shape::quad8:
      if (b_bar) return std::make_unique<LawBlock<Law, 8, kind, true>>(mesh, block, material);
      return std::make_unique<LawBlock<Law, 8, kind, false>>(mesh, block, material);
    default:
      throw std::invalid_argument("a two-dimensional analysis has no elements of this shape");
  }
}

}  // namespace solidus::mechanics
