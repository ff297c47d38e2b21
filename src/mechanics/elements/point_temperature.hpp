/// Temperatures and other nodal values at the quadrature points of a block.
#pragma once

#include <span>

#include "mesh/block_geometry.hpp"

namespace solidus::mechanics {

/// The temperature at a point of a batch from nodal values. Where all nodes of an element have one value it
/// is that value to the last bit.
Lane temperature_at(const mesh::BlockGeometry& geometry, Index batch, int point,
                    std::span<const double> nodal);
/// The same of a quantity that must not leave the range of its nodes: basis functions of quadratic shapes
/// are negative in places.
Lane within_nodes(const mesh::BlockGeometry& geometry, Index batch, int point, std::span<const double> nodal);

}  // namespace solidus::mechanics
