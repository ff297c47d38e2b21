/// View factors by rays against closed forms.
#include "heat/radiation/view_factors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/ray_search.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using heat::RadiatingFace;
using heat::RadiatingFaces;
using heat::ViewFactors;
using mesh::Point;

constexpr double k_pi = std::numbers::pi;

Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
double length(const Point& a) {
  return std::hypot(a[0], a[1], a[2]);
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Faces that a test adds surface by surface, each a cluster by itself.
class Faces {
 public:
  RadiatingFaces faces;

  void add(const std::vector<Point>& corners, int surface) {
    RadiatingFace face;
    face.n_corners = static_cast<int>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      face.corners[i] = corners[i];
      face.middle = face.middle + (1.0 / static_cast<double>(corners.size())) * corners[i];
    }
    // Halves of what two edges, or two diagonals, span.
    const Point n = corners.size() == 3
                        ? cross(corners[1] + -1.0 * corners[0], corners[2] + -1.0 * corners[0])
                        : cross(corners[2] + -1.0 * corners[0], corners[3] + -1.0 * corners[1]);
    face.normal = (1 / length(n)) * n;
    face.area = 0.5 * length(n);
    push(face, surface);
  }
  /// A line of a plane or of a half-plane through an axis, with its normal to the right of it.
  void add_line(const Point& a, const Point& b, int surface, AnalysisKind kind) {
    RadiatingFace face;
    face.n_corners = 2;
    face.corners[0] = a, face.corners[1] = b;
    face.middle = 0.5 * (a + b);
    const double l = std::hypot(b[0] - a[0], b[1] - a[1]);
    face.normal = {(b[1] - a[1]) / l, -(b[0] - a[0]) / l, 0};
    face.area = kind == AnalysisKind::axisymmetric ? k_pi * (a[0] + b[0]) * l : l;
    push(face, surface);
  }
  /// n × n parallelograms.
  void add_plate(const Point& origin, const Point& u, const Point& v, int n, int surface) {
    const double s = 1.0 / n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Point at = origin + (i * s) * u + (j * s) * v;
        add({at, at + s * u, at + s * u + s * v, at + s * v}, surface);
      }
  }
  /// A sphere by its faces in polar angles, with normals outward or inward.
  void add_sphere(double radius, int n, bool outward, int surface) {
    const auto at = [&](int i, int j) {
      const double theta = k_pi * i / n, phi = k_pi * j / n;
      return Point{radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
                   radius * std::cos(theta)};
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 2 * n; ++j) {
        std::vector<Point> corners{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        if (i == 0) corners.pop_back();
        if (i == n - 1) corners.erase(corners.begin() + 1);
        if (!outward) std::reverse(corners.begin(), corners.end());
        add(corners, surface);
      }
  }

 private:
  void push(RadiatingFace face, int surface) {
    face.surface = surface;
    face.cluster = faces.n_clusters++;
    faces.all.push_back(face);
  }
};

/// A_a F_ab of two surfaces.
double exchange(const Faces& f, const ViewFactors& factors, int a, int b) {
  double sum = 0;
  for (std::size_t c = 0; c < factors.size(); ++c)
    for (std::size_t k = factors.start[c]; k < factors.start[c + 1]; ++k)
      if (f.faces.all[c].surface == a && f.faces.all[factors.entries[k].to].surface == b)
        sum += factors.entries[k].exchange;
  return sum;
}

double area(const Faces& f, int surface) {
  double sum = 0;
  for (const RadiatingFace& face : f.faces.all)
    if (face.surface == surface) sum += face.area;
  return sum;
}

double factor(const Faces& f, const ViewFactors& factors, int a, int b) {
  return exchange(f, factors, a, b) / area(f, a);
}

/// Closure of every cluster and reciprocity of every pair.
void expect_closed(const ViewFactors& f) {
  for (std::size_t c = 0; c < f.size(); ++c) {
    double sum = f.open[c];
    for (std::size_t k = f.start[c]; k < f.start[c + 1]; ++k) {
      sum += f.entries[k].exchange;
      const std::size_t to = f.entries[k].to;
      double back = -1;
      for (std::size_t m = f.start[to]; m < f.start[to + 1]; ++m)
        if (f.entries[m].to == c) back = f.entries[m].exchange;
      EXPECT_NEAR(back, f.entries[k].exchange, 1e-15 * f.area[c]);
    }
    EXPECT_NEAR(sum / f.area[c], 1, 1e-10);
  }
}

constexpr std::size_t k_rays = 4096;

/// Equal squares of the side a, face to face at the distance c (J. R. Howell, A Catalog of Radiation Heat
/// Transfer Configuration Factors, C-11).
double opposite_squares(double x) {
  const double one = 1 + x * x, root = std::sqrt(one);
  return 2 / (k_pi * x * x) *
         (0.5 * std::log(one * one / (1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
          2 * x * std::atan(x));
}

/// Rectangles of the heights h (1) and w (2), at a right angle, over their length (C-14).
double perpendicular(double h, double w) {
  const double h2 = h * h, w2 = w * w, s = h2 + w2;
  const double logarithm =
      std::log((1 + w2) * (1 + h2) / (1 + s) * std::pow(w2 * (1 + s) / ((1 + w2) * s), w2) *
               std::pow(h2 * (1 + s) / ((1 + h2) * s), h2));
  return 1 / (k_pi * w) *
         (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * logarithm);
}

TEST(ViewFactors, AreThoseOfOppositeSquares) {
  for (const double distance : {0.5, 1.0, 2.0}) {
    Faces f;
    f.add_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 5, 0);
    f.add_plate({0, 0, distance}, {0, 1, 0}, {1, 0, 0}, 5, 1);
    const ViewFactors factors = heat::view_factors(f.faces, AnalysisKind::solid, k_rays);
    expect_closed(factors);
    EXPECT_NEAR(factor(f, factors, 0, 1) / opposite_squares(1 / distance), 1, 3e-3) << distance;
    EXPECT_EQ(exchange(f, factors, 0, 0), 0);
  }
  EXPECT_NEAR(opposite_squares(1), 0.1998, 1e-4);
}

TEST(ViewFactors, AreThoseOfPlatesAtARightAngle) {
  Faces f;
  f.add_plate({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 6, 0);   // looks down
  f.add_plate({0, 0, 0}, {0, 0, -2}, {0, 1, 0}, 6, 1);  // looks along x
  const ViewFactors factors = heat::view_factors(f.faces, AnalysisKind::solid, k_rays);
  expect_closed(factors);
  EXPECT_NEAR(factor(f, factors, 0, 1) / perpendicular(2, 1), 1, 3e-3);
  EXPECT_NEAR(perpendicular(1, 1), 0.2000, 1e-4);
}

/// In a plane by Hottel's crossed strings: half of what crossed strings are longer than uncrossed ones. A
/// plate between two others hides a part of them from each other.
TEST(ViewFactors, AreThoseOfCrossedStringsInAPlane) {
  const auto line = [](Faces& f, const Point& a, const Point& b, int n, int surface) {
    for (int i = 0; i < n; ++i)
      f.add_line(a + (static_cast<double>(i) / n) * (b + -1.0 * a),
                 a + (static_cast<double>(i + 1) / n) * (b + -1.0 * a), surface, AnalysisKind::plane_strain);
  };
  for (const bool blocked : {false, true}) {
    Faces f;
    line(f, {0, 1, 0}, {0, 0, 0}, 8, 0);  // at x = 0: its normal along −x
    line(f, {2, 0, 0}, {2, 1, 0}, 8, 1);
    for (RadiatingFace& face : f.faces.all) face.normal = -1.0 * face.normal;  // they face each other
    // A screen over the lower half, with two sides.
    if (blocked) {
      line(f, {1, 0, 0}, {1, 0.5, 0}, 4, 2);
      line(f, {0.999, 0.5, 0}, {0.999, 0, 0}, 4, 3);
    }
    const ViewFactors factors = heat::view_factors(f.faces, AnalysisKind::plane_strain, k_rays);
    expect_closed(factors);
    // Over the edge of the screen the lower string is as long as the crossed ones, which just touch it.
    const double straight = 2, diagonal = std::sqrt(5.0);
    const double expected = 0.5 * (2 * diagonal - straight - (blocked ? diagonal : straight));
    EXPECT_NEAR(factor(f, factors, 0, 1), expected, 3e-3) << blocked;
  }
}

TEST(ViewFactors, AreThoseOfOneSphereInAnother) {
  Faces f;
  f.add_sphere(0.5, 8, true, 0);
  f.add_sphere(1.0, 8, false, 1);
  const ViewFactors factors = heat::view_factors(f.faces, AnalysisKind::solid, 1024);
  expect_closed(factors);
  EXPECT_EQ(exchange(f, factors, 0, 0), 0);
  EXPECT_NEAR(factor(f, factors, 0, 1), 1, 1e-10);
  const double ratio = area(f, 0) / area(f, 1);
  EXPECT_NEAR(factor(f, factors, 1, 0), ratio, 1e-10);
  EXPECT_NEAR(factor(f, factors, 1, 1), 1 - ratio, 1e-10);
}

/// About an axis, and in a plane, of spheres and cylinders: the outer one sees A_1/A_2 of the inner one.
/// Before they are closed, the rays alone find it to what is given here.
TEST(ViewFactors, AreThoseOfRoundBodiesAboutAnAxisAndInAPlane) {
  for (const AnalysisKind kind : {AnalysisKind::axisymmetric, AnalysisKind::plane_strain}) {
    Faces f;
    const auto circle = [&](double r, bool outward, int surface) {
      const int n = kind == AnalysisKind::axisymmetric ? 24 : 48;
      const double whole = kind == AnalysisKind::axisymmetric ? k_pi : 2 * k_pi;
      for (int i = 0; i < n; ++i) {
        // From the lower end of the axis, against the clock.
        const auto at = [&](int k) {
          const double t = whole * k / n;
          return Point{r * std::sin(t), -r * std::cos(t), 0};
        };
        if (outward)
          f.add_line(at(i), at(i + 1), surface, kind);
        else
          f.add_line(at(i + 1), at(i), surface, kind);
      }
    };
    circle(0.5, true, 0);
    circle(1.0, false, 1);
    const ViewFactors factors = heat::view_factors(f.faces, kind, k_rays);
    expect_closed(factors);
    EXPECT_NEAR(factor(f, factors, 1, 0), area(f, 0) / area(f, 1), 1e-10);
    EXPECT_NEAR(factors.corrected, 0, 0.1);
    // Rings near the axis see the ball as others do.
    for (std::size_t c = 0; c < factors.size(); ++c)
      if (f.faces.all[c].surface == 1) {
        double seen = 0;
        for (std::size_t k = factors.start[c]; k < factors.start[c + 1]; ++k)
          if (f.faces.all[factors.entries[k].to].surface == 0) seen += factors.entries[k].exchange;
        EXPECT_NEAR(seen / factors.area[c], area(f, 0) / area(f, 1), 0.02) << c;
      }
  }
}

/// What looks past another surface loses its rays to the open part. A face of a closed box that is declared
/// to be larger than all that it sees cannot be closed.
TEST(ViewFactors, ThatDoNotCloseAreRefusedWithTheirPlace) {
  Faces open;
  open.add_plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 0);
  open.add_plate({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1);  // turned away
  EXPECT_NEAR(heat::view_factors(open.faces, AnalysisKind::solid, 256).open[0], 1, 1e-12);
  const Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{0, 0, 0};
  Faces box;
  box.add_plate(o, x, y, 1, 0);
  box.add_plate(z, y, x, 1, 1);
  box.add_plate(o, y, z, 1, 1);
  box.add_plate(x, z, y, 1, 1);
  box.add_plate(o, z, x, 1, 1);
  box.add_plate(y, x, z, 1, 1);
  for (RadiatingFace& face : box.faces.all) face.cluster = static_cast<std::size_t>(face.surface);
  box.faces.n_clusters = 2;
  EXPECT_NEAR(heat::view_factors(box.faces, AnalysisKind::solid, 256).open[1], 0, 1e-12);
  box.faces.all.front().area = 40;
  try {
    heat::view_factors(box.faces, AnalysisKind::solid, 256);
    ADD_FAILURE() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("do not close"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("near ("), std::string::npos);
  }
}

/// The first of many triangles, by looking at all of them.
TEST(RaySearch, FindsWhatALookAtAllTrianglesFinds) {
  std::vector<mesh::FlatTriangle> triangles;
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 300; ++i) {
    const Point at{random(), random(), random()};
    const auto near = [&] { return at + 0.1 * Point{random(), random(), random()}; };
    triangles.push_back({at, near(), near()});
  }
  const mesh::RaySearch search(triangles);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Point from{random(), random(), random()}, to{random(), random(), random()};
    const Point direction = to + -1.0 * from;
    const mesh::RaySearch::Hit hit = search.first(from, direction, 0);
    // Each triangle by itself is a search of one.
    double nearest = HUGE_VAL;
    for (const mesh::FlatTriangle& t : triangles)
      nearest = std::min(nearest, mesh::RaySearch({t}).first(from, direction, 0).distance);
    EXPECT_EQ(hit.distance, nearest);
    if (hit) ++met;
  }
  EXPECT_GT(met, 50);
}

}  // namespace
}  // namespace solidus
