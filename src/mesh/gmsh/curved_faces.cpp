/// How far a face bulges over its triangles is measured at the middles of edges; vertices are then moved
/// outward by the mean, and taken back where an element would become thin.
#include "mesh/gmsh/curved_faces.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_hardly = 0.3;         ///< sine of the angle below which faces continue one another
constexpr double k_hardly_plane = 1e-4;  ///< the same of plane faces: of one plane
constexpr double k_most_bulge = 0.3;     ///< distance off an edge over its length; more is of another face
constexpr double k_least_volume = 0.8;   ///< share of its volume that an element keeps
constexpr int k_rounds = 10;             ///< of halving displacements

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
void add(Point& p, double factor, const Point& q) {
  for (std::size_t i = 0; i < 3; ++i) p[i] += factor * q[i];
}

/// Removes the parts of a vector along orthonormal directions; returns the length that is left.
double leave(const std::vector<Point>& directions, Point& p) {
  for (const Point& d : directions) add(p, -dot(p, d), d);
  return std::sqrt(dot(p, p));
}

/// Nodes of the triangles of a face of the geometry, three each.
std::vector<Index> triangles_of(int face, const std::unordered_map<std::size_t, Index>& index) {
  constexpr int k_triangle = 2;  // Gmsh's number of the shape
  std::vector<std::size_t> elements, tags;
  gmsh::model::mesh::getElementsByType(k_triangle, elements, tags, face);
  std::vector<Index> nodes;
  for (const std::size_t tag : tags) nodes.push_back(index.at(tag));
  return nodes;
}

/// Vectors from the middles of the edges of triangles to the nearest points of their curved face [m], by the
/// edges' nodes, the lesser one first.
using Bulges = std::map<std::pair<Index, Index>, Point>;

Bulges bulges(int face, const std::vector<Index>& triangles, double unit, const RawMesh& mesh) {
  Bulges bulge;
  // Each edge once, although two triangles share it.
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    for (std::size_t a = 0; a < 3; ++a) bulge[std::minmax(triangles[t + a], triangles[t + (a + 1) % 3])];
  std::vector<double> middles, nearest, parametric;
  for (const auto& [edge, unused] : bulge)
    for (std::size_t i = 0; i < 3; ++i)
      middles.push_back(0.5 * (mesh.x[as_size(edge.first)][i] + mesh.x[as_size(edge.second)][i]) / unit);
  // Gmsh projects all middles at once.
  try {
    gmsh::model::getClosestPoint(2, face, middles, nearest, parametric);
  } catch (const std::string&) {  // a kind of face on which Gmsh finds no nearest points: it stays as it is
    nearest = middles;
  }
  std::size_t m = 0;
  for (auto& [edge, vector] : bulge) {
    for (std::size_t i = 0; i < 3; ++i, ++m) vector[i] = unit * (nearest[m] - middles[m]);
    const Point along = minus(mesh.x[as_size(edge.second)], mesh.x[as_size(edge.first)]);
    // A projection far away is one onto another part of the face.
    if (!(dot(vector, vector) <= k_most_bulge * k_most_bulge * dot(along, along))) vector = {};
  }
  return bulge;
}

/// Notes normal and offset of one face of the geometry at each of its vertices.
void look_at_face(int face, bool is_plane, double unit, const RawMesh& mesh,
                  const std::unordered_map<std::size_t, Index>& index,
                  std::unordered_map<Index, std::vector<FaceAtVertex>>& faces) {
  const std::vector<Index> triangles = triangles_of(face, index);
  const Bulges bulge = is_plane ? Bulges{} : bulges(face, triangles, unit, mesh);
  std::map<Index, std::pair<Point, double>> sums;  // of area × normal, and of area × offset
  // Sums at the vertices by area, over the triangles of this face.
  std::map<Index, double> areas;
  // Normals by area, and how far the face bulges over its triangles: the mean over their edges.
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const Index* node = triangles.data() + t;
    const Point& x = mesh.x[as_size(node[0])];
    Point normal = cross(minus(mesh.x[as_size(node[1])], x), minus(mesh.x[as_size(node[2])], x));
    const double area = std::sqrt(dot(normal, normal));
    if (!(area > 0)) continue;
    for (double& c : normal) c /= area;
    double offset = 0;
    for (std::size_t a = 0; !is_plane && a < 3; ++a)
      offset += dot(bulge.at(std::minmax(node[a], node[(a + 1) % 3])), normal) / 3;
    for (std::size_t a = 0; a < 3; ++a) {
      auto& [sum, offsets] = sums[node[a]];
      add(sum, area, normal);
      offsets += area * offset;
      areas[node[a]] += area;
    }
  }
  // At each vertex the mean normal and offset of this face.
  for (auto& [node, sum] : sums) {
    Point normal = sum.first;
    const double length = std::sqrt(dot(normal, normal));
    if (!(length > 0)) continue;
    for (double& c : normal) c /= length;
    faces[node].push_back({normal, sum.second / areas.at(node), 0.5 * areas.at(node), is_plane});
  }
}

/// Adds a face to those that it continues, or to the list.
void merge(const FaceAtVertex& face, std::vector<FaceAtVertex>& faces) {
  for (FaceAtVertex& other : faces) {
    const double cosine = dot(face.normal, other.normal);
    if (1 - cosine * cosine > k_hardly * k_hardly) continue;
    const double sign = cosine < 0 ? -1 : 1, area = face.area + other.area;
    for (std::size_t i = 0; i < 3; ++i)
      other.normal[i] = (other.area * other.normal[i] + sign * face.area * face.normal[i]) / area;
    const double length = std::sqrt(dot(other.normal, other.normal));
    for (double& c : other.normal) c /= length;
    other.offset = (other.area * other.offset + sign * face.area * face.offset) / area;
    other.area = area;
    return;
  }
  faces.push_back(face);
}

double volume(const std::vector<Point>& x, const Index* tet) {
  const Point& o = x[as_size(tet[0])];
  return dot(cross(minus(x[as_size(tet[1])], o), minus(x[as_size(tet[2])], o)), minus(x[as_size(tet[3])], o));
}

/// The vertices at one place, of bodies that touch and have nodes of their own. They move together: otherwise
/// the rim of one body would lie next to that of the other, and contact would find no partner there.
struct Place {
  Point displacement{};
  std::vector<Index> nodes;
};

/// Gathers the vertices that have a displacement by their places, each with the mean of theirs.
std::vector<Place> gather(const std::map<Index, Point>& displacement, const RawMesh& mesh) {
  constexpr double k_same = 1e-8;  // [m]
  std::map<std::array<long long, 3>, Place> places;
  for (const auto& [node, u] : displacement) {
    std::array<long long, 3> key{};
    for (std::size_t i = 0; i < 3; ++i) key[i] = std::llround(mesh.x[as_size(node)][i] / k_same);
    Place& place = places[key];
    add(place.displacement, 1, u);
    place.nodes.push_back(node);
  }
  std::vector<Place> all;
  for (auto& [key, place] : places) {
    for (double& c : place.displacement) c /= static_cast<double>(place.nodes.size());
    all.push_back(std::move(place));
  }
  return all;
}

/// Moves the vertices, by half as much around elements that become too thin, and so on.
void move(std::vector<Place> places, RawMesh& mesh) {
  const std::vector<Point> before = mesh.x;
  // Each round moves all vertices from their old places by what is left of their displacement.
  for (int round = 0; round <= k_rounds; ++round) {
    for (const Place& place : places)
      for (const Index node : place.nodes) {
        mesh.x[as_size(node)] = before[as_size(node)];
        add(mesh.x[as_size(node)], 1, place.displacement);
      }
    // Tetrahedra that have lost too much of their volume take their vertices back half way.
    std::vector<char> thin(mesh.x.size(), 0);
    bool any = false;
    for (const auto& [name, group] : mesh.groups)
      for (const RawBlock& block : group.blocks)
        for (std::size_t e = 0; block.shape == Shape::tet4 && e < block.nodes.size(); e += 4) {
          const Index* tet = block.nodes.data() + e;
          const double was = volume(before, tet), is = volume(mesh.x, tet);
          if (is / was >= k_least_volume) continue;
          any = true;
          for (std::size_t a = 0; a < 4; ++a) thin[as_size(tet[a])] = 1;
        }
    if (!any) return;
    for (Place& place : places)
      if (std::any_of(place.nodes.begin(), place.nodes.end(),
                      [&](Index node) { return thin[as_size(node)] != 0; }))
        for (double& c : place.displacement) c *= round + 1 < k_rounds ? 0.5 : 0;
  }
}

}  // namespace

Point vertex_displacement(std::span<const FaceAtVertex> faces) {
  // Planes hold the vertex in their normal; it may move only in what they leave free.
  std::vector<FaceAtVertex> curved;
  std::vector<Point> done;  // orthonormal directions in which the vertex must not, or need not, move further
  // Curved faces that continue one another are merged first, for together they ask for one
  // displacement.
  for (const FaceAtVertex& face : faces) {
    Point n = face.normal;
    if (!face.is_plane) {
      merge(face, curved);
    } else if (const double length = leave(done, n); length > k_hardly_plane) {
      for (double& c : n) c /= length;
      done.push_back(n);
    }
  }
  // The offset of each curved face in its normal, made orthogonal to what is done already.
  Point u{};
  for (const FaceAtVertex& face : curved) {
    Point n = face.normal;
    const double length = leave(done, n);
    if (length < k_hardly) continue;
    for (double& c : n) c /= length;
    add(u, (face.offset - dot(u, face.normal)) / length, n);
    done.push_back(n);
  }
  return u;
}

void enclose_curved_volume(const std::unordered_map<std::size_t, Index>& index, double unit, RawMesh& mesh) {
  // All faces of the geometry that Gmsh has, with what they ask of their vertices.
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 2);
  std::unordered_map<Index, std::vector<FaceAtVertex>> faces;
  bool any = false;
  // The offsets of curved faces at the vertices that enclose their volume.
  for (const auto& [dimension, face] : entities) {
    std::string type;
    gmsh::model::getType(dimension, face, type);
    if (type == "Discrete surface") continue;
    any = any || type != "Plane";
    look_at_face(face, type == "Plane", unit, mesh, index, faces);
  }
  // A geometry of planes needs nothing.
  if (!any) return;
  // Displacements are found for all vertices before any is moved, since offsets are those of the
  // mesh as it is.
  std::map<Index, Point> displacement;
  for (const auto& [node, list] : faces) {
    const Point u = vertex_displacement(list);
    if (dot(u, u) > 0) displacement.emplace(node, u);
  }
  move(gather(displacement, mesh), mesh);
}

}  // namespace solidus::mesh
