/// A row for each step with the totals of feeding.
#include "results/tables/feeding_table.hpp"

#include <algorithm>
#include <vector>

#include "criteria/columns.hpp"

namespace solidus::results {

namespace {

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  const std::vector<CsvColumn> head = head_of(criteria::feeding_columns());
  return from ? CsvTable(path, head, *from) : CsvTable(path, head);
}

const criteria::CriterionRecord* feeding_of(const coupling::State& state) {
  const auto found = std::ranges::find_if(
      state.criteria.records, [](const auto& record) { return record.name == criteria::Feeding::k_name; });
  return found == state.criteria.records.end() ? nullptr : &*found;
}

}  // namespace

FeedingTable::FeedingTable(const std::filesystem::path& path, std::optional<double> from)
    : table_(make_table(path, from)) {}

void FeedingTable::add(const coupling::State& state) {
  const criteria::CriterionRecord* record = feeding_of(state);
  if (record == nullptr) return;
  const criteria::FeedingSource source{state.time, criteria::Feeding::totals(*record)};
  table_.add(row_of(criteria::feeding_columns(), source));
}

}  // namespace solidus::results
