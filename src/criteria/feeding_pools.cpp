// Pools of a step, what they are asked for, and the mush that they feed.
#include <algorithm>

#include "criteria/feeding_step.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// Numbers that any process has, rising and without repetition.
std::vector<double> all_numbers(std::vector<double> own) {
  const auto sort = [](std::vector<double>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  };
  sort(own);
  std::vector<double> all = processes::gather(own);
  sort(all);
  return all;
}

/// The place of a number in a rising list; −1: it is not there.
int place_in(const std::vector<double>& numbers, double number) {
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
  return found != numbers.end() && *found == number ? static_cast<int>(found - numbers.begin()) : -1;
}

}  // namespace

void Feeding::feed(Step& step) const {
  leave_out_absent(step);
  // Pools first, whose demand is summed over processes; then mush is fed through itself, swollen pools refill
  // their holes, and the others are drained.
  find_pools(step);
  for (std::size_t i = 0; i < step.demands.size(); ++i)
    if (step.pool[i] >= 0)
      step.pools.metal[as_size(step.pool[i])] += step.rows(i, k_room) * step.demands[i].metal;
  processes::sum(step.pools.metal);
  feed_mush(step);
  refill(step);
  drain(step);
  for (std::size_t i = 0; i < step.demands.size(); ++i)
    if (step.soft[i] != 0) step.rows(i, k_metal) += step.demands[i].metal;
}

// Bodies may leave with melt in them; what was poured of them is followed no further.
void Feeding::leave_out_absent(Step& step) const {
  const auto left = [&](std::size_t i) { return step.soft[i] != 0 && !step.demands[i].present; };
  bool any = false;
  for (std::size_t i = 0; i < step.demands.size(); ++i) any = any || left(i);
  if (!parallel::any_process(any)) return;
  std::vector<double> absent(step.soft.size(), 0.0);
  for (std::size_t i = 0; i < step.demands.size(); ++i) absent[i] = left(i) ? 1.0 : 0.0;
  ghosts_.update(absent, 1);
  for (std::size_t i = 0; i < absent.size(); ++i)
    if (absent[i] != 0) step.soft[i] = step.inside[i] = 0;
}

// Air reaches a pool through an open skin, or through a pipe that has emptied a node next to it or lies in
// it. Crumbs of melt without a whole element are pools where air or a skin reaches them and mush elsewhere.
void Feeding::find_pools(Step& step) const {
  // Pools are connected parts of nodes whose metal can move.
  const ConnectedParts parts = connectivity_.parts(step.inside);
  const auto emptied_through = [&](std::size_t j, FeedingNumber kind) {
    return step.rows(j, kind) > k_nothing &&
           (step.inside[j] != 0 || step.rows(j, k_drained) >= 1 - k_nothing);
  };
  const auto reached = [&](std::size_t i, bool at_surface, FeedingNumber kind) {
    if (at_surface || step.rows(i, kind) > k_nothing) return true;
    return std::ranges::any_of(graph_.around(as_index(i)), [&](const FeedingGraph::Neighbour& n) {
      return emptied_through(as_size(n.node), kind);
    });
  };
  // A single node of a corner that stays hot is no skin that gives way.
  const auto gives_way = [&](std::size_t i) {
    return graph_.skin(i) &&
           std::ranges::any_of(graph_.around(as_index(i)), [&](const FeedingGraph::Neighbour& n) {
             const auto j = as_size(n.node);
             return step.inside[j] != 0 && graph_.skin(j);
           });
  };
  // Which pools air or a skin reaches: any of their nodes is enough.
  const std::size_t owned = step.demands.size();
  step.by_air.assign(step.inside.size(), 0.0);
  step.by_skin.assign(step.inside.size(), 0.0);
  std::vector<double> open, soft_skin, whole = parts.whole;
  for (std::size_t i = 0; i < owned; ++i) {
    if (step.inside[i] == 0) continue;
    step.by_air[i] = reached(i, graph_.vented(i), k_pipe) ? 1.0 : 0.0;
    step.by_skin[i] = reached(i, gives_way(i), k_sink) ? 1.0 : 0.0;
    if (step.by_air[i] != 0) open.push_back(parts.label[i]);
    if (step.by_skin[i] != 0) soft_skin.push_back(parts.label[i]);
  }
  // Over all processes, since a pool may lie on several.
  open = all_numbers(std::move(open));
  soft_skin = all_numbers(std::move(soft_skin));
  FeedingPools& pools = step.pools;
  // A part is a pool if air or a skin reaches it or if it holds a whole element.
  pools.label = open;
  pools.label.insert(pools.label.end(), soft_skin.begin(), soft_skin.end());
  pools.label.insert(pools.label.end(), whole.begin(), whole.end());
  std::sort(pools.label.begin(), pools.label.end());
  pools.label.erase(std::unique(pools.label.begin(), pools.label.end()), pools.label.end());
  // Both marks by the pool's place in the list, which is the same on all processes.
  for (const double label : pools.label) {
    pools.open.push_back(place_in(open, label) >= 0);
    pools.soft_skin.push_back(place_in(soft_skin, label) >= 0);
  }
  pools.metal.assign(pools.size(), 0.0);
  // Each node inside gets the number of its pool.
  for (std::size_t i = 0; i < step.inside.size(); ++i)
    if (step.inside[i] != 0) step.pool[i] = place_in(pools.label, parts.label[i]);
}

// Nothing is to be done where no mush outside of pools asks for metal or holds gas.
bool Feeding::asks_in_mush(const Step& step) const {
  bool mush = false;
  for (std::size_t i = 0; i < step.demands.size(); ++i)
    mush = mush ||
           (step.soft[i] != 0 && step.pool[i] < 0 && (step.demands[i].metal != 0 || gas_[as_size(body_[i])]));
  return parallel::any_process(mush);
}

// Pores open where mush is not connected with a pool.
void Feeding::feed_mush(Step& step) const {
  const std::size_t owned = step.demands.size();
  if (!asks_in_mush(step)) return;
  // Mush that is connected with a pool over soft metal is fed by it, through the mush.
  const ConnectedParts parts = connectivity_.parts(step.soft);
  std::vector<double> own;
  for (std::size_t i = 0; i < owned; ++i)
    if (step.pool[i] >= 0) own.push_back(parts.label[i]);
  const std::vector<double> fed = all_numbers(std::move(own));
  std::vector<int> region(step.soft.size(), -1);
  std::vector<MushPlace> place(step.soft.size(), MushPlace::none);
  // Input of the flow: what each node asks for, how its gas gives way, and by how much pressure may
  // drop.
  std::vector<double> flow(owned, 0.0), gives(owned, 0.0), drop(owned, 0.0);
  std::vector<GasLine> gas(owned);
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (step.soft[i] == 0) continue;
    region[i] = place_in(fed, parts.label[i]);
    if (region[i] >= 0) place[i] = step.pool[i] >= 0 ? MushPlace::pool : MushPlace::mush;
  }
  // The demand of each node is a flow into it; gas gives way with pressure, linearly within the step.
  std::vector<double> pressure(place.size());
  for (std::size_t i = 0; i < place.size(); ++i) pressure[i] = step.rows(i, k_pressure);
  for (std::size_t i = 0; i < owned; ++i) {
    if (place[i] != MushPlace::mush) continue;
    flow[i] = step.rows(i, k_room) * step.demands[i].metal * step.demands[i].fed.total() / step.dt;
    gas[i] = gas_line(step, i);
    gives[i] = -step.rows(i, k_room) * gas[i].slope / step.dt;
    flow[i] -= gives[i] * gas[i].pressure;
    drop[i] = most_drop(step, i);
  }
  // One flow for all regions, from the pressures of the step before as a start.
  const MushResult result = flow_through_mush(graph_, ghosts_, laws_,
                                              {.place = place,
                                               .pool = step.pool,
                                               .body = body_,
                                               .solid = step.solid,
                                               .temperature = step.temperature,
                                               .flow = flow,
                                               .gives = gives,
                                               .drop = drop,
                                               .n_pools = step.pools.size()},
                                              pressure);
  // Pressures give gas its room and pores theirs; mush that no pool reaches opens pores for all of its
  // demand.
  for (std::size_t i = 0; i < owned; ++i) {
    FeedingDemand& demand = step.demands[i];
    step.rows(i, k_pressure) = pressure[i];
    if (place[i] == MushPlace::mush) grow_gas(step, i, gas[i], pressure[i]);
    if (place[i] == MushPlace::none && step.soft[i] != 0) draw_gas(step, i);
    if (step.soft[i] == 0 || step.pool[i] >= 0) continue;
    if (place[i] == MushPlace::none)
      open_pores(step, i, std::max(0.0, demand.metal));
    else if (result.pores[i] > 0)
      open_in_mush(step, i,
                   std::min(std::max(0.0, demand.metal),
                            result.pores[i] * step.dt / (step.rows(i, k_room) * demand.fed.total())),
                   drop[i]);
    if (place[i] == MushPlace::none) demand.metal = 0;
  }
  // What flows out of each pool is what the mush asks of it.
  share_among_pools(step, result.from_pool, region, fed.size());
}

/// @param metal  that does not come, as FeedingDemand::metal
void Feeding::open_pores(Step& step, std::size_t node, double metal) {
  FeedingDemand& demand = step.demands[node];
  step.rows(node, k_pores) += metal * demand.fed.total();
  demand.metal -= metal;
}

// For each region what its mush asks for, and for each pool what it has and where it lies. Collective.
Feeding::PoolStock Feeding::stock_of_pools(const Step& step, const std::vector<int>& region,
                                           std::size_t n_regions) {
  const std::size_t n_pools = step.pools.size();
  PoolStock stock{std::vector<double>(n_regions, 0.0), std::vector<double>(n_pools, 0.0),
                  std::vector<double>(n_pools, -1.0)};
  auto& [asked, has, region_of] = stock;
  for (std::size_t i = 0; i < step.demands.size(); ++i) {
    if (region[i] < 0) continue;
    const double room = step.rows(i, k_room);
    if (step.pool[i] >= 0) {
      const auto p = as_size(step.pool[i]);
      has[p] += room * movable(step, i) / step.demands[i].fed.total();
      region_of[p] = region[i];
    } else {
      asked[as_size(region[i])] += room * step.demands[i].metal;
    }
  }
  // Sums of all processes; the region of a pool is known to those that hold nodes of it.
  processes::sum(asked);
  processes::sum(has);
  processes::largest(region_of);
  return stock;
}

// Pools give to the mush of their region in proportion to what flows from them, none more than it has. What
// all pools of a region together cannot give opens pores in its mush.
void Feeding::share_among_pools(Step& step, const std::vector<double>& from_pool,
                                const std::vector<int>& region, std::size_t n_regions) const {
  constexpr double k_given = 0.9;  // of what a pool has
  const std::size_t n_pools = step.pools.size();
  auto [asked, has, region_of] = stock_of_pools(step, region, n_regions);
  // Of what a pool has, its own surface needs some: the rest may be given.
  std::vector<double> left(n_regions, 0.0), flow(n_regions, 0.0), part(n_regions, 1.0);
  for (std::size_t p = 0; p < n_pools; ++p) {
    if (region_of[p] < 0) continue;
    has[p] = std::max(0.0, k_given * has[p] - std::max(0.0, step.pools.metal[p]));
    left[static_cast<std::size_t>(region_of[p])] += has[p];
    flow[static_cast<std::size_t>(region_of[p])] += std::max(0.0, from_pool[p]);
  }
  // Where the pools of a region have too little, each node of mush gets the same part, and pores
  // take the rest.
  for (std::size_t r = 0; r < n_regions; ++r)
    if (asked[r] > left[r]) part[r] = left[r] / asked[r];
  for (std::size_t i = 0; i < step.demands.size(); ++i) {
    if (region[i] < 0 || step.pool[i] >= 0) continue;
    const double given = part[as_size(region[i])];
    if (given < 1) open_pores(step, i, (1 - given) * step.demands[i].metal);
  }
  // Each pool gives in the ratio of the flows from it, up to what it has;
  std::vector<double> over(n_regions, 0.0), spare(n_regions, 0.0), gives(n_pools, 0.0);
  for (std::size_t p = 0; p < n_pools; ++p) {
    if (region_of[p] < 0) continue;
    const auto r = static_cast<std::size_t>(region_of[p]);
    const double all = part[r] * asked[r];
    const double share = flow[r] > 0 ? std::max(0.0, from_pool[p]) / flow[r]
                         : left[r] > 0
                             ? has[p] / left[r]
                             : 1.0 / static_cast<double>(std::ranges::count(region_of, region_of[p]));
    gives[p] = all > 0 ? std::min(all * share, has[p]) : all * share;
    over[r] += all * share - gives[p];
    spare[r] += has[p] - std::max(0.0, gives[p]);
  }
  // what it could not give comes from the spare metal of the other pools of the region.
  for (std::size_t p = 0; p < n_pools; ++p) {
    if (region_of[p] < 0) continue;
    const auto r = static_cast<std::size_t>(region_of[p]);
    if (over[r] > 0 && spare[r] > 0) gives[p] += over[r] * (has[p] - std::max(0.0, gives[p])) / spare[r];
    step.pools.metal[p] += gives[p];
  }
}

}  // namespace solidus::criteria
