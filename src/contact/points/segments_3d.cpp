/// Faces of the slave and of the master are projected onto a plane, clipped with each other as polygons,
/// and what they have in common is integrated by triangles.
#include <algorithm>
#include <array>
#include <cmath>

#include "contact/points/point_list.hpp"
#include "contact/surfaces/face_cells.hpp"
#include "contact/surfaces/polygon.hpp"
#include "mesh/quadrature.hpp"

namespace solidus::contact {

namespace {

// Pieces smaller than this part of the slave face hold nothing but rounding.
constexpr double k_least_piece = 1e-13;

// The distance by which a point of a piece may lie outside its face, in reference coordinates: rounding where
// edges are straight; the sagitta between a curved edge and the two chords that stand for it elsewhere.
double edge_tolerance(const Face& face) {
  return face.straight_edges() ? 1e-6 : 0.05;
}

// The plane through the centre of the slave face along whose normal both sides are projected.
struct Plane {
  Point origin, normal, e1, e2;
  explicit Plane(const Face& face) {
    const Point centre = reference_centre(face.shape);
    origin = face.at(centre);
    normal = face.normal(centre);
    tangent_basis(normal, e1, e2);
  }
  PlanePoint operator()(const Point& x) const {
    const Point r = subtract(x, origin);
    return {dot(r, e1), dot(r, e2)};
  }
  Point operator()(const PlanePoint& p) const { return add_scaled(add_scaled(origin, p[0], e1), p[1], e2); }
};

// The reference cells whose straight-sided images stand for the face: the face itself when its edges are
// straight and no cells are asked for, else four cells that follow the middles of its edges.
std::vector<std::vector<Point>> cells(const Face& face, bool asked) {
  const auto v = reference_vertices(face.shape);
  if (!asked && face.straight_edges()) return {{v.begin(), v.end()}};
  return face_cells(face.shape);
}

// The images of a face's cells in the plane, anticlockwise. Cells seen edge-on or folded are left out.
std::vector<Polygon> images(const Face& face, const Plane& plane, bool in_cells) {
  std::vector<Polygon> result;
  for (const auto& cell : cells(face, in_cells)) {
    Polygon image;
    for (const Point& xi : cell) image.push_back(plane(face.at(xi)));
    const double area = signed_area(image);
    if (std::abs(area) < 1e-12 * face.measure()) continue;
    if (area < 0) std::reverse(image.begin(), image.end());
    result.push_back(std::move(image));
  }
  return result;
}

bool facing(const Face& face, const Point& n) {
  return dot(face.normal(reference_centre(face.shape)), n) < k_facing_cosine;
}

// ratio of the slave's area to that of its image in the plane, times the area of a piece of the image
double area_ratio(const Face& slave, const Point& xi, const Plane& plane) {
  return 1 / std::max(std::abs(dot(slave.normal(xi), plane.normal)), 1e-3);
}

class Cutter {
 public:
  Cutter(const Face& slave, const FaceSearch& master, const CutOptions& options,
         std::vector<PairedPoint>& points)
      : slave_(slave),
        master_(master),
        options_(options),
        plane_(slave),
        points_(points),
        slave_images_(images(slave, plane_, options.cells)),
        size_(slave.size()) {}

  void cut_with(Index m, const std::vector<Index>& candidates) {
    const Face& partner = master_.face(m);
    if (!facing(partner, plane_.normal)) return;
    const int degree = options_.degree > 0 ? options_.degree : std::min(product_degree(slave_, partner), 20);
    const auto rule = mesh::gauss_rule(mesh::Shape::tri3, degree);
    // Both faces as polygons in one plane; where they overlap and no other face is nearer, the piece is
    // integrated by triangles.
    for (const Polygon& window : slave_images_)
      for (const Polygon& image : images(partner, plane_, false)) {
        const Polygon piece = clip(image, window, 1e-12 * size_);
        if (piece.empty() || signed_area(piece) < k_least_piece * size_ * size_) continue;
        if (!nearest_here(m, centroid(piece), candidates)) continue;
        for (std::size_t i = 1; i + 1 < piece.size(); ++i)
          integrate_triangle(m, {piece[0], piece[i], piece[i + 1]}, rule);
      }
  }

 private:
  // Another layer of the master may lie between: the nearest one takes the piece.
  bool nearest_here(Index m, const PlanePoint& p, const std::vector<Index>& candidates) const {
    const Point above = plane_(p);
    const Projection on_slave = project_along(slave_, above, plane_.normal, edge_tolerance(slave_));
    if (!on_slave.found) return false;
    const Face& partner = master_.face(m);
    const Projection own = project_along(partner, on_slave.y, plane_.normal, edge_tolerance(partner));
    if (!own.found || std::abs(own.distance) > options_.search_distance) return false;
    const SurfacePoint nearest =
        master_.along(on_slave.y, plane_.normal, options_.search_distance, 1e-9, candidates);
    return nearest.face < 0 || nearest.face == m ||
           std::abs(own.distance) <= std::abs(nearest.projection.distance) + 1e-9 * size_;
  }

  void integrate_triangle(Index m, const std::array<PlanePoint, 3>& corner, const mesh::Rule& rule) {
    const double twice_area = 2 * signed_area({corner.begin(), corner.end()});
    if (twice_area <= 0) return;
    for (const auto& q : rule) {
      PlanePoint p;
      for (std::size_t i = 0; i < 2; ++i)
        p[i] =
            corner[0][i] + q.xi[0] * (corner[1][i] - corner[0][i]) + q.xi[1] * (corner[2][i] - corner[0][i]);
      const Projection s = project_along(slave_, plane_(p), plane_.normal, edge_tolerance(slave_));
      if (!s.found) continue;
      // Along the slave's own normal, which on a curved face is not that of the plane; near the end of the
      // master the two may disagree about the face.
      const Face& partner = master_.face(m);
      Projection y = project_along(partner, s.y, slave_.normal(s.xi), edge_tolerance(partner));
      if (!y.found) y = project_along(partner, s.y, plane_.normal, edge_tolerance(partner));
      if (!y.found) continue;
      points_.push_back({m, s.xi, y.xi, q.weight * twice_area * area_ratio(slave_, s.xi, plane_)});
    }
  }

  const Face& slave_;
  const FaceSearch& master_;
  CutOptions options_;
  Plane plane_;
  std::vector<PairedPoint>& points_;
  std::vector<Polygon> slave_images_;
  double size_;
};

}  // namespace

void cut_face(const Face& slave, const FaceSearch& master, const std::vector<Index>& candidates,
              const CutOptions& options, std::vector<PairedPoint>& points) {
  Cutter cutter(slave, master, options, points);
  for (Index m : candidates) cutter.cut_with(m, candidates);
}

}  // namespace solidus::contact
