/// Verbs that run in Python: pictures, comparisons and studies (python/ of the repository,
/// share/solidus/python of an installed program).
#pragma once

#include <string>
#include <vector>

#include "app/verbs.hpp"

namespace solidus::app {

/// The Python that runs modules: what SOLIDUS_PYTHON names, else /usr/bin/python3.
std::string python_program();

/// Runs a module with that Python and waits for it; what it prints goes where ours goes. The module's exit
/// code is the program's: 0 or 1, and 130 after Ctrl-C. Throws InputError where there is no such Python or no
/// module.
ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace solidus::app
