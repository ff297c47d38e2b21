/// The verb `run`.
#include "run/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include "app/places.hpp"
#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "app/watch.hpp"
#include "linear/interruption.hpp"
#include "parallel/parallel.hpp"
#include "results/progress.hpp"
#include "results/run_folder.hpp"
#include "system/processes.hpp"
#include "system/terminal.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// -o, else the case's own wish (seen from the present folder), else results/CASE/VARIANT.
fs::path results_folder(const CaseArguments& arguments, const model::Case& c) {
  if (!arguments.output.empty()) return arguments.output;
  if (c.spec.output.folder) return *c.spec.output.folder;
  return results_root() / results::default_run_folder(c.file, c.variant);
}

/// A folder as one types it: below the present folder without the way to it.
std::string shown_path(const fs::path& folder) {
  const fs::path here = folder.lexically_normal().lexically_proximate(fs::current_path());
  return here.empty() || *here.begin() == ".." ? folder.lexically_normal().string() : here.string();
}

}  // namespace

ExitCode run(const CaseArguments& arguments) {
  const model::Case c = load_case(arguments);
  model::RunOptions options;
  options.folder = results_folder(arguments, c);
  const int rank = processes::rank();
  options.progress = rank == 0 ? &std::cout : nullptr;
  options.terminal = rank == 0 && arguments.progress_bar && results::is_terminal(STDOUT_FILENO);
  options.restart = arguments.restart;
  options.profile = arguments.profile;
  options.stop_asked = stop_asked;
  linear::interrupt_when(stop_asked);
  std::optional<Watch> watch;
  if (arguments.watch && rank == 0) {
    watch.emplace(options.folder);
    print("Watch it in a browser on this machine: " + watch->address() + "\n");
  }
  const model::RunResult result = model::run_case(c, options);
  if (watch) watch->finish();
  note_folder(options.folder);  // a run that stopped is drawn as far as it came
  if (arguments.report && rank == 0) write_report({.folders = {options.folder.string()}, .output = {}});
  if (!result.finished) {
    if (rank == 0)
      std::cerr << painted("solidus:", Colour::red, has_colours(STDERR_FILENO)) << " " << result.reason
                << std::endl;
    return parallel::any_process(interrupted()) ? k_interrupted : k_cannot_continue;
  }
  const std::string folder = shown_path(options.folder);
  print(fmt::format(
      "Results in {}.{}\n", folder,
      arguments.report ? std::string() : fmt::format(" Next: solidus report {0}; solidus plot {0}", folder)));
  return k_done;
}

}  // namespace solidus::app
