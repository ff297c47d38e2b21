/// Programs that a verb starts, in the environment that this one was started with.
#pragma once

#include <string>
#include <vector>

namespace solidus::app {

/// Remembers the environment that the program was started with: MPI adds to it what a child must not inherit,
/// which starts MPI itself. Called before MPI starts.
void keep_environment();

/// The variables that keep_environment() remembered, as "NAME=value".
const std::vector<std::string>& kept_environment();

/// Remembers the words of the command line, with which further processes of this program are started.
void keep_arguments(int argc, char** argv);
/// All but the name of the program.
const std::vector<std::string>& kept_arguments();

/// The end of a program that was waited for.
struct ChildOutcome {
  std::string failure;  ///< why it could not be started or was ended; empty where it ended by itself
  int code = -1;        ///< its exit code; -1 where there is none
  std::string said;     ///< its standard output and standard error, together
};

/// Starts a program in the kept environment, with nothing to read, and waits for it. One that takes longer is
/// killed, with the programs that it started.
/// @param command  the program, looked for along PATH where it has no slash, and its arguments
/// @param seconds  as long as it may take
ChildOutcome run_and_listen(std::vector<std::string> command, double seconds);

/// The pointers that exec takes: to the texts, which must outlive them, and a null behind.
std::vector<char*> pointers_to(std::vector<std::string>& texts);

}  // namespace solidus::app
