/// The command line: reads it and runs the verb that it names.
#pragma once

#include <string>

#include "app/exit_code.hpp"

namespace CLI {
class App;
}

namespace solidus::app {

/// Throws InputError where there is no verb of this name, with the nearest one.
CLI::App& verb_named(CLI::App& program, const std::string& name);

/// Throws InputError for a command line that cannot be read, and what the verb throws.
/// @param argc, argv  without what is behind --
ExitCode parse_and_run(int argc, char** argv);

}  // namespace solidus::app
