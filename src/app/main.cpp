/// The program: reads the command line, runs a verb, turns failures into one message and an exit code.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/built_version.hpp"
#include "app/child_process.hpp"
#include "app/command_line.hpp"
#include "app/exit_code.hpp"
#include "app/launched.hpp"
#include "app/patient_waits.hpp"
#include "app/python_tools.hpp"
#include "app/signals.hpp"
#include "mesh/making/reader_process.hpp"
#include "parallel/petsc_session.hpp"
#include "system/blas_threads.hpp"
#include "system/errors.hpp"
#include "system/free_memory.hpp"
#include "system/input_file.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"
#include "system/terminal.hpp"
#include "system/version.hpp"

namespace {

using namespace solidus;
using namespace solidus::app;

/// Ends the run after a failure: process 0 speaks for all when all failed; a process that failed alone speaks
/// for itself and takes the others down, which would wait for it for ever.
ExitCode fail(ExitCode code, const std::string& message) {
  constexpr double k_patience = 5;  // [s]
  const bool alike = processes::all_arrive(k_patience);
  const std::string name = painted("solidus:", Colour::red, has_colours(STDERR_FILENO));
  if (processes::rank() == 0 || !alike) std::fputs((name + " " + printable(message + "\n")).c_str(), stderr);
  if (!alike) processes::abort(code);
  return code;
}

ExitCode guarded(const std::function<ExitCode()>& verb) {
  try {
    return verb();
  } catch (const InputError& error) {
    return fail(k_bad_input, error.what());
  } catch (const StepRejected& error) {
    return fail(interrupted() ? k_interrupted : k_cannot_continue, error.what());
  } catch (const std::bad_alloc&) {
    return fail(k_cannot_continue, "the memory is exhausted; use a coarser mesh or more processes");
  } catch (const std::filesystem::filesystem_error& error) {
    // The system refused a file or folder. A function that names no path asked for the present folder, which
    // has been removed.
    const std::string path = error.path1().string();
    return fail(k_bad_input,
                fmt::format("{}: {}", path.empty() ? "the present folder" : path, error.code().message()));
  } catch (const std::exception& error) {
    // PETSc reads options late, when a solver is made; an option that it does not know is the user's error.
    if (std::string_view(error.what()).find("SetFromOptions") != std::string_view::npos)
      return fail(k_bad_input, fmt::format("an option behind -- is wrong: {}", error.what()));
    return fail(
        k_our_bug,
        fmt::format("internal error: {}\n  This is a mistake in Solidus; please report it.", error.what()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  set_program_version(built_version());
  // Only a run answers to signals by writing a checkpoint.
  const auto runs = [](const char* argument) { return std::string_view(argument) == "run"; };
  const bool run_wanted = std::any_of(argv + 1, argv + argc, runs);
  // A downstream reader that has ended is no failure: output to it is lost.
  std::signal(SIGPIPE, SIG_IGN);
  if (run_wanted) {
    listen_to_signals();
    mesh::give_up_reading_when(stop_asked);
  }
  // The program has no threads of its own while it reads a mesh.
  mesh::read_in_copies_of_this_process();
  // Libraries may change the environment, so it is read before they start.
  keep_environment();
  keep_arguments(argc, argv);
  profile::begin();
  give_large_arrays_back();
  use_one_thread_of_blas();
  if (petsc::all_on_one_machine()) {
    wait_patiently();
    petsc::yield_in_waits();
  }
  // Arguments behind "--" are PETSc's.
  char** const end = argv + argc;
  char** const separator = std::find_if(argv, end, [](const char* a) { return std::string_view(a) == "--"; });
  const std::vector<std::string> for_petsc(separator == end ? end : separator + 1, end);
  // Libraries first, as they take their own arguments.
  std::optional<profile::Part> start(std::in_place, "start of the program");
  try {
    if (!petsc::start(for_petsc)) {
      std::fputs("solidus: PETSc cannot start; its message is above, its options behind --\n", stderr);
      return separator == end ? k_our_bug : k_bad_input;
    }
  } catch (const InputError& error) {
    std::fputs(("solidus: " + printable(error.what()) + "\n").c_str(), stderr);
    return k_bad_input;
  }
  start.reset();
  if (!join_launcher()) {
    petsc::end();
    return k_done;
  }
  if (run_wanted && !stop_asked()) listen_to_signals();  // MPI and PETSc may have put theirs in place
  const int own_argc = static_cast<int>(separator - argv);
  // Errors become exit codes here, and nowhere else.
  const ExitCode code = guarded([&] { return parse_and_run(own_argc, argv); });
  petsc::end();
  return code;
}
