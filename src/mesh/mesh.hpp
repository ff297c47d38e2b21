/// The part of a mesh that one process holds.
///
/// A process owns a contiguous range of the global node numbers and holds every element and boundary face
/// that touches an owned node, so that it can fill its own rows without communication. Local nodes: owned
/// ones first (0 … n_owned_nodes − 1), ghosts behind. Nodes and faces of the surfaces named for replication
/// (contact) are held by every process.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/input_numbers.hpp"
#include "mesh/shape.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::mesh {

/// Elements (or boundary faces) of one shape and one body. The first `n_counted` are the ones this process
/// counts in sums: over all processes each element is counted exactly once.
struct ElementBlock {
  Shape shape = Shape::tri3;
  int body = -1;               ///< index into Mesh::bodies; −1 for faces of no body
  std::vector<Index> nodes;    ///< [element][node] local numbers
  InputNumbers input_element;  ///< number in the input file (for messages), same length as elements
  Index n_counted = 0;

  Index size() const { return as_index(nodes.size()) / node_count(shape); }
  const Index* element(Index e) const {
    return nodes.data() + static_cast<std::ptrdiff_t>(e) * node_count(shape);
  }
};

/// A named set of boundary faces, nodes included. In 2-D faces are lines. Faces are oriented outward of the
/// element they bound.
struct Surface {
  std::vector<ElementBlock> faces;  ///< one block per face shape
  std::vector<Index> nodes;         ///< local numbers, sorted, without repetition
  bool replicated = false;          ///< every process holds the whole surface
};

struct Body {
  std::string name;  ///< name of the volume group (area group in 2-D)
};

struct Mesh {
  int dimension = 2;  ///< 2 or 3
  Index n_owned_nodes = 0;
  std::vector<Point> x;      ///< [local node] coordinates [m]
  InputNumbers global_node;  ///< [local node] number over all processes, contiguous per process
  InputNumbers input_node;   ///< [local node] number in the input, the same whatever the number of processes
  GlobalIndex n_global_nodes = 0;
  GlobalIndex first_owned = 0;  ///< global number of local node 0

  std::vector<Body> bodies;
  std::vector<ElementBlock> blocks;         ///< volume elements (areas in 2-D)
  std::map<std::string, Surface> surfaces;  ///< named groups of boundary faces
  std::map<std::string, std::vector<Index>>
      node_sets;  ///< every named group (surfaces, bodies, points) as local nodes

  Index n_nodes() const { return as_index(x.size()); }
};

}  // namespace solidus::mesh
