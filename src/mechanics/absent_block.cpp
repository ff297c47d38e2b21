#include "mechanics/absent_block.hpp"

#include <algorithm>
#include <utility>

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
                         const material::Material& material, std::unique_ptr<BlockKernel> kept)
    : nowhere_(mesh, without_elements(block), kind, mesh::stiffness_rule(block.shape)),
      points_(nowhere_, material),
      kept_(std::move(kept)) {}

void AbsentBlock::get_field(ElementField which, std::span<double> out) const {
  if (kept_)
    kept_->get_field(which, out);
  else
    std::fill(out.begin(), out.end(), 0.0);
}

}  // namespace solidus::mechanics
