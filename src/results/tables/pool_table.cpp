/// A row for each pool at each step.
#include "results/tables/pool_table.hpp"

#include <vector>

#include "criteria/pools.hpp"
#include "numbers/types.hpp"

namespace solidus::results {

namespace {

std::vector<CsvColumn> pool_columns() {
  return {{"time", "s"},
          {"pool", "1"},
          {"parent", "1"},
          {"closed_off_since", "s"},
          {"frozen_at", "s"},
          {"volume", "m3"},
          {"solid_fraction", "1"},
          {"temperature", "degC"},
          {"x", "m"},
          {"y", "m"},
          {"z", "m"}};
}

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  return from ? CsvTable(path, pool_columns(), *from) : CsvTable(path, pool_columns());
}

}  // namespace

PoolTable::PoolTable(const std::filesystem::path& path, std::optional<double> from)
    : table_(make_table(path, from)) {}

void PoolTable::add(const coupling::State& state) {
  for (const criteria::CriterionRecord& record : state.criteria.records) {
    if (record.name != criteria::Pools::k_name) continue;
    // Pools that exist or have ended within the step.
    for (const criteria::Pool& pool : criteria::Pools::pools(record)) {
      if (!pool.present() && !pool.ended) continue;
      const std::vector<double> row = {state.time,
                                       static_cast<double>(pool.number),
                                       static_cast<double>(pool.parent),
                                       pool.closed_off,
                                       pool.frozen,
                                       pool.volume,
                                       pool.solid_fraction,
                                       pool.temperature - k_zero_celsius,
                                       pool.where[0],
                                       pool.where[1],
                                       pool.where[2]};
      table_.add(row);
    }
  }
}

}  // namespace solidus::results
