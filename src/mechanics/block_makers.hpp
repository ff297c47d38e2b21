/// One maker per law and analysis kind, each in its own translation unit: the kernels are large templates.
#pragma once

#include <memory>

#include "material/isentropic.hpp"
#include "material/viscoelastic.hpp"
#include "material/viscoplastic.hpp"
#include "mechanics/block_kernel.hpp"

namespace solidus::mechanics {

class ExternalBlockLaw;  // external_block_law.hpp

/// Throws std::invalid_argument for a shape that the kind does not have.
template <class Law, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                        const material::Material& material, bool b_bar);

using Maker = std::unique_ptr<BlockKernel>(const mesh::Mesh&, const mesh::Block&, const material::Material&,
                                           bool);
template <>
Maker make_block<material::Viscoelastic, AnalysisKind::plane_strain>;
template <>
Maker make_block<material::Viscoelastic, AnalysisKind::axisymmetric>;
template <>
Maker make_block<material::Viscoelastic, AnalysisKind::solid>;
template <>
Maker make_block<material::Viscoplastic, AnalysisKind::plane_strain>;
template <>
Maker make_block<material::Viscoplastic, AnalysisKind::axisymmetric>;
template <>
Maker make_block<material::Viscoplastic, AnalysisKind::solid>;
template <>
Maker make_block<ExternalBlockLaw, AnalysisKind::plane_strain>;
template <>
Maker make_block<ExternalBlockLaw, AnalysisKind::axisymmetric>;
template <>
Maker make_block<ExternalBlockLaw, AnalysisKind::solid>;
template <>
Maker make_block<material::Isentropic, AnalysisKind::plane_strain>;
template <>
Maker make_block<material::Isentropic, AnalysisKind::axisymmetric>;
template <>
Maker make_block<material::Isentropic, AnalysisKind::solid>;

}  // namespace solidus::mechanics
