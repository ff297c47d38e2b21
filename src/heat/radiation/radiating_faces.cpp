/// Every process gets all faces, sorted by the numbers of their nodes; clusters are made by halving.
#include "heat/radiation/radiating_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

namespace {

using mesh::Point;

/// Numbers of a face as they are sent: surface, four nodes, number of corners, corners, normal, area.
constexpr std::size_t k_numbers = 1 + 4 + 1 + 12 + 3 + 1;
using Sent = std::array<double, k_numbers>;
/// Surface and nodes, by which faces are told apart and sorted.
using Key = std::array<double, 5>;

Key key_of(const double* sent) {
  Key key;
  std::copy_n(sent, key.size(), key.begin());
  return key;
}

/// The faces of a surface that are here, counted ones and others.
std::vector<Sent> faces_here(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface,
                             int number, std::vector<char>& counted) {
  std::vector<Sent> sent;
  for (const mesh::ElementBlock& faces : surface.faces) {
    // Normal and area are integrals over the face, which may be curved.
    const mesh::FaceGeometry g(mesh, faces, kind,
                               mesh::gauss_rule(faces.shape, 2 * mesh::order(faces.shape) + 1));
    const int n = mesh::vertex_count(faces.shape);
    for (Index f = 0; f < g.n_faces; ++f) {
      Sent& s = sent.emplace_back();
      s.fill(0);
      counted.push_back(f < g.n_counted);
      s[0] = number;
      std::array<double, 4> nodes{-1, -1, -1, -1};
      for (int a = 0; a < n; ++a) {
        const auto node = as_size(faces.element(f)[a]);
        nodes[as_size(a)] = static_cast<double>(mesh.input_node[node]);
        for (std::size_t i = 0; i < 3; ++i) s[6 + 3 * as_size(a) + i] = mesh.x[node][i];
      }
      std::sort(nodes.begin(), nodes.end());
      std::copy(nodes.begin(), nodes.end(), s.begin() + 1);
      s[5] = n;
      for (int q = 0; q < g.n_points; ++q) {
        const auto at = as_size(f * g.n_points + q);
        for (std::size_t i = 0; i < 3; ++i) s[18 + i] += g.weight[at] * g.normal[at][i];
        s[21] += g.weight[at];
      }
    }
  }
  return sent;
}

/// A face from its numbers as they were sent.
RadiatingFace face_of(const double* s) {
  RadiatingFace face;
  face.surface = static_cast<int>(s[0]);
  face.n_corners = static_cast<int>(s[5]);
  for (int a = 0; a < face.n_corners; ++a)
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = s[6 + 3 * as_size(a) + i];
      face.corners[as_size(a)][i] = x;
      face.middle[i] += x / face.n_corners;
    }
  const double length = std::hypot(s[18], s[19], s[20]);
  for (std::size_t i = 0; i < 3; ++i) face.normal[i] = s[18 + i] / length;
  face.area = s[21];
  return face;
}

/// Place and direction of a face as six lengths, by which near and alike is measured.
std::array<double, 6> features(const RadiatingFace& face, double extent) {
  // A right angle is as far as a quarter of the whole.
  const double turn = 0.25 * extent / std::sqrt(2.0);
  return {face.middle[0],        face.middle[1],        face.middle[2],
          turn * face.normal[0], turn * face.normal[1], turn * face.normal[2]};
}

/// Halves the faces of the widest cluster, until there are so many.
class Clustering {
 public:
  Clustering(std::vector<RadiatingFace>& faces, std::size_t most) : faces_(faces) {
    Point low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const RadiatingFace& face : faces)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], face.middle[i]);
        high[i] = std::max(high[i], face.middle[i]);
      }
    extent_ = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    // One cluster a surface to begin with: faces of different surfaces radiate differently.
    std::map<int, std::vector<std::size_t>> of_surface;
    for (std::size_t f = 0; f < faces.size(); ++f) of_surface[faces[f].surface].push_back(f);
    for (auto& [surface, members] : of_surface) add(std::move(members));
    while (clusters_.size() < most && !widest_.empty()) halve();
    for (std::size_t c = 0; c < clusters_.size(); ++c)
      for (const std::size_t f : clusters_[c]) faces_[f].cluster = c;
  }
  std::size_t size() const { return clusters_.size(); }

 private:
  void add(std::vector<std::size_t> members) {
    clusters_.push_back(std::move(members));
    measure(clusters_.size() - 1);
  }
  /// Puts a cluster into the queue by its largest extent; a single face, or faces at one place, cannot be
  /// divided.
  void measure(std::size_t cluster) {
    if (clusters_[cluster].size() < 2) return;
    const auto [axis, width] = widest_axis(cluster);
    if (width > 0) widest_.push({width, -static_cast<double>(cluster)});
  }
  std::pair<std::size_t, double> widest_axis(std::size_t cluster) const {
    std::array<double, 6> low, high;
    low.fill(HUGE_VAL), high.fill(-HUGE_VAL);
    for (const std::size_t f : clusters_[cluster]) {
      const auto x = features(faces_[f], extent_);
      for (std::size_t i = 0; i < 6; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 6; ++i)
      if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
    return {axis, high[axis] - low[axis]};
  }
  /// Divides the widest cluster at the median of its faces along its widest direction. Faces of equal
  /// coordinates are ordered by their number, so that every process finds the same clusters.
  void halve() {
    const auto cluster = static_cast<std::size_t>(-widest_.top().second);
    widest_.pop();
    std::vector<std::size_t>& members = clusters_[cluster];
    const std::size_t axis = widest_axis(cluster).first;
    std::sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
      const double x = features(faces_[a], extent_)[axis], y = features(faces_[b], extent_)[axis];
      return x != y ? x < y : a < b;
    });
    const auto middle = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
    std::vector<std::size_t> second(middle, members.end());
    members.erase(middle, members.end());
    measure(cluster);
    add(std::move(second));
  }

  std::vector<RadiatingFace>& faces_;
  double extent_ = 0;
  std::vector<std::vector<std::size_t>> clusters_;
  std::priority_queue<std::pair<double, double>> widest_;  ///< width; minus the number: the first of several
};

}  // namespace

RadiatingFaces radiating_faces(const mesh::Mesh& mesh, AnalysisKind kind,
                               std::span<const mesh::Surface> surfaces, std::size_t most_clusters) {
  // Each process sends the faces that it counts; the others it needs only to find their numbers.
  std::vector<std::vector<Sent>> here;
  std::vector<double> mine;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    std::vector<char> counted;
    here.push_back(faces_here(mesh, kind, surfaces[s], static_cast<int>(s), counted));
    for (std::size_t f = 0; f < counted.size(); ++f)
      if (counted[f] != 0) mine.insert(mine.end(), here.back()[f].begin(), here.back()[f].end());
  }
  // All faces once, by the process that counts each, sorted by surface and nodes.
  const std::vector<double> gathered = processes::gather(mine);
  std::map<Key, const double*> sorted;
  for (std::size_t i = 0; i < gathered.size(); i += k_numbers) sorted[key_of(&gathered[i])] = &gathered[i];
  RadiatingFaces faces;
  std::map<Key, std::size_t> number;
  std::set<std::array<double, 4>> nodes_of;
  for (const auto& [key, sent] : sorted) {
    number[key] = faces.all.size();
    faces.all.push_back(face_of(sent));
    std::array<double, 4> nodes;
    std::copy(key.begin() + 1, key.end(), nodes.begin());
    if (!nodes_of.insert(nodes).second) faces.twice = faces.all.back().middle;
  }
  // A face of two surfaces would radiate twice: its place is returned for the message. Then the faces of this
  // process get the numbers that they have on all.
  for (const std::vector<Sent>& surface : here) {
    std::vector<std::size_t>& numbers = faces.of_surface.emplace_back();
    for (const Sent& face : surface) numbers.push_back(number.at(key_of(face.data())));
  }
  faces.n_clusters = Clustering(faces.all, most_clusters).size();
  return faces;
}

}  // namespace solidus::heat
