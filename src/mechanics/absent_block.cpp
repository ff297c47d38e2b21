#include "mechanics/absent_block.hpp"

namespace solidus::mechanics {

namespace {

mesh::Block without_elements(const mesh::Block& block) {
  mesh::Block none;
  none.shape = block.shape;
  none.body = block.body;
  return none;
}

}  // namespace

AbsentBlock::AbsentBlock(const mesh::Mesh& mesh, const mesh::Block& block, AnalysisKind kind,
                         const material::Material& material)
    : block_(block),
      nowhere_(mesh, without_elements(block), kind, mesh::stiffness_rule(block.shape)),
      points_(nowhere_, material) {}

ElementFields AbsentBlock::fields() const {
  const auto n = static_cast<std::size_t>(block_.size());
  ElementFields f;
  for (auto* tensor : {&f.stress, &f.strain, &f.viscous_strain, &f.plastic_strain, &f.back_stress})
    tensor->assign(n, {});
  for (auto* scalar : {&f.equivalent_plastic_strain, &f.flow_stress, &f.dissipation, &f.von_mises,
                       &f.pressure, &f.intermediate_temperature})
    scalar->assign(n, 0.0);
  return f;
}

}  // namespace solidus::mechanics
