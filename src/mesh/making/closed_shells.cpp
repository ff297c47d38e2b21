/// Triangles are joined over their edges to shells; winding numbers tell which shell lies within which, and
/// an edge with one triangle is where a skin is open.
#include "mesh/making/closed_shells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <unordered_map>

#include "mesh/making/casting_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_weld = 1e-6;  ///< of the extent; STL files hold seven digits
constexpr double k_pi = 3.14159265358979323846;

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double extent_of(const std::vector<Facets>& parts) {
  Point low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const Facets& part : parts)
    for (const auto& triangle : part.triangles)
      for (const Point& p : triangle)
        for (std::size_t i = 0; i < 3; ++i)
          low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  const Point d = minus(high, low);
  return low[0] <= high[0] ? std::sqrt(dot(d, d)) : 0.0;
}

/// Gives points that nearly coincide one number.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance) {}

  Index number(const Point& p) {
    // Cells are twice the tolerance wide, so that a point within it lies in this cell or in one next to it.
    Cell here{};
    for (std::size_t i = 0; i < 3; ++i) here[i] = static_cast<long>(std::floor(p[i] / (2 * tolerance_)));
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        for (long dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find({here[0] + dx, here[1] + dy, here[2] + dz});
          if (found == cells_.end()) continue;
          for (const Index i : found->second) {
            const Point d = minus(points_[as_size(i)], p);
            if (dot(d, d) <= tolerance_ * tolerance_) return i;
          }
        }
    // A point that is near none is a new one, in its cell.
    points_.push_back(p);
    const auto mine = as_index(points_.size() - 1);
    cells_[here].push_back(mine);
    return mine;
  }
  std::vector<Point> points() && { return std::move(points_); }

 private:
  using Cell = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      constexpr std::hash<long> bits;  // cells left of or below the origin have negative numbers
      return bits(c[0]) * 73856093U ^ bits(c[1]) * 19349663U ^ bits(c[2]) * 83492791U;
    }
  };
  double tolerance_;
  std::vector<Point> points_;
  std::unordered_map<Cell, std::vector<Index>, Hash> cells_;
};

struct Facet {
  std::array<Index, 3> nodes{};
  std::size_t part = 0;
};

using Edge = std::pair<Index, Index>;

Edge edge_of(const Facet& t, std::size_t k) {
  return std::minmax(t.nodes[k], t.nodes[(k + 1) % 3]);
}

/// Two triangles at every edge.
class Neighbours {
 public:
  Neighbours(const std::vector<Facet>& triangles, const std::vector<Point>& points, const std::string& path)
      : points_(points) {
    // All edges of all triangles; how many meet at each tells whether the skin is closed.
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) of_[edge_of(triangles[t], k)].push_back(t);
    // Edges of one triangle are holes, those of more than two are faces that touch; the first of
    // either is told.
    std::size_t open = 0, crowded = 0;
    const Edge *first_open = nullptr, *first_crowded = nullptr;
    for (const auto& [edge, list] : of_) {
      if (list.size() == 1 && open++ == 0) first_open = &edge;
      if (list.size() > 2 && crowded++ == 0) first_crowded = &edge;
    }
    if (open > 0)
      throw UnusableGeometry({path},
                             "the skin is not closed: " + std::to_string(open) +
                                 " edges belong to one triangle alone, the first near " + place(*first_open),
                             "skins without holes: most CAD programs and mesh tools close them");
    if (crowded > 0)
      throw UnusableGeometry(
          {path},
          std::to_string(crowded) + " edges belong to more than two triangles, the first near " +
              place(*first_crowded) + ": bodies touch there, or a face lies inside of a body",
          "closed skins that neither touch nor cross; a STEP file where bodies touch");
  }
  std::size_t beyond(std::size_t triangle, const Edge& edge) const {
    const std::vector<std::size_t>& two = of_.at(edge);
    return two[0] == triangle ? two[1] : two[0];
  }
  std::string place(const Edge& edge) const {
    const Point &a = points_[as_size(edge.first)], &b = points_[as_size(edge.second)];
    char text[96];
    std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", (a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
                  (a[2] + b[2]) / 2);
    return text;
  }

 private:
  const std::vector<Point>& points_;
  std::map<Edge, std::vector<std::size_t>> of_;
};

bool has_edge(const Facet& t, Index from, Index to) {
  for (std::size_t k = 0; k < 3; ++k)
    if (t.nodes[k] == from && t.nodes[(k + 1) % 3] == to) return true;
  return false;
}

/// The shell of all triangles that hang together with one, all looking to the same side.
Shell shell_from(std::size_t first, std::vector<Facet>& triangles, const Neighbours& neighbours,
                 std::vector<char>& taken, const std::vector<Facets>& parts, const std::string& path) {
  Shell shell;
  // The walk over neighbours gives each triangle the sense of the one that it was reached from.
  shell.name = parts[triangles[first].part].name;
  std::vector<std::size_t> waiting{first};
  taken[first] = 1;
  while (!waiting.empty()) {
    const std::size_t t = waiting.back();
    waiting.pop_back();
    shell.triangles.push_back(triangles[t].nodes);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = triangles[t].nodes[k], to = triangles[t].nodes[(k + 1) % 3];
      const Edge edge = std::minmax(from, to);
      const std::size_t next = neighbours.beyond(t, edge);
      // Two neighbours look to the same side if they use their edge in opposite senses.
      const bool turned = has_edge(triangles[next], from, to);
      if (taken[next] != 0) {
        if (turned)
          throw UnusableGeometry(
              {path}, "the skin has but one side, as a Möbius strip has, near " + neighbours.place(edge));
        continue;
      }
      if (turned) std::swap(triangles[next].nodes[0], triangles[next].nodes[1]);
      taken[next] = 1;
      waiting.push_back(next);
    }
  }
  return shell;
}

}  // namespace

double enclosed_volume(const ClosedShells& all, const Shell& shell) {
  double volume = 0;
  const Point& o = all.points[as_size(shell.triangles.front()[0])];
  for (const auto& t : shell.triangles) {
    const auto from = [&](std::size_t k) { return minus(all.points[as_size(t[k])], o); };
    volume += dot(from(0), cross(from(1), from(2))) / 6;
  }
  return volume;
}

double winding_number(const ClosedShells& all, const Shell& shell, const Point& point) {
  double angle = 0;
  for (const auto& t : shell.triangles) {
    std::array<Point, 3> r;
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = minus(all.points[as_size(t[k])], point);
      length[k] = std::sqrt(dot(r[k], r[k]));
    }
    angle += 2 * std::atan2(dot(r[0], cross(r[1], r[2])),
                            length[0] * length[1] * length[2] + dot(r[0], r[1]) * length[2] +
                                dot(r[1], r[2]) * length[0] + dot(r[2], r[0]) * length[1]);
  }
  return angle / (4 * k_pi);
}

void nest_shells(ClosedShells& all) {
  // Shells look outward first; how many others are around the corner of one tells whether it is metal or
  // cavity, and the smallest of them is the one around it.
  std::vector<double> volumes;
  for (Shell& shell : all.shells) {
    volumes.push_back(enclosed_volume(all, shell));
    if (volumes.back() < 0)
      for (auto& nodes : shell.triangles) std::swap(nodes[0], nodes[1]);
    volumes.back() = std::abs(volumes.back());
    shell.depth = 0;
    shell.around = -1;
  }
  for (std::size_t a = 0; a < all.shells.size(); ++a) {
    // Any corner will do, because no two shells cross.
    const Point& corner = all.points[as_size(all.shells[a].triangles.front()[0])];
    for (std::size_t b = 0; b < all.shells.size(); ++b) {
      if (a == b || winding_number(all, all.shells[b], corner) < 0.5) continue;
      ++all.shells[a].depth;
      int& around = all.shells[a].around;
      if (around < 0 || volumes[b] < volumes[as_size(around)]) around = static_cast<int>(b);
    }
  }
}

std::vector<std::array<Point, 3>> corners_of(const ClosedShells& all, const Shell& shell) {
  std::vector<std::array<Point, 3>> corners;
  corners.reserve(shell.triangles.size());
  for (const auto& t : shell.triangles)
    corners.push_back({all.points[as_size(t[0])], all.points[as_size(t[1])], all.points[as_size(t[2])]});
  return corners;
}

ClosedShells closed_shells(const std::vector<Facets>& parts, const std::string& path) {
  const double extent = extent_of(parts);
  if (!(extent > 0)) throw UnusableGeometry({path}, "the skin has no triangles, or no extent");
  Welder welder(k_weld * extent);
  std::vector<Facet> triangles;
  // Corners within the tolerance are one node; triangles that lose a side by this go.
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const auto& corners : parts[p].triangles) {
      Facet t{{welder.number(corners[0]), welder.number(corners[1]), welder.number(corners[2])}, p};
      if (t.nodes[0] != t.nodes[1] && t.nodes[1] != t.nodes[2] && t.nodes[2] != t.nodes[0])
        triangles.push_back(t);
    }
  // Only after welding are the corners numbered for good.
  ClosedShells all;
  all.points = std::move(welder).points();
  const Neighbours neighbours(triangles, all.points, path);
  // From each triangle that is left the shell is followed over its neighbours.
  std::vector<char> taken(triangles.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (taken[t] == 0) {
      Shell& shell = all.shells.emplace_back(shell_from(t, triangles, neighbours, taken, parts, path));
      shell.looked_inward = enclosed_volume(all, shell) < 0;
    }
  nest_shells(all);
  return all;
}

}  // namespace solidus::mesh
