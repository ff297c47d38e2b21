/// Builds the contact pairs of a case.
#pragma once

#include <span>
#include <vector>

#include "cases/case_spec.hpp"
#include "contact/points/parameters.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// One per [[contact]]. Heat passes between nodes only when heat content is integrated there too (closed
/// rule).
std::vector<contact::ContactParameters> contact_specs(const cases::CaseSpec& spec);

/// Young's modulus of every body at room temperature [Pa], for penalties given as a factor; of bodies without
/// one, 1 GPa (in an analysis of heat alone it is never used).
std::vector<double> contact_moduli(const std::vector<material::Material>& materials);

/// Sets from which gap on a liquid skin has left its wall, and the largest penalty next to a melt: by shares
/// of the free linear contraction, from the liquidus to room temperature, of ten sections of the castings on
/// the pair's surfaces, the smallest of them. A section is the same for a half between planes of symmetry and
/// the whole, as their gaps are. Collective.
/// @param sections  mechanics::sections, [body] [m]
void set_leaving_gap(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                     const std::vector<material::Material>& materials, std::span<const double> sections,
                     contact::ContactParameters& pair);

/// Sets the penalty of solid skins next to a melt (after set_leaving_gap): the factor on the stiffness of the
/// elements behind the softer of the two surfaces, whether their bodies deform or conduct heat alone. None
/// where a body has no Young's modulus: how hard such a wall is remains unknown, most are of sand.
/// Collective.
void set_solid_penalty(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                       contact::ContactParameters& pair);

/// Gives a law of spots that has no mean conductivity of its own that of the bodies, k̄ = 2 k_1 k_2/(k_1 +
/// k_2) (3.47), of the body that has most nodes on each surface. It is a table that follows k̄ to 1e-4 where
/// those of k_1 and k_2 are lines. Collective. Throws InputError where the master is a rigid surface, which
/// has no conductivity.
void set_mean_conductivity(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                           contact::ContactParameters& pair);

/// Chooses the law of pressure where the case leaves it to the program: of bodies none of which melts by
/// multipliers, whose pressures do not show the compliance of the
/// penalty; else as contact_specs() has it (docs/decisions/0033-default-pressure-of-contact.md).
void choose_normal(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                   contact::ContactParameters& pair);

}  // namespace solidus::setup
