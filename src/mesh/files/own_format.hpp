/// Reads the formats that need no library but those of the program itself.
#pragma once

#include <optional>
#include <string>

#include "mesh/files/file_format.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Whether a file holds a mesh in a format that read_own_format() may read. False for a file that cannot be
/// read at all: its reader says what is wrong with it.
bool is_own_format(const std::string& path);

/// The mesh, its cells split as the program computes them; nothing where Gmsh has to read it after all.
/// Throws InputError.
std::optional<RawMesh> read_own_format(const MeshSource& source);

/// Refuses what a case asks of a file that cannot have it: choices of geometries for a mesh, constants of
/// scripts for what is none. Throws InputError.
void check_choices(const MeshSource& source, const FileFormat& format);

}  // namespace solidus::mesh
