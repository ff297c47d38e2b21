/// The collection of a run's field files with their times (.pvd): the one file to open in ParaView.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace solidus::results {

/// The name of the collection in the folder of a run's results, which all that reads fields starts from.
constexpr std::string_view k_collection = "fields.pvd";

/// Rewritten whole and atomically after each addition, so that a run that is stopped or still going on can be
/// opened. One process writes it.
class PvdCollection {
 public:
  /// Starts an empty collection; the file appears with the first addition.
  explicit PvdCollection(std::filesystem::path path);
  /// Goes on with the collection of an earlier run, without what came after `time` (a restart). Throws
  /// OutputError when the file is not one of ours.
  PvdCollection(std::filesystem::path path, double time);

  struct Entry {
    double time = 0;   ///< [s]
    int part = 0;      ///< 0 for the bodies, 1, 2, … for surfaces
    std::string file;  ///< relative to the folder of the collection
  };
  /// Adds the files of one moment. Throws OutputError; the collection is then as before.
  void add(const std::vector<Entry>& moment);
  void add(double time, const std::string& file) { add({{time, 0, file}}); }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

}  // namespace solidus::results
