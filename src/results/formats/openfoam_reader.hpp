/// Reads a field of OpenFOAM: a time folder of a case, whose mesh lies in constant/polyMesh next to it.
#pragma once

#include <filesystem>
#include <string>

#include "results/formats/field_reader.hpp"

namespace solidus::results {

/// Reads a volScalarField (values of cells) or a pointScalarField (values of points), as text, also
/// compressed
/// (.gz). Cells of any shape are divided into tetrahedra that their centres span with the triangles of their
/// faces, in which values are linear; a point has the mean of the cells around it by their volumes. For sums
/// each cell keeps its own value and volume. The unit follows from the field's dimensions.
/// @param time    the folder of a time, "case/0.5", with the field as a file in it
/// @param length  metres per unit of the mesh's coordinates
/// Throws InputError: with the user's place where the folder, its mesh or the field is missing, with file and
/// line where a file is damaged, binary, or of another kind.
ReadField read_openfoam(const std::filesystem::path& time, const std::string& field, double length,
                        const SourceLocation& where);

}  // namespace solidus::results
