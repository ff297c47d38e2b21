/// Pools one by one, and where the metal that shrinks took its volume from.
#include "criteria/columns.hpp"

#include <array>

#include "numbers/types.hpp"

namespace solidus::criteria {

namespace {

constexpr auto always = [](const EveryRun&) { return true; };

constexpr auto k_pools = std::to_array<PoolColumn>({
    {{.name = "time", .unit = "s", .label = "Time", .doc = "Time at the end of the step"},
     always,
     [](const PoolSource& s) { return s.time; }},
    {{.name = "pool", .unit = "1", .label = "Pool", .doc = "Number of the pool, from one"},
     always,
     [](const PoolSource& s) { return static_cast<double>(s.pool.number); }},
    {{.name = "parent",
      .unit = "1",
      .label = "Split off from",
      .doc = "Number of the pool that it split off from; 0: it was there from the start",
      .no_value = 0},
     always,
     [](const PoolSource& s) { return static_cast<double>(s.pool.parent); }},
    {{.name = "closed_off_since",
      .unit = "s",
      .label = "Closed off since",
      .doc = "Time since which it holds no node of the feeders; -1: it is fed",
      .no_value = -1},
     always,
     [](const PoolSource& s) { return s.pool.closed_off; }},
    {{.name = "frozen_at",
      .unit = "s",
      .label = "Frozen at",
      .doc = "Time at which its last node passed the limit; -1: not yet, or it left as melt with its body",
      .no_value = -1},
     always,
     [](const PoolSource& s) { return s.pool.frozen; }},
    {{.name = "volume",
      .unit = "m3",
      .label = "Volume",
      .doc = "Volume that its nodes hold; zero in its last row"},
     always,
     [](const PoolSource& s) { return s.pool.volume; }},
    {{.name = "solid_fraction", .unit = "1", .label = "Solid fraction", .doc = "Mean over the pool"},
     always,
     [](const PoolSource& s) { return s.pool.solid_fraction; }},
    {{.name = "temperature",
      .unit = "degC",
      .label = "Temperature",
      .doc = "That of its hottest node, of the last node once it is frozen"},
     always,
     [](const PoolSource& s) { return s.pool.temperature - k_zero_celsius; }},
    {{.name = "x", .unit = "m", .label = "x", .doc = "Place of that node, x"},
     always,
     [](const PoolSource& s) { return s.pool.where[0]; }},
    {{.name = "y", .unit = "m", .label = "y", .doc = "Place of that node, y"},
     always,
     [](const PoolSource& s) { return s.pool.where[1]; }},
    {{.name = "z", .unit = "m", .label = "z", .doc = "Place of that node, z"},
     always,
     [](const PoolSource& s) { return s.pool.where[2]; }},
});

constexpr auto k_feeding = std::to_array<FeedingColumn>({
    {{.name = "time", .unit = "s", .label = "Time", .doc = "Time at the end of the step"},
     always,
     [](const FeedingSource& s) { return s.time; }},
    {{.name = "melt_contraction",
      .unit = "m3",
      .label = "Contraction of melt",
      .doc = "Contraction of the melt since pouring"},
     always,
     [](const FeedingSource& s) { return s.totals.melt; }},
    {{.name = "freezing_contraction",
      .unit = "m3",
      .label = "Contraction of freezing",
      .doc = "Contraction of the metal as it froze"},
     always,
     [](const FeedingSource& s) { return s.totals.freezing; }},
    {{.name = "solid_contraction",
      .unit = "m3",
      .label = "Contraction of solid",
      .doc = "Contraction of the solid metal"},
     always,
     [](const FeedingSource& s) { return s.totals.solid; }},
    {{.name = "pipe",
      .unit = "m3",
      .label = "Pipe",
      .doc = "Volume of the pipes, which are open to the atmosphere"},
     always,
     [](const FeedingSource& s) { return s.totals.pipe; }},
    {{.name = "sink", .unit = "m3", .label = "Sink", .doc = "Volume that the soft skin was drawn in by"},
     always,
     [](const FeedingSource& s) { return s.totals.sink; }},
    {{.name = "cavity", .unit = "m3", .label = "Cavity", .doc = "Volume of the closed cavities"},
     always,
     [](const FeedingSource& s) { return s.totals.cavity; }},
    {{.name = "pores", .unit = "m3", .label = "Pores", .doc = "Volume of the pores that melt did not feed"},
     always,
     [](const FeedingSource& s) { return s.totals.pores; }},
    {{.name = "gas", .unit = "m3", .label = "Gas", .doc = "Volume of the pores of gas"},
     always,
     [](const FeedingSource& s) { return s.totals.gas; }},
    {{.name = "wall", .unit = "m3", .label = "Wall", .doc = "Volume by which the wall of the mould gave way"},
     always,
     [](const FeedingSource& s) { return s.totals.wall; }},
    {{.name = "outside",
      .unit = "m3",
      .label = "Outside",
      .doc = "Volume that the outside has lost by the contraction of solid metal"},
     always,
     [](const FeedingSource& s) { return s.totals.outside; }},
    {{.name = "balance_defect",
      .unit = "1",
      .label = "Defect of the balance",
      .doc = "Difference of both sides of the balance of volume, as a share of the castings"},
     always,
     [](const FeedingSource& s) { return s.totals.defect(); }},
});

}  // namespace

std::span<const PoolColumn> pool_columns() {
  return k_pools;
}

std::span<const FeedingColumn> feeding_columns() {
  return k_feeding;
}

}  // namespace solidus::criteria
