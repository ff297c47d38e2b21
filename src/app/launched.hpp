/// The side of a process that `solidus run` has started along with others (app/launcher.hpp).
#pragma once

#include <memory>

#include "setup/made_mesh.hpp"

namespace solidus::app {

/// The variable of the environment that names the meeting of the launcher.
inline constexpr const char* k_launcher_variable = "SOLIDUS_LAUNCHER";

/// Whether a `solidus run` has started this process. Before MPI starts too.
bool started_by_launcher();

/// Tells the launcher that this process is there, and takes over its standard output and error, the mesh and
/// what has been said already. After MPI has started. Returns false where the launcher does not want it: the
/// process is to end without a word.
bool join_launcher();

/// Reads what a launcher leaves for the first process in a file: the warnings that were printed already,
/// which are kept and not told again, and the mesh. Throws mesh::MessageError.
setup::MadeMesh take_over(int file);

/// The mesh that the launcher has made, on process 0; null elsewhere, and where there is no launcher.
std::shared_ptr<setup::MadeMesh> mesh_of_launcher();

}  // namespace solidus::app
