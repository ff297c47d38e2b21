/// The rule `mortar`: contact points that stand for the surroundings of a node of the slave, an internal
/// header of the integration rules.
///
///   g_A = Σ_p w_p N̂_A(p) g_p / W_A,   W_A = Σ_p w_p N̂_A(p)
///
/// over the points p of rule `segments`; N̂ are the linear functions of the slave's vertices, of quadratic
/// faces too. Shape functions of both sides are averaged likewise, so that the pressure t_N(g_A) makes the
/// forces of the field Σ_A t_A N̂_A: exact on meshes that do not match where pressures are even, and with as
/// many conditions as the slave has vertices. The points of `segments` are more than the displacements of
/// faces that do not match can follow: with a stiff penalty pressures vary from point to point
/// (docs/decisions/0029-contact-at-means-around-nodes.md). F. Ben Belgacem, P. Hild, P. Laborde, The mortar
/// finite element method for contact problems, Math. Comput. Modelling 28 (1998) 263–271.
#pragma once

#include "contact/points/integration.hpp"

namespace solidus::contact {

/// @param pieces  by rule `segments`, all of them whatever this process owns
ContactPoints means_around_nodes(const mesh::Mesh& mesh, const ContactSurface& slave,
                                 const ContactPoints& pieces);

}  // namespace solidus::contact
