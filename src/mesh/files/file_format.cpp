#include "mesh/files/file_format.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Test = bool (*)(std::string_view head);

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

bool is_text(std::string_view head) {
  return head.find('\0') == std::string_view::npos;
}

// The first lines by which Gmsh itself knows a mesh (GModel::readMSH); anything else it would run.
bool begins_as_gmsh_mesh(std::string_view head) {
  return head.starts_with("$MeshFormat") || head.starts_with("$NOD") || head.starts_with("$Comments");
}
bool begins_as_script(std::string_view head) {
  return is_text(head) && !head.starts_with('$');
}
bool begins_as_step(std::string_view head) {
  return is_text(head) && head.find("ISO-10303-21") != std::string_view::npos;
}
bool begins_as_brep(std::string_view head) {
  return head.find("CASCADE Topology") != std::string_view::npos ||
         head.find("DBRep_DrawableShape") != std::string_view::npos;
}
// Column 73 of an IGES line names its section: S (start), or C and B of the compressed and binary forms.
bool begins_as_iges(std::string_view head) {
  return head.size() > 72 && (head[72] == 'S' || head[72] == 'C' || head[72] == 'B');
}
bool begins_as_universal(std::string_view head) {
  return is_text(head) && without_blanks(head).starts_with("-1");
}
bool begins_as_hdf5(std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n");
}
bool begins_as_medit(std::string_view head) {
  return is_text(head) && head.find("MeshVersionFormatted") != std::string_view::npos;
}
bool begins_as_vtk(std::string_view head) {
  return head.starts_with("# vtk DataFile");
}

bool begins_as_vtk_xml(std::string_view head) {
  return head.find("<VTKFile") != std::string_view::npos;
}

bool begins_as_stl(std::string_view head) {
  constexpr std::size_t k_binary = 84;  // a title, and the number of triangles
  return head.starts_with("solid") || head.size() >= k_binary;
}

struct Known {
  FileFormat format;
  /// Endings as Gmsh compares them: ".Step" is none of a CAD file to it, so it is none here.
  std::vector<std::string_view> endings;
  Test begins;
  const char* begins_with;  ///< description of the sign tested for, for a message
};

const std::vector<Known>& known_formats() {
  static const std::vector<Known> known = {
      {FileFormat::gmsh_mesh, {".msh"}, begins_as_gmsh_mesh, "'$MeshFormat'"},
      {FileFormat::gmsh_script, {".geo"}, begins_as_script, "text"},
      {FileFormat::step, {".step", ".STEP", ".stp", ".STP"}, begins_as_step, "'ISO-10303-21'"},
      {FileFormat::brep,
       {".brep", ".brp", ".BRP"},
       begins_as_brep,
       "'CASCADE Topology' or 'DBRep_DrawableShape'"},
      {FileFormat::iges,
       {".iges", ".IGES", ".igs", ".IGS"},
       begins_as_iges,
       "lines of 80 columns, the 73rd an 'S'"},
      {FileFormat::abaqus, {".inp", ".INP", ".Inp"}, is_text, "text"},
      {FileFormat::universal, {".unv", ".UNV"}, begins_as_universal, "'-1'"},
      {FileFormat::med, {".med", ".MED", ".rmed"}, begins_as_hdf5, "the signature of HDF5"},
      {FileFormat::nastran, {".bdf", ".BDF", ".nas", ".NAS"}, is_text, "text"},
      {FileFormat::medit, {".mesh", ".MESH"}, begins_as_medit, "'MeshVersionFormatted'"},
      {FileFormat::vtk, {".vtk", ".VTK"}, begins_as_vtk, "'# vtk DataFile'"},
      {FileFormat::vtu, {".vtu"}, begins_as_vtk_xml, "'<VTKFile'"},
      {FileFormat::stl, {".stl", ".STL"}, begins_as_stl, "'solid', or 80 bytes and the number of triangles"}};
  return known;
}

/// Null where no format has this ending.
const Known* known_by_ending(const std::string& ending) {
  for (const Known& known : known_formats())
    if (std::ranges::find(known.endings, ending) != known.endings.end()) return &known;
  return nullptr;
}

std::string all_endings() {
  std::string text;
  for (const Known& known : known_formats())
    for (const std::string_view ending : known.endings)
      if (std::none_of(ending.begin(), ending.end(), [](char c) { return c >= 'A' && c <= 'Z'; }))
        text += (text.empty() ? "" : ", ") + std::string(ending);
  return text;
}

std::string head_of(const std::string& path) {
  std::array<char, 4096> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

}  // namespace

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

FileFormat file_format(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const Known* known = known_by_ending(ending);
  if (known == nullptr)
    throw InputError({path},
                     ending.empty()
                         ? "the mesh file's name has no ending that says what the file is"
                         : "the ending '" + ending + "' of the mesh file's name is none that is known",
                     all_endings());
  if (!known->begins(head_of(path)))
    throw InputError({path}, "the file is not what its name says: a " + ending + " file begins with " +
                                 std::string(known->begins_with));
  return known->format;
}

const char* mesh_formats() {
  return ".msh 2.2 or 4.1, .geo, .step, Abaqus .inp, .vtu, .unv, .med, .bdf, …";
}

bool is_cad(FileFormat format) {
  return format == FileFormat::step || format == FileFormat::brep || format == FileFormat::iges;
}

bool is_geometry(FileFormat format) {
  return format == FileFormat::gmsh_script || is_cad(format);
}

}  // namespace solidus::mesh
