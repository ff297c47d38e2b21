#include "mechanics/absent_block.hpp"

namespace solidus::mechanics {

namespace {

mesh::ElementBlock without_elements(const mesh::ElementBlock& block) {
  mesh::ElementBlock none;
  none.shape = block.shape;
  none.body = block.body;
  return none;
}

}  // namespace

AbsentBlock::AbsentBlock(const mesh::Mesh& mesh, const mesh::ElementBlock& block, AnalysisKind kind,
                         const material::Material& material)
    : nowhere_(mesh, without_elements(block), kind, mesh::stiffness_rule(block.shape)),
      points_(nowhere_, material) {}

}  // namespace solidus::mechanics
