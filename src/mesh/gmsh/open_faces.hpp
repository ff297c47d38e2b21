/// Looks for the open curves that keep the faces of a geometry from closing to a solid. In the reader's
/// process, while Gmsh has the geometry open.
#pragma once

#include <string>

namespace solidus::mesh {

/// Describes the faces of a geometry without solids and the curves that bound only one of them: "12 faces in
/// 2 pieces; 7 curves bound one face only, the longest of 24 mm around (10, 0, 5) mm".
/// @param unit  of the file [m]
std::string open_faces_text(double unit);

}  // namespace solidus::mesh
