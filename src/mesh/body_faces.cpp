/// Faces are collected by their sorted vertices over the elements of all bodies; those that lie on the
/// border of two processes are counted on one of them.
#include "mesh/body_faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

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

std::vector<ElementRange> ranges_of(const Mesh& mesh) {
  constexpr Index k_elements = 512;
  std::vector<ElementRange> ranges;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const std::ptrdiff_t n_nodes = node_count(block.shape);
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
void each_face(const Mesh& mesh, const ElementRange& range, Visit&& visit) {
  const ElementBlock& block = mesh.blocks[as_size(range.block)];
  const auto n_vertices = as_size(vertex_count(face_shape(block.shape)));
  for (Index e = range.first; e < range.last; ++e)
    for (int f = 0; f < face_count(block.shape); ++f) {
      const std::span<const int> local = face_nodes(block.shape, f).first(n_vertices);
      const auto number = [&](int vertex) { return mesh.global_node[as_size(block.element(e)[vertex])]; };
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
FacesOfNodes faces_of_nodes(const Mesh& mesh, std::span<const ElementRange> ranges, Index first, Index last) {
  // Ranges of elements whose nodes lie wholly outside of the part are passed over.
  const auto each = [&](const auto& visit) {
    for (const ElementRange& range : ranges) {
      if (range.highest < first || range.lowest >= last) continue;
      each_face(mesh, range, [&](const FacePlace& place, Index lowest) {
        if (lowest >= first && lowest < last) visit(place, as_size(lowest - first));
      });
    }
  };
  // Two passes, one that counts and one that fills, so that the table needs no list for each node.
  FacesOfNodes faces;
  faces.start.assign(as_size(last - first) + 1, 0);
  each([&](const FacePlace&, std::size_t slot) { ++faces.start[slot + 1]; });
  std::partial_sum(faces.start.begin(), faces.start.end(), faces.start.begin());
  faces.places.resize(faces.start.back());
  std::vector<std::size_t> next(faces.start.begin(), faces.start.end() - 1);
  each([&](const FacePlace& place, std::size_t slot) { faces.places[next[slot]++] = place; });
  return faces;
}

BodyFace face_at(const Mesh& mesh, const FacePlace& place) {
  const ElementBlock& block = mesh.blocks[as_size(place.block)];
  const std::span<const int> local = face_nodes(block.shape, place.face);
  BodyFace face;
  face.body = block.body;
  face.n_vertices = vertex_count(face_shape(block.shape));
  face.n_nodes = static_cast<int>(local.size());
  for (std::size_t i = 0; i < local.size(); ++i) face.nodes[i] = block.element(place.element)[local[i]];
  face.key = body_face_key(mesh, face.vertices());
  return face;
}

bool before(const BodyFace& a, const BodyFace& b) {
  return std::tie(a.key, a.body) < std::tie(b.key, b.body);
}

/// Visits faces by their lowest vertex, of the local nodes before `n_lowest`, as each_body_face().
///
/// The vertices are taken in portions, each of which holds its faces, 275 bytes a node of tetrahedra.
/// Elements are in the order of their lowest numbers, and those of a portion are found among their ranges.
template <class Visit>
void visit_faces(const Mesh& mesh, Index n_lowest, const Visit& visit) {
  constexpr Index k_portion = 32'768;
  const std::vector<ElementRange> ranges = ranges_of(mesh);
  std::vector<BodyFace> of_node;
  for (Index first = 0; first < n_lowest; first += k_portion) {
    const Index last = std::min(n_lowest, first + k_portion);
    const FacesOfNodes faces = faces_of_nodes(mesh, ranges, first, last);
    for (std::size_t n = 0; n + 1 < faces.start.size(); ++n) {
      of_node.clear();
      for (std::size_t k = faces.start[n]; k < faces.start[n + 1]; ++k)
        of_node.push_back(face_at(mesh, faces.places[k]));
      std::sort(of_node.begin(), of_node.end(), before);
      for (std::size_t i = 0, end = 0; i < of_node.size(); i = end) {
        while (end < of_node.size() && of_node[end].key == of_node[i].key) ++end;
        const std::span<const BodyFace> same = std::span(of_node).subspan(i, end - i);
        for (const BodyFace& face : same)
          if (std::ranges::count(same, face.body, &BodyFace::body) == 1) visit(face, same);
      }
    }
  }
}

}  // namespace

std::array<GlobalIndex, 4> body_face_key(const Mesh& mesh, std::span<const Index> vertices) {
  std::array<GlobalIndex, 4> key{-1, -1, -1, -1};
  for (std::size_t i = 0; i < vertices.size(); ++i) key[i] = mesh.global_node[as_size(vertices[i])];
  std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(vertices.size()));
  return key;
}

std::set<std::array<GlobalIndex, 4>> body_face_keys(const Mesh& mesh, const std::set<std::string>& surfaces) {
  std::set<std::array<GlobalIndex, 4>> keys;
  for (const std::string& name : surfaces) {
    const auto surface = mesh.surfaces.find(name);
    if (surface == mesh.surfaces.end()) continue;
    for (const ElementBlock& faces : surface->second.faces)
      for (Index f = 0; f < faces.size(); ++f)
        keys.insert(body_face_key(mesh, std::span(faces.element(f), as_size(vertex_count(faces.shape)))));
  }
  return keys;
}

void each_body_face(const Mesh& mesh,
                    const std::function<void(const BodyFace& face, std::span<const BodyFace> same)>& visit) {
  visit_faces(mesh, mesh.n_owned_nodes, visit);
}

// All elements at an owned node are held here, so a face that has one is whole whichever vertex is its
// lowest.
void each_body_face_at_owned(
    const Mesh& mesh,
    const std::function<void(const BodyFace& face, std::span<const BodyFace> same)>& visit) {
  visit_faces(mesh, mesh.n_nodes(), [&](const BodyFace& face, std::span<const BodyFace> same) {
    const auto owned = [&](Index node) { return node < mesh.n_owned_nodes; };
    if (std::ranges::any_of(face.vertices(), owned)) visit(face, same);
  });
}

}  // namespace solidus::mesh
