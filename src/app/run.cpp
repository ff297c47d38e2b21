/// The verb `run`.
#include "model/run.hpp"

#include <petscsys.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iostream>

#include "app/places.hpp"
#include "app/verbs.hpp"
#include "results/progress.hpp"
#include "results/run_folder.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// -o, else the case's own wish (seen from the present folder), else results/CASE/VARIANT.
fs::path results_folder(const CaseArguments& arguments, const model::Case& c) {
  if (!arguments.output.empty()) return arguments.output;
  if (c.spec.output.folder) return *c.spec.output.folder;
  return results_root() / results::default_run_folder(c.file);
}

volatile std::sig_atomic_t stop_asked = 0;

extern "C" void ask_to_stop(int) {
  stop_asked = 1;
}

/// Ctrl-C, `kill` and what a batch system sends before the time is up end the run at the end of its step; the
/// second time they end it at once.
void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
}

}  // namespace

ExitCode run(const CaseArguments& arguments) {
  const model::Case c = model::load_case(arguments.path, arguments.set);
  model::RunOptions options;
  options.folder = results_folder(arguments, c);
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  options.progress = rank == 0 ? &std::cout : nullptr;
  options.terminal = rank == 0 && arguments.progress_bar && results::is_terminal(STDOUT_FILENO);
  options.restart = arguments.restart;
  options.stop_asked = [] { return stop_asked != 0; };
  listen_to_signals();
  const model::RunResult result = model::run_case(c, options);
  note_folder(options.folder);  // a run that stopped is drawn as far as it came
  if (!result.finished) {
    if (rank == 0) std::cerr << "solidus: " << result.reason << std::endl;
    return k_cannot_go_on;
  }
  print("Results in " + options.folder.lexically_normal().string() + "\n");
  return k_done;
}

}  // namespace solidus::app
