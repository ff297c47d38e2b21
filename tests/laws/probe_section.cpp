/// A section of the report that no file of the sources names: what the thermometers of a run have seen. For
/// each probe of temperature the highest and the last value and the steepest fall, and the rates over time.
#include <algorithm>
#include <string>
#include <vector>

#include "results/report/page_section.hpp"

namespace solidus {
namespace {

using results::PageBlock;
using results::PageCurves;
using results::PageTable;
using results::PageText;

constexpr std::string_view k_unit = "[degC]";

/// dT/dt of a curve between its rows [K/s]; zero where time stands still.
std::vector<double> rates(const std::vector<double>& time, const std::vector<double>& temperature) {
  std::vector<double> rates(time.size(), 0.0);
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] > time[i - 1]) rates[i] = (temperature[i] - temperature[i - 1]) / (time[i] - time[i - 1]);
  return rates;
}

std::vector<PageBlock> make(const results::SectionSource& run) {
  const auto history = run.table("history");
  if (!history || history->n_rows < 2) return {};
  const std::vector<double>& time = history->columns.front().numbers;
  PageTable table{.head = {"Probe", "Highest [°C]", "Last [°C]", "Steepest fall [K/s]"}, .rows = {}};
  PageCurves curves{.title = "Rates of probes", .unit = "K/s", .x = {"Time", time}, .lines = {}};
  for (const results::TableColumn& column : history->columns) {
    if (!column.header.ends_with(k_unit) || column.header.starts_with("T_m")) continue;
    const std::string name = column.header.substr(0, column.header.size() - k_unit.size());
    const std::vector<double> rate = rates(time, column.numbers);
    table.rows.push_back(
        {name, std::ranges::max(column.numbers), column.numbers.back(), -std::ranges::min(rate)});
    curves.lines.push_back({name, rate});
  }
  if (table.rows.empty()) return {};
  return {PageText{"Rates are those between two steps."}, std::move(table), std::move(curves)};
}

const results::AddPageSection k_probes{
    {.id = "thermometers", .title = "Thermometers", .place = 35, .make = &make}};

}  // namespace
}  // namespace solidus
