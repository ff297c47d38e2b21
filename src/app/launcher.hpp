/// Starts the processes of a run on this machine, and is between them and the user (decision 0077).
///
/// mpirun starts them, in a group of its own that no key of the terminal reaches. Each comes back to this
/// program through a socket, which hands it the output that this one was started with, and the first of them
/// the mesh: so their words go where those of one process would, and nothing is read or meshed twice. Signals
/// of this program go on to them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/exit_code.hpp"
#include "setup/made_mesh.hpp"

namespace solidus::app {

/// The mpirun next to the program, which an archive brings, else that of the PATH; empty where there is none.
std::string find_mpirun();

struct LaunchOutcome {
  std::optional<ExitCode> code;           ///< of the run; nothing where its processes could not be started
  std::string failure;                    ///< why not
  std::shared_ptr<setup::MadeMesh> mesh;  ///< given back in that case
};

/// Runs this program's own command line on several processes and waits for their end. Where one of them was
/// ended by a signal that was not the user's it says so; where the user's second signal ended them it ends
/// this program as that signal would.
/// @param mpirun    as found by find_mpirun()
/// @param mesh      goes to the first of them; nothing else may hold it, since its memory is needed
/// @param greeting  is printed when all of them are there
LaunchOutcome run_on_processes(int n, const std::string& mpirun, std::shared_ptr<setup::MadeMesh> mesh,
                               const std::string& greeting);

}  // namespace solidus::app
