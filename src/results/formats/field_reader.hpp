/// A scalar field of a file: of another run, or of another program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "system/errors.hpp"

namespace solidus::results {

struct ReadField {
  mesh::Mesh mesh;  ///< of this process alone, one body; nodes that parts share are there once a part
  std::vector<double> values;  ///< [node], in the file's unit
  std::string unit;            ///< of the values, where the file says it, else empty
  /// Where the file has values of cells, which may have other shapes than the mesh's elements: these, [cell],
  /// in the file's unit, and their volumes [m³]. Sums over the file are over them. Else empty.
  std::vector<double> cell_values = {}, cell_volumes = {};
};

/// Reads a file of VTK (vtu_reader.hpp) or the folder of a time of OpenFOAM (openfoam_reader.hpp).
/// @param body    only cells whose data `body` is this; −1: all
/// @param length  metres per unit of the file's coordinates
/// Throws InputError.
ReadField read_field(const std::filesystem::path& path, const std::string& field, int body, double length,
                     const SourceLocation& where);

}  // namespace solidus::results
