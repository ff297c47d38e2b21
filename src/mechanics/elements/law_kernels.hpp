/// The kernels of a law with displacements alone, by the table of shapes.
#pragma once

#include "mechanics/elements/element_kernels.hpp"
#include "mechanics/elements/law_block.hpp"

namespace solidus::mechanics {

template <class Law, AnalysisKind kind>
struct LawKernels {
  template <int n_nodes, bool b_bar>
  using Kernel = LawBlock<Law, n_nodes, kind, b_bar>;
};

template <class Law, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                        const material::Material& material, bool b_bar) {
  return make_kernel_of_shape<LawKernels<Law, kind>, kind>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
