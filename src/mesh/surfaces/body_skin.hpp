/// The skin of a body of a mesh, and whether other bodies lie inside of it.
#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "mesh/surfaces/face_walk.hpp"

namespace solidus::mesh {

/// The faces of the elements of a body that no other element of it has, in the order of its elements.
std::vector<Face> outer_faces(const RawMesh& mesh, const std::string& body);

/// A face of an element that no other element of its body has.
struct OuterFace {
  Shape shape = Shape::point1;
  std::vector<Index> nodes;  ///< outward
};

/// The skin of a body, in the order of its elements.
std::vector<OuterFace> faces_on_skin(const RawMesh& mesh, const std::string& body);

/// The share of the elements of a body, of some of them, whose middle lies inside of a skin.
double share_inside(const RawMesh& mesh, const std::string& body, const std::vector<OuterFace>& skin);

}  // namespace solidus::mesh
