/// The program: reads the command line, runs a verb, turns failures into one message and an exit code.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <optional>

#include "app/built_version.hpp"
#include "app/child_process.hpp"
#include "app/command_tree.hpp"
#include "app/completion.hpp"
#include "app/manual_page.hpp"
#include "app/python_tools.hpp"
#include "app/python_verbs.hpp"
#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "case/case_keys.hpp"
#include "case/case_materials.hpp"
#include "input/key_docs.hpp"
#include "input/keys.hpp"
#include "material/external_law.hpp"
#include "material/library.hpp"
#include "mesh/reader_process.hpp"
#include "parallel/petsc_session.hpp"
#include "system/blas_threads.hpp"
#include "system/errors.hpp"
#include "system/free_memory.hpp"
#include "system/input_file.hpp"
#include "system/log.hpp"
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
  } catch (const std::exception& error) {
    // PETSc reads options late, when a solver is made; an option that it does not know is the user's error.
    if (std::string_view(error.what()).find("SetFromOptions") != std::string_view::npos)
      return fail(k_bad_input, fmt::format("an option behind -- is wrong: {}", error.what()));
    return fail(
        k_our_bug,
        fmt::format("internal error: {}\n  This is a mistake in Solidus; please report it.", error.what()));
  }
}

void add_case_arguments(CLI::App& verb, CaseArguments& arguments) {
  verb.add_option("CASE", arguments.path,
                  "A case file, or a folder with a case.toml; CASE:VARIANT for one of its variants")
      ->required();
  verb.add_option("--set", arguments.set, "Change a key, for example --set time.step=\"0.5 s\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_trust(CLI::App& verb, bool& trust) {
  verb.add_flag("--trust-geo", trust,
                "Run .geo scripts whatever they say: they can start programs and write files as you can");
}

void add_trust_laws(CLI::App& verb, bool& trust) {
  verb.add_flag("--trust-laws", trust,
                "Load laws of materials from shared objects: their code runs as a program of their author");
}

CLI::App* add_material_import(CLI::App& materials, MaterialImportArguments& arguments) {
  CLI::App* verb = materials.add_subcommand(
      "import",
      "Make a material card from a table of Thermo-Calc, JMatPro or pycalphad's Scheil (CSV or JSON)");
  verb->add_option("FILE", arguments.file, "The table")->required();
  verb->add_option("-o,--output", arguments.output, "The material file to write; default: print it");
  verb->add_option("--like", arguments.like, "A card for what the table lacks");
  verb->add_option("--title", arguments.title, "What the material is, in one line");
  verb->add_option("--source", arguments.source, "Where the table comes from; default: its name");
  verb->add_option("--latent-heat", arguments.latent_heat,
                   "For example \"390 kJ/kg\", for tables without enthalpy");
  verb->add_option("--volume-change", arguments.volume_change, "On freezing, for example -0.045");
  verb->add_option("--molar-mass", arguments.molar_mass, "For example \"27.1 g/mol\", for columns per mole");
  verb->add_option("--column", arguments.columns,
                   "Which column holds what: QUANTITY=HEADER or QUANTITY=HEADER:UNIT, "
                   "for example \"enthalpy=HMR:J/mol\"")
      ->allow_extra_args(false);
  return verb;
}

CLI::App* add_solidification(CLI::App& materials, SolidificationArguments& arguments) {
  CLI::App* verb = materials.add_subcommand(
      "scheil", "Print the solid fraction of an alloy by Scheil's equation or the lever rule");
  verb->add_option("ALLOY", arguments.alloy, "Weight per cent, for example Al-9Si-3Cu-0.3Mg")->required();
  verb->add_flag("--lever", arguments.lever, "The lever rule: full diffusion in the solid");
  verb->add_option("--system", arguments.system, "A file with the liquidus; default: that of the library");
  verb->add_option("--tolerance", arguments.tolerance,
                   "Of the straight lines between the points; default 0.002");
  verb->add_option("-o,--output", arguments.output, "A file; default: print it");
  return verb;
}

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

/// Returns the words that completion offers besides verbs and options.
KnownWords known_words() {
  return {key_paths(model::case_keys().info()), material::material_names(model::material_folders())};
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
  program.add_option("--log", level, "debug, info, warn or silent")->type_name("LEVEL");

  CaseArguments arguments;
  std::string key, name, unit;
  bool manual = false, of_material = false, of_point = false;
  CLI::App* run_verb = program.add_subcommand("run", "Run a case");
  add_case_arguments(*run_verb, arguments);
  run_verb->add_option("-o,--output", arguments.output, "Folder of the results; default results/CASE/VARIANT")
      ->type_name("FOLDER");
  run_verb->add_flag_callback(
      "--no-progress", [&] { arguments.progress_bar = false; }, "Print plain lines, also on a terminal");
  run_verb->add_flag("--restart", arguments.restart,
                     "Continue a run that was stopped, from its checkpoint in the folder of the results");
  run_verb->add_flag("--profile", arguments.profile,
                     "Print at the end where the wall time went (always in summary.json)");
  run_verb->add_flag("--report", arguments.report,
                     "Write report.html, a page for the browser, into the folder of the results at the end");
  run_verb->add_flag("--watch", arguments.watch,
                     "Show the report while the run goes on, at an address of this machine alone");
  run_verb->add_flag("--sure", arguments.sure,
                     "Run it twice more, with longer steps and with larger elements, for the errors of the "
                     "answers; half to one and a half times its time again");
  CLI::App* check_verb = program.add_subcommand("check", "Check a case: everything but solving");
  add_case_arguments(*check_verb, arguments);
  CLI::App* resolve_verb =
      program.add_subcommand("resolve", "Print a case as one file: includes, --set and defaults in place");
  add_case_arguments(*resolve_verb, arguments);
  CLI::App* variants_verb =
      program.add_subcommand("variants", "List the variants of a case, which run as CASE:VARIANT");
  variants_verb->add_option("CASE", arguments.path, "A case file, or a folder with a case.toml")->required();
  for (CLI::App* verb : {run_verb, check_verb, resolve_verb}) {
    CLI::Option* heat_only = verb->add_flag("--heat-only", arguments.heat_only,
                                            "Compute heat alone; what does not apply is left out and named");
    verb->add_flag("--coupled", arguments.coupled, "Compute heat and mechanics")->excludes(heat_only);
  }
  add_trust(*run_verb, arguments.trust_script);
  add_trust(*check_verb, arguments.trust_script);
  bool trust_laws = false, check_law = false;
  add_trust_laws(*run_verb, trust_laws);
  add_trust_laws(*check_verb, trust_laws);
  CLI::App* explain_verb = program.add_subcommand("explain", "Explain a key of the case file, or list all");
  explain_verb->add_option("KEY", key, "For example time.step");
  explain_verb->add_flag("--manual", manual, "The reference manual of all keys, in Markdown");
  bool of_fields = false, as_json = false;
  CLI::Option* fields_option =
      explain_verb->add_flag("--fields", of_fields, "Fields of results instead of keys; KEY is one of them");
  explain_verb->add_flag("--json", as_json, "With --fields: for other programs")->needs(fields_option);
  CLI::App* schema_verb =
      program.add_subcommand("schema", "Print the JSON Schema of the case file, for editors");
  for (CLI::App* verb : {explain_verb, schema_verb}) {
    CLI::Option* material =
        verb->add_flag("--material", of_material, "Keys of a material file instead of a case file");
    verb->add_flag("--point", of_point, "Keys of a point file instead of a case file")->excludes(material);
  }
  for (const char* file_kind : {"--material", "--point"})
    fields_option->excludes(explain_verb->get_option(file_kind));
  CLI::App* point_verb = program.add_subcommand(
      "point", "Take a point of a material through a history of strain, stress and temperature");
  point_verb->add_option("CASE", arguments.path, "A point file, or a folder with a point.toml")->required();
  point_verb->add_option("--set", arguments.set, "Change a key, for example --set temperature=\"300 degC\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  point_verb
      ->add_option("-o,--output", arguments.output, "Folder of the results; default results/FOLDER/FILE")
      ->type_name("FOLDER");
  add_trust_laws(*point_verb, trust_laws);
  point_verb->add_flag("--check-law", check_law,
                       "Check the law along the history instead: tangent, energy, isotropy, repetition");
  CLI::App* mesh_verb = program.add_subcommand("mesh-info", "Report groups, sizes and quality of a mesh");
  mesh_verb->add_option("CASE", arguments.path, "A mesh file, or a case")->required();
  mesh_verb->add_option("--set", arguments.set, "Change a key of the case")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  mesh_verb
      ->add_option("--unit", unit,
                   "Unit of length of a mesh file, for example mm; default what the file says, else m")
      ->type_name("UNIT");
  std::string pictures;
  mesh_verb
      ->add_option("--pictures", pictures,
                   "Folder for pictures of every body's faces by their numbers, and for faces.vtk (ParaView)")
      ->type_name("FOLDER");
  add_trust(*mesh_verb, arguments.trust_script);
  CLI::App* materials_verb =
      program.add_subcommand("materials", "List the material library, or print one material");
  materials_verb->add_option("NAME", name, "A material of the library, or a material file");
  materials_verb
      ->add_option("-o,--output", arguments.output,
                   "Folder for tables of the properties and the flow curves (CSV)")
      ->type_name("FOLDER");
  MaterialImportArguments imported;
  SolidificationArguments freezing;
  CLI::App* import_verb = add_material_import(*materials_verb, imported);
  CLI::App* scheil_verb = add_solidification(*materials_verb, freezing);
  ExportArguments exported;
  CLI::App* export_verb = program.add_subcommand("export",
                                                 "Write what a run left for another program: its end as the "
                                                 "start of a structural analysis, or its fields");
  export_verb->add_option("FOLDER", exported.folder, "Folder of the run's results")->required();
  export_verb->add_option("--calculix", exported.calculix, "File for CalculiX: stress at every point")
      ->type_name("FILE");
  export_verb->add_option("--abaqus", exported.abaqus, "File for Abaqus: stress of the elements")
      ->type_name("FILE");
  export_verb
      ->add_option("--vtkhdf", exported.vtkhdf,
                   "One file with the fields of all times, for ParaView 5.12 or newer")
      ->type_name("FILE");
  export_verb
      ->add_option("--med", exported.med, "One file with the fields of all times, for Salome and code_aster")
      ->type_name("FILE");
  export_verb->add_flag("--deformed", exported.deformed, "Deformed instead of nominal coordinates");
  export_verb->add_flag("--temperature-history", exported.temperature_history,
                        "With --calculix or --abaqus: the temperatures of all times as the load, no stress");
  add_trust(*export_verb, exported.trust_script);
  add_trust_laws(*export_verb, trust_laws);
  NewArguments fresh;
  CLI::App* new_verb = program.add_subcommand("new", "Make a case that runs from the geometry of a casting");
  new_verb->add_option("PART", fresh.geometry, "A STEP, BREP, IGES or STL file, or a mesh")->required();
  new_verb->add_option("--alloy", fresh.alloy,
                       "What is cast, always needed: an alloy of `solidus materials`, or a file");
  new_verb->add_option("--process", fresh.process, "sand, shell, gravity_die or high_pressure; default sand");
  new_verb
      ->add_option("--shots", fresh.shots,
                   "Castings in a row into one die, which stays warm; for gravity_die and high_pressure")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  new_verb->add_option("--riser", fresh.riser, "auto: put a riser on the thickest place");
  new_verb->add_option("--symmetry", fresh.symmetry, "x, y or z: keep half of the part, below its middle");
  new_verb
      ->add_option("--as", fresh.as, "What a body of the file is, NAME=ROLE, for example --as Box_2=chill")
      ->allow_extra_args(false);
  new_verb->add_option("--unit", fresh.unit,
                       "Unit of length of the file; default what STEP and IGES files say, else mm");
  new_verb->add_option("--fineness", fresh.fineness,
                       "So many times as many elements along each edge; default 1");
  new_verb->add_option("-o,--output", fresh.folder, "Folder for the case; default the file's name, here");
  ReportArguments reported;
  CLI::App* report_verb =
      program.add_subcommand("report", "Write what runs left as one page that opens in any browser");
  report_verb->add_option("RUN", reported.folders, "Folders of results; two are shown side by side")
      ->required();
  report_verb->add_option("-o,--output", reported.output,
                          "The page; default report.html in the first folder");
  CLI::App* version_verb = program.add_subcommand("version", "Print versions");
  CLI::App* doctor_verb = program.add_subcommand(
      "doctor", "Say what this machine lacks for runs, several processes and pictures");
  const PythonVerbs python(program);
  std::string verb_name, shell, editor_folder;
  CLI::App* editor_verb = program.add_subcommand(
      "init-editor", "Write schemas and rules with which editors check and complete cases");
  editor_verb->add_option("FOLDER", editor_folder, "Folder of the cases; default the present one");
  CLI::App* completion_verb =
      program.add_subcommand("completion", "Print a script with which a shell completes command lines");
  completion_verb->add_option("SHELL", shell, "bash, zsh or fish")->required();
  CLI::App* man_verb = program.add_subcommand("man", "Print the manual page, for man -l -");
  CLI::App* help_verb = program.add_subcommand("help", "Print what a verb does and its options");
  help_verb->add_option("VERB", verb_name, "A verb; without it the list of verbs");
  for (CLI::App* verb : program.get_subcommands({})) verb->fallthrough();

  const auto verb_of = [&program](const std::string& wanted) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : program.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), wanted) == verbs.end())
      throw InputError({}, fmt::format("there is no verb '{}'", wanted), one_of(verbs, wanted));
    return program.get_subcommand(wanted);
  };
  if (argc > 1 && argv[1][0] != '-') verb_of(argv[1]);
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
    const auto verbs = program.get_subcommands();
    if (argc == 1)
      throw InputError({}, "which verb?",
                       "`solidus run CASE`, for example; `solidus --help` shows all of them");
    throw InputError({}, error.what(),
                     verbs.empty() ? "`solidus --help` shows verbs and options"
                                   : "`solidus help " + verbs[0]->get_name() + "` shows its options");
  }
  set_log_level(level);
  if (trust_laws) material::trust_external_laws();
  const FileKind file = of_material ? FileKind::material_file
                        : of_point  ? FileKind::point_file
                                    : FileKind::case_file;
  if (*run_verb) return run(arguments);
  if (*check_verb) return check(arguments);
  if (*variants_verb) return list_variants(arguments.path);
  if (*resolve_verb) return resolve(arguments);
  if (*point_verb) return check_law ? check_point_laws(arguments) : run_point(arguments);
  if (*explain_verb && of_fields)
    return explain_fields(key, as_json  ? ExplainedAs::json
                               : manual ? ExplainedAs::manual
                                        : ExplainedAs::text);
  if (*explain_verb) return explain(file, key, manual);
  if (*schema_verb) return schema(file);
  if (*mesh_verb) return mesh_info(arguments, unit, pictures);
  if (*import_verb) return import_material(imported);
  if (*scheil_verb) return solidification_path(freezing);
  if (*materials_verb) return materials(name, arguments.output);
  if (*export_verb) return export_state(exported);
  if (*new_verb) return new_case(fresh);
  if (*report_verb) return write_report(reported);
  if (*version_verb) return version();
  if (*doctor_verb) return doctor();
  if (*help_verb) {
    // help() of the program itself would tell of this verb, which was asked for.
    print(verb_name.empty()
              ? program.get_formatter()->make_help(&program, "solidus", CLI::AppFormatMode::Normal)
              : verb_of(verb_name)->help("solidus"));
    return k_done;
  }
  if (*completion_verb) {
    print(completion(command_tree(program), known_words(), shell));
    return k_done;
  }
  if (*man_verb) {
    print(manual_page(command_tree(program)));
    return k_done;
  }
  if (*editor_verb) return init_editor(editor_folder);
  if (const std::optional<ExitCode> code = python.run()) return *code;
  return k_our_bug;
}

}  // namespace

int main(int argc, char** argv) {
  set_program_version(built_version());
  const auto runs = [](const char* argument) { return std::string_view(argument) == "run"; };
  const bool run_wanted = std::any_of(argv + 1, argv + argc, runs);
  // A downstream reader that has ended is no failure: output to it is lost.
  std::signal(SIGPIPE, SIG_IGN);
  if (run_wanted) {
    listen_to_signals();
    mesh::give_up_reading_when(stop_asked);
  }
  keep_environment();
  profile::begin();
  give_large_arrays_back();
  use_one_thread_of_blas();
  // Arguments behind "--" are PETSc's.
  char** const end = argv + argc;
  char** const separator = std::find_if(argv, end, [](const char* a) { return std::string_view(a) == "--"; });
  const std::vector<std::string> for_petsc(separator == end ? end : separator + 1, end);
  std::optional<profile::Part> start(std::in_place, "start of the program");
  try {
    if (!petsc::start(for_petsc)) {
      std::fputs("solidus: PETSc cannot start; its message stands above, its options behind --\n", stderr);
      return separator == end ? k_our_bug : k_bad_input;
    }
  } catch (const InputError& error) {
    std::fputs(("solidus: " + printable(error.what()) + "\n").c_str(), stderr);
    return k_bad_input;
  }
  start.reset();
  if (run_wanted && !stop_asked()) listen_to_signals();  // MPI and PETSc may have put theirs in place
  const int own_argc = static_cast<int>(separator - argv);
  const ExitCode code = guarded([&] { return parse_and_run(own_argc, argv); });
  petsc::end();
  return code;
}
