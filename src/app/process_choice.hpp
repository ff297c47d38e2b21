/// On how many processes a run goes: as many as pay on this machine for this case (decision 0077).
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
  std::optional<ExitCode> code;  ///< how it ended, on processes that were started for it
  std::shared_ptr<setup::MadeMesh>
      mesh;  ///< else, where the run is this process's own: its mesh, if there is one
};

/// Decides on how many processes a case runs, says so in one line, and if they are several starts them and
/// waits for their end. Where a launcher of MPI has started this process it leaves everything as it is.
/// Throws InputError for what the case has wrong that shows with its mesh, and for processes that were asked
/// for and cannot be had.
/// @param asked  by --processes; absent: by SOLIDUS_PROCESSES, and without that as many as pay
RunStart start_run(std::optional<int> asked, const setup::Case& c, const run::RunOptions& options);

}  // namespace solidus::app
