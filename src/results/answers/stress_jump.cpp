/// Stress of elements against its mean at the nodes, by body, from sums over all processes.
#include "results/answers/stress_jump.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/quantities.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "results/fields/spots.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

using Deviator = std::array<double, 6>;  ///< xx, yy, zz, xy, yz, xz

Deviator deviator(const FieldValues& stress, std::size_t element) {
  Deviator s;
  for (std::size_t i = 0; i < 6; ++i) s[i] = stress[6 * element + i];
  const double mean = (s[0] + s[1] + s[2]) / 3;
  for (std::size_t i = 0; i < 3; ++i) s[i] -= mean;
  return s;
}

double square(const Deviator& s) {
  return s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

struct NodeSum {
  double volume = 0;
  Deviator stress{};
};

/// Σ V |s|² of a body, and what of it the means at its nodes explain, on this process.
std::array<double, 2> sums_of_body(const mesh::Mesh& mesh, AnalysisKind kind, int body,
                                   const FieldValues& stress) {
  std::array<double, 2> sums{};
  std::vector<NodeSum> nodes(as_size(mesh.n_owned_nodes));
  std::size_t first = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const std::size_t begin = first;
    // Element values lie block after block, those of other bodies too.
    first += as_size(block.size());
    if (block.body != body) continue;
    const PackVector<Lane> integrals = mesh::basis_integrals(mesh, block, kind);
    const auto n = as_size(mesh::node_count(block.shape));
    // Each element adds its deviator to its nodes; what the nodal means do not explain is the jump between
    // elements.
    for (Index e = 0; e < block.size(); ++e) {
      double volume = 0;
      for (std::size_t a = 0; a < n; ++a) volume += integrals[as_size(e / k_lanes) * n + a][e % k_lanes];
      const Deviator s = deviator(stress, begin + as_size(e));
      const double share = volume / static_cast<double>(n);
      for (std::size_t a = 0; a < n; ++a) {
        const Index node = block.element(e)[a];
        if (node >= mesh.n_owned_nodes) continue;
        NodeSum& sum = nodes[as_size(node)];
        sum.volume += share;
        for (std::size_t i = 0; i < 6; ++i) sum.stress[i] += share * s[i];
        sums[0] += share * square(s);
      }
    }
  }
  // V |s|² of the nodal means: what they explain of the sum.
  for (const NodeSum& sum : nodes)
    if (sum.volume > 0) sums[1] += square(sum.stress) / sum.volume;
  return sums;
}

/// Whether a body has elements of first order alone.
bool of_first_order(const mesh::Mesh& mesh, int body) {
  return std::ranges::none_of(mesh.blocks, [&](const mesh::ElementBlock& block) {
    return block.body == body && mesh::node_count(block.shape) > mesh::vertex_count(block.shape);
  });
}

}  // namespace

std::vector<double> stress_jumps(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields) {
  const FieldValues stress(fields, mechanics::fields::k_stress.name);
  if (fields.find(mechanics::fields::k_stress.name) == nullptr) return {};
  std::vector<double> jumps;
  for (int body = 0; body < static_cast<int>(mesh.bodies.size()); ++body) {
    std::array<double, 2> sums = sums_of_body(mesh, kind, body, stress);
    processes::sum(std::span(sums));
    jumps.push_back(sums[0] > 0 ? std::sqrt(std::max(0.0, 1 - sums[1] / sums[0])) : 0.0);
  }
  return jumps;
}

void tell_stress_jumps(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields,
                       std::span<const CastBody> castings) {
  constexpr double k_much = 0.5;
  // The share of the stress that neighbouring elements disagree about, for each body.
  const std::vector<double> jumps = stress_jumps(mesh, kind, fields);
  // Only elements of first order are meant, as those of second order follow bending.
  for (std::size_t b = 0; b < jumps.size(); ++b) {
    if (!(jumps[b] > k_much) || !of_first_order(mesh, static_cast<int>(b))) continue;
    const auto cast = std::ranges::find(castings, static_cast<int>(b), &CastBody::body);
    const bool freezes = cast != castings.end();
    logging::info(
        "'{}': stress jumps by {:.0f} % of its size between its elements, which are of first order: they "
        "bend "
        "too stiffly, and take gradients of temperature for stress; {}",
        freezes ? cast->name : mesh.bodies[b].name, 100 * jumps[b],
        freezes ? "smaller ones come closer"
                : "elements of second order (mesh.order = 2) follow both, smaller ones of first order come "
                  "closer");
  }
}

}  // namespace solidus::results
