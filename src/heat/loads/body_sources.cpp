/// Heat that is made within bodies: how the power of a source is shared out over the nodes.
#include "heat/loads/body_sources.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

int body_named(const mesh::Mesh& mesh, const std::string& name) {
  std::map<std::string, int> bodies;
  for (std::size_t i = 0; i < mesh.bodies.size(); ++i) bodies[mesh.bodies[i].name] = static_cast<int>(i);
  return named_group(bodies, name, "body");
}

}  // namespace

BodySources::BodySources(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                         std::span<const char> at_nodes, const ThermalConditions& conditions) {
  const Where where{mesh, kind, active, at_nodes};
  add_sources(where, conditions.sources);
  add_burning(where, conditions.exothermics);
  powers_.resize(sources_.size());
}

// Spread over the nodes as their heat is stored, so that a uniform source warms them alike.
void BodySources::add_sources(const Where& where, const std::vector<Source>& sources) {
  for (const Source& source : sources) {
    const int body = body_named(where.mesh, source.body);
    Volume volume{.name = source.name, .power = source.power, .factor = source.factor};
    add_nodal_shares(where, body, volume);
    if (volume.placed()) place(where, body, volume);
    volume.heat.resize(as_size(where.mesh.n_owned_nodes));
    sources_.push_back(std::move(volume));
  }
}

void BodySources::add_burning(const Where& where, const std::vector<Exothermic>& exothermics) {
  // A sleeve is a source whose power follows from the state of its nodes. A node of several sleeves ignites
  // at the lowest of their temperatures.
  if (!exothermics.empty()) ignition_.assign(where.mesh.x.size(), HUGE_VAL);
  for (const Exothermic& burning : exothermics) {
    const int body = body_named(where.mesh, burning.body);
    Volume volume{.name = burning.name, .power = 0.0, .factor = 1.0};
    volume.burning = burning;
    add_nodal_shares(where, body, volume);
    volume.heat.resize(as_size(where.mesh.n_owned_nodes));
    sources_.push_back(std::move(volume));
    if (!where.active.body(body)) continue;
    for (const mesh::ElementBlock& block : where.mesh.blocks)
      if (block.body == body)
        for (const Index node : block.nodes) {
          double& lowest = ignition_[as_size(node)];
          lowest = std::min(lowest, burning.ignition);
        }
  }
}

void BodySources::add_nodal_shares(const Where& where, int body, Volume& volume) {
  // The share of a node is the integral of its shape function over the body, or the lumped weight where heat
  // is stored at the nodes.
  std::vector<double> weight(as_size(where.mesh.n_owned_nodes), 0.0);
  // Weights are computed for eight elements at a time; only nodes of this process are kept.
  for (const mesh::ElementBlock& block : where.mesh.blocks) {
    if (block.body != body || !where.active.body(body)) continue;
    const PackVector<Lane> weights = where.at_nodes[as_size(body)] != 0
                                         ? mesh::nodal_weights(where.mesh, block, where.kind)
                                         : mesh::basis_integrals(where.mesh, block, where.kind);
    const int n = mesh::node_count(block.shape);
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < n; ++a) {
        const Index node = block.element(e)[a];
        if (node < where.mesh.n_owned_nodes)
          weight[as_size(node)] += weights[as_size(e / k_lanes * n + a)][e % k_lanes];
      }
  }
  for (std::size_t i = 0; i < weight.size(); ++i) {
    if (weight[i] == 0) continue;
    volume.shares.push_back({as_index(i), weight[i]});
  }
}

/// The points at which the power is taken are the nodes, or Gauss points where the body stores its heat
/// there.
void BodySources::place(const Where& where, int body, Volume& volume) {
  std::vector<CellIntegrals::Cells> cells;
  std::vector<PlacedLoad::Point> points;
  std::vector<PlacedLoad::Share> shares;
  const bool at_nodes = where.at_nodes[as_size(body)] != 0;
  if (at_nodes)
    for (const Volume::Share& share : volume.shares) {
      shares.push_back({share.node, as_index(points.size()), share.weight});
      points.push_back({where.mesh.x[as_size(share.node)], share.node, -1, share.weight});
    }
  for (const mesh::ElementBlock& block : where.mesh.blocks) {
    if (block.body != body || !where.active.body(body)) continue;
    cells.push_back({block.shape, block.nodes, block.n_counted});
    if (at_nodes) continue;
    const mesh::BlockGeometry g(where.mesh, block, where.kind,
                                mesh::gauss_rule(block.shape, 2 * mesh::order(block.shape) + 1));
    for (Index e = 0; e < block.size(); ++e)
      for (int q = 0; q < g.n_points; ++q) {
        const double weight = g.weight_at(e / k_lanes, q)[e % k_lanes];
        const auto number = as_index(points.size());
        PlacedLoad::Point& point = points.emplace_back();
        for (int a = 0; a < g.n_nodes; ++a) {
          const Index node = block.element(e)[a];
          const double n = g.values[as_size(q * g.n_nodes + a)];
          for (std::size_t i = 0; i < 3; ++i) point.x[i] += n * where.mesh.x[as_size(node)][i];
          if (node < where.mesh.n_owned_nodes) shares.push_back({node, number, n * weight});
        }
      }
  }
  volume.load = std::make_unique<PlacedLoad>(where.mesh, where.kind, volume.name,
                                             LoadLaw{LoadLaw::Kind::power, {volume.factor, volume.power}},
                                             std::move(cells), std::move(points), std::move(shares));
}

/// The mean power of the step: from the points of the source where it depends on place, else one mean for all
/// nodes.
void BodySources::Volume::set_window(const LoadWindow& window) {
  if (load) {
    load->set(window);
    std::copy(load->heat().begin(), load->heat().end(), heat.begin());
    return;
  }
  const LoadValues mean = mean_load(window, {LoadLaw::Kind::power, {factor, power}});
  std::fill(heat.begin(), heat.end(), 0.0);
  for (const Share& share : shares) heat[as_size(share.node)] += (mean[0] - mean[1]) * share.weight;
}

/// The heat of a step is that of the fraction which burns between what was released before and the end of the
/// step.
void BodySources::Volume::burn(const BurningState& state, double begin, double end) {
  std::fill(heat.begin(), heat.end(), 0.0);
  if (state.lit.empty()) return;
  for (const Share& share : shares) {
    const auto node = as_size(share.node);
    const double after = burnt_share(state.lit[node], burning->duration, end),
                 before = burnt_share(state.lit[node], burning->duration, state.released[node]);
    heat[node] += burning->heat * (after - before) / (end - begin) * share.weight;
  }
}

bool BodySources::placed() const {
  return std::ranges::any_of(sources_, [](const Volume& v) { return v.placed(); });
}

void BodySources::set_window(const LoadWindow& window) {
  for (Volume& source : sources_)
    if (!source.burning) source.set_window(window);
}

/// The longest step over which every source that depends on place keeps its form.
double BodySources::lasting(double from, double to) const {
  double longest = HUGE_VAL;
  for (const Volume& source : sources_)
    if (source.load) longest = std::min(longest, source.load->lasting(from, to));
  return longest;
}

void BodySources::set_burning(const BurningState& state, double begin, double end) {
  for (Volume& source : sources_)
    if (source.burning) source.burn(state, begin, end);
}

void BodySources::add_residual(std::span<double> out, double& moved) {
  clear_powers();
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Volume& source = sources_[s];
    for (std::size_t i = 0; i < source.heat.size(); ++i) {
      out[i] -= source.heat[i];
      powers_[s] += source.heat[i];
      moved += std::abs(source.heat[i]);
    }
  }
}

/// The least and the greatest heat of a node, for the bounds of temperature.
std::pair<double, double> BodySources::heat_range() const {
  std::pair<double, double> range{0.0, 0.0};
  for (const Volume& source : sources_)
    for (const double heat : source.heat) {
      range.first = std::min(range.first, heat);
      range.second = std::max(range.second, heat);
    }
  return range;
}

/// Heat that sources bring to nodes and take from them, each as a positive number.
void BodySources::add_supply(std::span<double> gain, std::span<double> loss) const {
  for (const Volume& source : sources_)
    for (std::size_t i = 0; i < source.heat.size(); ++i)
      (source.heat[i] > 0 ? gain : loss)[i] += std::abs(source.heat[i]);
}

void BodySources::clear_powers() {
  std::fill(powers_.begin(), powers_.end(), 0.0);
}

std::vector<NamedPower> BodySources::powers() const {
  std::vector<NamedPower> all;
  for (std::size_t s = 0; s < sources_.size(); ++s)
    all.push_back({sources_[s].name, parallel::global_sum(powers_[s])});
  return all;
}

}  // namespace solidus::heat
