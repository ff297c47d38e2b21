// How pools empty from the top: pipes, sinks, cavities.
#include <algorithm>
#include <utility>

#include "criteria/feeding_levels.hpp"
#include "criteria/feeding_step.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

double Feeding::movable(const Step& step, std::size_t node) {
  return std::max(0.0, std::min(step.mobile[node] * (1 - step.rows(node, k_drained)), step.rows.fill(node)));
}

void Feeding::drain(Step& step) const {
  // What shrinks in a pool, `metal`, is asked for first at the surfaces that can sink, then in the interior,
  // and what neither gives stays unfed.
  const FeedingPools& pools = step.pools;
  std::vector<double> asked(pools.size());
  bool any = false;
  for (std::size_t p = 0; p < pools.size(); ++p) {
    asked[p] = std::max(0.0, pools.metal[p]);
    any = any || asked[p] > 0;
  }
  if (!any) return;
  // `reached` says how much of a node the level may drain, from what was drained there before.
  std::vector<double> reached(step.inside.size(), 0.0);
  for (std::size_t i = 0; i < step.demands.size(); ++i)
    if (step.pool[i] >= 0) reached[i] = reached_at_first(step, i);
  ghosts_.update(reached, 1);
  // A pool that is neither open nor has a skin soft enough to sink gives nothing at its surface.
  std::vector<double> at_surface = asked;
  for (std::size_t p = 0; p < pools.size(); ++p)
    if (pools.open[p] == 0 && pools.soft_skin[p] == 0) at_surface[p] = 0;
  const std::vector<double> given = drain_from(step, reached, at_surface, true);
  // What is left after the surface, beyond rounding, empties the pool from inside: a cavity below its highest
  // place.
  bool more = false;
  for (std::size_t p = 0; p < pools.size(); ++p) {
    asked[p] -= given[p];
    if (asked[p] <= k_exact * std::max(0.0, pools.metal[p])) asked[p] = 0;
    more = more || asked[p] > 0;
  }
  if (!more) return;
  std::ranges::fill(reached, 1.0);
  const std::vector<double> inside = drain_from(step, reached, asked, false);
  for (std::size_t p = 0; p < pools.size(); ++p) {
    asked[p] -= inside[p];
    if (asked[p] <= k_exact * std::max(0.0, pools.metal[p])) asked[p] = 0;
  }
  leave_unfed(step, std::move(asked));
}

// A pool whose holes cannot give all that it is asked for opens pores among its own nodes.
void Feeding::leave_unfed(Step& step, std::vector<double> missing) {
  if (std::ranges::none_of(missing, [](double metal) { return metal > 0; })) return;
  std::vector<double> own(missing.size(), 0.0);
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < step.demands.size(); ++i)
      if (step.pool[i] >= 0 && step.demands[i].metal > 0) visit(i, as_size(step.pool[i]));
  };
  each([&](std::size_t i, std::size_t p) { own[p] += step.rows(i, k_room) * step.demands[i].metal; });
  processes::sum(own);
  each([&](std::size_t i, std::size_t p) {
    if (missing[p] > 0) open_pores(step, i, missing[p] / own[p] * step.demands[i].metal);
  });
}

double Feeding::reached_at_first(const Step& step, std::size_t node) {
  return step.pools.open[as_size(step.pool[node])] != 0 ? step.by_air[node] : step.by_skin[node];
}

// Air follows the melt that sinks: nodes next to those that are drained at a level may be drained too.
bool Feeding::spread(const Step& step, const std::vector<PoolLevel>& level,
                     std::vector<double>& reached) const {
  // Nodes that the level of their pool has fallen below, in pools that give metal.
  std::vector<double> drained(reached.size(), 0.0);
  for (std::size_t i = 0; i < step.demands.size(); ++i) {
    if (step.pool[i] < 0 || reached[i] == 0) continue;
    const PoolLevel& l = level[as_size(step.pool[i])];
    if (l.given > 0 && l.level < graph_.high(i)) drained[i] = 1;
  }
  ghosts_.update(drained, 1);
  // A neighbour of such a node in the same pool is reached if it lies above the level too.
  bool grown = false;
  for (std::size_t i = 0; i < step.demands.size(); ++i) {
    if (step.pool[i] < 0 || reached[i] != 0) continue;
    const PoolLevel& l = level[as_size(step.pool[i])];
    if (!(l.level < graph_.high(i))) continue;
    const bool beside =
        std::ranges::any_of(graph_.around(as_index(i)), [&](const FeedingGraph::Neighbour& n) {
          const auto j = as_size(n.node);
          return drained[j] != 0 && step.pool[j] == step.pool[i];
        });
    if (!beside) continue;
    reached[i] = 1;
    grown = true;
  }
  // Another process may have grown its part: the caller repeats until none grows.
  if (!parallel::any_process(grown)) return false;
  ghosts_.update(reached, 1);
  return true;
}

std::vector<double> Feeding::drain_from(Step& step, std::vector<double>& reached,
                                        const std::vector<double>& asked, bool at_surface) const {
  std::vector<DrainedNode> nodes;
  std::vector<PoolLevel> levels;
  // A node gives melt from the whole room that still moves in it. At the surface of a pool the melt spreads
  // to the nodes that its sinking level reaches, and the levels are found again until none is reached.
  do {
    nodes.clear();
    for (std::size_t i = 0; i < step.demands.size(); ++i) {
      if (step.pool[i] < 0 || reached[i] == 0) continue;
      const auto p = as_size(step.pool[i]);
      const double drained = step.rows(i, k_drained), moves = movable(step, i);
      if (!(asked[p] > 0) || !(moves > 0) || drained >= 1) continue;
      const double room = step.rows(i, k_room) * moves / (1 - drained);
      nodes.push_back(
          {i, p, graph_.low(i), graph_.high(i), drained, room, room / step.demands[i].fed.total()});
    }
    levels = find_levels(nodes, asked);
  } while (at_surface && spread(step, levels, reached));
  // A pool that cannot give all that is asked gives what it holds; the others are emptied by exactly what was
  // asked, whatever the search for the level left.
  std::vector<double> given(asked.size(), 0.0);
  for (std::size_t p = 0; p < asked.size(); ++p)
    given[p] = levels[p].given < (1 - k_exact) * asked[p] ? levels[p].given : asked[p];
  for (const DrainedNode& d : nodes) {
    const PoolLevel& l = levels[d.pool];
    if (!(l.given > 0)) continue;
    const double scale = given[d.pool] == asked[d.pool] ? asked[d.pool] / l.given : 1.0;
    empty(step, d, scale * d.gain(l.level), at_surface);
  }
  return given;
}

/// Takes melt out of a node.
/// @param gain  further share of it that is drained
void Feeding::empty(Step& step, const DrainedNode& d, double gain, bool at_surface) {
  const FeedingRows& rows = step.rows;
  const FeedingNumber kind = !at_surface ? k_cavity : step.pools.open[d.pool] != 0 ? k_pipe : k_sink;
  const double share = gain * d.room / rows(d.node, k_room);
  rows(d.node, k_drained) += gain;
  rows(d.node, kind) += share;
  rows(d.node, k_metal) -= share / step.demands[d.node].fed.total();
}

// A pool that swells fills the holes in it, and rises where it can when they are full.
void Feeding::refill(Step& step) const {
  const FeedingPools& pools = step.pools;
  if (std::ranges::none_of(pools.metal, [](double metal) { return metal < 0; })) return;
  const FeedingRows& rows = step.rows;
  std::vector<double> holds(2 * pools.size(), 0.0);  // metal that its holes take, and its surface full
  const auto surface = [&](std::size_t i, std::size_t p) {
    return pools.open[p] == 0 && pools.soft_skin[p] == 0 ? 1.0 : reached_at_first(step, i);
  };
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < step.demands.size(); ++i)
      if (step.pool[i] >= 0 && pools.metal[as_size(step.pool[i])] < 0)
        visit(i, as_size(step.pool[i]), rows(i, k_room) / step.demands[i].fed.total());
  };
  // What all holes of a pool take, and its surface when it rises by one; summed over the processes.
  each([&](std::size_t i, std::size_t p, double metal) {
    holds[p] += metal * std::max(0.0, rows.emptied(i));
    holds[pools.size() + p] += metal * surface(i, p);
  });
  processes::sum(holds);
  // Each hole closes by the same share, each surface rises by the same height.
  each([&](std::size_t i, std::size_t p, double) {
    const double swells = -pools.metal[p], in_holes = std::min(swells, holds[p]);
    const double part = holds[p] > 0 ? in_holes / holds[p] : 0;
    const double rise = holds[pools.size() + p] > 0 ? (swells - in_holes) / holds[pools.size() + p] : 0;
    double filled = 0;
    if (rows.emptied(i) > 0)
      for (const FeedingNumber kind : {k_pipe, k_sink, k_cavity}) {
        filled += part * rows(i, kind);
        rows(i, kind) *= 1 - part;
      }
    const double risen = rise * surface(i, p);
    rows(i, pools.open[p] != 0 ? k_pipe : k_sink) -= risen;
    rows(i, k_drained) -= (filled + risen) / std::max(step.mobile[i], k_least_mobile);
    rows(i, k_metal) += (filled + risen) / step.demands[i].fed.total();
  });
}

}  // namespace solidus::criteria
