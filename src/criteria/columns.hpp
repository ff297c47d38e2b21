/// The columns of pools.csv and feeding.csv.
#pragma once

#include <span>

#include "criteria/feeding.hpp"
#include "criteria/pools.hpp"
#include "quantities/column.hpp"

namespace solidus::criteria {

struct EveryRun {};

/// A pool at the end of a step [s].
struct PoolSource {
  double time;
  const Pool& pool;
};
using PoolColumn = quantities::ReadColumn<EveryRun, PoolSource, double>;
/// pools.csv in its order.
std::span<const PoolColumn> pool_columns();

/// Volumes since pouring, at the end of a step [s].
struct FeedingSource {
  double time;
  FeedingTotals totals;
};
using FeedingColumn = quantities::ReadColumn<EveryRun, FeedingSource, double>;
/// feeding.csv in its order.
std::span<const FeedingColumn> feeding_columns();

}  // namespace solidus::criteria
