/// Samples are spread over a grid of boxes by sweeps, each box taking what its neighbours allow; walls are
/// measured by rays from one side to the other.
#include "mesh/making/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidus::mesh {

namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

constexpr double k_none = 1e30;

using SkinTriangle = std::array<Point, 3>;

Point normal_of(const SkinTriangle& t) {
  Point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const double size = std::sqrt(dot(n, n));
  if (size > 0)
    for (double& c : n) c /= size;
  return n;
}

Point centre_of(const SkinTriangle& t) {
  Point centre{};
  for (const Point& p : t)
    for (std::size_t i = 0; i < 3; ++i) centre[i] += p[i] / 3;
  return centre;
}

double radius_of(const SkinTriangle& t, const Point& centre) {
  double radius = 0;
  for (const Point& p : t) {
    const Point d = minus(p, centre);
    radius = std::max(radius, std::sqrt(dot(d, d)));
  }
  return radius;
}

/// Distance along a ray, of a direction of length one, at which it meets a triangle; negative: not at all or
/// behind. Möller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection", J. Graph. Tools 2,
/// 21-28.
double meet(const Point& from, const Point& direction, const SkinTriangle& triangle) {
  constexpr double k_edge = 1e-9;
  const Point e1 = minus(triangle[1], triangle[0]), e2 = minus(triangle[2], triangle[0]);
  const Point p = cross(direction, e2);
  const double determinant = dot(e1, p);
  if (determinant == 0) return -1;
  const Point t = minus(from, triangle[0]);
  const double u = dot(t, p) / determinant;
  if (u < -k_edge || u > 1 + k_edge) return -1;
  const Point q = cross(t, e1);
  const double v = dot(direction, q) / determinant;
  if (v < -k_edge || u + v > 1 + k_edge) return -1;
  return dot(e2, q) / determinant;
}

}  // namespace

SizeField::SizeField(const Point& low, const Point& high, const std::vector<SizeSample>& samples,
                     double growth, int cells)
    : low_(low) {
  // Cells are cubes: their number along the longest side gives their size.
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, high[i] - low[i]);
  size_ = longest / cells;
  for (std::size_t i = 0; i < 3; ++i)
    n_[i] = std::max(1, static_cast<int>(std::ceil((high[i] - low[i]) / size_)));
  h_.assign(index(n_[0] - 1, n_[1] - 1, n_[2] - 1) + 1, k_none);
  // In each cell of the grid the smallest size of the triangles whose boxes reach it; from there sizes grow
  // outwards.
  for (const SizeSample& s : samples) {
    std::array<int, 3> from{}, to{};
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = cell(std::min({s.corners[0][i], s.corners[1][i], s.corners[2][i]}), i);
      to[i] = cell(std::max({s.corners[0][i], s.corners[1][i], s.corners[2][i]}), i);
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) h_[index(i, j, k)] = std::min(h_[index(i, j, k)], s.size);
  }
  spread(growth);
}

int SizeField::cell(double x, std::size_t axis) const {
  return std::clamp(static_cast<int>(std::floor((x - low_[axis]) / size_)), 0, n_[axis] - 1);
}

// Distances along the 26 directions to neighbours, swept forward and backward until nothing changes
// (Borgefors 1986, "Distance transformations in digital images", Comput. Vis. Graph. Image Process. 34).
void SizeField::spread(double growth) {
  bool changed = true;
  const auto visit = [&](int i, int j, int k, int direction) {
    double& here = h_[index(i, j, k)];
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          if ((dk * 9 + dj * 3 + di) * direction >= 0) continue;  // those that the sweep has passed
          const int a = i + di, b = j + dj, c = k + dk;
          if (a < 0 || b < 0 || c < 0 || a >= n_[0] || b >= n_[1] || c >= n_[2]) continue;
          const double through = h_[index(a, b, c)] +
                                 growth * size_ * std::sqrt(static_cast<double>(di * di + dj * dj + dk * dk));
          if (through < here * (1 - 1e-12)) here = through, changed = true;
        }
  };
  // Two sweeps in opposite directions spread every cell as far as it reaches in most cases.
  for (int sweep = 0; changed && sweep < 20; ++sweep) {
    changed = false;
    for (int k = 0; k < n_[2]; ++k)
      for (int j = 0; j < n_[1]; ++j)
        for (int i = 0; i < n_[0]; ++i) visit(i, j, k, 1);
    for (int k = n_[2] - 1; k >= 0; --k)
      for (int j = n_[1] - 1; j >= 0; --j)
        for (int i = n_[0] - 1; i >= 0; --i) visit(i, j, k, -1);
  }
}

double SizeField::at(const Point& x) const {
  return h_[index(cell(x[0], 0), cell(x[1], 1), cell(x[2], 2))];
}

SkinPiece skin_piece(const std::array<Point, 3>& triangle, const SizeField& field, double largest) {
  const Point n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
  return {0.5 * std::sqrt(dot(n, n)), std::min(largest, field.at(centre_of(triangle)))};
}

bool looks_inward(const std::vector<std::array<Point, 3>>& skin, std::size_t triangle) {
  const Point from = centre_of(skin[triangle]), direction = normal_of(skin[triangle]);
  const double nothing = 1e-6 * radius_of(skin[triangle], from);
  int crossings = 0;
  for (std::size_t k = 0; k < skin.size(); ++k)
    if (k != triangle && meet(from, direction, skin[k]) > nothing) ++crossings;
  return crossings % 2 == 1;
}

std::vector<double> wall_thickness(const std::vector<std::array<Point, 3>>& skin, std::size_t most) {
  std::vector<Point> centre;
  std::vector<double> radius;
  for (const SkinTriangle& t : skin) {
    centre.push_back(centre_of(t));
    radius.push_back(radius_of(t, centre.back()));
  }
  // From the centre of each triangle, or of some where there are many, inward to the next one.
  std::vector<double> thickness(skin.size(), 0.0);
  const std::size_t stride = 1 + skin.size() / most;
  for (std::size_t s = 0; s < skin.size(); s += stride) {
    Point inward = normal_of(skin[s]);
    for (double& c : inward) c = -c;
    const double nothing = 1e-6 * radius[s];
    double nearest = std::numeric_limits<double>::max();
    // Triangles whose bounding sphere the ray misses, or that lie behind what is found, are passed over.
    for (std::size_t k = 0; k < skin.size(); ++k) {
      const Point to = minus(centre[k], centre[s]);
      const double ahead = dot(to, inward);
      if (k == s || ahead < -radius[k] || ahead - radius[k] > nearest ||
          dot(to, to) - ahead * ahead > radius[k] * radius[k])
        continue;
      if (const double distance = meet(centre[s], inward, skin[k]); distance > nothing)
        nearest = std::min(nearest, distance);
    }
    if (nearest < std::numeric_limits<double>::max()) thickness[s] = nearest;
  }
  return thickness;
}

}  // namespace solidus::mesh
