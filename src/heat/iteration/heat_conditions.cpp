/// Conditions of a heat system: surfaces, prescribed temperatures and sources: how the power in a body is
/// shared out over its nodes.
#include <algorithm>
#include <map>
#include <string>

#include "heat/iteration/heat_system.hpp"
#include "mesh/block_geometry.hpp"
#include "system/errors.hpp"

namespace solidus::heat {

namespace {

template <class Map>
const typename Map::mapped_type& find(const Map& groups, const std::string& name, const char* what) {
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second;
  std::string allowed;
  for (const auto& group : groups) allowed += (allowed.empty() ? "" : ", ") + group.first;
  throw InputError({}, std::string("no ") + what + " '" + name + "' in the mesh", allowed);
}

}  // namespace

void HeatSystem::add_conditions(const ThermalConditions& conditions) {
  // Surfaces are restricted to faces of active bodies. Fluxes, films and radiation have one kind of object,
  // whose law differs.
  const auto add_surface = [&](const auto& condition) {
    surfaces_.emplace_back(mesh_, kind_,
                           active_.part(mesh_, find(mesh_.surfaces, condition.surface, "surface")),
                           condition.name, SurfaceLaw(condition), closed_);
  };
  for (const Flux& flux : conditions.fluxes) add_surface(flux);
  for (const Film& film : conditions.films) add_surface(film);
  for (const Radiation& radiation : conditions.radiations) add_surface(radiation);
  add_sources(conditions.sources);
  add_burning(conditions.exothermics);
  add_prescribed(conditions.temperatures);
  // Storage for the power of each condition is made here; whether anything depends on place decides what has
  // to be integrated again.
  surface_power_.resize(surfaces_.size());
  source_power_.resize(sources_.size());
  placed_ =
      std::any_of(surfaces_.begin(), surfaces_.end(), [](const SurfaceHeat& s) { return s.placed(); }) ||
      std::any_of(sources_.begin(), sources_.end(), [](const Volume& v) { return v.placed(); }) ||
      std::any_of(prescribed_.begin(), prescribed_.end(),
                  [](const Prescribed& p) { return !p.value.uniform(); });
}

int HeatSystem::body_named(const std::string& name) const {
  std::map<std::string, int> bodies;
  for (std::size_t i = 0; i < mesh_.bodies.size(); ++i) bodies[mesh_.bodies[i].name] = static_cast<int>(i);
  return find(bodies, name, "body");
}

// Spread over the nodes as their heat is stored, so that a uniform source warms them alike.
void HeatSystem::add_sources(const std::vector<Source>& sources) {
  for (const Source& source : sources) {
    const int body = body_named(source.body);
    Volume volume{.name = source.name, .power = source.power, .factor = source.factor};
    add_nodal_shares(body, volume);
    if (volume.placed()) place(body, volume);
    volume.heat.resize(static_cast<std::size_t>(mesh_.n_owned_nodes));
    sources_.push_back(std::move(volume));
  }
}

void HeatSystem::add_burning(const std::vector<Exothermic>& exothermics) {
  // A sleeve is a source whose power follows from the state of its nodes. A node of several sleeves ignites
  // at the lowest of their temperatures.
  if (!exothermics.empty()) ignition_.assign(mesh_.x.size(), HUGE_VAL);
  for (const Exothermic& burning : exothermics) {
    const int body = body_named(burning.body);
    Volume volume{.name = burning.name, .power = 0.0, .factor = 1.0};
    volume.burning = burning;
    add_nodal_shares(body, volume);
    volume.heat.resize(static_cast<std::size_t>(mesh_.n_owned_nodes));
    sources_.push_back(std::move(volume));
    if (!active_.body(body)) continue;
    for (const mesh::ElementBlock& block : mesh_.blocks)
      if (block.body == body)
        for (const Index node : block.nodes) {
          double& lowest = ignition_[static_cast<std::size_t>(node)];
          lowest = std::min(lowest, burning.ignition);
        }
  }
}

void HeatSystem::add_prescribed(const std::vector<PrescribedTemperature>& conditions) {
  // A node may be in several groups; the condition that comes last holds it.
  std::vector<int> holder(mesh_.x.size(), -1);  // the later condition in the list holds
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (Index node : find(mesh_.node_sets, conditions[i].node_set, "group"))
      holder[static_cast<std::size_t>(node)] = static_cast<int>(i);
  for (const PrescribedTemperature& c : conditions) prescribed_.push_back({c.name, c.value, {}, {}, {}});
  fixed_.assign(mesh_.x.size(), 0);
  for (std::size_t node = 0; node < holder.size(); ++node) {
    // Nodes of absent bodies have no equation, and are fixed.
    if (!active_.node(static_cast<Index>(node))) {
      fixed_[node] = 1;
      continue;
    }
    if (holder[node] < 0) continue;
    fixed_[node] = 1;
    Prescribed& p = prescribed_[static_cast<std::size_t>(holder[node])];
    p.nodes.push_back(static_cast<Index>(node));
    if (!p.value.uniform()) p.x.push_back(mesh_.x[node]);
  }
  for (Prescribed& p : prescribed_) p.now.resize(p.nodes.size());
}

void HeatSystem::add_nodal_shares(int body, Volume& volume) const {
  // The share of a node is the integral of its shape function over the body, or the lumped weight where heat
  // is stored at the nodes.
  std::vector<double> weight(static_cast<std::size_t>(mesh_.n_owned_nodes), 0.0);
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (block.body != body || !active_.body(body)) continue;
    const PackVector<Lane> weights = at_nodes_[static_cast<std::size_t>(body)] != 0
                                         ? mesh::nodal_weights(mesh_, block, kind_)
                                         : mesh::basis_integrals(mesh_, block, kind_);
    const int n = mesh::node_count(block.shape);
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < n; ++a) {
        const Index node = block.element(e)[a];
        if (node < mesh_.n_owned_nodes)
          weight[static_cast<std::size_t>(node)] +=
              weights[static_cast<std::size_t>(e / k_lanes * n + a)][e % k_lanes];
      }
  }
  for (std::size_t i = 0; i < weight.size(); ++i) {
    if (weight[i] == 0) continue;
    volume.shares.push_back({static_cast<Index>(i), weight[i]});
  }
}

/// The points at which the power is taken are the nodes, or Gauss points where the body stores its heat
/// there.
void HeatSystem::place(int body, Volume& volume) const {
  std::vector<CellIntegrals::Cells> cells;
  std::vector<PlacedLoad::Point> points;
  std::vector<PlacedLoad::Share> shares;
  const bool at_nodes = at_nodes_[static_cast<std::size_t>(body)] != 0;
  if (at_nodes)
    for (const Volume::Share& share : volume.shares) {
      shares.push_back({share.node, static_cast<Index>(points.size()), share.weight});
      points.push_back({mesh_.x[static_cast<std::size_t>(share.node)], share.node, -1, share.weight});
    }
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (block.body != body || !active_.body(body)) continue;
    cells.push_back({block.shape, block.nodes, block.n_counted});
    if (at_nodes) continue;
    const mesh::BlockGeometry g(mesh_, block, kind_,
                                mesh::gauss_rule(block.shape, 2 * mesh::order(block.shape) + 1));
    for (Index e = 0; e < block.size(); ++e)
      for (int q = 0; q < g.n_points; ++q) {
        const double weight = g.weight_at(e / k_lanes, q)[e % k_lanes];
        const auto number = static_cast<Index>(points.size());
        PlacedLoad::Point& point = points.emplace_back();
        for (int a = 0; a < g.n_nodes; ++a) {
          const Index node = block.element(e)[a];
          const double n = g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
          for (std::size_t i = 0; i < 3; ++i) point.x[i] += n * mesh_.x[static_cast<std::size_t>(node)][i];
          if (node < mesh_.n_owned_nodes) shares.push_back({node, number, n * weight});
        }
      }
  }
  volume.load = std::make_unique<PlacedLoad>(mesh_, kind_, volume.name,
                                             LoadLaw{LoadLaw::Kind::power, {volume.factor, volume.power}},
                                             std::move(cells), std::move(points), std::move(shares));
}

void HeatSystem::Volume::set_window(const LoadWindow& window) {
  if (load) {
    load->set(window);
    std::copy(load->heat().begin(), load->heat().end(), heat.begin());
    return;
  }
  const LoadValues mean = mean_load(window, {LoadLaw::Kind::power, {factor, power}});
  std::fill(heat.begin(), heat.end(), 0.0);
  for (const Share& share : shares)
    heat[static_cast<std::size_t>(share.node)] += (mean[0] - mean[1]) * share.weight;
}

void HeatSystem::Volume::burn(const BurningState& state, double begin, double end) {
  std::fill(heat.begin(), heat.end(), 0.0);
  if (state.lit.empty()) return;
  for (const Share& share : shares) {
    const auto node = static_cast<std::size_t>(share.node);
    const double after = burnt_share(state.lit[node], burning->duration, end),
                 before = burnt_share(state.lit[node], burning->duration, state.released[node]);
    heat[node] += burning->heat * (after - before) / (end - begin) * share.weight;
  }
}

}  // namespace solidus::heat
