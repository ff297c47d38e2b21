/// The difference of plastic flow between two solutions becomes a stress by the elastic moduli, less what
/// creep itself relaxes within the step.
#include "mechanics/creep_error.hpp"

#include <algorithm>
#include <cmath>

#include "material/laws/perzyna.hpp"
#include "material/viscoplastic.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/tensor.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

constexpr std::size_t k_stress_components = 6;
/// Of 2G: a casting keeps stresses far above it, hot metal flows under lower ones in any step.
constexpr double k_least_stress = 2e-4;

Sym<double> tensor(const Lane* at, int lane) {
  return {at[0][lane], at[1][lane], at[2][lane], at[3][lane], at[4][lane], at[5][lane]};
}

bool creeps(const material::Material& material) {
  return material.flow && material.external == nullptr && !material.flow->rate_independent();
}

/// The share of an error of ε^vp that is left in s/2G after the step and a further one.
double share_left(const material::Flow& flow, const material::Viscoplastic::Properties<double>& p,
                  double rate, double dt) {
  if (rate <= 0) return 1;
  const double slope = material::overstress<double>(flow.rate_dependence, p.flow, rate).slope;
  if (!std::isfinite(slope)) return 1;
  const double left = slope / (slope + 2 * p.elastic.shear * dt);
  return left * left;
}

/// The larger of the rates at a point in a step and in the one before: where flow ends it has answered to its
/// error until then.
double largest_rate(const BlockHistory& rate, const CreepField& before, std::size_t block, std::size_t at,
                    int lane) {
  const double now = norm(tensor(rate.values.data() + at, lane));
  if (block >= before.size() || before[block].values.size() != rate.values.size()) return now;
  return std::max(now, norm(tensor(before[block].values.data() + at, lane)));
}

}  // namespace

CreepError::CreepError(const MechanicalPhase& phase) : phase_(phase) {
  // Only blocks whose law flows by a rate have such an error. Volumes of elements are those of their nodal
  // weights.
  const mesh::Mesh& mesh = phase.mesh();
  for (const mesh::ElementBlock& block : mesh.blocks) {
    Block& b = blocks_.emplace_back();
    const material::Material& material = phase.bodies().material(block.body);
    b.creeps = creeps(material);
    if (!b.creeps) continue;
    any_ = true;
    b.first = material.solidification() != nullptr ? k_stress_components : 0;  // behind ε^v (law_parts.cpp)
    const PackVector<Lane> nodal = mesh::nodal_weights(mesh, block, phase.bodies().kind);
    // Nodal weights of an element sum to its volume.
    const auto n_nodes = as_size(mesh::node_count(block.shape));
    for (std::size_t e = 0; e < as_size(block.n_counted); ++e) {
      double volume = 0;
      for (std::size_t a = 0; a < n_nodes; ++a)
        volume += nodal[e / k_lanes * n_nodes + a][static_cast<int>(e % k_lanes)];
      b.volume.push_back(volume);
    }
  }
}

CreepField CreepError::flow(const MechanicalState& from, const MechanicalState& to, double factor) const {
  // The flow of a step is the difference of the viscoplastic strain in both histories, times a factor (a
  // rate, or a share of the step).
  CreepField field(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!blocks_[b].creeps || b >= to.history.size() || b >= from.history.size()) continue;
    const BlockHistory &old = from.history[b], &now = to.history[b];
    const auto width = as_size(now.n_components);
    if (old.values.size() != now.values.size()) continue;
    const std::size_t n = width > 0 ? now.values.size() / width : 0;  // none where a process has no element
    field[b] = {static_cast<int>(k_stress_components), now.n_points, {}};
    field[b].values.assign(n * k_stress_components, Lane(0.0));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < k_stress_components; ++k) {
        const std::size_t at = i * width + blocks_[b].first + k;
        field[b].values[i * k_stress_components + k] = Lane(factor) * (now.values[at] - old.values[at]);
      }
  }
  return field;
}

CreepField CreepError::error(const CreepField& rate, const CreepField& before, double dt) {
  CreepField error = rate;
  for (std::size_t b = 0; b < error.size(); ++b) {
    if (b >= before.size() || before[b].values.size() != error[b].values.size()) {
      error[b] = {};
      continue;
    }
    // Half of the step times the change of the rate, as of backward Euler.
    for (std::size_t i = 0; i < error[b].values.size(); ++i)
      error[b].values[i] = Lane(dt / 2) * (rate[b].values[i] - before[b].values[i]);
  }
  return error;
}

double CreepError::of_stress(const CreepField& error, const CreepField& rate, const CreepField& before,
                             std::span<const double> temperature, const MechanicalState& now,
                             double dt) const {
  const mesh::Mesh& mesh = phase_.mesh();
  // The error of the viscoplastic strain in a step makes an error 2G δε^vp of the stress. Its root mean
  // square over a body is compared with that of the deviator.
  std::vector<double> sums(2 * mesh.bodies.size(), 0.0);  // of the squares of δs and of s, [body]
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    // Blocks without flow, or whose stress is not stored, have nothing to compare.
    if (b >= error.size() || error[b].values.empty()) continue;
    if (b >= now.elements.size() || !now.elements[b]) continue;
    std::vector<double> stress(as_size(block.size()) * k_stress_components);
    now.elements[b]->get(ElementField::stress, stress);
    const material::Material& material = phase_.bodies().material(block.body);
    const material::Viscoplastic law(material);
    const auto n_points = as_size(error[b].n_points);
    const auto n_nodes = as_size(mesh::node_count(block.shape));
    for (std::size_t e = 0; e < blocks_[b].volume.size(); ++e) {
      // Properties are those of the element's mean temperature. What is not wholly solid is left out: its
      // stress follows the flow at once.
      double theta = 0;
      const Index* nodes = block.element(as_index(e));
      for (std::size_t a = 0; a < n_nodes; ++a)
        theta += temperature[as_size(nodes[a])] / static_cast<double>(n_nodes);
      const auto p = law.properties_at<double>(theta, theta);
      if (p.elastic.solid_fraction < 1) continue;
      const double two_g = 2 * p.elastic.shear, volume = blocks_[b].volume[e];
      const double* s = stress.data() + e * k_stress_components;
      const Sym<double> deviator = dev(Sym<double>{s[0], s[1], s[2], s[3], s[4], s[5]});
      // A least stress keeps elements without stress from counting as infinitely wrong.
      const double least = k_least_stress * two_g;
      double square = 0;
      // The error at each point is reduced by what relaxation leaves of it within this step and the next.
      for (std::size_t q = 0; q < n_points; ++q) {
        const std::size_t at = (e / k_lanes * n_points + q) * k_stress_components;
        const int lane = static_cast<int>(e % k_lanes);
        const double left = two_g * norm(tensor(error[b].values.data() + at, lane)) *
                            share_left(*material.flow, p, largest_rate(rate[b], before, b, at, lane), dt);
        square += left * left / static_cast<double>(n_points);
      }
      const auto body = 2 * as_size(block.body);
      sums[body] += volume * square;
      sums[body + 1] += volume * (dot(deviator, deviator) + least * least);
    }
  }
  // The largest ratio of all bodies is the error. One that is not a number is passed on, so that the step is
  // rejected.
  processes::sum(std::span(sums));
  double largest = 0;
  for (std::size_t body = 0; body < sums.size(); body += 2) {
    if (std::isnan(sums[body])) return sums[body];
    if (sums[body + 1] > 0) largest = std::max(largest, std::sqrt(sums[body] / sums[body + 1]));
  }
  return largest;
}

}  // namespace solidus::mechanics
