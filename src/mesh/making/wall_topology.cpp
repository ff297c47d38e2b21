/// Faces of a body become a surface with its edges; faces that other bodies share hold their vertices.
#include "mesh/making/wall_topology.hpp"

#include <algorithm>
#include <unordered_set>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Calls use(block, element, face, nodes of the face) for every face of a group's elements.
template <class Use>
void for_each_face(const RawGroup& group, Use&& use) {
  std::vector<Index> nodes;
  for (int k = 0; k < static_cast<int>(group.blocks.size()); ++k) {
    const RawBlock& block = group.blocks[as_size(k)];
    const auto nn = as_size(node_count(block.shape));
    for (std::size_t e = 0; e * nn < block.nodes.size(); ++e)
      for (int f = 0; f < face_count(block.shape); ++f) {
        nodes.clear();
        for (const int a : face_nodes(block.shape, f)) nodes.push_back(block.nodes[e * nn + as_size(a)]);
        use(k, as_index(e), f, nodes);
      }
  }
}

/// The faces that occur once among the elements of a group.
std::unordered_set<FaceKey, FaceKeyHash> boundary_of(const RawGroup& body) {
  std::unordered_set<FaceKey, FaceKeyHash> alone;
  for_each_face(body, [&](int k, Index, int, const std::vector<Index>& nodes) {
    const Shape shape = body.blocks[as_size(k)].shape;
    const auto [place, first] = alone.insert(face_key(nodes.data(), vertex_count(face_shape(shape))));
    if (!first) alone.erase(place);
  });
  return alone;
}

/// Nodes on faces that elements of another body have too.
void hold_at_other_bodies(const RawMesh& mesh, const std::string& body, const std::string& source,
                          const std::unordered_set<FaceKey, FaceKeyHash>& boundary, WallTopology& wall) {
  for (const auto& entry : mesh.groups) {
    const std::string& name = entry.first;
    const RawGroup& group = entry.second;
    if (name == body || group.dimension != mesh.dimension) continue;
    for_each_face(group, [&](int k, Index, int, const std::vector<Index>& nodes) {
      const int n = vertex_count(face_shape(group.blocks[as_size(k)].shape));
      const FaceKey key = face_key(nodes.data(), n);
      if (!wall.faces.contains(key) || wall.wall_faces.contains(key)) return;
      if (!boundary.contains(key))
        throw InputError({source},
                         "the body '" + name + "' has elements of the body '" + body + "', which gets layers",
                         "groups of bodies that do not overlap");
      for (int a = 0; a < n; ++a) wall.held[as_size(nodes[as_size(a)])] = 1;
    });
  }
}

}  // namespace

std::vector<LocalEdge> edges_of(Shape shape) {
  std::vector<LocalEdge> edges;
  if (dimension(shape) == 1) return {{0, 1, order(shape) == 2 ? 2 : -1}};
  // Each edge once, with the node in its middle where the element is quadratic.
  const auto add = [&](int a, int b, int middle) {
    for (const LocalEdge& e : edges)
      if ((e.a == a && e.b == b) || (e.a == b && e.b == a)) return;
    edges.push_back({a, b, middle});
  };
  // Faces of the shape have all of its edges.
  for (int f = 0; f < face_count(shape); ++f) {
    const auto local = face_nodes(shape, f);
    const auto n = as_size(vertex_count(face_shape(shape)));
    if (n == 2) {
      add(local[0], local[1], order(shape) == 2 ? local[2] : -1);
      continue;
    }
    for (std::size_t e = 0; e < n; ++e)
      add(local[e], local[(e + 1) % n], order(shape) == 2 ? local[n + e] : -1);
  }
  return edges;
}

WallTopology find_wall(const RawMesh& mesh, const std::vector<std::string>& surfaces, const std::string& body,
                       const std::string& source) {
  const RawGroup& elements = mesh.groups.at(body);
  // First the faces and nodes of the named surfaces are marked as wall.
  WallTopology wall;
  wall.on_wall.assign(mesh.x.size(), 0);
  wall.held.assign(mesh.x.size(), 0);
  std::vector<std::size_t> asked(surfaces.size(), 0), found(surfaces.size(), 0);
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (const RawBlock& block : mesh.groups.at(surfaces[s]).blocks) {
      const auto nn = as_size(node_count(block.shape));
      for (std::size_t f = 0; f < block.nodes.size(); f += nn) {
        const FaceKey key = face_key(block.nodes.data() + f, vertex_count(block.shape));
        if (wall.wall_faces.try_emplace(key, static_cast<int>(s)).second) ++asked[s];
        for (int a = 0; a < vertex_count(block.shape); ++a)
          wall.on_wall[as_size(block.nodes[f + as_size(a)])] = 1;
      }
    }
  // Then the faces of the body are gone through: those of the wall, those of the boundary around, and those
  // that only touch it. A wall inside of the body cannot have layers on one side.
  const auto boundary = boundary_of(elements);
  for_each_face(elements, [&](int k, Index e, int f, const std::vector<Index>& nodes) {
    const Shape shape = elements.blocks[as_size(k)].shape;
    const int n = vertex_count(face_shape(shape));
    const FaceKey key = face_key(nodes.data(), n);
    const bool outer = boundary.contains(key);
    bool touches = false;
    for (int a = 0; a < n; ++a) touches = touches || wall.on_wall[as_size(nodes[as_size(a)])] != 0;
    const auto of_wall = wall.wall_faces.find(key);
    const bool is_wall = of_wall != wall.wall_faces.end();
    if (outer && !is_wall) wall.boundary.push_back({nodes, n});
    if (!touches) return;
    wall.faces[key] = {0, k, f, e};
    if (is_wall && !outer)
      throw InputError(
          {source},
          "the surface '" + surfaces[as_size(of_wall->second)] + "' lies inside the body '" + body + "'",
          "a surface that bounds the body");
    if (!outer) return;
    (is_wall ? wall.wall : wall.around).push_back({nodes, n, is_wall ? of_wall->second : -1});
    if (!is_wall) return;
    ++found[as_size(of_wall->second)];
    if (n == 2) return;
    // Edges of wall faces are counted, so that the rim is known: an edge that one wall face alone has.
    for (int a = 0; a < n; ++a) ++wall.wall_edges[edge_key(nodes[as_size(a)], nodes[as_size((a + 1) % n)])];
  });
  // A surface whose faces belong to another body is a mistake of the case, which the message explains.
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (found[s] != asked[s])
      throw InputError({source},
                       std::to_string(asked[s] - found[s]) + " of the " + std::to_string(asked[s]) +
                           " faces of '" + surfaces[s] + "' are not faces of the body '" + body +
                           "', which gets layers there",
                       "the surface on the body's own side");
  // Nodes that other bodies share do not move.
  hold_at_other_bodies(mesh, body, source, boundary, wall);
  return wall;
}

}  // namespace solidus::mesh
