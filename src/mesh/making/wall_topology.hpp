/// The faces of a body around a wall, for wall_layers.cpp.
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

using Edge = std::pair<Index, Index>;  ///< vertices, the lesser one first

struct EdgeHash {
  std::size_t operator()(const Edge& e) const {
    return as_size(e.first) * 0x9E3779B97F4A7C15ULL ^ as_size(e.second);
  }
};

inline Edge edge_key(Index a, Index b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// A face of the body: its nodes, vertices first, as its element has them (outward).
struct WallFace {
  std::vector<Index> nodes;
  int n_vertices = 0;
  int surface = -1;  ///< index of the surface that it belongs to; -1: none of the wall
};

struct WallTopology {
  std::vector<WallFace> wall;      ///< the faces of the surfaces
  std::vector<WallFace> around;    ///< further boundary faces of the body that touch the wall
  std::vector<char> on_wall;       ///< [node]: a vertex of the wall
  std::vector<WallFace> boundary;  ///< all boundary faces of the body but those of the wall
  std::vector<char> held;          ///< [node]: on a face of `around` beyond which is another body
  FaceOwners faces;                ///< faces of the body that touch the wall
  std::unordered_map<FaceKey, int, FaceKeyHash> wall_faces;  ///< and the index of their surface
  std::unordered_map<Edge, int, EdgeHash> wall_edges;        ///< and how many faces of the wall have it
};

/// Local vertices of the edges of a shape, and its mid node on each (−1 for linear shapes).
struct LocalEdge {
  int a, b, middle;
};
std::vector<LocalEdge> edges_of(Shape shape);

/// The wall is made of all the surfaces; a face that two of them have counts for the first.
/// Throws InputError for a surface that does not bound the body, or lies inside it.
WallTopology find_wall(const RawMesh& mesh, const std::vector<std::string>& surfaces, const std::string& body,
                       const std::string& source);

}  // namespace solidus::mesh
