/// The stress in a VTK XML file of an unstructured grid (.vtu, or the parts that a .pvtu lists): of another
/// run, or of another program.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "system/errors.hpp"

namespace solidus::results {

/// Values at places of the file: at its points, or at the middles of its cells.
struct ReadStress {
  std::vector<mesh::Point> x;                 ///< [m]
  std::vector<std::array<double, 6>> values;  ///< xx, yy, zz, xy, yz, xz, in the file's unit, [place]
  std::string unit;                           ///< where the file says it, else empty
};

/// Reads a field of six components, of cells where the file has it there, else of points. Cells that the file
/// marks as copies of another part (`vtkGhostType`) are left out.
/// @param body    only cells whose data `body` is this; −1: all
/// @param length  metres per unit of the file's coordinates
/// Throws InputError: with the place of the user's key where the file, its field or its body is not there,
/// with the file where it is damaged.
ReadStress read_stress(const std::filesystem::path& file, const std::string& field, int body, double length,
                       const SourceLocation& where);

}  // namespace solidus::results
