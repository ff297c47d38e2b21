/// The number of processes of a run, chosen from the machine and the case (decision 0077).
#pragma once

#include <memory>
#include <optional>

#include "app/exit_code.hpp"
#include "run/session.hpp"
#include "setup/made_mesh.hpp"

namespace solidus::app {

/// The physical cores that this process may use: those of its affinity, within the quota of its container.
int usable_cores();

/// How a run began.
struct RunStart {
  std::optional<ExitCode> code;  ///< exit code, if the run was done by processes started for it
  std::shared_ptr<setup::MadeMesh>
      mesh;  ///< otherwise, if this process runs the case: its mesh, if it was made
};

/// Chooses the number of processes of a case, reports it in one line, and starts them and waits for their end
/// if there are several. Does nothing if this process was started by an MPI launcher. Throws InputError for
/// errors of the case that are found with its mesh, and if the requested processes are not available.
/// @param asked  number given by --processes; absent: by SOLIDUS_PROCESSES, otherwise chosen
RunStart start_run(std::optional<int> asked, const setup::Case& c, const run::RunOptions& options);

}  // namespace solidus::app
