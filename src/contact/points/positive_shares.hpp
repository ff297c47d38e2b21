/// Shape functions of quadratic faces that are nowhere below zero: those of the linear parts between the
/// nodes.
///
///   line3   two lines
///   tri6    four triangles: one at each corner, one between the nodes in the middles of the edges
///   quad8   a triangle at each corner, and the square between the nodes in the middles of the edges
///   (bilinear)
///
/// They sum to one and reproduce fields that are linear in the reference coordinates, as the quadratic
/// functions N do; where these are below zero, heat that they share out passes from cold to hot. The place on
/// the face follows from the values of N there, for N reproduce linear fields.
#pragma once

#include <span>

namespace solidus::contact {

/// Computes the values L_a of these functions where the functions of the face have the values n_a, and adds
/// ∂L_a/∂n_b, [a][b]. Linear faces keep their n. Beyond the face it is the nearest place on it.
/// @param dimension  of the bodies, 2 or 3; with the number of nodes it tells the shape
/// @param slope  [a][b], zero on entry; may be empty
void positive_shares(int dimension, std::span<const double> n, std::span<double> l, std::span<double> slope);

}  // namespace solidus::contact
