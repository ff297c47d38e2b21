#include "heat/nodal_potential.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::heat {

NodalPotential::NodalPotential(const mesh::Mesh& mesh, std::span<const KirchhoffPotential> potentials,
                               const linear::ActiveSet& active)
    : potentials_(potentials),
      identity_(std::all_of(potentials.begin(), potentials.end(),
                            [](const KirchhoffPotential& u) { return u.constant(); })) {
  if (identity_) return;
  std::vector<std::pair<Index, int>> pairs;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (!active.body(block.body)) continue;
    std::vector<Index> nodes = block.nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const Index node : nodes)
      if (node < mesh.n_owned_nodes) pairs.emplace_back(node, block.body);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  start_.assign(static_cast<std::size_t>(mesh.n_owned_nodes) + 1, 0);
  bodies_.reserve(pairs.size());
  for (const auto& [node, body] : pairs) {
    ++start_[static_cast<std::size_t>(node) + 1];
    bodies_.push_back(body);
  }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
}

double NodalPotential::value(Index node, double temperature) const {
  if (identity_) return temperature;
  const auto list = bodies(node);
  if (list.empty()) return temperature;
  double sum = 0;
  for (const int body : list) {
    const KirchhoffPotential& u = potentials_[static_cast<std::size_t>(body)];
    sum += u.constant() ? temperature : u.value(temperature) / u.reference();
  }
  return sum / static_cast<double>(list.size());
}

double NodalPotential::slope(Index node, double temperature) const {
  if (identity_) return 1.0;
  const auto list = bodies(node);
  if (list.empty()) return 1.0;
  double sum = 0;
  for (const int body : list) {
    const KirchhoffPotential& u = potentials_[static_cast<std::size_t>(body)];
    sum += u.constant() ? 1.0 : u.conductivity(temperature) / u.reference();
  }
  return sum / static_cast<double>(list.size());
}

double NodalPotential::temperature(Index node, double value, double near) const {
  if (identity_) return value;
  const auto list = bodies(node);
  if (list.empty()) return value;
  if (list.size() == 1) {
    const KirchhoffPotential& u = potentials_[static_cast<std::size_t>(list.front())];
    return u.constant() ? value : u.temperature(value * u.reference());
  }
  // v rises and is smooth but for its slope's bends: Newton's method, within a bracket once there is one.
  constexpr int k_trials = 60;
  constexpr double k_rounding = 1e-15;
  double low = -HUGE_VAL, high = HUGE_VAL, t = near;
  for (int trial = 0; trial < k_trials; ++trial) {
    const double defect = this->value(node, t) - value;
    if (defect == 0) break;
    (defect > 0 ? high : low) = t;
    double next = t - defect / slope(node, t);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (!std::isfinite(next) || std::abs(next - t) <= k_rounding * std::abs(t)) break;
    t = next;
  }
  return t;
}

std::size_t NodalPotential::bytes() const {
  return start_.capacity() * sizeof start_[0] + bodies_.capacity() * sizeof bodies_[0];
}

}  // namespace solidus::heat
