/// One set of files for each moment, then the collection that lists them.
#include "results/formats/field_output.hpp"

#include <fmt/format.h>

#include <cctype>
#include <utility>
#include <vector>

#include "results/formats/vtu.hpp"
#include "results/output/output_error.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

// Group names are free text; file names keep the characters that are safe on every system.
std::string file_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return text;
}

}  // namespace

FieldOutput::FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh)
    : mesh_(mesh), fields_(folder.fields()), collection_(folder.collection()) {}

FieldOutput::FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh, double time)
    : FieldOutput(folder, mesh) {
  on_first_process([&] {
    collection_ = PvdCollection(folder.collection(), time);
    for (const PvdCollection::Entry& entry : collection_.entries()) {
      if (entry.part == 0) ++written_;
      last_time_ = entry.time;
    }
  });
  processes::broadcast(std::span(&written_, 1));
  processes::broadcast(std::span(&last_time_, 1));
}

// Returns the file to open, relative to the folder of the collection.
std::string FieldOutput::write_one(const std::string& name, const mesh::Surface* surface,
                                   const FieldSet& fields, double time) {
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

void FieldOutput::write(double time, const FieldSet& fields,
                        const std::map<std::string, FieldSet>& surfaces) {
  if (written_ > 0 && time == last_time_) return;
  std::vector<std::string> files = {write_one(fmt::format("fields_{:05}", written_), nullptr, fields, time)};
  for (const auto& [name, values] : surfaces)
    files.push_back(write_one(fmt::format("surface_{}_{:05}", file_name(name), written_),
                              &mesh_.surfaces.at(name), values, time));
  on_first_process([&] {
    std::vector<PvdCollection::Entry> entries;
    for (std::size_t i = 0; i < files.size(); ++i) entries.push_back({time, static_cast<int>(i), files[i]});
    collection_.add(entries);
  });
  ++written_;
  last_time_ = time;
}

}  // namespace solidus::results
