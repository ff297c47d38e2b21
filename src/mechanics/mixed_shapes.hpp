/// The laws of the mixed kernels of one shape.
#pragma once

#include <stdexcept>

#include "mechanics/coupled_mixed_block.hpp"

namespace solidus::mechanics {

template <int n_nodes, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_mixed_block_of_shape(mesh::Shape shape, const mesh::Mesh& mesh,
                                                       const mesh::Block& block,
                                                       const material::Material& material, Mapping mapping,
                                                       Stabilisation stabilisation) {
  if (block.shape != shape) throw std::invalid_argument("mixed elements are linear simplices");
  switch (mapping) {
    case Mapping::simultaneous:
      return std::make_unique<CoupledMixedBlock<n_nodes, kind>>(mesh, block, material, stabilisation);
    case Mapping::isentropic:
      return std::make_unique<MixedBlock<material::Isentropic, n_nodes, kind>>(mesh, block, material,
                                                                               stabilisation);
    case Mapping::isothermal:
      break;
  }
  if (!material.flow && material.liquid_model == material::LiquidModel::maxwell)
    return std::make_unique<MixedBlock<material::Viscoelastic, n_nodes, kind>>(mesh, block, material,
                                                                               stabilisation);
  return std::make_unique<MixedBlock<material::Viscoplastic, n_nodes, kind>>(mesh, block, material,
                                                                             stabilisation);
}

}  // namespace solidus::mechanics
