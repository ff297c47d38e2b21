/// Verbs that run in Python: pictures, comparisons and studies (python/ of the repository,
/// share/solidus/python of an installed program).
#pragma once

#include <string>
#include <vector>

#include "app/verbs.hpp"

namespace solidus::app {

/// Remembers the environment that the program was started with: MPI adds to it what a child must not inherit,
/// which starts MPI itself. Called before MPI starts.
void keep_environment();

/// Runs a module with the Python that SOLIDUS_PYTHON names, else /usr/bin/python3, and waits for it; what it
/// prints goes where ours goes. The module's exit code is the program's: 0 or 1, and 130 after Ctrl-C.
/// Throws InputError where there is no such Python or no module.
ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace solidus::app
