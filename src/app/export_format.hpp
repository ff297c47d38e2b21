/// A format of `solidus export`: it describes itself in its own file, by its option, its line of help and
/// what writes it.
///
///   std::string write(const ExportRequest& request);
///
///   const AddExportFormat k_table{{  // at namespace scope: help, completion and the manual page have it
///       .name = "table",
///       .place = 50,
///       .help = "A table of the last fields, for a spreadsheet",
///       .write = &write}};
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace solidus::app {

/// One export as the command line asks for it.
struct ExportRequest {
  std::filesystem::path folder;      ///< of a run
  std::filesystem::path file;        ///< to write
  bool deformed = false;             ///< coordinates with the displacement
  bool temperature_history = false;  ///< the temperatures of all times as a load
  bool trust_script = false;         ///< as of CaseArguments
};

struct ExportFormat {
  std::string_view name;         ///< of its option, without the dashes
  int place = 0;                 ///< options come in the order of these numbers, which differ
  std::string_view help;         ///< of its option
  bool starts_analysis = false;  ///< takes --deformed and --temperature-history; else these are refused
  /// Writes the file and returns what is to be printed. Throws InputError for a run that has not what the
  /// format needs, OutputError where the file cannot be written; then there is none.
  std::string (*write)(const ExportRequest& request) = nullptr;
};

/// All formats, built in and added, in the order of their places.
const std::vector<ExportFormat>& export_formats();

/// Throws std::logic_error where another format has the name or the place.
void add_export_format(const ExportFormat& format);

/// Adds a format while the program starts, as an object at namespace scope.
struct AddExportFormat {
  explicit AddExportFormat(const ExportFormat& format) { add_export_format(format); }
};

/// The collection of the field files of a run, fields.pvd. Throws InputError where there is none, and on
/// several processes.
std::filesystem::path collection_of(const ExportRequest& request);

}  // namespace solidus::app
