/// The penalty from the stiffness of the elements next to the surfaces.
#pragma once

#include <span>

#include "contact/points/geometry.hpp"

namespace solidus::contact {

/// ⟨E/h⟩ over the faces of a surface, weighted by their areas [Pa/m]: E of the body behind a face, h the
/// height of its element over the face. One value for the whole surface: a uniform pressure then goes with a
/// uniform penetration, as the patch test wants. Collective.
/// @param modulus E [Pa] of every body of the mesh
double local_stiffness(const mesh::Mesh& mesh, const ContactSurface& surface,
                       std::span<const double> modulus);

/// The larger ⟨E/h⟩ of the two surfaces [Pa/m]; zero where no modulus is known. Collective.
double stiffness_of(const mesh::Mesh& mesh, const PairSurfaces& surfaces, std::span<const double> modulus);

/// ε_N of a pair [Pa/m]: as given, or the factor on the stiffness of the stiffer of its surfaces. Collective.
/// Throws InputError for one that is not positive, and for a factor where no stiffness is known.
double penalty_of(const mesh::Mesh& mesh, const ContactParameters& spec, const PairSurfaces& surfaces,
                  std::span<const double> modulus);

}  // namespace solidus::contact
