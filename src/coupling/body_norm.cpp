#include "coupling/body_norm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::coupling {

using mesh::Point;

/// Sums over nodes of the weight w, the place x and the displacement u.
struct BodyNorm::Moments {
  static constexpr int k_size = 17;
  double weight = 0, square = 0;            ///< Σ w, Σ w |u|²
  Point place{}, displacement{}, moment{};  ///< Σ w x, Σ w u, Σ w x × u
  std::array<Point, 2> second{};            ///< Σ w x_i², Σ w x_j x_k

  void add(double w, const Point& x, const Point& u) {
    weight += w;
    // Moments of displacement and place, from which the best rigid motion follows.
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      square += w * u[i] * u[i];
      place[i] += w * x[i];
      displacement[i] += w * u[i];
      moment[i] += w * (x[j] * u[k] - x[k] * u[j]);
      second[0][i] += w * x[i] * x[i];
      second[1][i] += w * x[j] * x[k];
    }
  }
  /// Σ w |u − t − θ × (x − c)|² at the t and θ that make it least: what they explain is |Σ w u|² / Σ w and
  /// mᵀ I⁻¹ m, with moment m and inertia I about the centre c of the nodes.
  double distortion(AnalysisKind kind) const;
  /// These t and θ themselves.
  struct Rigid {
    Point centre{}, translation{}, rotation{};
    Point at(const Point& x) const;
  };
  Rigid rigid(AnalysisKind kind) const;

 private:
  /// I = L D Lᵀ without the directions in which nothing turns (D = 0), and y of L y = m.
  struct Turning {
    std::array<Point, 3> l{};
    Point d{}, y{};
  };
  Turning turning(AnalysisKind kind) const;
};

BodyNorm::Moments::Turning BodyNorm::Moments::turning(AnalysisKind kind) const {
  Turning of;
  Point m{};
  std::array<Point, 3> inertia{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    // All moments are shifted to the centre of the nodes, which makes translation and rotation independent of
    // each other.
    m[i] = moment[i] - (place[j] * displacement[k] - place[k] * displacement[j]) / weight;
    inertia[i][i] = second[0][j] + second[0][k] - (place[j] * place[j] + place[k] * place[k]) / weight;
    inertia[j][k] = inertia[k][j] = place[j] * place[k] / weight - second[1][i];
  }
  // Nodes on a line do not turn about it, and a node alone does not turn: what is left of its inertia is
  // rounding of the second moments.
  constexpr double k_singular = 1e-9;
  const double least = k_singular * (second[0][0] + second[0][1] + second[0][2]);
  auto& [l, d, y] = of;
  // A plane body turns about z alone. The factors are taken row by row; a direction that has no inertia is
  // passed over, and its rotation stays zero.
  for (std::size_t i = kind == AnalysisKind::plane_strain ? 2 : 0; i < 3; ++i) {
    d[i] = inertia[i][i];
    y[i] = m[i];
    for (std::size_t j = 0; j < i; ++j) {
      if (d[j] <= 0) continue;
      double value = inertia[i][j];
      for (std::size_t k = 0; k < j; ++k) value -= l[i][k] * l[j][k] * d[k];
      l[i][j] = value / d[j];
      d[i] -= l[i][j] * l[i][j] * d[j];
      y[i] -= l[i][j] * y[j];
    }
    if (!(d[i] > least)) d[i] = 0;
  }
  return of;
}

double BodyNorm::Moments::distortion(AnalysisKind kind) const {
  // Without nodes that count nothing is known of a motion, and the sum is zero as well.
  if (weight <= 0) return square;
  const auto explained_by = [&](std::size_t i) { return displacement[i] * displacement[i] / weight; };
  // A ring that widens does not move.
  if (kind == AnalysisKind::axisymmetric) return std::max(square - explained_by(1), 0.0);
  const Turning turns = turning(kind);
  double rest = square;
  // Translation and rotation are each taken off the whole: what they explain does not overlap about the
  // centre.
  for (std::size_t i = 0; i < 3; ++i) rest -= explained_by(i);
  // mᵀ I⁻¹ m = Σ y_i² / D_i.
  for (std::size_t i = 0; i < 3; ++i)
    if (turns.d[i] > 0) rest -= turns.y[i] * turns.y[i] / turns.d[i];
  // Rounding may leave a little less than nothing where a body only moves. A value that is not a number must
  // not be turned into zero.
  return std::isnan(rest) ? rest : std::max(rest, 0.0);
}

BodyNorm::Moments::Rigid BodyNorm::Moments::rigid(AnalysisKind kind) const {
  Rigid motion;
  if (weight <= 0) return motion;
  for (std::size_t i = 0; i < 3; ++i) {
    motion.centre[i] = place[i] / weight;
    if (kind != AnalysisKind::axisymmetric || i == 1) motion.translation[i] = displacement[i] / weight;
  }
  if (kind == AnalysisKind::axisymmetric) return motion;
  // I θ = m from the last to the first: Lᵀ θ = D⁻¹ y.
  const Turning turns = turning(kind);
  for (std::size_t i = 3; i-- > 0;) {
    if (turns.d[i] <= 0) continue;
    motion.rotation[i] = turns.y[i] / turns.d[i];
    for (std::size_t j = i + 1; j < 3; ++j) motion.rotation[i] -= turns.l[j][i] * motion.rotation[j];
  }
  return motion;
}

Point BodyNorm::Moments::Rigid::at(const Point& x) const {
  Point u = translation;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    u[i] += rotation[j] * (x[k] - centre[k]) - rotation[k] * (x[j] - centre[j]);
  }
  return u;
}

BodyNorm::BodyNorm(const mesh::Mesh& mesh, AnalysisKind kind)
    : mesh_(&mesh),
      kind_(kind),
      centre_(mesh.bodies.size()),
      n_bodies_(mesh.bodies.size()),
      n_nodes_(mesh.x.size()) {
  const auto n_owned = as_size(mesh.n_owned_nodes);
  // The volume that belongs to each node of each body, as shares of the body; and its centre.
  std::vector<std::vector<double>> weight(n_bodies_, std::vector<double>(n_owned, 0.0));
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const PackVector<Lane> nodal = mesh::nodal_weights(mesh, block, kind);
    const auto n_nodes = as_size(mesh::node_count(block.shape));
    for (Index e = 0; e < block.size(); ++e)
      for (std::size_t a = 0; a < n_nodes; ++a) {
        // Every element at an owned node is here, so its weight is whole without the other processes.
        const Index node = block.element(e)[a];
        if (node < mesh.n_owned_nodes)
          weight[as_size(block.body)][as_size(node)] +=
              nodal[as_size(e / k_lanes) * n_nodes + a][static_cast<int>(e % k_lanes)];
      }
  }
  for (std::size_t b = 0; b < n_bodies_; ++b) {
    // The volume is summed over processes, each of which has its own nodes.
    const double volume = parallel::global_sum(std::accumulate(weight[b].begin(), weight[b].end(), 0.0));
    for (std::size_t i = 0; i < n_owned; ++i)
      if (weight[b][i] > 0) shares_.push_back({as_index(i), static_cast<int>(b), weight[b][i] / volume});
  }
  // A centre is a sum over the nodes of all processes, and needed on each of them.
  for (const Share& share : shares_)
    for (std::size_t k = 0; k < 3; ++k)
      centre_[as_size(share.body)][k] += share.weight * mesh.x[as_size(share.node)][k];
  processes::sum(std::span(centre_.data()->data(), 3 * n_bodies_));
}

double BodyNorm::operator()(std::span<const double> values, std::span<const char> counts) const {
  const std::size_t width = n_nodes_ > 0 ? values.size() / n_nodes_ : 0;
  // Mean squares over each body by volume; the largest of all bodies is the norm.
  std::vector<double> square(n_bodies_, 0.0);
  for (const Share& share : shares_) {
    if (!counts.empty() && counts[as_size(share.node)] == 0) continue;
    for (std::size_t k = 0; k < width; ++k) {
      const double v = values[as_size(share.node) * width + k];
      square[as_size(share.body)] += share.weight * v * v;
    }
  }
  for (double& s : square) s = parallel::global_sum(s);
  return largest(square);
}

double BodyNorm::largest(const std::vector<double>& squares) const {
  double largest = 0;
  for (const double square : squares) {
    // A comparison with a value that is not a number is false, and the largest of the others would hide it.
    if (std::isnan(square)) return square;
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

template <class Take>
void BodyNorm::each_displaced(std::span<const double> displacement, std::span<const char> counts,
                              const Take& take) const {
  const auto width = as_size(displacement_components(kind_));
  // Places count from the centre of the body, which keeps the moments well conditioned.
  for (const Share& share : shares_) {
    const auto node = as_size(share.node), body = as_size(share.body);
    // Nodes that do not count have no part in the motion either.
    if (displacement.empty() || (!counts.empty() && counts[node] == 0)) continue;
    Point u{}, x = mesh_->x[node];
    for (std::size_t k = 0; k < width; ++k) u[k] = displacement[node * width + k];
    for (std::size_t k = 0; k < 3; ++k) x[k] -= centre_[body][k];
    take(share, x, u);
  }
}

std::vector<BodyNorm::Moments> BodyNorm::moments(std::span<const double> displacement,
                                                 std::span<const char> counts) const {
  std::vector<Moments> moments(n_bodies_);
  each_displaced(displacement, counts, [&](const Share& share, const Point& x, const Point& u) {
    moments[as_size(share.body)].add(share.weight, x, u);
  });
  // The moments go between processes as plain numbers, whose count has to be that of the structure.
  static_assert(sizeof(Moments) == Moments::k_size * sizeof(double));
  processes::sum(std::span(reinterpret_cast<double*>(moments.data()), Moments::k_size * n_bodies_));
  return moments;
}

double BodyNorm::of_distortion(std::span<const double> displacement, std::span<const char> counts) const {
  std::vector<double> square;
  for (const Moments& of_body : moments(displacement, counts)) square.push_back(of_body.distortion(kind_));
  return largest(square);
}

double BodyNorm::farthest_distortion(std::span<const double> displacement,
                                     std::span<const char> counts) const {
  std::vector<Moments::Rigid> rigid;
  for (const Moments& of_body : moments(displacement, counts)) rigid.push_back(of_body.rigid(kind_));
  // The distance of each node from where the rigid motion of its body would have it.
  double farthest = 0;
  each_displaced(displacement, counts, [&](const Share& share, const Point& x, const Point& u) {
    const Point moved = rigid[as_size(share.body)].at(x);
    const double distance = std::hypot(u[0] - moved[0], u[1] - moved[1], u[2] - moved[2]);
    // A distance that is not a number stays.
    if (!std::isnan(farthest) && !(distance <= farthest)) farthest = distance;
  });
  return parallel::global_max(farthest);
}

double BodyNorm::mean(std::span<const double> values) const {
  std::vector<double> sum(n_bodies_, 0.0);
  for (const Share& share : shares_) sum[as_size(share.body)] += share.weight * values[as_size(share.node)];
  double largest = 0;
  for (const double s : sum) {
    // The magnitude is taken after the sum: in a mean, what is above and below cancels.
    const double mean = std::abs(parallel::global_sum(s));
    if (std::isnan(mean)) return mean;
    largest = std::max(largest, mean);
  }
  return largest;
}

}  // namespace solidus::coupling
