/// The table of all formats: each describes itself in its own file, and a file is matched by its ending and
/// its first bytes together.
#include "mesh/files/file_format.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "mesh/files/built_in_formats.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

bool share_an_ending(const FileFormat& one, const FileFormat& other) {
  return std::ranges::any_of(one.endings, [&](std::string_view ending) {
    return std::ranges::find(other.endings, ending) != other.endings.end();
  });
}

void insert(std::vector<FileFormat>& formats, FileFormat format) {
  if (format.read == nullptr && format.read_skin == nullptr && !format.by_gmsh && !format.by_library)
    throw std::logic_error("nothing reads the mesh format '" + std::string(format.name) + "'");
  for (const FileFormat& other : formats)
    if (other.name == format.name || other.place == format.place || share_an_ending(other, format))
      throw std::logic_error("the mesh formats '" + std::string(format.name) + "' and '" +
                             std::string(other.name) + "' share a name, a place or an ending");
  const auto next = std::ranges::upper_bound(formats, format.place, {}, &FileFormat::place);
  formats.insert(next, std::move(format));
}

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<FileFormat>& formats() {
  static std::vector<FileFormat> all = [] {
    std::vector<FileFormat> built_in;
    for (FileFormat& format : built_in_formats()) insert(built_in, std::move(format));
    return built_in;
  }();
  return all;
}

/// Null where no format has this ending.
const FileFormat* known_by_ending(const std::string& ending) {
  for (const FileFormat& format : formats())
    if (std::ranges::find(format.endings, ending) != format.endings.end()) return &format;
  return nullptr;
}

std::string all_endings() {
  std::string text;
  for (const FileFormat& format : formats())
    for (const std::string_view ending : format.endings)
      if (std::none_of(ending.begin(), ending.end(), [](char c) { return c >= 'A' && c <= 'Z'; }))
        text += (text.empty() ? "" : ", ") + std::string(ending);
  return text;
}

std::string head_of(const std::string& path) {
  std::array<char, 4096> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  return {bytes.data(), as_size(file.gcount())};
}

}  // namespace

const std::vector<FileFormat>& file_formats() {
  return formats();
}

void add_file_format(FileFormat format) {
  insert(formats(), std::move(format));
}

void check_readable(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError({path}, "the mesh file does not exist");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError({path}, "the mesh is not a file");
  if (std::filesystem::file_size(path, error) == 0) throw InputError({path}, "the mesh file is empty");
  if (!std::ifstream(path)) throw InputError({path}, "the mesh file cannot be read");
}

bool is_mesh_name(const std::string& path) {
  return known_by_ending(std::filesystem::path(path).extension().string()) != nullptr;
}

const FileFormat& file_format(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const FileFormat* known = known_by_ending(ending);
  if (known == nullptr)
    throw InputError({path},
                     ending.empty()
                         ? "the mesh file's name has no ending that says what the file is"
                         : "the ending '" + ending + "' of the mesh file's name is none that is known",
                     all_endings());
  if (!known->begins(head_of(path)))
    throw InputError({path}, "the file is not what its name says: a " + ending + " file begins with " +
                                 std::string(known->begins_with));
  return *known;
}

std::string common_formats() {
  std::string text;
  for (const FileFormat& format : formats())
    if (!format.told.empty()) text += std::string(format.told) + ", ";
  return text + "…";
}

bool is_geometry(FileHolds holds) {
  return holds == FileHolds::script || holds == FileHolds::shapes;
}

}  // namespace solidus::mesh
