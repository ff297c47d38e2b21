/// From starts inside of a body a place climbs to where it is farthest from the skin: that distance is the
/// radius of the sphere.
#include "mesh/making/hot_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "mesh/making/size_field.hpp"
#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The skin of several bodies without the faces that two of them share.
std::vector<SkinFace> common_skin(const RawMesh& mesh, const std::vector<std::string>& bodies) {
  std::map<std::array<Index, 4>, int> count;
  std::vector<SkinFace> all;
  for (const std::string& body : bodies)
    for (SkinFace& face : skin_of(mesh, body)) {
      ++count[face_key(face.nodes.data(), static_cast<int>(face.corners.size())).vertices];
      all.push_back(std::move(face));
    }
  std::erase_if(all, [&](const SkinFace& face) {
    return count.at(face_key(face.nodes.data(), static_cast<int>(face.corners.size())).vertices) > 1;
  });
  return all;
}

double depth(const std::vector<SkinFace>& skin, const std::vector<double>& reach, const Point& p) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < skin.size(); ++f)
    if (distance(skin[f].centre, p) - reach[f] < least)
      least = std::min(least, distance(nearest_on_face(skin[f], p), p));
  return least;
}

/// Uphill from a point that lies inside, in steps along the axes that become smaller; the depth grows with
/// each, so that no step can leave the body. On a plane no step goes along its normal.
InscribedSphere climb(const std::vector<SkinFace>& skin, const std::vector<double>& reach, Point p, double r,
                      const std::optional<HalfSpace>& on) {
  // Steps are halved when no direction leads higher, down to a fiftieth of the first depth.
  for (double step = r / 2; step > 0.02 * r; step /= 2) {
    bool higher = true;
    for (int pass = 0; higher && pass < 20; ++pass) {
      higher = false;
      for (std::size_t i = 0; i < 3; ++i)
        for (const double sign : {-1.0, 1.0}) {
          if (on && as_size(on->axis) == i) continue;
          Point next = p;
          next[i] += sign * std::min(step, r / 2);
          if (const double there = depth(skin, reach, next); there > r * (1 + 1e-9)) {
            r = there;
            p = next;
            higher = true;
          }
        }
    }
  }
  return {p, r};
}

/// The mean of an element's vertices, and of a plane the mean of the points in which it cuts the lines
/// between them, which lies in the element too; none where it cuts none.
std::optional<Point> point_inside(const std::vector<Point>& vertices, const std::optional<HalfSpace>& on) {
  Point mean{};
  double n = 0;
  const auto add = [&](const Point& p) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += p[i];
    ++n;
  };
  // Without a plane all vertices count alike; with one the points where lines between vertices
  // cross it.
  for (const Point& a : vertices) {
    if (!on) {
      add(a);
      continue;
    }
    const auto axis = as_size(on->axis);
    for (const Point& b : vertices) {
      if (!(a[axis] <= on->at && b[axis] > on->at)) continue;
      const double share = (on->at - a[axis]) / (b[axis] - a[axis]);
      add({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])});
    }
  }
  if (n == 0) return {};
  for (double& c : mean) c /= n;
  if (on) mean[as_size(on->axis)] = on->at;
  return mean;
}

std::array<Point, 3> outward(const SkinFace& face, std::size_t second) {
  const std::vector<Point>& x = face.corners;
  std::array<Point, 3> t = {x[0], x[second], x[second + 1]};
  Point u{}, v{};
  for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i];
  const Point n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  if (n[0] * face.normal[0] + n[1] * face.normal[1] + n[2] * face.normal[2] < 0) std::swap(t[1], t[2]);
  return t;
}

std::vector<std::array<Point, 3>> triangles(const std::vector<SkinFace>& skin) {
  std::vector<std::array<Point, 3>> all;
  for (const SkinFace& face : skin)
    for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) all.push_back(outward(face, k));
  return all;
}

}  // namespace

std::vector<InscribedSphere> inscribed_spheres(const RawMesh& mesh, const std::vector<std::string>& bodies,
                                               std::size_t most, std::optional<HalfSpace> on) {
  // Hot spots are the largest spheres that fit into the bodies. Depth is the distance to the nearest face of
  // the skin, which the reach of each face bounds from below.
  const std::vector<SkinFace> skin = common_skin(mesh, bodies);
  std::vector<double> reach;
  for (const SkinFace& face : skin) {
    double far = 0;
    for (const Point& corner : face.corners) far = std::max(far, distance(corner, face.centre));
    reach.push_back(far);
  }
  // Seeds are points within elements: all of them on a section, every so many of a large body.
  std::vector<InscribedSphere> seeds;
  for (const std::string& body : bodies)
    for (const RawBlock& block : mesh.groups.at(body).blocks) {
      const auto nn = as_size(node_count(block.shape));
      const int vertices = vertex_count(block.shape);
      constexpr std::size_t k_seeds = 1500;
      const std::size_t stride = nn * (on ? 1 : 1 + block.nodes.size() / nn / k_seeds);
      std::vector<Point> x(as_size(vertices));
      for (std::size_t e = 0; e < block.nodes.size(); e += stride) {
        for (std::size_t a = 0; a < x.size(); ++a) x[a] = mesh.x[as_size(block.nodes[e + a])];
        if (const std::optional<Point> centre = point_inside(x, on))
          seeds.push_back({*centre, depth(skin, reach, *centre)});
      }
    }
  // From the deepest seeds on, a sphere is grown by climbing to the local maximum of the depth. Seeds that a
  // sphere already covers would climb to the same place.
  std::sort(seeds.begin(), seeds.end(), [](const auto& a, const auto& b) { return a.radius > b.radius; });
  std::vector<InscribedSphere> found;
  constexpr std::size_t k_climbs = 40;
  std::size_t climbs = 0;
  for (const InscribedSphere& seed : seeds) {
    if (climbs == k_climbs) break;
    const auto covers = [&](const InscribedSphere& s) { return distance(s.centre, seed.centre) < s.radius; };
    if (std::any_of(found.begin(), found.end(), covers)) continue;
    ++climbs;
    const InscribedSphere top = climb(skin, reach, seed.centre, seed.radius, on);
    const auto inside = [&](const InscribedSphere& s) { return distance(s.centre, top.centre) < s.radius; };
    if (std::none_of(found.begin(), found.end(), inside)) found.push_back(top);
  }
  // The largest ones are kept, and none that is less than half as large as the first.
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.radius > b.radius; });
  if (found.size() > most) found.resize(most);
  std::erase_if(found, [&](const InscribedSphere& s) { return s.radius < 0.5 * found.front().radius; });
  return found;
}

std::vector<double> thickness_by_area(const RawMesh& mesh, const std::string& body) {
  const std::vector<SkinFace> skin = skin_of(mesh, body);
  const std::vector<std::array<Point, 3>> all = triangles(skin);
  const std::vector<double> thickness = wall_thickness(all);
  std::vector<std::pair<double, double>> weighted;
  // The thickness of each triangle with its area; then the values at equal steps of area, from thin to thick.
  double sum = 0;
  // Triangles without an opposite wall have no thickness.
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (!(thickness[t] > 0)) continue;
    Point u{}, v{};
    for (std::size_t i = 0; i < 3; ++i)
      u[i] = all[t][1][i] - all[t][0][i], v[i] = all[t][2][i] - all[t][0][i];
    const double area =
        0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    weighted.emplace_back(thickness[t], area);
    sum += area;
  }
  std::sort(weighted.begin(), weighted.end());
  std::vector<double> list;
  constexpr int k_parts = 100;
  double passed = 0;
  for (const auto& [value, area] : weighted) {
    passed += area;
    while (static_cast<int>(list.size()) < k_parts &&
           passed >= sum * (static_cast<double>(list.size()) + 0.5) / k_parts)
      list.push_back(value);
  }
  return list;
}

BodyExtent extent_of(const RawMesh& mesh, const std::string& body) {
  // The box begins inverted, so that the first point sets both ends.
  BodyExtent extent;
  extent.low.fill(std::numeric_limits<double>::max());
  extent.high.fill(std::numeric_limits<double>::lowest());
  // The divergence theorem on the skin's triangles.
  const std::vector<SkinFace> skin = skin_of(mesh, body);
  for (const SkinFace& face : skin) extent.area += face.area;
  for (const auto& t : triangles(skin)) {
    const double six = t[0][0] * (t[1][1] * t[2][2] - t[1][2] * t[2][1]) -
                       t[0][1] * (t[1][0] * t[2][2] - t[1][2] * t[2][0]) +
                       t[0][2] * (t[1][0] * t[2][1] - t[1][1] * t[2][0]);
    extent.volume += six / 6;
    for (std::size_t i = 0; i < 3; ++i) {
      extent.centre[i] += six / 24 * (t[0][i] + t[1][i] + t[2][i]);
      for (const Point& p : t)
        extent.low[i] = std::min(extent.low[i], p[i]), extent.high[i] = std::max(extent.high[i], p[i]);
    }
  }
  // The centre is the first moment over the volume.
  for (double& c : extent.centre) c /= extent.volume;
  return extent;
}

ViewFromAbove::ViewFromAbove(const RawMesh& mesh, const std::vector<std::string>& bodies)
    : faces_(triangles(common_skin(mesh, bodies))) {}

std::vector<double> ViewFromAbove::crossings(const Point& point) const {
  std::vector<double> heights;
  for (const auto& t : faces_) {
    const double x0 = t[0][0] - point[0], y0 = t[0][1] - point[1], x1 = t[1][0] - point[0],
                 y1 = t[1][1] - point[1], x2 = t[2][0] - point[0], y2 = t[2][1] - point[1];
    const double a = x1 * y2 - x2 * y1, b = x2 * y0 - x0 * y2, c = x0 * y1 - x1 * y0, sum = a + b + c;
    if (sum == 0 || a / sum < 0 || b / sum < 0 || c / sum < 0) continue;
    heights.push_back((a * t[0][2] + b * t[1][2] + c * t[2][2]) / sum);
  }
  return heights;
}

double ViewFromAbove::top(const Point& point) const {
  double top = point[2];
  for (const double z : crossings(point)) top = std::max(top, z);
  return top;
}

double ViewFromAbove::first_exit(const Point& point) const {
  double first = std::numeric_limits<double>::max();
  for (const double z : crossings(point))
    if (z > point[2]) first = std::min(first, z);
  return std::min(first, top(point));
}

}  // namespace solidus::mesh
