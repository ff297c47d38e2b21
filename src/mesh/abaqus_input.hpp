/// Meshes in Abaqus/CalculiX input files (.inp), which Gmsh writes but does not read.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads *NODE, *ELEMENT, *NSET, *ELSET and *SURFACE (TYPE=ELEMENT) with *INCLUDE, ignoring every other
/// keyword. Groups: element sets, the elements' own first (bodies, or surfaces where they hold shells, lines
/// or faces), node sets as points, and surfaces as the faces they name. Element types by shape, whatever the
/// formulation: C3D4(T), C3D10…, C3D8…, C3D20…, CPE3/CPS3/CAX3/S3/DC2D3/…, CPE4…, CPE6…, CPE8…, and trusses
/// or beams as lines. Throws InputError with file and line.
RawMesh read_abaqus_input(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
