/// Rays are cast cluster by cluster, each with its own sequence; the rows of all processes are then put
/// together, averaged with their mirror images and scaled.
#include "heat/radiation/view_factors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "mesh/ray_search.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

namespace {

using mesh::Point;

constexpr int k_sectors = 96;       ///< of a ring about an axis
constexpr double k_closed = 1e-12;  ///< |Σ_j F_ij + F_i∞ − 1| that is left
constexpr int k_most_scalings = 2000;
constexpr double k_start = 1e-9;  ///< of the extent: nearer hits are the face itself

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The k-th place of the sequence in [0, 1)⁴.
std::array<double, 4> place(std::size_t k, const std::array<double, 4>& shift) {
  constexpr double k_g = 1.1673039782614187;  // g⁵ = g + 1
  std::array<double, 4> u{};
  double step = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    step /= k_g;
    u[i] = std::fmod(shift[i] + step * static_cast<double>(k + 1), 1.0);
  }
  return u;
}

/// Where the sequence of a cluster begins: numbers without a pattern that follow from its own (SplitMix64).
std::array<double, 4> shift_of(std::size_t cluster) {
  std::uint64_t state = 0x9e3779b97f4a7c15ULL * (cluster + 1);
  std::array<double, 4> shift{};
  for (double& s : shift) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    s = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  return shift;
}

/// A place on a face and the normal there.
struct Origin {
  Point x{}, normal{};
};

/// The faces as triangles in space, and places on them.
class Scene {
 public:
  Scene(const RadiatingFaces& faces, AnalysisKind kind) : faces_(faces.all), kind_(kind) {
    members_.resize(faces.n_clusters);
    area_.resize(faces.n_clusters, 0.0);
    Point low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const RadiatingFace& face = faces_[f];
      members_[face.cluster].push_back(f);
      area_[face.cluster] += face.area;
      for (int a = 0; a < face.n_corners; ++a)
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], face.corners[as_size(a)][i]);
          high[i] = std::max(high[i], face.corners[as_size(a)][i]);
        }
    }
    extent_ = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    std::vector<mesh::FlatTriangle> triangles;
    for (std::size_t f = 0; f < faces_.size(); ++f) add_triangles(f, triangles);
    search_.emplace(std::move(triangles));
  }

  double area(std::size_t cluster) const { return area_[cluster]; }
  /// The cluster that the k-th ray of a cluster meets first, and whether on the side of its normal; none: it
  /// leaves.
  struct Met {
    std::size_t cluster;
    bool front;
  };
  std::optional<Met> cast(std::size_t cluster, std::size_t k, const std::array<double, 4>& shift) const {
    const std::array<double, 4> u = place(k, shift);
    const Origin from = origin(cluster, u);
    const Point direction = direction_from(from.normal, u[2], u[3]);
    const mesh::RaySearch::Hit hit = search_->first(from.x, direction, k_start * extent_);
    if (!hit) return std::nullopt;
    const RadiatingFace& face = faces_[face_of_[hit.triangle]];
    return Met{face.cluster, dot(normal_of_[hit.triangle], direction) < 0};
  }

 private:
  void add_triangle(std::size_t face, const Point& a, const Point& b, const Point& c, const Point& normal,
                    std::vector<mesh::FlatTriangle>& triangles) {
    triangles.push_back({a, b, c});
    face_of_.push_back(face);
    normal_of_.push_back(normal);
  }
  void add_triangles(std::size_t f, std::vector<mesh::FlatTriangle>& triangles) {
    const RadiatingFace& face = faces_[f];
    const auto& x = face.corners;
    switch (kind_) {
      case AnalysisKind::solid:
        add_triangle(f, x[0], x[1], x[2], face.normal, triangles);
        if (face.n_corners == 4) add_triangle(f, x[0], x[2], x[3], face.normal, triangles);
        return;
      case AnalysisKind::plane_strain: {
        // As high as it is long on either side of the plane in which the rays stay.
        const auto lifted = [&](std::size_t a, double z) { return Point{x[a][0], x[a][1], z}; };
        add_triangle(f, lifted(0, -extent_), lifted(1, -extent_), lifted(1, extent_), face.normal, triangles);
        add_triangle(f, lifted(0, -extent_), lifted(1, extent_), lifted(0, extent_), face.normal, triangles);
        return;
      }
      case AnalysisKind::axisymmetric:
        for (int s = 0; s < k_sectors; ++s) {
          const double one = angle(s - 0.5), two = angle(s + 0.5);
          const Point normal = turned({face.normal[0], face.normal[1], 0}, angle(s));
          add_triangle(f, ring(x[0], one), ring(x[1], one), ring(x[1], two), normal, triangles);
          add_triangle(f, ring(x[0], one), ring(x[1], two), ring(x[0], two), normal, triangles);
        }
    }
  }
  static double angle(double sector) { return 2 * std::numbers::pi * sector / k_sectors; }
  /// r along x, z along y, turned about y.
  static Point turned(const Point& x, double angle) {
    return {x[0] * std::cos(angle), x[1], x[0] * std::sin(angle)};
  }
  /// The corner of a facet: as far out that facets have the area of the ring.
  static Point ring(const Point& x, double angle) {
    constexpr double k_half = std::numbers::pi / k_sectors;
    return turned({x[0] * k_half / std::sin(k_half), x[1], 0}, angle);
  }

  Origin origin(std::size_t cluster, const std::array<double, 4>& u) const {
    // The first number chooses the face by its area, and what is left of it a place in it.
    const std::vector<std::size_t>& members = members_[cluster];
    double at = u[0] * area_[cluster];
    std::size_t m = 0;
    while (m + 1 < members.size() && at >= faces_[members[m]].area) at -= faces_[members[m++]].area;
    const RadiatingFace& face = faces_[members[m]];
    const double v = std::clamp(at / face.area, 0.0, 1.0);
    const auto& x = face.corners;
    const auto between = [](const Point& a, const Point& b, double t) {
      return Point{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
    };
    switch (kind_) {
      case AnalysisKind::plane_strain:
        return {between(x[0], x[1], v), face.normal};
      case AnalysisKind::axisymmetric: {
        // The radius grows along the face, and with it the share of its places.
        const double r0 = x[0][0], r1 = x[1][0], squared = r0 * r0 + v * (r1 * r1 - r0 * r0);
        const double t = std::abs(r1 - r0) > 1e-9 * (r0 + r1) ? (std::sqrt(squared) - r0) / (r1 - r0) : v;
        const Point on = between(x[0], x[1], t);
        constexpr double k_half = std::numbers::pi / k_sectors;
        const double corner = on[0] * k_half / std::sin(k_half);
        return {{corner * std::cos(k_half), on[1], (2 * u[1] - 1) * corner * std::sin(k_half)},
                {face.normal[0], face.normal[1], 0}};
      }
      default:
        return {on_polygon(face, v, u[1]), face.normal};
    }
  }
  /// A place of a triangle or quadrilateral, evenly over its area.
  static Point on_polygon(const RadiatingFace& face, double v, double w) {
    const auto& x = face.corners;
    std::array<std::size_t, 3> corners{0, 1, 2};
    if (face.n_corners == 4) {
      const auto half = [&](std::size_t b, std::size_t c) {
        Point p{}, q{};
        for (std::size_t i = 0; i < 3; ++i) p[i] = x[b][i] - x[0][i], q[i] = x[c][i] - x[0][i];
        const Point n = cross(p, q);
        return std::sqrt(dot(n, n));
      };
      const double first = half(1, 2), share = first / (first + half(2, 3));
      if (v < share) {
        v /= share;
      } else {
        v = (v - share) / (1 - share);
        corners = {0, 2, 3};
      }
    }
    const double s = std::sqrt(v), b = s * (1 - w), c = s * w;
    Point p{};
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = (1 - b - c) * x[corners[0]][i] + b * x[corners[1]][i] + c * x[corners[2]][i];
    return p;
  }
  /// A direction by the law of cosines about a normal.
  Point direction_from(const Point& n, double u, double v) const {
    if (kind_ == AnalysisKind::plane_strain) {
      const double sine = 2 * u - 1, cosine = std::sqrt(1 - sine * sine);
      return {cosine * n[0] - sine * n[1], cosine * n[1] + sine * n[0], 0};
    }
    const Point other = std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    Point a = cross(n, other);
    const double length = std::sqrt(dot(a, a));
    for (double& c : a) c /= length;
    const Point b = cross(n, a);
    const double sine = std::sqrt(u), cosine = std::sqrt(1 - u), phi = 2 * std::numbers::pi * v;
    Point d{};
    for (std::size_t i = 0; i < 3; ++i)
      d[i] = cosine * n[i] + sine * (std::cos(phi) * a[i] + std::sin(phi) * b[i]);
    return d;
  }

  const std::vector<RadiatingFace>& faces_;
  AnalysisKind kind_;
  double extent_ = 0;
  std::vector<std::vector<std::size_t>> members_;  ///< faces of each cluster
  std::vector<double> area_;                       ///< of each cluster [m²]
  std::vector<std::size_t> face_of_;               ///< of each triangle
  std::vector<Point> normal_of_;                   ///< the same
  std::optional<mesh::RaySearch> search_;
};

/// How many rays of one cluster meet another one; to `k_open`: they leave.
struct Met {
  std::size_t from, to;
  double rays;
};
constexpr std::size_t k_open = std::numeric_limits<std::size_t>::max();

/// Casts the rays of every cluster; processes share them. Returns what they meet over all processes.
std::vector<Met> cast_rays(const Scene& scene, std::size_t n_clusters, std::size_t rays) {
  // A pair is sent as one number, which is exact: from × (n + 1) + to, the open part being number n.
  const std::size_t columns = n_clusters + 1;
  std::vector<double> mine;
  std::vector<double> counts(columns);
  std::vector<std::size_t> touched;
  const auto stride = as_size(processes::count());
  for (auto c = as_size(processes::rank()); c < n_clusters; c += stride) {
    const std::array<double, 4> shift = shift_of(c);
    touched.clear();
    for (std::size_t k = 0; k < rays; ++k) {
      // The back of a face is the inside of a body, which is not open: surfaces that are not in the enclosure
      // have let the ray through.
      const auto hit = scene.cast(c, k, shift);
      const std::size_t to = hit && hit->front ? hit->cluster : n_clusters;
      if (counts[to] == 0) touched.push_back(to);
      counts[to] += 1;
    }
    for (const std::size_t to : touched) {
      mine.insert(mine.end(), {static_cast<double>(c * columns + to), counts[to]});
      counts[to] = 0;
    }
  }
  const std::vector<double> all = processes::gather(mine);
  std::vector<Met> met;
  met.reserve(all.size() / 2);
  for (std::size_t i = 0; i < all.size(); i += 2) {
    const auto pair = static_cast<std::size_t>(all[i]);
    const std::size_t to = pair % columns;
    met.push_back({pair / columns, to == n_clusters ? k_open : to, all[i + 1]});
  }
  return met;
}

/// S ← ½ (S + Sᵀ) as sorted rows, from exchanges that may hold a pair several times.
void set_rows(std::vector<std::pair<std::uint64_t, double>>& halves, std::size_t n, ViewFactors& f) {
  std::sort(halves.begin(), halves.end());
  f.start.assign(n + 1, 0);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const bool again = i > 0 && halves[i].first == halves[i - 1].first;
    if (again) {
      f.entries.back().exchange += halves[i].second;
      continue;
    }
    f.entries.push_back({as_size(halves[i].first % n), halves[i].second});
    ++f.start[as_size(halves[i].first / n) + 1];
  }
  f.entries.shrink_to_fit();
  for (std::size_t c = 0; c < n; ++c) f.start[c + 1] += f.start[c];
}

/// Finds d of the rows; see the header. Throws InputError where some row cannot be closed.
void close(const RadiatingFaces& faces, ViewFactors& f) {
  std::vector<double> d(f.size(), 1.0);
  double worst = 0;
  std::size_t where = 0;
  for (int i = 0; i < k_most_scalings; ++i) {
    const std::vector<double> sum = f.multiply(d);
    worst = 0;
    for (std::size_t c = 0; c < f.size(); ++c) {
      const double row = d[c] * (sum[c] + f.open[c]);
      const double off = std::abs(row / f.area[c] - 1);
      if (!(off <= worst)) worst = off, where = c;
      // The root of the error: both clusters of a pair take their half of it.
      if (row > 0) d[c] *= std::sqrt(f.area[c] / row);
    }
    if (i == 0) f.corrected = worst;
    if (worst <= k_closed) break;
  }
  if (!(worst <= 1e-10)) {
    const auto face = std::ranges::find(faces.all, where, &RadiatingFace::cluster);
    throw InputError({},
                     fmt::format("the view factors of the enclosure do not close: they add up to {:.6g} "
                                 "near ({:.4g}, {:.4g}, {:.4g}) m",
                                 1 + worst, face->middle[0], face->middle[1], face->middle[2]),
                     "surfaces that see each other or the open part, with normals out of their bodies");
  }
  for (std::size_t c = 0; c < f.size(); ++c) {
    f.open[c] *= d[c];
    for (std::size_t k = f.start[c]; k < f.start[c + 1]; ++k)
      f.entries[k].exchange *= d[c] * d[f.entries[k].to];
  }
}

}  // namespace

std::vector<double> ViewFactors::multiply(const std::vector<double>& x) const {
  std::vector<double> y(size(), 0.0);
  for (std::size_t c = 0; c < size(); ++c)
    for (std::size_t k = start[c]; k < start[c + 1]; ++k) y[c] += entries[k].exchange * x[entries[k].to];
  return y;
}

ViewFactors view_factors(const RadiatingFaces& faces, AnalysisKind kind, std::size_t rays) {
  const Scene scene(faces, kind);
  const std::size_t n = faces.n_clusters;
  ViewFactors f;
  f.open.assign(n, 0.0);
  for (std::size_t c = 0; c < n; ++c) f.area.push_back(scene.area(c));
  // Each ray carries its share of the area; half of an exchange comes from either side.
  std::vector<std::pair<std::uint64_t, double>> halves;
  for (const Met& met : cast_rays(scene, n, rays)) {
    const double exchange = f.area[met.from] * met.rays / static_cast<double>(rays);
    if (met.to == k_open) {
      f.open[met.from] += exchange;
      continue;
    }
    halves.push_back({met.from * n + met.to, 0.5 * exchange});
    halves.push_back({met.to * n + met.from, 0.5 * exchange});
  }
  set_rows(halves, n, f);
  close(faces, f);
  return f;
}

double share_of_own_view(const RadiatingFaces& faces, AnalysisKind kind, std::size_t rays) {
  const Scene scene(faces, kind);
  double all = 0, own = 0;
  for (const Met& met : cast_rays(scene, faces.n_clusters, rays)) {
    const double area = scene.area(met.from) * met.rays;
    all += area;
    if (met.to != k_open) own += area;
  }
  return all > 0 ? own / all : 0;
}

}  // namespace solidus::heat
