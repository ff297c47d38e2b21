/// What the filling of a mould is computed from: the mesh, the materials, the laws of the walls and [filling]
/// of a case, in files that the driver of the flow reads (python/solidus_plots/fill.py).
#pragma once

#include <filesystem>

#include "setup/case_file.hpp"

namespace solidus::run {

/// Writes into a folder, which is made:
///
/// ```
/// mesh.vtu      the elements, with the number of the body of each
/// cavity.json   bodies with roles, temperatures at the start and materials (tables over the temperature in K
/// of
///               the enthalpy per volume [J/m3] and the conductivity [W/(m K)]), conductances between bodies
///               in contact [W/(m2 K)], faces of the gate and the vents, and the keys of [filling], all in SI
/// ```
///
/// On one process. Throws InputError where the case has no [filling] or nothing that is poured, names groups
/// that its mesh does not have, or is wrong otherwise; OutputError.
void write_filling_input(setup::Case c, const std::filesystem::path& folder);

}  // namespace solidus::run
