/// Clipping by Sutherland and Hodgman (1974); area and centroid by the shoelace formula.
#include "contact/surfaces/polygon.hpp"

#include <cmath>
#include <cstddef>

namespace solidus::contact {

double signed_area(const Polygon& polygon) {
  // Relative to the first vertex, so that a polygon far from the origin loses no digits.
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double ax = polygon[i][0] - polygon[0][0], ay = polygon[i][1] - polygon[0][1];
    const double bx = polygon[i + 1][0] - polygon[0][0], by = polygon[i + 1][1] - polygon[0][1];
    sum += 0.5 * (ax * by - ay * bx);
  }
  return sum;
}

PlanePoint centroid(const Polygon& polygon) {
  PlanePoint sum{};
  for (const PlanePoint& p : polygon) {
    sum[0] += p[0];
    sum[1] += p[1];
  }
  const auto n = static_cast<double>(polygon.size());
  return {sum[0] / n, sum[1] / n};
}

Polygon clip(const Polygon& subject, const Polygon& window, double tolerance) {
  // The window's edges cut one after the other: what is left of the polygon goes to the next edge.
  Polygon current = subject, next;
  for (std::size_t e = 0; e < window.size() && !current.empty(); ++e) {
    const PlanePoint& a = window[e];
    const PlanePoint& b = window[(e + 1) % window.size()];
    const double ex = b[0] - a[0], ey = b[1] - a[1], length = std::hypot(ex, ey);
    // Signed distance to the edge, positive inside.
    const auto height = [&](const PlanePoint& p) {
      const double h = (ex * (p[1] - a[1]) - ey * (p[0] - a[0])) / length;
      return std::abs(h) <= tolerance ? 0.0 : h;
    };
    next.clear();
    // Corners inside stay, and every side that crosses the edge adds the point where it does.
    for (std::size_t i = 0; i < current.size(); ++i) {
      const PlanePoint& p = current[i];
      const PlanePoint& q = current[(i + 1) % current.size()];
      const double hp = height(p), hq = height(q);
      if (hp >= 0) next.push_back(p);
      if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) {
        const double s = hp / (hp - hq);
        next.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
      }
    }
    current.swap(next);
  }
  // Fewer than three corners have no area.
  return current.size() < 3 ? Polygon{} : current;
}

}  // namespace solidus::contact
