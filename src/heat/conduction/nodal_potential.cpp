/// Nodes of one material use its potential directly; nodes of several invert the sum of theirs by Newton's
/// method.
#include "heat/conduction/nodal_potential.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

NodalPotential::NodalPotential(const mesh::Mesh& mesh, std::span<const KirchhoffPotential> potentials,
                               const linear::ActiveSet& active)
    : potentials_(potentials),
      identity_(std::all_of(potentials.begin(), potentials.end(),
                            [](const KirchhoffPotential& u) { return u.constant(); })) {
  // With constant conductivities the potential is the temperature times a constant everywhere, and nothing
  // has to be looked up.
  if (identity_) return;
  const auto n = as_size(mesh.n_owned_nodes);
  // The bodies of a node are needed in rising order, in a list of rows: a node that several materials share
  // has a potential of each.
  const auto for_bodies = [&](const auto& take) {  // in rising order, with their owned nodes
    for (std::size_t body = 0; body < mesh.bodies.size(); ++body) {
      std::vector<char> there(mesh.x.size(), 0);
      for (const mesh::ElementBlock& block : mesh.blocks)
        if (as_size(block.body) == body && active.body(block.body))
          for (const Index node : block.nodes) there[as_size(node)] = 1;
      for (std::size_t i = 0; i < n; ++i)
        if (there[i] != 0) take(i, static_cast<int>(body));
    }
  };
  // The first pass over the bodies counts, the second fills in.
  start_.assign(n + 1, 0);
  for_bodies([&](std::size_t node, int) { ++start_[node + 1]; });
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  bodies_.resize(as_size(start_.back()));
  std::vector<Index> next(start_.begin(), start_.end() - 1);
  for_bodies([&](std::size_t node, int body) { bodies_[as_size(next[node]++)] = body; });
  // Where every node of the process has one and the same body, the list is given up for its number alone.
  const bool alike = n > 0 && std::adjacent_find(start_.begin(), start_.end(),
                                                 [](Index a, Index b) { return b != a + 1; }) == start_.end();
  if (!alike || std::any_of(bodies_.begin(), bodies_.end(), [&](int b) { return b != bodies_.front(); }))
    return;
  std::vector<Index>().swap(start_);
  bodies_ = std::vector<int>(1, bodies_.front());
}

double NodalPotential::value(Index node, double temperature) const {
  if (identity_) return temperature;
  const auto list = bodies(node);
  if (list.empty()) return temperature;
  double sum = 0;
  for (const int body : list) {
    const KirchhoffPotential& u = potentials_[as_size(body)];
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
    const KirchhoffPotential& u = potentials_[as_size(body)];
    sum += u.constant() ? 1.0 : u.conductivity(temperature) / u.reference();
  }
  return sum / static_cast<double>(list.size());
}

double NodalPotential::temperature(Index node, double value, double near) const {
  // Where all conductivities are constant and alike v is Θ itself.
  if (identity_) return value;
  const auto list = bodies(node);
  if (list.empty()) return value;
  // A node of one body is inverted in closed form.
  if (list.size() == 1) {
    const KirchhoffPotential& u = potentials_[as_size(list.front())];
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
