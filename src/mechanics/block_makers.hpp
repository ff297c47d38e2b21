/// One maker per analysis kind, each in its own translation unit: the kernels are large templates.
#pragma once

#include <memory>

#include "mechanics/block_kernel.hpp"

namespace solidus::mechanics {

std::unique_ptr<BlockKernel> make_plane_strain_block(const mesh::Mesh&, const mesh::Block&,
                                                     const material::Material&, bool);
std::unique_ptr<BlockKernel> make_axisymmetric_block(const mesh::Mesh&, const mesh::Block&,
                                                     const material::Material&, bool);
std::unique_ptr<BlockKernel> make_solid_block(const mesh::Mesh&, const mesh::Block&,
                                              const material::Material&, bool);

}  // namespace solidus::mechanics
