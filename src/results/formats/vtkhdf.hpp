/// The fields of a run in one file of VTKHDF (HDF5), for ParaView 5.12, VTK 9.3 and whatever reads HDF5.
#pragma once

#include <cstddef>
#include <filesystem>

namespace solidus::results {

struct VtkHdfReport {
  std::size_t times = 0, points = 0, cells = 0, fields = 0;
};

/// Gathers the moments that the collection of a run lists: an unstructured grid with steps (VTK file formats,
/// "VTKHDF", version 2.0). The mesh, with numbers of nodes, elements, bodies and processes, is in the file
/// once; fields of points and cells, and `vtkGhostType` of bodies that have left, once a moment. The parts of
/// several processes become one. Values are those of the files, compressed without loss, units are written as
/// the attribute UNITS_LABEL.
/// @param collection  fields.pvd
/// One process. Throws InputError where a file is missing or damaged or has another mesh than the first,
/// OutputError where the new one cannot be written; then there is none.
VtkHdfReport write_vtkhdf(const std::filesystem::path& collection, const std::filesystem::path& file);

}  // namespace solidus::results
