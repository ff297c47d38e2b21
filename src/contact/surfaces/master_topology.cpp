/// Neighbours are found through vertices: faces at each vertex, then faces around each face, faces at each
/// edge, and the free boundary where an edge has one face alone.
#include "contact/surfaces/master_topology.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr double k_on_rim = 1e-12;  ///< in reference coordinates

// Distance of ξ from edge `e`, in reference coordinates.
double off_edge(mesh::Shape shape, const Point& xi, std::size_t e) {
  const auto v = reference_vertices(shape);
  const Point& a = v[e];
  const Point d = subtract(v[(e + 1) % v.size()], a), r = subtract(xi, a);
  return std::abs(d[0] * r[1] - d[1] * r[0]) / norm(d);
}

void append_sorted(std::vector<Index>& data, std::vector<Index>& row) {
  std::sort(row.begin(), row.end());
  row.erase(std::unique(row.begin(), row.end()), row.end());
  data.insert(data.end(), row.begin(), row.end());
}

}  // namespace

Point edge_direction(mesh::Shape shape, int e) {
  const auto v = reference_vertices(shape);
  const auto i = as_size(e);
  return subtract(v[(i + 1) % v.size()], v[i]);
}

int MasterTopology::n_edges(Index face) const {
  const mesh::Shape shape = surface_.shape(face);
  return mesh::dimension(shape) == 1 ? 0 : mesh::vertex_count(shape);
}

Index MasterTopology::vertex(Index face, int local) const {
  return surface_.nodes(face)[as_size(local)];
}

int MasterTopology::local_vertex(Index face, Index node) const {
  for (int v = 0; v < mesh::vertex_count(surface_.shape(face)); ++v)
    if (vertex(face, v) == node) return v;
  return -1;
}

MasterTopology::MasterTopology(const ContactSurface& surface) : surface_(surface) {
  // Neighbourhoods are found by vertices: a table of the faces at each vertex comes first.
  const Index n = surface.n_faces();
  const std::vector<Index>& nodes = surface.all_nodes();
  const auto row_of = [&](Index node) {
    return as_index(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  std::vector<std::vector<Index>> at_node(nodes.size());
  vertex_row_.assign(as_size(n) * 4, -1);
  for (Index f = 0; f < n; ++f)
    for (int v = 0; v < mesh::vertex_count(surface.shape(f)); ++v) {
      const Index row = row_of(vertex(f, v));
      vertex_row_[slot(f, v)] = row;
      at_node[as_size(row)].push_back(f);
    }
  first_at_vertex_.push_back(0);
  for (const auto& faces : at_node) {
    at_vertex_.insert(at_vertex_.end(), faces.begin(), faces.end());
    first_at_vertex_.push_back(at_vertex_.size());
  }
  // From it follow, for every face, the faces around it (with a common vertex) and those at each of its edges
  // (with both ends in common).
  free_vertex_.assign(nodes.size(), 0);
  first_around_.push_back(0);
  first_at_edge_.push_back(0);
  std::vector<Index> ring, both;
  for (Index f = 0; f < n; ++f) {
    const int vertices = mesh::vertex_count(surface.shape(f));
    ring.assign(1, f);
    for (int v = 0; v < vertices; ++v) {
      const auto faces = row(at_vertex_, first_at_vertex_, vertex_row_[slot(f, v)]);
      ring.insert(ring.end(), faces.begin(), faces.end());
      // A vertex at the end of a line, or an edge with one face alone, lies at the rim of the surface.
      if (mesh::dimension(surface.shape(f)) == 1 && faces.size() == 1)
        free_vertex_[as_size(vertex_row_[slot(f, v)])] = 1;
    }
    append_sorted(around_, ring);
    first_around_.push_back(around_.size());
    for (int e = 0; e < 4; ++e) {
      both.clear();
      if (e < n_edges(f)) {
        const Index end = vertex(f, (e + 1) % vertices);
        for (Index other : row(at_vertex_, first_at_vertex_, vertex_row_[slot(f, e)]))
          if (local_vertex(other, end) >= 0) both.push_back(other);
        // Both vertices of a rim edge are free.
        if (both.size() == 1) {
          free_vertex_[as_size(vertex_row_[slot(f, e)])] = 1;
          free_vertex_[as_size(vertex_row_[slot(f, (e + 1) % vertices)])] = 1;
        }
      }
      append_sorted(at_edge_, both);
      first_at_edge_.push_back(at_edge_.size());
    }
  }
}

std::span<const Index> MasterTopology::at_edge(Index face, int e) const {
  return row(at_edge_, first_at_edge_, as_index(slot(face, e)));
}

Feature MasterTopology::feature(Index face, const Point& xi) const {
  const mesh::Shape shape = surface_.shape(face);
  const auto v = reference_vertices(shape);
  // Vertices before edges, since a vertex lies on edges too.
  for (std::size_t a = 0; a < v.size(); ++a)
    if (distance(xi, v[a]) <= k_on_rim) {
      const int local = static_cast<int>(a);
      const Index r = vertex_row_[slot(face, local)];
      return {Feature::Kind::vertex, local, row(at_vertex_, first_at_vertex_, r),
              free_vertex_[as_size(r)] != 0};
    }
  // Not at a vertex: on the one edge that ξ lies on, or inside.
  for (int e = 0; e < n_edges(face); ++e)
    if (off_edge(shape, xi, as_size(e)) <= k_on_rim) {
      const auto faces = at_edge(face, e);
      return {Feature::Kind::edge, e, faces, faces.size() == 1};
    }
  return {};
}

}  // namespace solidus::contact
