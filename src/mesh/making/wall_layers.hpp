/// Thin layers of elements on a wall: the mould's side of the face between casting and mould, where the first
/// minutes of heat are thinner than an element. Rank 0 only, as reading a mesh is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

struct WallLayers {
  std::string surface;            ///< whose faces are faces of elements of the body
  std::string body;               ///< in which the layers lie
  int number = 2;                 ///< of layers
  double growth = 2;              ///< each is so many times as thick as the one before it
  std::optional<double> first{};  ///< thickness of the one on the wall [m]; else 0.8 edges for all
};

/// Report on the layers that were made, for the log and for tests.
struct WallLayerReport {
  double first = 0;     ///< thickness of the first layer that was asked for [m]
  double whole = 0;     ///< of all layers that was asked for [m]
  double mean = 0;      ///< of all layers that there is room for, mean over the wall's vertices [m]
  Index n_columns = 0;  ///< vertices of the wall that have layers
  Index n_bare = 0;     ///< vertices that have none: there is no room, or a third body begins
};

/// Moves the wall's vertices into the body, the body's inner nodes with them, and fills the space with layers
/// of elements of the body's shape, simplices or quads and hexahedra, linear or quadratic. Each vertex of the
/// wall costs one node a layer (of linear elements). Where there is no room the layers are thinner, down to
/// none. Faces of the wall keep their nodes, so other bodies, contact and conditions see no difference;
/// surfaces that meet the wall at its rim get the layers' faces. Before validate_and_orient().
/// @param source  for messages: the file or shape of the mesh
/// Throws InputError for a surface that does not bound the body.
WallLayerReport add_wall_layers(RawMesh& mesh, const WallLayers& layers, const std::string& source);

/// The same on several surfaces of one body at once: where two of them meet the layers go on from one to the
/// other, with a thickness between those of both.
/// @param together  layers of one body, equal in number and growth; not empty
/// @return a report for each; vertices that two surfaces share count for both
std::vector<WallLayerReport> add_wall_layers(RawMesh& mesh, const std::vector<WallLayers>& together,
                                             const std::string& source);

}  // namespace solidus::mesh
