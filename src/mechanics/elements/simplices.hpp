/// Element formulations of linear triangles and tetrahedra.
#pragma once

#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

enum class Simplices {
  automatic,    ///< mixed where the material is or may become nearly incompressible
  mixed,        ///< displacement and pressure (mixed_kernel.hpp)
  displacement  ///< displacement alone: one constant strain; locks in plastic flow and in the melt
};

enum class Stabilisation {
  automatic,   ///< algebraic in quasi-statics, orthogonal with inertia
  orthogonal,  ///< orthogonal sub-grid scales (OSGS)
  algebraic    ///< algebraic sub-grid scales (ASGS), quasi-statics only
};

/// A material that melts, flows plastically or has somewhere a Poisson's ratio above 0.45.
bool nearly_incompressible(const material::Material& material);

/// Whether the elements of a block are mixed: linear simplices alone ever are.
bool is_mixed(const mesh::ElementBlock& block, const material::Material& material, Simplices simplices);

}  // namespace solidus::mechanics
