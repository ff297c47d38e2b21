/// Flat faces in a grid of cells, so that the nearest one to a place is found among few.
#include "mesh/surfaces/skin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/surfaces/body_skin.hpp"
#include "mesh/surfaces/face_walk.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) {
  return std::sqrt(dot(a, a));
}
Point along(const Point& a, const Point& direction, double s) {
  return {a[0] + s * direction[0], a[1] + s * direction[1], a[2] + s * direction[2]};
}

/// The foot of the perpendicular from p, or the end that is nearer.
Point nearest_on_segment(const Point& a, const Point& b, const Point& p) {
  const Point d = b - a;
  const double square = dot(d, d);
  return along(a, d, square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0);
}

// Regions of the triangle's plane: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
Point nearest_on_triangle(const Point& a, const Point& b, const Point& c, const Point& p) {
  const Point ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  // Each test finds the region of a corner or of an edge; a point that is in none of them lies above the
  // triangle.
  if (d1 <= 0 && d2 <= 0) return a;
  const Point bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, ab, d1 / (d1 - d3));
  const Point cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, ac, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, c - b, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return along(along(a, ab, vb / sum), ac, vc / sum);
}

/// Sets centre, area and unit normal of a face from its corners; a line has its length as area.
void measure(SkinFace& face) {
  const std::vector<Point>& x = face.corners;
  face.centre = {};
  for (const Point& p : x)
    for (std::size_t i = 0; i < 3; ++i) face.centre[i] += p[i] / static_cast<double>(x.size());
  // The normal of a line lies to its right; a quadrilateral has the mean of its two triangles.
  Point n{};
  if (x.size() == 2) {
    const Point d = x[1] - x[0];
    n = {d[1], -d[0], 0};
  } else {
    n = cross(x[1] - x[0], x[2] - x[0]);
    if (x.size() == 4) {
      const Point more = cross(x[2] - x[0], x[3] - x[0]);
      for (std::size_t i = 0; i < 3; ++i) n[i] += more[i];
    }
    for (double& c : n) c *= 0.5;
  }
  face.area = length(n);
  if (face.area > 0)
    for (double& c : n) c /= face.area;
  face.normal = n;
}

}  // namespace

SkinFace face_through(std::vector<Point> corners) {
  SkinFace face;
  face.corners = std::move(corners);
  measure(face);
  return face;
}

std::vector<SkinFace> skin_of(const RawMesh& mesh, const std::string& body) {
  std::vector<SkinFace> skin;
  for (const Face& outer : outer_faces(mesh, body)) {
    SkinFace face;
    face.shape = outer.shape;
    face.nodes = outer.nodes();
    for (int i = 0; i < vertex_count(face.shape); ++i)
      face.corners.push_back(point_of(mesh, face.nodes[as_size(i)]));
    measure(face);
    // Elements may be mirrored before validate_and_orient(): outward is away from the element's centre.
    const auto n_vertices = as_size(vertex_count(outer.element_shape));
    const Point inside = middle_of(mesh, outer.element.first(n_vertices));
    if (dot(face.normal, face.centre - inside) < 0)
      for (double& c : face.normal) c = -c;
    skin.push_back(std::move(face));
  }
  return skin;
}

Point nearest_on_face(const SkinFace& face, const Point& p) {
  const std::vector<Point>& x = face.corners;
  if (x.size() == 2) return nearest_on_segment(x[0], x[1], p);
  const Point first = nearest_on_triangle(x[0], x[1], x[2], p);
  if (x.size() == 3) return first;
  // A quadrilateral is taken as two triangles.
  const Point second = nearest_on_triangle(x[0], x[2], x[3], p);
  return length(first - p) <= length(second - p) ? first : second;
}

double mean_edge(const std::vector<SkinFace>& faces) {
  double sum = 0;
  std::size_t n = 0;
  for (const SkinFace& face : faces) {
    const std::size_t corners = face.corners.size(), edges = corners == 2 ? 1 : corners;
    for (std::size_t i = 0; i < edges; ++i, ++n)
      sum += length(face.corners[i] - face.corners[(i + 1) % corners]);
  }
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

SkinSearch::SkinSearch(const std::vector<SkinFace>& faces, double reach)
    : faces_(faces), reach_(reach), size_(std::max(2 * reach, mean_edge(faces))) {
  // A face is entered in each cell that it can be reached from, so that a search needs one cell only.
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Point low = faces[f].corners[0], high = low;
    for (const Point& p : faces[f].corners)
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    for (std::size_t i = 0; i < 3; ++i) low[i] -= reach, high[i] += reach;
    const Cell from = cell(low), to = cell(high);
    for (long i = from[0]; i <= to[0]; ++i)
      for (long j = from[1]; j <= to[1]; ++j)
        for (long k = from[2]; k <= to[2]; ++k) cells_[{i, j, k}].push_back(f);
  }
}

SkinSearch::Cell SkinSearch::cell(const Point& p) const {
  return {std::lround(std::floor(p[0] / size_)), std::lround(std::floor(p[1] / size_)),
          std::lround(std::floor(p[2] / size_))};
}

std::optional<SkinSearch::Found> SkinSearch::facing(const Point& point, const Point& normal,
                                                    double opposed) const {
  const auto here = cells_.find(cell(point));
  if (here == cells_.end()) return {};
  std::optional<Found> best;
  for (const std::size_t f : here->second) {
    const SkinFace& face = faces_[f];
    if (dot(face.normal, normal) > -opposed) continue;
    const double distance = length(nearest_on_face(face, point) - point);
    if (distance <= reach_ && (!best || distance < best->distance)) best = Found{f, distance};
  }
  return best;
}

std::optional<SkinSearch::Found> SkinSearch::nearest(const Point& point) const {
  const auto here = cells_.find(cell(point));
  if (here == cells_.end()) return {};
  std::optional<Found> best;
  for (const std::size_t f : here->second) {
    const double distance = length(nearest_on_face(faces_[f], point) - point);
    if (distance <= reach_ && (!best || distance < best->distance)) best = Found{f, distance};
  }
  return best;
}

/// Points of a face at which its gap is measured: away from its corners, which it shares with neighbours.
std::vector<Point> sample_points(const SkinFace& face) {
  const std::vector<Point>& x = face.corners;
  const auto towards = [&](const Point& corner, double share) {
    return along(face.centre, corner - face.centre, share);
  };
  std::vector<Point> points;
  if (x.size() == 2) return {towards(x[0], 2.0 / 3), face.centre, towards(x[1], 2.0 / 3)};
  if (x.size() == 3) points.push_back(face.centre);
  for (const Point& corner : x) points.push_back(towards(corner, 0.5));
  return points;
}

double area_of(const RawMesh& mesh, const std::string& surface) {
  double area = 0;
  const auto group = mesh.groups.find(surface);
  if (group == mesh.groups.end() || group->second.dimension != mesh.dimension - 1) return area;
  for (const RawBlock& block : group->second.blocks) {
    const auto nn = as_size(node_count(block.shape)), corners = as_size(vertex_count(block.shape));
    for (std::size_t f = 0; f < block.nodes.size(); f += nn) {
      SkinFace face;
      for (std::size_t i = 0; i < corners; ++i) face.corners.push_back(mesh.x[as_size(block.nodes[f + i])]);
      measure(face);
      area += face.area;
    }
  }
  return area;
}

void add_surface(RawMesh& mesh, const std::string& name, const std::vector<const SkinFace*>& faces,
                 const std::string& source) {
  if (mesh.groups.contains(name))
    throw InputError({source}, "the mesh has a group '" + name + "' already, where one is to be made",
                     "another name of the body or of that group");
  RawGroup group{mesh.dimension - 1, {}};
  // One block for each shape of faces; faces have no number of their own in the input.
  for (const SkinFace* face : faces) {
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == face->shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{face->shape, {}, {}});
    block->nodes.insert(block->nodes.end(), face->nodes.begin(), face->nodes.end());
    block->input_element.push_back(0);
  }
  mesh.groups.emplace(name, std::move(group));
}

}  // namespace solidus::mesh
