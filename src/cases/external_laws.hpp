/// Laws from shared objects in a case: who may load them, and what of a case goes with them.
#pragma once

#include "cases/case_spec.hpp"
#include "material/material.hpp"

namespace solidus::cases {

/// Loads the law from outside of a material, if it has one. Throws InputError: not trusted, a library that
/// cannot be used (material/external_law.hpp), a scheme or time integration that needs more of a law than
/// such a one gives, and moduli that are not those of the material file where deformation exchanges heat.
void load_external_law(const CaseSpec& spec, material::Material& material);

}  // namespace solidus::cases
