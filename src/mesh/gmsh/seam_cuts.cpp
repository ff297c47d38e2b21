/// A body with a closed face is cut by a square through its seam, which leaves two faces that are not
/// closed.
#include "mesh/gmsh/seam_cuts.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

struct Plane {
  Point through, normal;  ///< a unit normal
};

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double length(const Point& v) {
  return std::hypot(v[0], v[1], v[2]);
}

/// The curve at which a face meets itself: it bounds the face twice. None where the face does not close.
std::optional<int> seam_of(int face) {
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, face}}, curves, false, true, false);
  std::map<int, int> times;
  for (const auto& [dimension, tag] : curves)
    if (++times[std::abs(tag)] == 2) return std::abs(tag);
  return {};
}

/// The plane through the centre of the box around a face and two places of its seam, those that are farthest
/// from one line with the centre: the ends of the seam of a cylinder, an end and the middle of that of a
/// sphere. None where all places are on one line with it.
std::optional<Plane> seam_plane(int face, int seam) {
  const Extent box = extent_of({{2, face}});
  Point centre{};
  for (std::size_t i = 0; i < 3; ++i) centre[i] = (box.low[i] + box.high[i]) / 2;
  std::vector<double> low, high, x;
  gmsh::model::getParametrizationBounds(1, seam, low, high);
  constexpr int k_places = 5;
  std::vector<double> parameters;
  for (int k = 0; k < k_places; ++k) parameters.push_back(low[0] + (high[0] - low[0]) * k / (k_places - 1));
  gmsh::model::getValue(1, seam, parameters, x);
  std::vector<Point> arms;
  for (std::size_t k = 0; k + 2 < x.size(); k += 3) arms.push_back(minus({x[k], x[k + 1], x[k + 2]}, centre));
  Point normal{};
  for (std::size_t i = 0; i < arms.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const Point n = cross(arms[i], arms[j]); length(n) > length(normal)) normal = n;
  const double size = length(normal);
  constexpr double k_flat = 1e-6;  // of the square of the extent
  if (size < k_flat * box.diagonal() * box.diagonal()) return {};
  for (double& c : normal) c /= size;
  return Plane{centre, normal};
}

/// Adds a square in the plane, of this half width around its point.
int add_square(const Plane& plane, double half) {
  // Two axes in the plane, from the coordinate axis that is least along its normal.
  const auto smallest = std::min_element(plane.normal.begin(), plane.normal.end(),
                                         [](double a, double b) { return std::abs(a) < std::abs(b); });
  Point axis{};
  axis[as_size(smallest - plane.normal.begin())] = 1;
  Point u = cross(plane.normal, axis);
  const double size = length(u);
  for (double& c : u) c /= size;
  const Point v = cross(plane.normal, u);
  // Four corners around the point, in order, and the sides between them.
  std::vector<int> corners, sides;
  constexpr std::array<std::array<double, 2>, 4> k_corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [a, b] : k_corners) {
    Point p = plane.through;
    for (std::size_t i = 0; i < 3; ++i) p[i] += half * (a * u[i] + b * v[i]);
    corners.push_back(occ::addPoint(p[0], p[1], p[2]));
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    sides.push_back(occ::addLine(corners[k], corners[(k + 1) % corners.size()]));
  return occ::addPlaneSurface({occ::addCurveLoop(sides)});
}

/// Faces that bound no volume are what is left of the square beyond the bodies.
void remove_loose_faces() {
  std::set<int> bounds;
  for (const auto& volume : all_volumes())
    for (const int face : boundary_of(volume.second)) bounds.insert(face);
  gmsh::vectorpair faces, loose;
  occ::getEntities(faces, 2);
  for (const auto& face : faces)
    if (!bounds.contains(face.second)) loose.push_back(face);
  occ::remove(loose, true);
  occ::synchronize();
}

void cut(std::vector<BodyVolumes>& parts, const Plane& plane) {
  // All volumes of all parts at once, so that they stay joined along the cut.
  gmsh::vectorpair volumes, out;
  for (const BodyVolumes& part : parts)
    volumes.insert(volumes.end(), part.volumes.begin(), part.volumes.end());
  // A square larger than all bodies cuts them; pieces come back in the order of the volumes.
  const int square = add_square(plane, 2 * extent_of(volumes).diagonal());
  std::vector<gmsh::vectorpair> pieces;
  occ::fragment(volumes, {{2, square}}, out, pieces);
  occ::synchronize();
  std::size_t next = 0;
  for (BodyVolumes& part : parts) {
    const std::size_t n = part.volumes.size();
    part.volumes.clear();
    for (std::size_t k = 0; k < n; ++k, ++next)
      std::copy_if(pieces[next].begin(), pieces[next].end(), std::back_inserter(part.volumes),
                   [](const auto& piece) { return piece.first == 3; });
  }
  remove_loose_faces();
}

}  // namespace

bool cut_along_seams(std::vector<BodyVolumes>& parts, const std::set<int>& faces) {
  std::vector<Plane> planes;  // numbers of faces do not outlast the first cut
  for (const int face : faces)
    if (const std::optional<int> seam = seam_of(face))
      if (const std::optional<Plane> plane = seam_plane(face, *seam)) planes.push_back(*plane);
  for (const Plane& plane : planes) cut(parts, plane);
  return !planes.empty();
}

}  // namespace solidus::mesh
