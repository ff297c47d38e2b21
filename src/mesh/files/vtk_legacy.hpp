/// Meshes in VTK's legacy format (.vtk), of versions 1 to 5.1, text or binary.
#pragma once

#include <optional>
#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads an unstructured grid: points, cells, and the cell data of one component that tell bodies apart
/// (mesh/files/vtk_grid.hpp). Nothing for a file of another kind of data, such as POLYDATA. Throws InputError
/// with the line, of a binary file the place, of what is damaged or not known.
std::optional<RawMesh> read_legacy_vtk(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
