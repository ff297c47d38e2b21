/// The kernels with pressures at the nodes, by the law that a scheme needs.
#pragma once

#include "mechanics/elements/coupled_mixed_block.hpp"
#include "mechanics/elements/element_kernels.hpp"

namespace solidus::mechanics {

template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_mixed_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                              const material::Material& material, Mapping mapping,
                                              Stabilisation stabilisation) {
  constexpr mesh::ShapeRow row = mixed_row(kind);
  constexpr int n_nodes = row.nodes;
  if (block.shape != row.shape) throw std::invalid_argument("mixed elements are linear simplices");
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
