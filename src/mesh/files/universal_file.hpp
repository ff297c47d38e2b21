/// Meshes in universal files of I-DEAS (.unv), which Salome, FreeCAD, Code_Aster and Gmsh write.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads nodes (datasets 15, 781, 2411), elements (780, 2412) and permanent groups (2429, 2430, 2432, 2435,
/// 2452, 2467, 2477). A group of elements is a body, a surface or lines, by its elements of the highest
/// dimension; a group of nodes is points. Elements of no group are group_3d_N or group_2d_N by their
/// property N. Datasets of results and names say nothing of a mesh; others are named in the notes, as is a
/// unit of length in dataset 164 that is not `unit_in_metres`: programs write it whatever their lengths are.
/// Throws InputError with file and line, also for nodes in a coordinate system that is not the global one.
RawMesh read_universal_file(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
