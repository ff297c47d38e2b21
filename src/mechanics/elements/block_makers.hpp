/// The makers of kernels. Each is a template whose instances, one file per law and analysis kind, are those
/// that the list of cmake/element_kernels.cmake says: the kernels are large templates.
#pragma once

#include <memory>

#include "material/derivatives/isentropic.hpp"
#include "material/viscoelastic.hpp"
#include "material/viscoplastic.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/simplices.hpp"

namespace solidus::mechanics {

class ExternalBlockLaw;  // external_block_law.hpp

/// Displacements alone. Throws std::invalid_argument for a shape that the kind does not have.
template <class Law, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                        const material::Material& material, bool b_bar);

/// Makes a kernel for the simultaneous scheme (coupled_kernel.hpp). Throws std::invalid_argument for a shape
/// that the kind does not have.
template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_coupled_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                                const material::Material& material, bool b_bar);

/// Pressures at the nodes (mixed_kernel.hpp). Throws std::invalid_argument for a shape that has no such
/// kernel.
template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_mixed_block(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                              const material::Material& material, Mapping mapping,
                                              Stabilisation stabilisation);

}  // namespace solidus::mechanics
