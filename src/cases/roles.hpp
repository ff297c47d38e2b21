/// Roles of bodies in the foundry, and decisions that follow from them.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "material/material.hpp"

namespace solidus::cases {

std::string_view name(Role role);  ///< "casting"

/// The role that a name tells, in English or German ("riser_2", "Kern"); nothing where it tells none.
std::optional<Role> role_in_name(const std::string& name);

/// Returns the role that the user gives; else a casting if the material can melt, the role that the names of
/// body and material tell, or a mould.
Role role_of(const BodySpec& body, const material::Material& material);

/// Whether bodies of a role are poured: they start as melt, feed each other and heat what is around them. The
/// one place that says so for geometries and drafts; a case that is built knows it by its materials.
bool is_poured(Role role);

/// Whether a body only conducts heat.
bool only_conducts(const BodySpec& body);

/// Decides bodies with physics = "automatic": those that are no castings and whose material has no elastic
/// properties only conduct heat, where the case couples heat with mechanics and another body deforms. A
/// material that cannot be read is left to load_materials(). Says in one line what it has decided.
void decide_physics(CaseSpec& spec);

}  // namespace solidus::cases
