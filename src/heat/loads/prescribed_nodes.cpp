#include "heat/loads/prescribed_nodes.hpp"

#include <algorithm>

#include "heat/loads/temperature_range.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

PrescribedNodes::PrescribedNodes(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                                 const std::vector<PrescribedTemperature>& conditions)
    : n_owned_(mesh.n_owned_nodes) {
  // A node may be in several groups; the condition that comes last holds it.
  std::vector<int> holder(mesh.x.size(), -1);  // the later condition in the list holds
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (Index node : named_group(mesh.node_sets, conditions[i].node_set, "group"))
      holder[as_size(node)] = static_cast<int>(i);
  for (const PrescribedTemperature& c : conditions) prescribed_.push_back({c.name, c.value, {}, {}, {}});
  fixed_.assign(mesh.x.size(), 0);
  for (std::size_t node = 0; node < holder.size(); ++node) {
    // Nodes of absent bodies have no equation, and are fixed.
    if (!active.node(as_index(node))) {
      fixed_[node] = 1;
      continue;
    }
    if (holder[node] < 0) continue;
    fixed_[node] = 1;
    Prescribed& p = prescribed_[as_size(holder[node])];
    p.nodes.push_back(as_index(node));
    if (!p.value.uniform()) p.x.push_back(mesh.x[node]);
  }
  for (Prescribed& p : prescribed_) p.now.resize(p.nodes.size());
}

bool PrescribedNodes::placed() const {
  return std::ranges::any_of(prescribed_, [](const Prescribed& p) { return !p.value.uniform(); });
}

void PrescribedNodes::set_time(double time) {
  for (Prescribed& p : prescribed_) p.value.values(p.x, time, p.now);
}

void PrescribedNodes::prescribe(std::span<double> temperature) const {
  for (const Prescribed& p : prescribed_)
    for (std::size_t k = 0; k < p.nodes.size(); ++k) temperature[as_size(p.nodes[k])] = p.now[k];
}

TemperatureRange PrescribedNodes::range() const {
  TemperatureRange range;
  for (const Prescribed& p : prescribed_)
    for (const double temperature : p.now) range = united(range, {temperature, temperature});
  return range;
}

std::vector<NamedPower> PrescribedNodes::reaction_powers(std::span<const double> reactions) const {
  std::vector<NamedPower> all;
  for (const Prescribed& p : prescribed_) {
    double sum = 0;
    for (Index node : p.nodes)
      if (node < n_owned_) sum += reactions[as_size(node)];
    all.push_back({p.name, parallel::global_sum(sum)});
  }
  return all;
}

}  // namespace solidus::heat
