#include "check/boundary_faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace solidus::model {

namespace {

/// The place of a face in the mesh.
struct FacePlace {
  Index element = 0;
  int block = 0, face = 0;
};

/// Calls visit(place, lowest) for every face; `lowest` is the vertex whose number over all processes is the
/// lowest.
template <class Visit>
void each_face(const mesh::Mesh& mesh, Visit&& visit) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const auto n_vertices = static_cast<std::size_t>(mesh::vertex_count(mesh::face_shape(block.shape)));
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < mesh::face_count(block.shape); ++f) {
        const std::span<const int> local = mesh::face_nodes(block.shape, f).first(n_vertices);
        const auto number = [&](int vertex) {
          return mesh.global_node[static_cast<std::size_t>(block.element(e)[vertex])];
        };
        visit(FacePlace{e, static_cast<int>(b), f}, block.element(e)[std::ranges::min(local, {}, number)]);
      }
  }
}

/// Faces sorted by their lowest vertex, of the vertices from `first` to before `last`. Where these are owned
/// here, all elements that have the face are held here.
struct FacesOfNodes {
  std::vector<std::size_t> start;  ///< of each vertex in `places`; one more at the end
  std::vector<FacePlace> places;
};

FacesOfNodes faces_of_nodes(const mesh::Mesh& mesh, Index first, Index last) {
  const auto slot = [&](Index node) { return static_cast<std::size_t>(node - first); };
  const auto among = [&](Index node) { return node >= first && node < last; };
  FacesOfNodes faces;
  faces.start.assign(slot(last) + 1, 0);
  each_face(mesh, [&](const FacePlace&, Index lowest) {
    if (among(lowest)) ++faces.start[slot(lowest) + 1];
  });
  std::partial_sum(faces.start.begin(), faces.start.end(), faces.start.begin());
  faces.places.resize(faces.start.back());
  std::vector<std::size_t> next(faces.start.begin(), faces.start.end() - 1);
  each_face(mesh, [&](const FacePlace& place, Index lowest) {
    if (among(lowest)) faces.places[next[slot(lowest)]++] = place;
  });
  return faces;
}

BoundaryFace face_at(const mesh::Mesh& mesh, const FacePlace& place) {
  const mesh::ElementBlock& block = mesh.blocks[static_cast<std::size_t>(place.block)];
  const std::span<const int> local = mesh::face_nodes(block.shape, place.face);
  BoundaryFace face;
  face.body = block.body;
  face.n_vertices = mesh::vertex_count(mesh::face_shape(block.shape));
  for (std::size_t i = 0; i < static_cast<std::size_t>(face.n_vertices); ++i)
    face.nodes[i] = block.element(place.element)[local[i]];
  face.key = face_key(mesh, face.vertices());
  return face;
}

bool before(const BoundaryFace& a, const BoundaryFace& b) {
  return std::tie(a.key, a.body) < std::tie(b.key, b.body);
}

}  // namespace

std::array<GlobalIndex, 4> face_key(const mesh::Mesh& mesh, std::span<const Index> vertices) {
  std::array<GlobalIndex, 4> key{-1, -1, -1, -1};
  for (std::size_t i = 0; i < vertices.size(); ++i)
    key[i] = mesh.global_node[static_cast<std::size_t>(vertices[i])];
  std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(vertices.size()));
  return key;
}

// The vertices are taken in few portions: each costs a pass through the mesh and holds its faces.
void each_boundary_face(
    const mesh::Mesh& mesh,
    const std::function<void(const BoundaryFace& face, std::span<const BoundaryFace> same)>& visit) {
  constexpr Index k_portion = 4'000'000;
  std::vector<BoundaryFace> of_node;
  for (Index first = 0; first < mesh.n_owned_nodes; first += k_portion) {
    const Index last = std::min(mesh.n_owned_nodes, first + k_portion);
    const FacesOfNodes faces = faces_of_nodes(mesh, first, last);
    for (std::size_t n = 0; n + 1 < faces.start.size(); ++n) {
      of_node.clear();
      for (std::size_t k = faces.start[n]; k < faces.start[n + 1]; ++k)
        of_node.push_back(face_at(mesh, faces.places[k]));
      std::sort(of_node.begin(), of_node.end(), before);
      for (std::size_t i = 0, end = 0; i < of_node.size(); i = end) {
        while (end < of_node.size() && of_node[end].key == of_node[i].key) ++end;
        const std::span<const BoundaryFace> same = std::span(of_node).subspan(i, end - i);
        for (const BoundaryFace& face : same)
          if (std::ranges::count(same, face.body, &BoundaryFace::body) == 1) visit(face, same);
      }
    }
  }
}

}  // namespace solidus::model
