/// Totals of feeding as columns with their units.
#include "results/tables/feeding_table.hpp"

#include <algorithm>
#include <vector>

#include "criteria/feeding.hpp"

namespace solidus::results {

namespace {

std::vector<CsvColumn> feeding_columns() {
  return {{"time", "s"},
          {"melt_contraction", "m3"},
          {"freezing_contraction", "m3"},
          {"solid_contraction", "m3"},
          {"pipe", "m3"},
          {"sink", "m3"},
          {"cavity", "m3"},
          {"pores", "m3"},
          {"gas", "m3"},
          {"wall", "m3"},
          {"outside", "m3"},
          {"balance_defect", "1"}};
}

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  return from ? CsvTable(path, feeding_columns(), *from) : CsvTable(path, feeding_columns());
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
  const criteria::FeedingTotals t = criteria::Feeding::totals(*record);
  const std::vector<double> row = {state.time, t.melt,  t.freezing, t.solid, t.pipe,    t.sink,
                                   t.cavity,   t.pores, t.gas,      t.wall,  t.outside, t.defect()};
  table_.add(row);
}

}  // namespace solidus::results
