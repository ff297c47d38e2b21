/// Reads a field from a VTK XML file of an unstructured grid (.vtu), or the parts that a .pvtu lists: of
/// another run, or of another program.
#pragma once

#include <filesystem>
#include <string>

#include "results/formats/field_reader.hpp"

namespace solidus::results {

/// Reads point data of one component. Numbers may be text, base64 or raw, compressed by zlib or not, of
/// little endian. Cells of the shapes that Solidus has are taken as they are; voxels, pixels, wedges and
/// pyramids as hexahedra, quadrilaterals and tetrahedra. Of the cells only those of the highest dimension are
/// kept, and none that `vtkGhostType` marks.
/// @param body    only cells whose data `body` is this; −1: all
/// @param length  metres per unit of the file's coordinates
/// Throws InputError: with the place of the user's key where the file, its field or its body is not there,
/// with the file where it is damaged or of a kind that is not read.
ReadField read_vtu(const std::filesystem::path& file, const std::string& field, int body, double length,
                   const SourceLocation& where);

}  // namespace solidus::results
