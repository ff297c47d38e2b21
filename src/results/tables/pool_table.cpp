/// A row for each pool at each step.
#include "results/tables/pool_table.hpp"

#include <vector>

#include "criteria/columns.hpp"

namespace solidus::results {

namespace {

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  const std::vector<CsvColumn> head = head_of(criteria::pool_columns());
  return from ? CsvTable(path, head, *from) : CsvTable(path, head);
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
      const criteria::PoolSource source{state.time, pool};
      table_.add(row_of(criteria::pool_columns(), source));
    }
  }
}

}  // namespace solidus::results
