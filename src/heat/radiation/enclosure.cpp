/// Sums over the nodes of clusters, one linear system for all of them that every process solves, and its
/// answer back at the nodes.
#include "heat/radiation/enclosure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/stopwatch.hpp"

namespace solidus::heat {

namespace {

constexpr double k_solved = 1e-14, k_accepted = 1e-11;  ///< residuals, of the right-hand side
constexpr int k_most_iterations = 500;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Enclosure::Enclosure(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const mesh::Surface> surfaces,
                     const EnclosureOptions& options)
    : mesh_(mesh), ghosts_(mesh) {
  const Stopwatch watch(seconds_);
  const RadiatingFaces faces = radiating_faces(mesh, kind, surfaces, options.most_clusters);
  n_faces_ = faces.all.size();
  if (n_faces_ == 0) return;
  if (faces.twice)
    throw InputError(
        {},
        fmt::format("two surfaces that see each other have a face in common, at ({:.4g}, {:.4g}, "
                    "{:.4g}) m",
                    (*faces.twice)[0], (*faces.twice)[1], (*faces.twice)[2]),
        "each face in one of the surfaces with radiation = \"enclosure\"");
  const std::size_t rays =
      std::clamp(options.rays_in_all / faces.n_clusters, options.least_rays, options.most_rays);
  factors_ = heat::view_factors(faces, kind, rays);
  surface_of_.resize(faces.n_clusters);
  for (const RadiatingFace& face : faces.all) surface_of_[face.cluster] = face.surface;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    shares_.push_back(shares_of(surfaces[k], kind, faces, faces.of_surface[k]));
}

/// The weights of the closed rule, ∫ N dA of each face, with which surfaces take heat too.
std::vector<Enclosure::Share> Enclosure::shares_of(const mesh::Surface& surface, AnalysisKind kind,
                                                   const RadiatingFaces& faces,
                                                   const std::vector<std::size_t>& numbers) const {
  std::vector<Share> shares;
  std::size_t number = 0;
  for (const mesh::ElementBlock& block : surface.faces) {
    const mesh::FaceGeometry g(mesh_, block, kind,
                               mesh::gauss_rule(block.shape, 2 * mesh::order(block.shape) + 1));
    for (Index f = 0; f < g.n_faces; ++f, ++number)
      for (int a = 0; a < g.n_nodes; ++a) {
        const Index node = block.element(f)[a];
        if (node >= mesh_.n_owned_nodes) continue;
        double weight = 0;
        for (int q = 0; q < g.n_points; ++q)
          weight += g.weight[as_size(f * g.n_points + q)] * g.values[as_size(q * g.n_nodes + a)];
        shares.push_back({node, faces.all[numbers[number]].cluster, weight});
      }
  }
  return shares;
}

std::vector<double> Enclosure::irradiation(std::span<const double> temperature,
                                           std::span<const EnclosureSurface> surfaces) {
  if (n_faces_ == 0) return {};
  // What the clusters emit and how much of what falls on them they take, as areas, over all processes.
  const std::size_t n = factors_.size();
  std::vector<double> sums(2 * n, 0.0);
  for (std::size_t s = 0; s < shares_.size(); ++s)
    for (const Share& share : shares_[s]) {
      const double t = temperature[as_size(share.node)];
      const double taken = share.weight * surfaces[s].emissivity(t);
      sums[share.cluster] += taken * t * t * t * t;
      sums[n + share.cluster] += taken;
    }
  processes::sum(std::span<double>(sums));
  // The same per area, and what comes in through the opening.
  std::vector<double> emitted(n), emissivity(n), from_outside(n);
  for (std::size_t c = 0; c < n; ++c) {
    emitted[c] = sums[c] / factors_.area[c];
    emissivity[c] = std::clamp(sums[n + c] / factors_.area[c], 0.0, 1.0);
    from_outside[c] = factors_.open[c] * surfaces[as_size(surface_of_[c])].environment;
  }
  return solve(emitted, emissivity, from_outside);
}

std::vector<std::vector<double>> Enclosure::at_nodes(const std::vector<double>& on_clusters) const {
  // A node takes the mean of its faces by its shares of them.
  std::vector<std::vector<double>> fourth(shares_.size(), std::vector<double>(mesh_.x.size(), 0.0));
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    std::vector<double> weight(mesh_.x.size(), 0.0);
    for (const Share& share : shares_[s]) {
      const auto node = as_size(share.node);
      fourth[s][node] += share.weight * on_clusters[share.cluster];
      weight[node] += share.weight;
    }
    for (std::size_t i = 0; i < weight.size(); ++i)
      if (weight[i] != 0) fourth[s][i] /= weight[i];
    ghosts_.update(fourth[s], 1);
  }
  return fourth;
}

/// Finds y of the symmetric and positive definite system
///   (A − √(1 − ε) S √(1 − ε)) y = r
/// by conjugate gradients, scaled by the areas, which are its diagonal but for what a cluster sees of itself.
std::vector<double> Enclosure::reflected(const std::vector<double>& root, std::vector<double> r) const {
  const std::size_t n = factors_.size();
  const auto apply = [&](const std::vector<double>& x) {
    std::vector<double> scaled(n);
    for (std::size_t c = 0; c < n; ++c) scaled[c] = root[c] * x[c];
    std::vector<double> result = factors_.multiply(scaled);
    for (std::size_t c = 0; c < n; ++c) result[c] = factors_.area[c] * x[c] - root[c] * result[c];
    return result;
  };
  std::vector<double> y(n, 0.0), z(n);
  const auto scale = [&] {
    for (std::size_t c = 0; c < n; ++c) z[c] = r[c] / factors_.area[c];
  };
  scale();
  std::vector<double> p = z;
  // It starts from zero each time, so that a run that is restarted finds the same numbers.
  const double first = dot(r, z), enough = k_solved * k_solved * first;
  double product = first;
  for (int i = 0; i < k_most_iterations && product > enough; ++i) {
    const std::vector<double> applied = apply(p);
    const double step = product / dot(p, applied);
    for (std::size_t c = 0; c < n; ++c) {
      y[c] += step * p[c];
      r[c] -= step * applied[c];
    }
    scale();
    const double next = dot(r, z);
    for (std::size_t c = 0; c < n; ++c) p[c] = z[c] + next / product * p[c];
    product = next;
  }
  // Rounding may end the iteration above what was asked for, but not far above it.
  if (!(product <= k_accepted * k_accepted * first))
    throw StepRejected("radiation between surfaces: its balance is not found", {}, Failure::linear_solver);
  return y;
}

/// G/σ of the clusters, from y = √(1 − ε) G/σ with the right-hand side √(1 − ε) (S M + E Θ_∞⁴).
std::vector<double> Enclosure::solve(const std::vector<double>& emitted,
                                     const std::vector<double>& emissivity,
                                     const std::vector<double>& from_outside) {
  const std::size_t n = factors_.size();
  std::vector<double> root(n), r = factors_.multiply(emitted);
  for (std::size_t c = 0; c < n; ++c) {
    root[c] = std::sqrt(1 - emissivity[c]);
    r[c] = root[c] * (r[c] + from_outside[c]);
  }
  const std::vector<double> y = reflected(root, std::move(r));
  // What leaves the clusters, and what of it falls on each.
  std::vector<double> leaving(n);
  for (std::size_t c = 0; c < n; ++c) leaving[c] = emitted[c] + root[c] * y[c];
  std::vector<double> on = factors_.multiply(leaving);
  double out = 0;
  for (std::size_t c = 0; c < n; ++c) {
    on[c] = (on[c] + from_outside[c]) / factors_.area[c];
    out += factors_.open[c] * leaving[c] - from_outside[c];
  }
  to_environment_ = k_stefan_boltzmann * out;
  return on;
}

std::size_t Enclosure::bytes() const {
  std::size_t total = factors_.bytes();
  for (const auto& shares : shares_) total += shares.capacity() * sizeof(Share);
  return total;
}

}  // namespace solidus::heat
