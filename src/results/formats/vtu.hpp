/// Fields on the mesh as VTK XML files (.vtu: one process's part, .pvtu: the list of parts), for
/// ParaView 5.11 and the plots. Appended raw data, zlib blocks, UInt64 headers (VTK file formats, "XML file
/// formats").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "results/fields/field.hpp"

namespace solidus::results {

/// Writes the elements this process counts, with the nodes they touch. Values stay in SI, units go into VTK's
/// UNITS_LABEL. Vectors of two components are written with a third that is zero. Besides the fields: point
/// data `node` and cell data `element` (numbers of the input), `body` (index into Mesh::bodies), `process`,
/// and where bodies have left `vtkGhostType`, which hides their cells.
/// Not collective. Throws OutputError, NotFiniteError (nothing is written then).
void write_vtu(const std::filesystem::path& path, const mesh::Mesh& mesh, const FieldSet& fields,
               double time);

/// The same for the faces of a surface this process counts. Only fields at nodes are written.
void write_surface_vtu(const std::filesystem::path& path, const mesh::Mesh& mesh,
                       const mesh::Surface& surface, const FieldSet& fields, double time);

/// Writes the list of the parts of all processes; `parts` relative to the folder of `path`.
/// @param surface  the parts come from write_surface_vtu
void write_pvtu(const std::filesystem::path& path, const std::vector<std::string>& parts,
                const FieldSet& fields, bool surface);

}  // namespace solidus::results
