/// The verb `run`.
#include "run/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <utility>

#include "app/case_arguments.hpp"
#include "app/launched.hpp"
#include "app/mould_filling.hpp"
#include "app/places.hpp"
#include "app/process_choice.hpp"
#include "app/report_page.hpp"
#include "app/signals.hpp"
#include "app/verb.hpp"
#include "app/watch.hpp"
#include "linear/interruption.hpp"
#include "parallel/parallel.hpp"
#include "results/output/run_folder.hpp"
#include "run/error_runs.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/time_input.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/terminal.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

struct RunArguments : CaseArguments {
  std::string output;            ///< results folder; empty: by the case
  bool progress_bar = true;      ///< on a terminal
  bool restart = false;          ///< go on from the checkpoint
  bool profile = false;          ///< show at the end where the time went
  bool watch = false;            ///< serve the report while the run goes on
  bool report = false;           ///< write the report at the end
  std::optional<int> processes;  ///< absent: as many as pay
  std::string sensitivities;     ///< file of the parameters of derivatives; empty: none
  bool sure = false;             ///< compare with further runs for the errors of the answers
};

constexpr int k_most_processes = 1024;  // of one machine

/// -o, else the case's own wish (seen from the present folder), else results/CASE/VARIANT.
fs::path results_folder(const RunArguments& arguments, const setup::Case& c) {
  if (!arguments.output.empty()) return arguments.output;
  if (c.spec.output.folder) return *c.spec.output.folder;
  return results_root() / results::default_run_folder(c.file, c.variant);
}

/// A folder as one types it: below the present folder without the way to it.
std::string shown_path(const fs::path& folder) {
  const fs::path here = folder.lexically_normal().lexically_proximate(fs::current_path());
  return here.empty() || *here.begin() == ".." ? folder.lexically_normal().string() : here.string();
}

/// The same case with further assignments.
CaseArguments with(const RunArguments& arguments, const std::vector<std::string>& overrides) {
  CaseArguments beside = arguments;
  beside.set.insert(beside.set.end(), overrides.begin(), overrides.end());
  return beside;
}

/// Runs the case, and what --sure asks for in addition.
run::RunResult run_all(const RunArguments& arguments, const setup::Case& c, run::RunOptions options) {
  std::optional<results::Summary> summary;
  double displacement_error = 0;
  {
    run::Session session(c, options);  // whose memory the further runs need
    const run::RunResult result = session.run();
    if (!result.finished || !arguments.sure) return result;
    summary = *session.summary();
    options.mesh.reset();  // the further runs have others
    displacement_error =
        setup::displacement_error(c.spec.time, setup::sections_of(c.spec, session.made().assembly.mesh));
  }
  // The further runs differ in some keys alone; all else is as given on the command line.
  const auto load = [&](const std::vector<std::string>& overrides) {
    return load_case(with(arguments, overrides));
  };
  // Their errors of the answers are printed below the summary.
  const run::ErrorRuns made =
      run::run_beside(c, std::move(*summary), displacement_error, options, load,
                      [](const std::string& text) { print("--sure: " + text + "\n"); });
  const cases::OutputSpec& output = c.spec.output;
  print(results::text(*made.summary.answers, made.summary.criteria,
                      {output.length_unit, output.temperature_unit, output.stress_unit}));
  return {};
}

/// The case; one that a launcher has read already says nothing again.
setup::Case read_case(const RunArguments& arguments) {
  const logging::Level level = logging::level();
  if (started_by_launcher()) logging::set_level(std::max(level, logging::Level::warn));
  setup::Case c = load_case(arguments);
  logging::set_level(level);
  return c;
}

/// The case with the mould filled, in the folder `filling` next to the results. Processes that a launcher has
/// started find it filled.
/// Returns how filling ended where it did not end well.
std::optional<ExitCode> fill_first(RunArguments& arguments, setup::Case& c) {
  if (!c.spec.filling || c.spec.filling->result) return {};
  const fs::path folder = fs::absolute(results_folder(arguments, c) / "filling").lexically_normal();
  if (!started_by_launcher()) {
    const ExitCode code = fill_mould(c, folder, {arguments.processes, arguments.restart});
    if (code != k_done) return code;
  }
  // The key says where the run starts from, so that the case among its results is complete.
  std::ostringstream assignment;
  assignment << "filling.result=" << std::quoted(folder.string());
  arguments.set.push_back(assignment.str());
  c = read_case(arguments);
  return {};
}

ExitCode run_case(RunArguments arguments) {
  // The order of a run at the command line: case, options, the page that watches it, the run itself, and what
  // is printed at its end.
  setup::Case c = read_case(arguments);
  if (const std::optional<ExitCode> ended = fill_first(arguments, c)) return *ended;
  if (arguments.sure && c.spec.time.steady)
    throw InputError(c.spec.time.where, "--sure compares answers of a transient run, and this case is steady",
                     "a run without --sure");
  run::RunOptions options;
  options.folder = results_folder(arguments, c);
  const int rank = processes::rank();
  // The first process alone talks; the others compute.
  options.progress = rank == 0 ? &std::cout : nullptr;
  options.terminal = rank == 0 && arguments.progress_bar && is_terminal(STDOUT_FILENO);
  options.restart = arguments.restart;
  options.profile = arguments.profile;
  options.stop_asked = stop_asked;
  // Derivatives are taken on one process.
  const std::optional<int> processes =
      arguments.processes || arguments.sensitivities.empty() ? arguments.processes : std::optional(1);
  RunStart start = start_run(processes, c, options);
  if (start.code) return *start.code;
  options.mesh = std::move(start.mesh);
  if (!arguments.sensitivities.empty()) {
    if (arguments.restart)
      throw InputError({}, "derivatives begin at the start of a run", "--sensitivities without --restart");
    options.neighbours = run::read_neighbours(arguments.sensitivities, [&](const auto& overrides) {
      return load_case(with(arguments, overrides));
    });
  }
  linear::interrupt_when(stop_asked);
  std::optional<Watch> watch;
  if (arguments.watch && rank == 0) {
    watch.emplace(options.folder);
    print("Watch it in a browser on this machine: " + watch->address() + "\n");
  }
  const run::RunResult result = run_all(arguments, c, options);
  // The folder is noted before the outcome is judged, because pictures are drawn of a run that stopped too.
  if (watch) watch->finish();
  note_folder(options.folder);  // a run that stopped is drawn as far as it came
  if (arguments.report && rank == 0) write_report({options.folder.string()}, {});
  // A run that was stopped from outside ends with another exit code than one that cannot continue.
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

class Run final : public Verb {
 public:
  explicit Run(CLI::App& program) : Verb(program, "run", "Run a case") {
    RunArguments& a = arguments_;
    // The case comes first, then where the results go and on how many processes, how the run is shown, and
    // what it may do in addition.
    add_case(command(), a);
    command()
        .add_option("-o,--output", a.output, "Folder of the results; default results/CASE/VARIANT")
        ->type_name("FOLDER");
    command().add_flag_callback(
        "--no-progress", [&a] { a.progress_bar = false; }, "Print plain lines, also on a terminal");
    command()
        .add_option("--processes", a.processes,
                    "Run on so many processes of this machine; default as many as pay for the case and find "
                    "a core that is free")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, k_most_processes));
    command().add_flag("--restart", a.restart,
                       "Continue a run that was stopped, from its checkpoint in the folder of the results");
    command().add_flag("--profile", a.profile,
                       "Print at the end where the wall time went (always in summary.json)");
    command().add_flag(
        "--report", a.report,
        "Write report.html, a page for the browser, into the folder of the results at the end");
    command().add_flag("--watch", a.watch,
                       "Show the report while the run goes on, at an address of this machine alone");
    // Derivatives, and the further runs for errors.
    command()
        .add_option("--sensitivities", a.sensitivities,
                    "Write sensitivities.csv: derivatives of probed temperatures, and displacements, by the "
                    "parameters of "
                    "this file (heat alone, steps of a given size)")
        ->type_name("FILE");
    command().add_flag("--sure", a.sure,
                       "Run it twice more, with longer steps and with larger elements, for the errors of the "
                       "answers; half to one and a half times its time again");
    add_physics(command(), a);
    add_trust(command(), a.trust_script);
    add_trust_laws(command());
  }
  ExitCode run() override { return run_case(arguments_); }

 private:
  RunArguments arguments_;
};

}  // namespace

std::unique_ptr<Verb> run_verb(CLI::App& program) {
  return std::make_unique<Run>(program);
}

}  // namespace solidus::app
