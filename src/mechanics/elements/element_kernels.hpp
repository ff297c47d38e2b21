/// The kernel of a block by the table of shapes (mesh/shape_table.hpp): a shape of the dimension of an
/// analysis has a kernel with the standard operator and, unless it is a simplex, one with B-bar. Included by
/// the instances that cmake/element_kernels.cmake makes, for the kernels are large templates.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

#include "mechanics/elements/block_makers.hpp"
#include "mesh/shape_table.hpp"

namespace solidus::mechanics {

/// @tparam Kernels  has a template Kernel<n_nodes, b_bar>, made of (mesh, block, material)
/// Throws std::invalid_argument for a shape that the kind does not have.
template <class Kernels, AnalysisKind kind>
std::unique_ptr<BlockKernel> make_kernel_of_shape(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                                  const material::Material& material, bool b_bar) {
  std::unique_ptr<BlockKernel> made;
  const auto try_row = [&]<std::size_t i>() {
    constexpr mesh::ShapeRow row = mesh::k_shape_rows[i];
    if constexpr (row.dimension == displacement_components(kind) && row.reference != mesh::Reference::split) {
      if (block.shape != row.shape) return;
      if constexpr (row.reference != mesh::Reference::simplex)
        if (b_bar) {
          made = std::make_unique<typename Kernels::template Kernel<row.nodes, true>>(mesh, block, material);
          return;
        }
      made = std::make_unique<typename Kernels::template Kernel<row.nodes, false>>(mesh, block, material);
    }
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (try_row.template operator()<i>(), ...);
  }
  (std::make_index_sequence<mesh::k_shape_rows.size()>());
  if (!made) throw std::invalid_argument("an analysis of this kind has no elements of this shape");
  return made;
}

/// The row of the shape with pressures at its nodes.
constexpr mesh::ShapeRow mixed_row(AnalysisKind kind) {
  for (const mesh::ShapeRow& row : mesh::k_shape_rows)
    if (row.mixed && row.dimension == displacement_components(kind)) return row;
  return {};
}

}  // namespace solidus::mechanics
