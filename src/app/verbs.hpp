/// The verbs of the program. Each prints what the user asked for on stdout, from process 0; errors are
/// thrown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "build/case_file.hpp"

namespace solidus::app {

/// Exit codes of the program (docs/guide/command_line.md).
enum ExitCode { k_done = 0, k_bad_input = 1, k_cannot_continue = 2, k_our_bug = 3, k_interrupted = 130 };

struct CaseArguments {
  std::string path;  ///< a case file, or a folder with a case.toml; with :VARIANT one of its variants
  std::vector<std::string> set;  ///< "path=value"
  std::string output;            ///< results folder; empty: by the case
  bool progress_bar = true;      ///< on a terminal
  bool restart = false;          ///< go on from the checkpoint
  bool profile = false;          ///< show at the end where the time went
  bool trust_script = false;     ///< run a .geo script whatever it says
  bool heat_only = false;        ///< heat alone, whatever the case says
  bool coupled = false;          ///< heat and mechanics, whatever the case says
  bool watch = false;            ///< serve the report while the run goes on
  bool report = false;           ///< write the report at the end
  bool sure = false;             ///< compare with runs beside it for the errors of the answers
};

/// Writes to stdout on process 0; says so when that is not possible (a full disk behind a redirection).
void print(const std::string& text);

ExitCode run(const CaseArguments& arguments);
ExitCode check(const CaseArguments& arguments);
/// Prints as JSON what of a case is uncertain, and by how much; checks the case as check() does.
ExitCode list_uncertain(const CaseArguments& arguments);
/// Prints a case as one file: includes, overrides and defaults in place, paths absolute. Reads no mesh.
ExitCode resolve(const CaseArguments& arguments);
/// Lists the variants of a case (build/case_layers.hpp).
ExitCode list_variants(const std::string& path);
/// A material point through a history of strain, stress and temperature.
/// @param arguments path: a point file, or a folder with a point.toml
ExitCode run_point(const CaseArguments& arguments);
/// The laws of a point file, checked along its histories (point/check_law.hpp); exit code 1 where one fails.
ExitCode check_point_laws(const CaseArguments& arguments);
/// The files whose keys are declared.
enum class FileKind { case_file, material_file, point_file };
/// @param key a path such as "time.step"; empty: all keys
ExitCode explain(FileKind file, const std::string& key, bool manual);
enum class ExplainedAs { text, manual, json };
/// The fields that a run can have (coupling/all_fields.hpp).
/// @param field  one of them; empty: all
ExitCode explain_fields(const std::string& field, ExplainedAs form);
ExitCode schema(FileKind file);
/// @param path a case, or a mesh file
/// @param unit of the lengths of a mesh file; empty: what the file says, else m
/// @param pictures  folder for pictures of the faces by number; empty: none
ExitCode mesh_info(const CaseArguments& arguments, const std::string& unit,
                   const std::filesystem::path& pictures);
/// @param name   a material of the library or a file; empty: the list
/// @param output a folder for its tables (CSV); empty: none
ExitCode materials(const std::string& name, const std::string& output);
struct MaterialImportArguments {
  std::string file;    ///< a table, CSV or JSON
  std::string output;  ///< the material file to write; empty: stdout
  std::string like, title, source;
  std::string latent_heat, volume_change, molar_mass;  ///< quantities with units; empty: not given
  std::vector<std::string> columns;                    ///< "QUANTITY=HEADER" or "QUANTITY=HEADER:UNIT"
};
/// A material card from the table of a thermodynamic program.
ExitCode import_material(const MaterialImportArguments& arguments);
struct SolidificationArguments {
  std::string alloy;         ///< "Al-9Si-3Cu-0.3Mg"
  bool lever = false;        ///< the lever rule instead of Scheil's equation
  std::string system;        ///< a file with the liquidus; empty: that of the library
  double tolerance = 0.002;  ///< of the chords, in solid fraction
  std::string output;        ///< a file; empty: stdout
};
/// The fraction curve of an alloy by Scheil's equation or the lever rule.
ExitCode solidification_path(const SolidificationArguments& arguments);
/// A case as the command line changes it. Throws InputError.
model::Case load_case(const CaseArguments& arguments);
struct ExportArguments {
  std::string folder;                         ///< of a run
  std::string calculix, abaqus, vtkhdf, med;  ///< file to write, exactly one of them
  bool deformed = false;                      ///< coordinates with the displacement
  bool temperature_history = false;           ///< the temperatures of all times as a load
  bool trust_script = false;                  ///< as of CaseArguments
};
ExitCode export_state(const ExportArguments& arguments);
struct NewArguments {
  std::string geometry, alloy, folder, symmetry, riser;
  std::string process = "sand", unit;
  std::vector<std::string> as;  ///< "NAME=role"
  double fineness = 1;
  int shots = 0;  ///< zero: not given
};
/// From the geometry of a casting to a case that runs.
ExitCode new_case(const NewArguments& arguments);
struct ReportArguments {
  std::vector<std::string> folders;  ///< of runs
  std::string output;                ///< the page; empty: report.html in the first folder
};
/// Not collective: one process reads and writes.
ExitCode write_report(const ReportArguments& arguments);
ExitCode version();
/// Tries what runs need of the machine (reader of meshes, materials, room for results, several processes,
/// Python for pictures) and prints a line for each. k_bad_input where no run is possible.
ExitCode doctor();
/// Writes schemas and rules for editors into a folder; empty: the present one.
ExitCode init_editor(const std::string& folder);

}  // namespace solidus::app
