/// Solids of faces that lie next to each other without belonging together, as IGES files and some STEP files
/// have them. In the reader's process, while Gmsh has the geometry open.
#pragma once

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Makes a solid of each closed shell of a geometry that has faces and no solid; does nothing where there are
/// solids. Faces are joined where they meet within 1e-4 of the extent. One shell is sewn and filled. Of
/// several, faces that lie in one place are made one; then faces that hang together by curves between two of
/// them close to shells, where three or more meet at a curve together with faces that two bodies share. A
/// shell inside of a body is a body of its own where the file has its faces twice, else a cavity.
/// Throws UnusableGeometry where the faces do not close.
void close_to_solids(const MeshSource& source);

/// The same for a geometry that need not be solid: one whose faces lie in a plane z = const stays as it is.
void close_to_solids_unless_plane(const MeshSource& source);

}  // namespace solidus::mesh
