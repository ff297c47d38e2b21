/// Search for the element that a boundary face belongs to.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <unordered_map>

#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// The vertices of a face in rising order: the same key whatever its orientation.
struct FaceKey {
  std::array<Index, 4> vertices{-1, -1, -1, -1};
  bool operator==(const FaceKey&) const = default;
};

struct FaceKeyHash {
  std::size_t operator()(const FaceKey& k) const {
    std::size_t h = 0;
    for (const Index v : k.vertices) h = h * 0x9E3779B97F4A7C15ULL + std::hash<Index>{}(v) + (h >> 29);
    return h;
  }
};

inline FaceKey face_key(const Index* nodes, int n_vertices) {
  FaceKey k;
  std::copy_n(nodes, n_vertices, k.vertices.begin());
  std::sort(k.vertices.begin(), k.vertices.end());  // −1 where a face has fewer than four
  return k;
}

/// Owner of a face: body (index in the list given), block, element and its face. Bodies are searched in
/// order, so a face between two bodies that share nodes belongs to the first.
struct FaceOwner {
  int body = -1, block = -1, face = -1;
  Index element = -1;
};
using FaceOwners = std::unordered_map<FaceKey, FaceOwner, FaceKeyHash>;

/// Fills in the owner of every key of `wanted` that is a face of an element of the bodies.
void find_face_owners(const RawMesh& mesh, const std::vector<std::string>& bodies, FaceOwners& wanted);

}  // namespace solidus::mesh
