/// Finds the format of a mesh file from its name and its first bytes together.
///
/// Gmsh takes every file whose name and first line it does not know for a script and runs it; scripts can
/// start other programs. So the program decides what a file is, and Gmsh only sees files that it reads as
/// just that.
///
/// A format describes itself in its own file: mesh/files/format_NAME.cpp gives it as format_NAME(), and
///
///   const AddFileFormat k_su2{{  // at namespace scope
///       .name = "SU2", .place = 95, .endings = {".su2"}, .begins = &begins, .begins_with = "'NDIME='",
///       .read = &read}};
///
/// adds one to the program and to the reader of meshes, which both have to be linked with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/files/file_unit.hpp"
#include "mesh/files/stl_file.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// What a file of a format holds.
enum class FileHolds {
  mesh,
  skin,    ///< triangles of skins: what they enclose is meshed
  shapes,  ///< of a CAD program, without groups: Gmsh meshes them
  script   ///< of Gmsh: a program that makes a geometry
};

/// Reads the mesh of a file, wedges and pyramids whole; nothing where Gmsh is to
/// read it after all. Throws
/// InputError for a file that is damaged or has what the format's reader refuses.
using ReadMeshFile = std::optional<RawMesh> (*)(const std::string& path, double unit_in_metres);
/// Reads the skins of a file, as read_stl (mesh/files/stl_file.hpp).
using ReadSkinFile = std::vector<Facets> (*)(const std::string& path);
/// The unit of length that a file names itself, as unit_of_file (mesh/files/file_unit.hpp).
using ReadFileUnit = std::optional<LengthUnit> (*)(const std::string& path);

struct FileFormat {
  std::string_view name;  ///< in messages: "STL"
  int place = 0;          ///< formats are tried and told in the order of these numbers, which differ
  /// Endings as Gmsh compares them: ".Step" is none of a CAD file to it, so it is none here.
  std::vector<std::string_view> endings;
  bool (*begins)(std::string_view head) = nullptr;  ///< whether a file with these first bytes is of it
  std::string_view begins_with;                     ///< description of the sign tested for, for a message
  std::string_view told = {};  ///< in messages that name the most common formats; empty: it is not among them
  FileHolds holds = FileHolds::mesh;
  ReadMeshFile read = nullptr;
  /// Gmsh knows it by these endings and first bytes, and reads what `read` leaves to it. Of another file Gmsh
  /// would make a script, and run it.
  bool by_gmsh = false;
  bool by_library = false;  ///< the MED library reads it, which the reader of meshes alone is linked with
  ReadSkinFile read_skin = nullptr;  ///< of what holds a skin
  ReadFileUnit unit = nullptr;       ///< null: files of the format name none
  bool in_mm = false;  ///< its reader hands lengths over in mm, whatever the unit of the file is
};

/// All formats, built in and added, in the order of their places.
const std::vector<FileFormat>& file_formats();

/// Throws std::logic_error where another format has the name, the place or one of the endings, and for a
/// format that nothing reads.
void add_file_format(FileFormat format);

/// Adds a format while the program starts, as an object at namespace scope.
struct AddFileFormat {
  explicit AddFileFormat(FileFormat format) { add_file_format(std::move(format)); }
};

/// Throws InputError where there is no file of this name with something in it that can be read.
void check_readable(const std::string& path);

/// Whether the ending of a file's name is that of a geometry or a mesh.
bool is_mesh_name(const std::string& path);

/// The format of a regular file that exists and is not empty.
/// Throws InputError where the name has no known ending or the content is not what the ending says.
const FileFormat& file_format(const std::string& path);

/// The most common formats, for messages.
std::string common_formats();

/// A file that Gmsh meshes: of a CAD program, or a script.
bool is_geometry(FileHolds holds);

}  // namespace solidus::mesh
