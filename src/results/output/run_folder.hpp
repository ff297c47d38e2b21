/// The folder of one run: results/CASE/VARIANT with everything in it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace solidus::results {

/// results/NAME/default for NAME/case.toml, results/NAME/VARIANT for NAME/VARIANT.toml or a variant of the
/// name, relative to the present folder.
/// @param variant  of the case file (setup/case_layers.hpp); empty: the file as it is
std::filesystem::path default_run_folder(const std::filesystem::path& case_file,
                                         const std::string& variant = {});

/// Whether the run of this folder has come to its end: its summary says so, which is written last.
/// Collective.
bool is_finished(const std::filesystem::path& folder);

/// ```
/// case.toml     the case, fully resolved; its first line says that Solidus wrote it
/// history.csv   probes and globals     steps.csv  every step     summary.json  how it went
/// fields/       of the formats of fields, which also have files here (field_format.hpp)
/// checkpoint/   to go on from
/// pools.csv     pools of melt, where something can freeze
/// feeding.csv   where the metal that shrinks took its volume from, with heat alone
/// shots.csv     every shot               stages.csv  what each stage has left in the bodies
/// sensitivities.csv  derivatives of probes, of a run with --sensitivities
/// report.html   the page that `solidus report` wrote; a new run takes it away
/// ```
class RunFolder {
 public:
  /// Creates the folder, removes what an earlier run of ours left there and writes case.toml. Files that are
  /// not ours stay; links are kept and written through. Collective. Throws OutputError on every process when
  /// the folder cannot be made or written, or holds a case.toml, history.csv ... or a table that Solidus did
  /// not write.
  /// @param resolved_case  text of case.toml
  /// @param continued a run is continued: its files are kept
  /// @param tables  names of further files that the run writes there
  RunFolder(std::filesystem::path root, std::string_view resolved_case, bool continued = false,
            std::span<const std::string> tables = {});
  /// Whether a run itself may write a file of this name.
  static bool is_taken(std::string_view file);

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path history() const { return root_ / "history.csv"; }
  std::filesystem::path steps() const { return root_ / "steps.csv"; }
  std::filesystem::path pools() const { return root_ / "pools.csv"; }
  std::filesystem::path feeding() const { return root_ / "feeding.csv"; }
  std::filesystem::path shots() const { return root_ / "shots.csv"; }
  std::filesystem::path stages() const { return root_ / "stages.csv"; }
  std::filesystem::path sensitivities() const { return root_ / "sensitivities.csv"; }
  std::filesystem::path summary() const { return root_ / "summary.json"; }
  std::filesystem::path fields() const { return root_ / "fields"; }

 private:
  std::filesystem::path root_;
};

}  // namespace solidus::results
