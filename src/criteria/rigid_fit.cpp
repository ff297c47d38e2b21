/// Volume, centre and inertia of each body once; a fit is then two sums over its nodes.
#include "criteria/rigid_fit.hpp"

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

using mesh::Point;

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Inverts a symmetric positive definite matrix, given by rows.
std::array<Point, 3> inverse(const std::array<Point, 3>& m) {
  const std::array<Point, 3> adjugate{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
  const double determinant = dot(m[0], adjugate[0]);
  std::array<Point, 3> r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = adjugate[j][i] / determinant;
  return r;
}

template <std::size_t n>
std::array<double, n> global_sums(std::array<double, n> numbers) {
  processes::sum(numbers);
  return numbers;
}

}  // namespace

Point SmallMotion::at(const Point& x) const {
  const Point turned = cross(rotation, {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]});
  return {translation[0] + turned[0], translation[1] + turned[1], translation[2] + turned[2]};
}

RigidFit::RigidFit(const mesh::Mesh& mesh, AnalysisKind kind)
    : mesh_(mesh), kind_(kind), bodies_(mesh.bodies.size()) {
  // The fit needs volume, centre and inertia of each body, summed over the counted elements of all processes.
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    OfBody& body = bodies_[b];
    std::vector<double> volume(mesh.x.size(), 0.0);
    // Nodal volumes of counted elements: each element once over all processes.
    for (const mesh::ElementBlock& block : mesh.blocks) {
      if (block.body != static_cast<int>(b)) continue;
      const PackVector<Lane> weights = mesh::nodal_weights(mesh, block, kind);
      const auto n = as_size(mesh::node_count(block.shape));
      for (Index e = 0; e < block.n_counted; ++e)
        for (std::size_t a = 0; a < n; ++a)
          volume[as_size(block.element(e)[a])] += weights[as_size(e / k_lanes) * n + a][e % k_lanes];
    }
    // Nodes without volume in this body are left out; the fourth sum is the volume itself.
    std::array<double, 4> first{};
    for (std::size_t node = 0; node < volume.size(); ++node) {
      if (volume[node] == 0) continue;
      body.nodes.push_back(as_index(node));
      body.volume.push_back(volume[node]);
      first[3] += volume[node];
      for (std::size_t i = 0; i < 3; ++i) first[i] += volume[node] * mesh.x[node][i];
    }
    first = global_sums(first);
    body.total = first[3];
    if (!(body.total > 0)) continue;  // nothing of it is active yet
    for (std::size_t i = 0; i < 3; ++i) body.centre[i] = first[i] / first[3];

    // The inertia tensor about the centre gives the rotation that fits best: fully in space, about the normal
    // in a plane, none around an axis.
    std::array<double, 9> inertia{};
    for (std::size_t k = 0; k < body.nodes.size(); ++k) {
      Point r = mesh.x[as_size(body.nodes[k])];
      for (std::size_t i = 0; i < 3; ++i) r[i] -= body.centre[i];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          inertia[3 * i + j] += body.volume[k] * ((i == j ? dot(r, r) : 0.0) - r[i] * r[j]);
    }
    inertia = global_sums(inertia);
    std::array<Point, 3> tensor{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) tensor[i][j] = inertia[3 * i + j];
    // In the plane only the rotation about z can be seen.
    if (kind == AnalysisKind::solid)
      body.inverse_inertia = inverse(tensor);
    else if (kind == AnalysisKind::plane_strain)
      body.inverse_inertia[2][2] = 1 / tensor[2][2];
  }
}

std::vector<SmallMotion> RigidFit::fit(std::span<const double> displacement) const {
  const auto components = as_size(displacement_components(kind_));
  std::vector<SmallMotion> motions;
  for (const OfBody& body : bodies_) {
    // Mean displacement and moment of the displacements about the centre.
    std::array<double, 6> sums{};
    for (std::size_t k = 0; k < body.nodes.size(); ++k) {
      const auto node = as_size(body.nodes[k]);
      Point u{}, r = mesh_.x[node];
      for (std::size_t i = 0; i < components; ++i) u[i] = displacement[node * components + i];
      for (std::size_t i = 0; i < 3; ++i) r[i] -= body.centre[i];
      const Point moment = cross(r, u);
      for (std::size_t i = 0; i < 3; ++i) {
        sums[i] += body.volume[k] * u[i];
        sums[3 + i] += body.volume[k] * moment[i];
      }
    }
    sums = global_sums(sums);
    SmallMotion motion;
    if (!(body.total > 0)) {
      motions.push_back(motion);
      continue;
    }
    motion.centre = body.centre;
    // With the inertia they give the translation and rotation of least squares.
    for (std::size_t i = 0; i < 3; ++i) {
      motion.translation[i] = sums[i] / body.total;
      motion.rotation[i] = dot(body.inverse_inertia[i], {sums[3], sums[4], sums[5]});
    }
    // A ring that widens does not move.
    if (kind_ == AnalysisKind::axisymmetric) motion.translation[0] = 0;
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace solidus::criteria
