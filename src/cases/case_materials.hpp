/// The materials of a case, from the library and from files.
#pragma once

#include <filesystem>
#include <vector>

#include "cases/case_spec.hpp"
#include "material/material.hpp"

namespace solidus::cases {

/// Folders in which materials are looked up by name; the first one that has the name wins: the folders of the
/// environment variable SOLIDUS_MATERIALS (separated by colons), `share/solidus/materials` and `materials` in
/// the folders above the program, and `materials` of the sources it was built from.
std::vector<std::filesystem::path> material_folders();

/// One material per body, in the order of the bodies.
/// Throws InputError for an unknown material, a file that is wrong, and a property that the physics of the
/// case needs.
std::vector<material::Material> load_materials(const CaseSpec& spec);

/// Throws InputError for a body without inertia that starts as a melt without stiffness against shear: the
/// modified shear modulus f_S G (2.77) is zero there, and nothing but luck is in equilibrium.
/// @param highest  initial temperature [K], [body]
void check_melts(const CaseSpec& spec, const std::vector<material::Material>& materials,
                 const std::vector<double>& highest);

}  // namespace solidus::cases
