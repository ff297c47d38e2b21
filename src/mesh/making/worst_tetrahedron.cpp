/// The worst element is named with its place, and with the angle of the geometry that forces it if there is
/// one.
#include "mesh/making/worst_tetrahedron.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/tetrahedra.hpp"

namespace solidus::mesh {

namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& u, const Point& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
double length(const Point& v) {
  return std::sqrt(dot(v, v));
}

/// The angle of a tetrahedron at its edge (a, b) [degree].
double angle_at(const Tetrahedra& mesh, std::size_t t, Index a, Index b) {
  const auto [p, q] = mesh[t].beside(a, b);
  const Point along = minus(mesh.x(b), mesh.x(a));
  const auto across = [&](Index node) {  // the part that is normal to the edge
    Point v = minus(mesh.x(node), mesh.x(a));
    const double share = dot(v, along) / dot(along, along);
    for (std::size_t i = 0; i < 3; ++i) v[i] -= share * along[i];
    return v;
  };
  const Point u = across(p), v = across(q);
  return std::acos(std::clamp(dot(u, v) / (length(u) * length(v)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// The angle between the faces of a body that meet at the edge (a, b), through the tetrahedron t of the body;
/// 360 where the edge lies within the body [degree].
double angle_of_body(const Tetrahedra& mesh, std::size_t t, Index a, Index b) {
  double sum = 0;
  for (const bool forward : {true, false}) {
    const std::vector<std::size_t> around = around_edge(mesh, a, b);
    std::size_t here = t;
    for (std::size_t step = 0; step < around.size(); ++step) {
      if (here != t || forward) sum += angle_at(mesh, here, a, b);
      const auto [p, q] = mesh[here].beside(a, b);
      const Index beyond = forward ? q : p;
      const auto next = std::find_if(around.begin(), around.end(), [&](std::size_t other) {
        return other != here && mesh[other].has(beyond) && mesh[other].body == mesh[t].body;
      });
      if (next == around.end()) break;
      here = *next;
      if (here == t) return 360;
    }
  }
  return sum;
}

}  // namespace

std::string worst_tetrahedron_text(RawMesh mesh) {
  // The worst tetrahedron is told with its body and place, and with what makes it bad, if that is in the
  // geometry.
  const Tetrahedra tets(mesh);
  if (tets.count() == 0) return "";
  std::size_t worst = 0;
  for (std::size_t t = 0; t < tets.count(); ++t)
    if (quality(tets, t) < quality(tets, worst)) worst = t;
  const auto& nodes = tets[worst].nodes;
  Point centre{};
  for (const Index node : nodes)
    for (std::size_t i = 0; i < 3; ++i) centre[i] += tets.x(node)[i] / 4;
  // The angle of the body at its edges tells a wedge; edges much shorter than those around tell a small
  // feature.
  double sharpest = 360, shortest = 1e300, sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      sharpest = std::min(sharpest, angle_of_body(tets, worst, nodes[i], nodes[j]));
      shortest = std::min(shortest, length(minus(tets.x(nodes[i]), tets.x(nodes[j]))));
    }
    for (const Index other : neighbours(tets, nodes[i]))
      sum += length(minus(tets.x(nodes[i]), tets.x(other))), ++n;
  }
  std::string text = fmt::format("in '{}' around ({:.4g}, {:.4g}, {:.4g}) mm", tets.body_name(worst),
                                 1e3 * centre[0], 1e3 * centre[1], 1e3 * centre[2]);
  constexpr double k_sharp = 25, k_short = 0.25;
  const double mean = sum / static_cast<double>(n);
  if (sharpest < k_sharp)
    text += fmt::format(", where its faces meet at {:.2g} degrees", sharpest);
  else if (shortest < k_short * mean)
    text +=
        fmt::format(", at an edge of {:.2g} mm between elements of {:.2g} mm", 1e3 * shortest, 1e3 * mean);
  return text;
}

}  // namespace solidus::mesh
