/// Meshes in MED files (.med, .rmed), which Salome, Code_Aster and FreeCAD write: HDF5 files that the MED
/// library of EDF and CEA reads.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads the unstructured meshes of a file, at their first computation step. Groups are those of the families
/// of elements and nodes; of groups of one name and several dimensions those of the lower ones get "_2d",
/// "_1d" or "_0d" behind. Elements of full dimension in no group are a body with the name of their mesh,
/// faces in no group MESH_2d. Where the file holds several meshes and a name is that of groups of more than
/// one, the name of the mesh and a dot are before it. A unit of length that the file names and that is not
/// `unit_in_metres` is told in the notes.
/// Throws InputError for structured meshes, other than Cartesian coordinates, cells that are none of
/// mesh/files/med_cells.hpp, versions before 3, a file that is damaged or takes data from other files, and in
/// a build without the MED library.
RawMesh read_med_file(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
