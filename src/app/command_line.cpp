/// The verbs are declared with CLI11, the line is parsed, the verb is run, and its failure becomes an exit
/// code.
#include "app/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/version.hpp"

namespace solidus::app {

namespace {

void set_log_level(const std::string& wanted) {
  using logging::Level;
  const std::map<std::string, Level> levels = {
      {"debug", Level::debug}, {"info", Level::info}, {"warn", Level::warn}, {"silent", Level::silent}};
  const auto level = levels.find(wanted);
  if (level == levels.end())
    throw InputError({}, fmt::format("there is no log level '{}'", wanted),
                     one_of({"debug", "info", "warn", "silent"}, wanted));
  logging::set_level(level->second);
}

/// Reads the command line into the options of the verbs. Returns an exit code where that was all: help or the
/// version was asked for.
std::optional<ExitCode> parse(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForVersion& version_text) {
    print(std::string(version_text.what()) + "\n");
    return k_done;
  } catch (const CLI::Success& help) {
    print(help.get_name() == "CallForHelp"
              ? (program.get_subcommands().empty() ? program.help()
                                                   : program.get_subcommands()[0]->help("solidus"))
              : program.help("", CLI::AppFormatMode::All));
    return k_done;
  } catch (const CLI::ParseError& error) {
    // A command line without anything is answered by an example.
    if (argc == 1)
      throw InputError({}, "which verb?",
                       "`solidus run CASE`, for example; `solidus --help` shows all of them");
    const auto named = program.get_subcommands();
    // The verb at hand says where its options are explained.
    throw InputError({}, error.what(),
                     named.empty() ? "`solidus --help` shows verbs and options"
                                   : "`solidus help " + named[0]->get_name() + "` shows its options");
  }
  return {};
}

}  // namespace

CLI::App& verb_named(CLI::App& program, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  if (std::ranges::find(names, name) == names.end())
    throw InputError({}, fmt::format("there is no verb '{}'", name), one_of(names, name));
  return *program.get_subcommand(name);
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App program("Solidus " + program_version() + ": how a metal casting solidifies in its mould.");
  program.require_subcommand(1);
  program.footer(
      "Options of PETSc follow behind --, for example: solidus run CASE -- -heat_ksp_monitor\n"
      "Exit codes: 0 done, 1 your input, 2 the simulation could not go on, 3 our bug, 130 stopped by "
      "Ctrl-C.");
  program.set_version_flag("--version", "Solidus " + program_version(), "Print the version");
  std::string level = "info";
  // One level of the log for all verbs, before or behind the verb.
  program.add_option("--log", level, "debug, info, warn or silent")->type_name("LEVEL");
  std::vector<std::unique_ptr<Verb>> all;
  // Verbs register themselves; the one chosen runs after the whole line is understood.
  for (const MakeVerb make : verbs()) all.push_back(make(program));
  for (CLI::App* verb : program.get_subcommands({})) verb->fallthrough();

  // An unknown verb is told with the nearest name, which the library does not do.
  if (argc > 1 && argv[1][0] != '-') verb_named(program, argv[1]);
  if (const std::optional<ExitCode> code = parse(program, argc, argv)) return *code;
  set_log_level(level);
  for (const std::unique_ptr<Verb>& verb : all)
    if (verb->asked_for()) return verb->run();
  return k_our_bug;
}

}  // namespace solidus::app
