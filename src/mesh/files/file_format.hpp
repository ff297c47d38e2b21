/// Finds the format of a mesh file from its name and its first bytes together.
///
/// Gmsh takes every file whose name and first line it does not know for a script and runs it; scripts can
/// start other programs. So the program decides what a file is, and Gmsh only sees files that it reads as
/// just that.
#pragma once

#include <string>

namespace solidus::mesh {

enum class FileFormat {
  gmsh_mesh,    ///< .msh
  gmsh_script,  ///< .geo: a program that makes a geometry
  step,
  brep,
  iges,
  abaqus,
  universal,  ///< .unv
  med,
  nastran,
  medit,
  vtk,
  vtu,
  stl  ///< triangles of a skin
};

/// Throws InputError where there is no file of this name with something in it that can be read.
void check_readable(const std::string& path);

/// Whether the ending of a file's name is that of a geometry or a mesh.
bool is_mesh_name(const std::string& path);

/// The format of a regular file that exists and is not empty.
/// Throws InputError where the name has no known ending or the content is not what the ending says.
FileFormat file_format(const std::string& path);

/// The most common formats, for messages.
const char* mesh_formats();

/// A file of a CAD program: shapes without groups.
bool is_cad(FileFormat format);
/// A file that Gmsh meshes: of a CAD program, or a script.
bool is_geometry(FileFormat format);

}  // namespace solidus::mesh
