/// Neighbouring faces that bend by less than the angle are joined by disjoint sets.
#include "mesh/surfaces/smooth_parts.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "mesh/surfaces/faces.hpp"

namespace solidus::mesh {

namespace {

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The number of the drawn face that each face is a facet of; −1: none.
std::vector<int> numbers_of(const std::vector<const SkinFace*>& faces, const std::vector<DrawnFace>& drawn) {
  std::unordered_map<FaceKey, int, FaceKeyHash> number;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    for (const std::array<Index, 4>& facet : drawn[i].facets)
      number.emplace(FaceKey{facet}, static_cast<int>(i));
  std::vector<int> numbers(faces.size(), -1);
  if (number.empty()) return numbers;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto found =
        number.find(face_key(faces[f]->nodes.data(), static_cast<int>(faces[f]->corners.size())));
    if (found != number.end()) numbers[f] = found->second;
  }
  return numbers;
}

}  // namespace

SmoothParts smooth_parts(const std::vector<const SkinFace*>& faces, double angle,
                         const std::vector<DrawnFace>& drawn) {
  // Faces are united across edges that bend by less than the angle, or that lie within one face of the
  // drawing. A set is known by its root, which path halving keeps near.
  const std::vector<int> of_geometry = numbers_of(faces, drawn);
  std::vector<std::size_t> root(faces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  // Edges of the plane are nodes, those of space pairs of nodes.
  std::map<std::pair<Index, Index>, std::vector<std::size_t>> edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t n = faces[f]->corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = faces[f]->nodes[i], b = n == 2 ? a : faces[f]->nodes[(i + 1) % n];
      edges[{std::min(a, b), std::max(a, b)}].push_back(f);
    }
  }
  for (const auto& [edge, around] : edges)
    for (std::size_t i = 1; i < around.size(); ++i)
      if (dot(faces[around[0]]->normal, faces[around[i]]->normal) >= std::cos(angle) ||
          (of_geometry[around[0]] >= 0 && of_geometry[around[0]] == of_geometry[around[i]]))
        root[find(around[i])] = find(around[0]);
  // Sets that meet at an edge without being one are neighbours.
  SmoothParts parts;
  for (std::size_t f = 0; f < faces.size(); ++f) parts.of_face.push_back(find(f));
  for (const auto& [edge, around] : edges)
    for (const std::size_t a : around)
      for (const std::size_t b : around)
        if (parts.of_face[a] != parts.of_face[b]) parts.meet.insert({parts.of_face[a], parts.of_face[b]});
  return parts;
}

}  // namespace solidus::mesh
