// Gas and graphite in the balance of feeding: what takes room in addition to the metal, and what expands.
#include <algorithm>

#include "criteria/feeding_step.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

GasLaw::Place gas_place(std::span<const double> temperature, std::span<const double> solid,
                        const FeedingRows& rows, std::size_t node) {
  return {temperature[node], solid[node], rows(node, k_freezing)};
}

/// The share of a room that metal and its gas have.
double filled_share(const FeedingRows& rows, std::size_t node) {
  return std::max(0.0, 1 - std::max(0.0, rows.emptied(node)) - rows(node, k_pores));
}

}  // namespace

// In a pool the melt gives way to it; in mush it grows as far as melt comes or goes (grow_gas, draw_gas).
void Feeding::blow(std::size_t node, Step& step) const {
  const std::optional<GasLaw>& law = gas_[as_size(body_[node])];
  if (!law) return;
  const FeedingRows& rows = step.rows;
  const GasLaw::Place place = gas_place(step.temperature, step.solid_after, rows, node);
  rows(node, k_gas) = filled_share(rows, node) * law->pores(place, 0);
}

/// By how much the wall gives way in a step, as a share of the room of a node.
double Feeding::wall_yields(std::size_t node, const CriterionInput& old, const CriterionInput& next,
                            const Step& step) const {
  const material::Material& material = storage_.material(body_[node]);
  if (!material.graphite) return 0;
  double expands = 0;
  for (const material::PhaseChange& change : material.phase_changes)
    if (change.graphite)
      expands +=
          change.volume_change * (change.fraction.value(next.heat.temperature[node], next.plateau_at(node)) -
                                  change.fraction.value(old.heat.temperature[node], old.plateau_at(node)));
  const double yields =
      (1 - material.graphite->feeding_share(rigidity_)) * expands * step.rows(node, k_metal);
  // A wall that has moved by its whole way holds, and all further expansion feeds.
  if (most_wall_.empty()) return yields;
  return std::min(yields, std::max(0.0, most_wall_[as_size(body_[node])] - step.rows(node, k_wall)));
}

/// The movement of the wall over the modulus of each body, its volume over its skin with a wall. Collective.
std::vector<double> Feeding::most_wall(const FeedingOptions& options) const {
  std::vector<double> most(options.walled.size(), 0.0);
  for (std::size_t body = 0; body < most.size(); ++body) {
    double own = 0;
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) own += storage_.volume(i, static_cast<int>(body));
    const double volume = parallel::global_sum(own);
    if (volume > 0) most[body] = options.wall_movement * options.walled[body] / volume;
  }
  return most;
}

/// How gas in mush follows the pressure, g = slope (P − P₀) + what there is of it.
Feeding::GasLine Feeding::gas_line(const Step& step, std::size_t node) const {
  const std::optional<GasLaw>& law = gas_[as_size(body_[node])];
  const double has = filled_share(step.rows, node);
  if (!law || !(has > 0)) return {};
  const GasLaw::Place place = gas_place(step.temperature, step.solid_after, step.rows, node);
  const double there = std::max(0.0, step.rows(node, k_gas));
  const double pressure = law->pressure_at(place, there / has);
  // Where there is none, only melt at a pressure below that at which pores open makes some.
  if (!(there > 0) && step.rows(node, k_pressure) >= pressure) return {};
  return {pressure, has * law->slope(place, pressure)};
}

/// Gas of mush whose melt comes to a pressure, by the line that the flow has gone by.
void Feeding::grow_gas(Step& step, std::size_t node, const GasLine& line, double pressure) {
  const FeedingRows& rows = step.rows;
  const double grown = std::max(line.slope * (pressure - line.pressure), -rows(node, k_gas));
  rows(node, k_gas) += grown;
  FeedingDemand& demand = step.demands[node];
  demand.metal -= grown / demand.fed.total();
}

/// Mush that no melt reaches draws its gas larger, down to the pressure at which other pores open, and swells
/// where gas has more than that of the surroundings. Metal that expands closes pores.
void Feeding::draw_gas(Step& step, std::size_t node) const {
  const std::optional<GasLaw>& law = gas_[as_size(body_[node])];
  if (!law) return;
  const FeedingRows& rows = step.rows;
  FeedingDemand& demand = step.demands[node];
  const double volume = demand.fed.total(), has = filled_share(rows, node), there = rows(node, k_gas);
  const GasLaw::Place place = gas_place(step.temperature, step.solid_after, rows, node);
  const double drop = laws_[as_size(body_[node])].critical_drop();
  const double least = has * law->pores(place, 0), most = std::max(least, has * law->pores(place, -drop));
  const double grown = std::clamp(there + demand.metal * volume, least, most) - there;
  rows(node, k_gas) += grown;
  demand.metal -= grown / volume;
  const double closed = std::clamp(-demand.metal * volume, 0.0, rows(node, k_pores));
  rows(node, k_pores) -= closed;
  demand.metal += closed / volume;
}

/// The drop of pressure at which pores open: the critical one, or that at which gas takes all that a node
/// asks for.
double Feeding::most_drop(const Step& step, std::size_t node) const {
  const double critical = laws_[as_size(body_[node])].critical_drop();
  const std::optional<GasLaw>& law = gas_[as_size(body_[node])];
  const FeedingDemand& demand = step.demands[node];
  const double asked = demand.metal * demand.fed.total(), has = filled_share(step.rows, node);
  if (!law || !(asked > 0) || !(has > 0)) return critical;
  const double wanted = (step.rows(node, k_gas) + asked) / has;
  if (!(wanted < 1)) return critical;
  const GasLaw::Place place = gas_place(step.temperature, step.solid_after, step.rows, node);
  return std::min(critical, -law->pressure_at(place, wanted));
}

/// Opens pores in mush that melt does not reach, or lets its gas expand where that needs the smaller fall of
/// pressure.
void Feeding::open_in_mush(Step& step, std::size_t node, double metal, double drop) const {
  const std::size_t body = as_size(body_[node]);
  if (!gas_[body] || drop >= laws_[body].critical_drop()) {
    open_pores(step, node, metal);
    return;
  }
  FeedingDemand& demand = step.demands[node];
  step.rows(node, k_gas) += metal * demand.fed.total();
  demand.metal -= metal;
}

}  // namespace solidus::criteria
