#include "mesh/making/metal_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "mesh/making/hot_spots.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_infinite = 1e300;

/// The lower envelope of parabolas in one dimension: squared distances to the nearest zero of a line of
/// cells, of squared distances across it (P. Felzenszwalb, D. Huttenlocher, "Distance transforms of sampled
/// functions", Theory of Computing 8 (2012) 415–428).
void transform_line(const std::vector<double>& f, std::vector<double>& out) {
  const int n = static_cast<int>(f.size());
  std::vector<int> apex(f.size(), 0);
  std::vector<double> border(f.size() + 1, 0);
  // Parabolas whose apex others cover are removed from the envelope as they are found.
  int k = -1;
  const auto value = [&](int i) { return f[as_size(i)]; };
  for (int q = 0; q < n; ++q) {
    if (value(q) >= k_infinite) continue;
    double s = -k_infinite;
    while (k >= 0) {
      const int v = apex[as_size(k)];
      s = ((value(q) + double(q) * q) - (value(v) + double(v) * v)) / (2.0 * (q - v));
      if (s > border[as_size(k)]) break;
      --k;
    }
    if (k < 0) s = -k_infinite;
    ++k;
    apex[as_size(k)] = q;
    border[as_size(k)] = s;
    border[as_size(k) + 1] = k_infinite;
  }
  out.assign(f.size(), k_infinite);
  if (k < 0) return;
  int at = 0;
  for (int q = 0; q < n; ++q) {
    while (border[as_size(at) + 1] < q) ++at;
    const int v = apex[as_size(at)];
    out[as_size(q)] = double(q - v) * (q - v) + value(v);
  }
}

}  // namespace

MetalGrid::MetalGrid(const RawMesh& mesh, const std::vector<std::string>& bodies, std::size_t number) {
  double volume = 0;
  Point high{};
  low_.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const std::string& body : bodies) {
    const BodyExtent extent = extent_of(mesh, body);
    volume += extent.volume;
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = std::min(low_[i], extent.low[i]);
      high[i] = std::max(high[i], extent.high[i]);
    }
  }
  // So many cubes as asked for fill the volume of the bodies.
  edge_ = std::cbrt(volume / static_cast<double>(number));
  // A layer of cells around the metal has none, so that every cube of it has a nearest cell outside; the
  // first with metal begin at the lowest faces, where as many are counted too much as too little.
  for (std::size_t i = 0; i < 3; ++i) {
    low_[i] -= edge_;
    n_[i] = static_cast<int>(std::ceil((high[i] - low_[i]) / edge_)) + 2;
  }
  fill(mesh, bodies);
  measure_depth();
}

std::size_t MetalGrid::cell(int x, int y, int z) const {
  return (as_size(x) * as_size(n_[1]) + as_size(y)) * as_size(n_[2]) + as_size(z);
}

void MetalGrid::fill(const RawMesh& mesh, const std::vector<std::string>& bodies) {
  // Along each vertical line metal lies between the first and the second crossing of the skin, the third and
  // the fourth, and so on. Lines are a little off the middle of their cells, so that they meet no edge.
  constexpr double k_off = 1.3e-4, k_off_too = 2.1e-4;
  const ViewFromAbove view(mesh, bodies);
  cube_of_.assign(as_size(n_[0]) * as_size(n_[1]) * as_size(n_[2]), -1);
  for (int x = 0; x < n_[0]; ++x)
    for (int y = 0; y < n_[1]; ++y) {
      std::vector<double> z = view.crossings(
          {low_[0] + (x + 0.5 + k_off) * edge_, low_[1] + (y + 0.5 + k_off_too) * edge_, low_[2]});
      std::sort(z.begin(), z.end());
      for (std::size_t i = 0; i + 1 < z.size(); i += 2)
        for (int k = std::max(0, static_cast<int>(std::ceil((z[i] - low_[2]) / edge_ - 0.5)));
             k < n_[2] && low_[2] + (k + 0.5) * edge_ < z[i + 1]; ++k) {
          int& cube = cube_of_[cell(x, y, k)];
          if (cube < 0) cube = static_cast<int>(cubes_.size()), cubes_.push_back(cell(x, y, k));
        }
    }
  if (cubes_.empty()) cube_of_[0] = 0, cubes_.push_back(0);
}

/// The depth of a cube below the surface: its distance to the nearest cell without metal, one direction after
/// the other.
void MetalGrid::measure_depth() {
  std::vector<double> squared(cube_of_.size());
  for (std::size_t i = 0; i < squared.size(); ++i) squared[i] = cube_of_[i] < 0 ? 0 : k_infinite;
  const std::array<std::size_t, 3> stride = {as_size(n_[1]) * as_size(n_[2]), as_size(n_[2]), 1};
  std::vector<double> line, out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = as_size(n_[axis]);
    for (std::size_t first = 0; first < squared.size(); ++first) {
      if (first / stride[axis] % n != 0) continue;
      line.resize(n);
      for (std::size_t i = 0; i < n; ++i) line[i] = squared[first + i * stride[axis]];
      transform_line(line, out);
      for (std::size_t i = 0; i < n; ++i) squared[first + i * stride[axis]] = out[i];
    }
  }
  // The skin lies half an edge before the centre of the nearest cell outside.
  depth_.resize(cubes_.size());
  for (std::size_t c = 0; c < cubes_.size(); ++c) depth_[c] = edge_ * (std::sqrt(squared[cubes_[c]]) - 0.5);
}

Point MetalGrid::centre(std::size_t cube) const {
  const std::size_t c = cubes_[cube], nz = as_size(n_[2]), ny = as_size(n_[1]);
  return {low_[0] + (static_cast<double>(c / nz / ny) + 0.5) * edge_,
          low_[1] + (static_cast<double>(c / nz % ny) + 0.5) * edge_,
          low_[2] + (static_cast<double>(c % nz) + 0.5) * edge_};
}

std::vector<int> MetalGrid::neighbours(std::size_t cube) const {
  // All cells around: ways along diagonals are 1.7 edges long in place of three.
  const std::size_t c = cubes_[cube], nz = as_size(n_[2]), ny = as_size(n_[1]);
  const int x = static_cast<int>(c / nz / ny), y = static_cast<int>(c / nz % ny),
            z = static_cast<int>(c % nz);
  std::vector<int> around;
  for (int i = std::max(0, x - 1); i <= std::min(n_[0] - 1, x + 1); ++i)
    for (int j = std::max(0, y - 1); j <= std::min(n_[1] - 1, y + 1); ++j)
      for (int k = std::max(0, z - 1); k <= std::min(n_[2] - 1, z + 1); ++k) {
        const int other = cube_of_[cell(i, j, k)];
        if (other >= 0 && other != static_cast<int>(cube)) around.push_back(other);
      }
  return around;
}

/// No neighbour lies deeper: the cube is on the middle line or surface of a wall, or in the centre of a thick
/// place.
bool MetalGrid::on_ridge(std::size_t cube) const {
  const std::vector<int> around = neighbours(cube);
  return std::ranges::none_of(around, [&](int other) { return depth_[as_size(other)] > depth_[cube]; });
}

/// Whether a neighbour is reached from another start: metal between two risers, say.
bool MetalGrid::between_places(std::size_t cube, const WaysInMetal& ways) const {
  return std::ranges::any_of(neighbours(cube),
                             [&](int other) { return ways.from[as_size(other)] != ways.from[cube]; });
}

std::size_t MetalGrid::cube_at(const Point& point) const {
  std::array<int, 3> i{};
  for (std::size_t d = 0; d < 3; ++d)
    i[d] = std::clamp(static_cast<int>((point[d] - low_[d]) / edge_), 0, n_[d] - 1);
  if (const int cube = cube_of_[cell(i[0], i[1], i[2])]; cube >= 0) return as_size(cube);
  // A point outside of the metal has the nearest cube.
  std::size_t nearest = 0;
  double least = k_infinite;
  for (std::size_t c = 0; c < cubes_.size(); ++c) {
    const Point x = centre(c);
    const double far = std::hypot(x[0] - point[0], x[1] - point[1], x[2] - point[2]);
    if (far < least) least = far, nearest = c;
  }
  return nearest;
}

double MetalGrid::volume_in(const Point& middle, double radius) const {
  std::size_t inside = 0;
  for (std::size_t c = 0; c < cubes_.size(); ++c) {
    const Point x = centre(c);
    inside += std::hypot(x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]) < radius ? 1 : 0;
  }
  return static_cast<double>(inside) * edge_ * edge_ * edge_;
}

/// The width of the widest way from a cube to each other one, as in Dijkstra's search with the least depth
/// along a way in place of its length.
std::vector<double> MetalGrid::widest_ways(std::size_t from) const {
  std::vector<double> width(cubes_.size(), 0);
  std::priority_queue<std::pair<double, std::size_t>> queue;
  width[from] = depth_[from];
  queue.emplace(width[from], from);
  while (!queue.empty()) {
    const auto [wide, cube] = queue.top();
    queue.pop();
    if (wide < width[cube]) continue;
    for (const int next : neighbours(cube)) {
      const auto to = as_size(next);
      const double there = std::min(wide, depth_[to]);
      if (there > width[to]) width[to] = there, queue.emplace(there, to);
    }
  }
  return width;
}

WaysInMetal MetalGrid::beginnings(const std::vector<WayStart>& starts) const {
  WaysInMetal ways{std::vector<double>(cubes_.size(), k_infinite), std::vector<int>(cubes_.size(), -1)};
  for (std::size_t c = 0; c < cubes_.size(); ++c) {
    const Point x = centre(c);
    for (std::size_t s = 0; s < starts.size() && ways.from[c] < 0; ++s) {
      const WayStart& start = starts[s];
      const double aside = std::hypot(x[0] - start.centre[0], x[1] - start.centre[1]);
      if (aside < start.radius + 0.5 * edge_ && std::abs(x[2] - start.centre[2]) < start.below + edge_)
        ways.length[c] = 0, ways.from[c] = static_cast<int>(s);
    }
  }
  return ways;
}

/// Dijkstra's search from all starts at once: the length of the shortest way, and the start that it comes
/// from.
WaysInMetal MetalGrid::shortest_ways(const std::vector<WayStart>& starts) const {
  WaysInMetal ways = beginnings(starts);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t c = 0; c < cubes_.size(); ++c)
    if (ways.from[c] >= 0) queue.emplace(0.0, c);
  while (!queue.empty()) {
    const auto [length, cube] = queue.top();
    queue.pop();
    if (length > ways.length[cube]) continue;
    const Point a = centre(cube);
    for (const int next : neighbours(cube)) {
      const auto to = as_size(next);
      const Point b = centre(to);
      const double there = length + std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      if (there >= ways.length[to]) continue;
      ways.length[to] = there;
      ways.from[to] = ways.from[cube];
      queue.emplace(there, to);
    }
  }
  return ways;
}

}  // namespace solidus::mesh
