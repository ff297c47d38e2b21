/// The collection is written again with each moment, so that it is whole whenever the run ends.
#include "results/formats/pvd.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "results/formats/vtk_data.hpp"
#include "results/output/output_file.hpp"

namespace solidus::results {

namespace {

// The value of an attribute in a line this file wrote; false when it is not there.
bool attribute(std::string_view line, std::string_view name, std::string& value) {
  const std::string key = fmt::format(" {}=\"", name);
  const std::size_t start = line.find(key);
  if (start == std::string_view::npos) return false;
  const std::size_t from = start + key.size(), to = line.find('"', from);
  if (to == std::string_view::npos) return false;
  value = line.substr(from, to - from);
  return true;
}

}  // namespace

PvdCollection::PvdCollection(std::filesystem::path path) : path_(std::move(path)) {}

PvdCollection::PvdCollection(std::filesystem::path path, double time) : path_(std::move(path)) {
  std::ifstream file(path_);
  std::string line, text, part, name;
  bool ours = false;
  // Entries up to the time at which the run goes on are kept.
  while (std::getline(file, line)) {
    ours = ours || line.find("<Collection>") != std::string::npos;
    if (line.find("<DataSet") == std::string::npos) continue;
    if (!attribute(line, "timestep", text) || !attribute(line, "part", part) ||
        !attribute(line, "file", name))
      throw OutputError(path_.string(),
                        "this collection was not written by Solidus; the run cannot go on with it");
    // A time that is no number means another writer, whose file must not be overwritten.
    char* end = nullptr;
    const double at = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !std::isfinite(at))
      throw OutputError(path_.string(), fmt::format("'{}' in this collection is no time", text));
    if (at <= time) entries_.push_back({at, std::atoi(part.c_str()), name});
  }
  if (!ours) throw OutputError(path_.string(), "there is no collection of fields to go on with");
}

void PvdCollection::add(const std::vector<Entry>& moment) {
  std::vector<Entry> entries = entries_;
  entries.insert(entries.end(), moment.begin(), moment.end());
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Entry& entry : entries)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", entry.time, entry.part,
                        xml_text(entry.file));
  text += "  </Collection>\n</VTKFile>\n";
  write_file(path_, text);
  entries_ = std::move(entries);
}

}  // namespace solidus::results
