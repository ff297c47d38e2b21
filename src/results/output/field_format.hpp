/// A format in which a run writes its fields: it describes itself in its own file, by its key of [output],
/// the files that it leaves in the results folder, and what writes them. results/formats/format_NAME.cpp
/// gives it as format_NAME(), and
///
///   std::unique_ptr<FieldWriter> make(const RunFolder& folder, const mesh::Mesh& mesh, std::optional<double>
///   from);
///
///   const AddFieldFormat k_extremes{{  // at namespace scope: case files and runs have it
///       .name = "extremes",
///       .place = 15,
///       .doc = "A table of the extremes of each field too.",
///       .files = {"extremes.csv"},
///       .make = &make}};
///
/// adds one to the program.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace solidus::mesh {
struct Mesh;
}

namespace solidus::results {

class FieldSet;   // results/fields/field.hpp
class RunFolder;  // results/output/run_folder.hpp

/// Writes the fields of one run. Its functions are collective: an error on one process is thrown on all
/// (OutputError, NotFiniteError).
class FieldWriter {
 public:
  virtual ~FieldWriter() = default;
  /// Writes the fields of one moment. Moments come in the order of their times, each of them once.
  /// @param surfaces  nodal fields of surfaces of the mesh, by name of the surface
  virtual void write(double time, const FieldSet& bodies,
                     const std::map<std::string, FieldSet>& surfaces) = 0;
  /// The run ends or stops, and at least one moment has been written, by it or before it was continued.
  virtual void end() {}
};

struct FieldFormat {
  std::string_view name;  ///< of its key in [output], which is true or false
  int place = 0;          ///< formats are written in the order of these numbers, which differ
  /// A sentence about the key. Empty: there is none, and every run writes the format.
  std::string_view doc = {};
  /// Its files directly in the results folder. The next run in the folder removes them.
  std::vector<std::string_view> files = {};
  /// Whether a file in the folder `fields` may be of the format; the next run removes these too. Null: none
  /// is.
  bool (*is_field_file)(std::string_view name) = nullptr;
  /// Called once a run, on all processes.
  /// @param from  the time from which a run is continued: what was written up to it stays, later moments are
  ///              dropped
  std::unique_ptr<FieldWriter> (*make)(const RunFolder& folder, const mesh::Mesh& mesh,
                                       std::optional<double> from) = nullptr;
};

/// All formats, built in and added, in the order of their places.
const std::vector<FieldFormat>& field_formats();

/// Throws std::logic_error where another format has the name, the place or one of the files, and for a format
/// that nothing writes.
void add_field_format(FieldFormat format);

/// Adds a format while the program starts, as an object at namespace scope.
struct AddFieldFormat {
  explicit AddFieldFormat(FieldFormat format);
};

}  // namespace solidus::results
