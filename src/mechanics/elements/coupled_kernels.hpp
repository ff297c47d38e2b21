/// The kernels of the simultaneous scheme with displacements and temperature, by the table of shapes.
#pragma once

#include "mechanics/elements/coupled_block.hpp"
#include "mechanics/elements/element_kernels.hpp"

namespace solidus::mechanics {

template <AnalysisKind kind>
struct CoupledKernels {
  template <int n_nodes, bool b_bar>
  using Kernel = CoupledBlock<n_nodes, kind, b_bar>;
};

template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_coupled_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                                const material::Material& material, bool b_bar) {
  return make_kernel_of_shape<CoupledKernels<kind>, kind>(mesh, block, material, b_bar);
}

}  // namespace solidus::mechanics
