/// The fields of a run as VTK XML files, which every run writes: fields/fields_00012.vtu, in parallel
/// fields/fields_00012.pvtu with one part per process, surfaces likewise as fields/surface_NAME_00012.vtu,
/// all of them numbered and collected in fields.pvd.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "numbers/index_casts.hpp"
#include "results/fields/field.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/vtu.hpp"
#include "results/output/field_format.hpp"
#include "results/output/output_error.hpp"
#include "results/output/run_folder.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

/// Returns the name of a group, which is free text, with the characters that are safe in names of files on
/// every system.
std::string file_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return text;
}

/// Takes `end` off the end of a name, if it is there.
bool strip(std::string_view& name, std::string_view end) {
  if (!name.ends_with(end)) return false;
  name.remove_suffix(end.size());
  return true;
}

/// Takes a number of at least `least` digits off the end of a name.
bool strip_number(std::string_view& name, std::size_t least) {
  const auto last =
      std::find_if_not(name.rbegin(), name.rend(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto digits = as_size(last - name.rbegin());
  if (digits < least) return false;
  name.remove_suffix(digits);
  return true;
}

/// Recognises fields_00012.vtu, surface_NAME_00012_p3.vtu, their .pvtu lists, and the files that an
/// interrupted run left of them.
bool is_field_file(std::string_view name) {
  if (!strip(name, ".part")) strip(name, ".spool");
  if (!strip(name, ".pvtu") && !strip(name, ".vtu")) return false;
  std::string_view without_process = name;
  if (strip_number(without_process, 1) && strip(without_process, "_p")) name = without_process;
  return strip_number(name, 5) && strip(name, "_") &&
         (name == "fields" || (name.starts_with("surface_") && name.size() > 8));
}

/// One set of files for each moment, then the collection that lists them.
class VtuWriter final : public FieldWriter {
 public:
  VtuWriter(const RunFolder& folder, const mesh::Mesh& mesh, std::optional<double> from);
  /// After an error the collection is unchanged.
  void write(double time, const FieldSet& bodies, const std::map<std::string, FieldSet>& surfaces) override;

 private:
  std::string write_one(const std::string& name, const mesh::Surface* surface, const FieldSet& fields,
                        double time) const;

  const mesh::Mesh& mesh_;
  std::filesystem::path fields_;
  PvdCollection collection_;
  int written_ = 0;
};

VtuWriter::VtuWriter(const RunFolder& folder, const mesh::Mesh& mesh, std::optional<double> from)
    : mesh_(mesh), fields_(folder.fields()), collection_(folder.root() / k_collection) {
  if (!from) return;
  on_first_process([&] {
    collection_ = PvdCollection(folder.root() / k_collection, *from);
    for (const PvdCollection::Entry& entry : collection_.entries())
      if (entry.part == 0) ++written_;
  });
  processes::broadcast(std::span(&written_, 1));
}

// Returns the file to open, relative to the folder of the collection.
std::string VtuWriter::write_one(const std::string& name, const mesh::Surface* surface,
                                 const FieldSet& fields, double time) const {
  const int rank = processes::rank(), size = processes::count();
  // One file for each process, or a single one without a number.
  const auto part = [&](int process) {
    return size == 1 ? name + ".vtu" : fmt::format("{}_p{}.vtu", name, process);
  };
  // Each process writes its part; with several of them the first one writes the list.
  run_collectively([&] {
    if (surface != nullptr)
      write_surface_vtu(fields_ / part(rank), mesh_, *surface, fields, time);
    else
      write_vtu(fields_ / part(rank), mesh_, fields, time);
  });
  if (size == 1) return "fields/" + part(0);
  on_first_process([&] {
    std::vector<std::string> parts;
    for (int process = 0; process < size; ++process) parts.push_back(part(process));
    write_pvtu(fields_ / (name + ".pvtu"), parts, fields, surface != nullptr);
  });
  return "fields/" + name + ".pvtu";
}

void VtuWriter::write(double time, const FieldSet& bodies, const std::map<std::string, FieldSet>& surfaces) {
  std::vector<std::string> files = {write_one(fmt::format("fields_{:05}", written_), nullptr, bodies, time)};
  for (const auto& [name, values] : surfaces)
    files.push_back(write_one(fmt::format("surface_{}_{:05}", file_name(name), written_),
                              &mesh_.surfaces.at(name), values, time));
  on_first_process([&] {
    std::vector<PvdCollection::Entry> entries;
    for (std::size_t i = 0; i < files.size(); ++i) entries.push_back({time, static_cast<int>(i), files[i]});
    collection_.add(entries);
  });
  ++written_;
}

std::unique_ptr<FieldWriter> make(const RunFolder& folder, const mesh::Mesh& mesh,
                                  std::optional<double> from) {
  return std::make_unique<VtuWriter>(folder, mesh, from);
}

}  // namespace

FieldFormat format_vtu() {
  return {
      .name = "vtu", .place = 10, .files = {k_collection}, .is_field_file = &is_field_file, .make = &make};
}

}  // namespace solidus::results
