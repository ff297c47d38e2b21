#include "mesh/making/reader_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "input/units.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/own_format.hpp"
#include "mesh/making/reader.hpp"
#include "mesh/making/reader_message.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::mesh {

namespace {

ReadMesh* reads_here = nullptr;  ///< null: readers read
bool copies_read = false;        ///< of this process

[[noreturn]] void too_little_memory(const MeshSource& source, const ReaderLimits& limits) {
  throw InputError(
      {source.path},
      "reading or meshing needs more memory than " + std::to_string(std::lround(limits.memory / 1e6)) + " MB",
      "larger elements, or more memory: SOLIDUS_MESH_MEMORY=\"8 GB\"");
}

/// Nothing where another reader has to read the file.
std::optional<RawMesh> take_answer(Reader& reader, const MeshSource& source, const ReaderLimits& limits) {
  const TakeBytes take = [&](void* bytes, std::size_t n) { reader.take(bytes, n); };
  // Outlooks come before the answer itself, any number of them.
  ReaderAnswer answer = ReaderAnswer::internal;
  take(&answer, sizeof answer);
  while (answer == ReaderAnswer::outlook) {
    reader.hear(take_outlook(take));
    take(&answer, sizeof answer);
  }
  switch (answer) {
    case ReaderAnswer::mesh:
      return take_mesh(take, limits.memory);
    case ReaderAnswer::unusable_geometry:
      throw UnusableGeometry({}, take_text(take));
    case ReaderAnswer::input_error:
      throw InputError({}, take_text(take));
    case ReaderAnswer::memory:
      too_little_memory(source, limits);
    case ReaderAnswer::internal:
      throw InputError({source.path}, "the mesh cannot be read: " + take_text(take));
    case ReaderAnswer::elsewhere:
      return {};
    case ReaderAnswer::outlook:
      break;  // taken above
  }
  throw MessageError("an answer of no kind");
}

/// Reads in a reader, or with `copies` in a copy of this process, which leaves some files to a reader.
std::optional<RawMesh> ask_reader(const MeshSource& source, const CastingGeometry* casting, bool copies,
                                  const TimeOfWay& time, double* spent) {
  const ReaderLimits limits = reader_limits(source, casting != nullptr);
  Reader reader(source, limits, time);
  if (copies)
    reader.fork([](const MeshSource& file, const CastingGeometry*) { return read_own_format(file); });
  else
    reader.start();
  reader.request(casting);
  const auto note_time = [&] {
    if (spent != nullptr) *spent = reader.processor_time();
  };
  // The time is noted also when the geometry could not be meshed.
  try {
    std::optional<RawMesh> mesh = take_answer(reader, source, limits);
    note_time();
    return mesh;
  } catch (const InputError&) {
    note_time();
    throw;
  } catch (const MessageError& error) {
    throw InputError({source.path},
                     fmt::format("what the program that reads meshes, '{}', answered is no mesh: {}",
                                 reader.program(), error.what()),
                     k_same_build);
  }
}

RawMesh read_in_own_process(const MeshSource& source, const CastingGeometry* casting, const TimeOfWay& time,
                            double* spent) {
  // A format of this program needs none of the reader's libraries, which take longer to load than most
  // meshes to read.
  if (copies_read && casting == nullptr && is_own_format(source.path))
    if (std::optional<RawMesh> mesh = ask_reader(source, nullptr, true, time, spent)) return std::move(*mesh);
  if (std::optional<RawMesh> mesh = ask_reader(source, casting, false, time, spent)) return std::move(*mesh);
  throw std::logic_error("the reader of meshes left a file to itself");
}

/// "8 GB" or "500 MB" in bytes.
double bytes_of(const std::string& text) {
  double number = 0;
  std::array<char, 4> unit{};
  const int found = std::sscanf(text.c_str(), "%lf %3s", &number, unit.data());
  const std::string_view named(unit.data());
  const double scale = named == "GB" ? 1e9 : named == "MB" ? 1e6 : 0;
  if (found != 2 || !(number > 0) || scale == 0)
    throw InputError({"SOLIDUS_MESH_MEMORY"}, "'" + text + "' is no amount of memory",
                     "\"8 GB\" or \"500 MB\"");
  return number * scale;
}

double seconds_of(const std::string& text) {
  try {
    const double time = units::parse_quantity(text, "s");
    if (time > 0) return time;
  } catch (const std::invalid_argument&) {  // NOLINT: said below
  }
  throw InputError({"SOLIDUS_MESH_TIME"}, "'" + text + "' is no duration", "\"20 min\"");
}

/// Whether a regular file is none that Gmsh would have to mesh.
bool holds_mesh(const std::string& path) {
  try {
    return !is_geometry(file_format(path).holds);
  } catch (const InputError&) {  // the reader says what is wrong with it
    return true;
  }
}

}  // namespace

void read_in_this_process(ReadMesh* read) {
  reads_here = read;
}

void read_in_copies_of_this_process() {
  copies_read = true;
}

ReaderLimits reader_limits(const MeshSource& source, bool meshes) {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  ReaderLimits limits{0.5 * machine, 1800};
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(source.path, error));
  // A file that holds a mesh becomes some twenty times as large in memory, and takes a second per megabyte
  // where the machine is busy.
  if (!error && !meshes && holds_mesh(source.path))
    limits = {std::min(limits.memory, 1e9 + 60 * size), 60 + size / 1e6};
  if (const char* memory = std::getenv("SOLIDUS_MESH_MEMORY")) limits.memory = bytes_of(memory);
  if (const char* time = std::getenv("SOLIDUS_MESH_TIME")) limits.time = seconds_of(time);
  return limits;
}

RawMesh read_in_one_way(const MeshSource& source, const CastingGeometry* casting, const TimeOfWay& time,
                        double* spent) {
  RawMesh mesh =
      reads_here != nullptr ? reads_here(source, casting) : read_in_own_process(source, casting, time, spent);
  // A file that is read several times says each thing once.
  static std::set<std::string> said;
  for (const std::string& note : mesh.notes)
    if (const std::string text = note.starts_with(source.path) ? note : source.path + ": " + note;
        said.insert(text).second)
      logging::warn("{}", text);
  return mesh;
}

RawMesh read_mesh(const MeshSource& source) {
  return read_in_one_way(source, nullptr);
}

RawMesh read_mesh(const std::string& path, double unit_in_metres, double element_size, int element_order,
                  const std::map<std::string, double>& constants, const GeometryChoice& geometry) {
  return read_mesh(MeshSource{path, unit_in_metres, element_size, element_order, constants, geometry});
}

}  // namespace solidus::mesh
