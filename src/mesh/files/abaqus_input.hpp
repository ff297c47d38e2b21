/// Meshes in Abaqus/CalculiX input files (.inp), which Gmsh writes but does not read.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads *NODE and *ELEMENT, also with INPUT=, in the systems of *SYSTEM and SYSTEM=, what *NGEN, *NFILL,
/// *NCOPY, *ELGEN and *ELCOPY make of them (mesh/files/abaqus_generation.hpp), *NSET, *ELSET and *SURFACE,
/// *INCLUDE, and parts with their instances in an assembly, moved and turned. Keywords of materials, steps,
/// loads and output say nothing of a mesh; any other one is named in the notes of the mesh, and one that
/// would change nodes or elements is refused.
///
/// Groups: element sets, the elements' own first (bodies, or surfaces where they hold shells, lines or
/// faces), node sets as points, and surfaces as the faces they name. Sets that a program has made for its
/// own use (INTERNAL) are none. A set of an instance has the name of the instance before it where another
/// has one of the same name. Element types by shape, whatever the formulation: C3D4(T), C3D10…, C3D8…,
/// C3D20…, CPE3/CPS3/CAX3/S3/DC2D3/…, CPE4…, CPE6…, CPE8…, and trusses or beams as lines. Throws InputError
/// with file and line.
RawMesh read_abaqus_input(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
