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

/// Elements that are looked at or passed over together, and the numbers of their vertices, from the least to
/// the greatest [local node].
struct ElementRange {
  int block = 0;
  Index first = 0, last = 0;
  Index lowest = 0, highest = 0;
};

std::vector<ElementRange> ranges_of(const mesh::Mesh& mesh) {
  constexpr Index k_elements = 512;
  std::vector<ElementRange> ranges;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const std::ptrdiff_t n_nodes = mesh::node_count(block.shape);
    for (Index first = 0; first < block.size(); first += k_elements) {
      const Index last = std::min(block.size(), first + k_elements);
      const auto [lowest, highest] =
          std::minmax_element(block.element(first), block.element(first) + (last - first) * n_nodes);
      ranges.push_back({static_cast<int>(b), first, last, *lowest, *highest});
    }
  }
  return ranges;
}

/// Calls visit(place, lowest) for every face of a range; `lowest` is the vertex whose number over all
/// processes is the lowest.
template <class Visit>
void each_face(const mesh::Mesh& mesh, const ElementRange& range, Visit&& visit) {
  const mesh::ElementBlock& block = mesh.blocks[static_cast<std::size_t>(range.block)];
  const auto n_vertices = static_cast<std::size_t>(mesh::vertex_count(mesh::face_shape(block.shape)));
  for (Index e = range.first; e < range.last; ++e)
    for (int f = 0; f < mesh::face_count(block.shape); ++f) {
      const std::span<const int> local = mesh::face_nodes(block.shape, f).first(n_vertices);
      const auto number = [&](int vertex) {
        return mesh.global_node[static_cast<std::size_t>(block.element(e)[vertex])];
      };
      visit(FacePlace{e, range.block, f}, block.element(e)[std::ranges::min(local, {}, number)]);
    }
}

/// Faces sorted by their lowest vertex, of the vertices from `first` to before `last`. Where these are owned
/// here, all elements that have the face are held here.
struct FacesOfNodes {
  std::vector<std::size_t> start;  ///< of each vertex in `places`; one more at the end
  std::vector<FacePlace> places;
};

/// @param ranges  of the whole mesh
FacesOfNodes faces_of_nodes(const mesh::Mesh& mesh, std::span<const ElementRange> ranges, Index first,
                            Index last) {
  const auto each = [&](const auto& visit) {
    for (const ElementRange& range : ranges) {
      if (range.highest < first || range.lowest >= last) continue;
      each_face(mesh, range, [&](const FacePlace& place, Index lowest) {
        if (lowest >= first && lowest < last) visit(place, static_cast<std::size_t>(lowest - first));
      });
    }
  };
  FacesOfNodes faces;
  faces.start.assign(static_cast<std::size_t>(last - first) + 1, 0);
  each([&](const FacePlace&, std::size_t slot) { ++faces.start[slot + 1]; });
  std::partial_sum(faces.start.begin(), faces.start.end(), faces.start.begin());
  faces.places.resize(faces.start.back());
  std::vector<std::size_t> next(faces.start.begin(), faces.start.end() - 1);
  each([&](const FacePlace& place, std::size_t slot) { faces.places[next[slot]++] = place; });
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

std::set<std::array<GlobalIndex, 4>> face_keys(const mesh::Mesh& mesh,
                                               const std::set<std::string>& surfaces) {
  std::set<std::array<GlobalIndex, 4>> keys;
  for (const std::string& name : surfaces) {
    const auto surface = mesh.surfaces.find(name);
    if (surface == mesh.surfaces.end()) continue;
    for (const mesh::ElementBlock& faces : surface->second.faces)
      for (Index f = 0; f < faces.size(); ++f)
        keys.insert(face_key(
            mesh, std::span(faces.element(f), static_cast<std::size_t>(mesh::vertex_count(faces.shape)))));
  }
  return keys;
}

// The vertices are taken in portions, each of which holds its faces, 275 bytes a node of tetrahedra. Elements
// stand in the order of their lowest numbers, and those of a portion are found among their ranges.
void each_boundary_face(
    const mesh::Mesh& mesh,
    const std::function<void(const BoundaryFace& face, std::span<const BoundaryFace> same)>& visit) {
  constexpr Index k_portion = 32'768;
  const std::vector<ElementRange> ranges = ranges_of(mesh);
  std::vector<BoundaryFace> of_node;
  for (Index first = 0; first < mesh.n_owned_nodes; first += k_portion) {
    const Index last = std::min(mesh.n_owned_nodes, first + k_portion);
    const FacesOfNodes faces = faces_of_nodes(mesh, ranges, first, last);
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
