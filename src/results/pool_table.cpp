#include "results/pool_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/types.hpp"
#include "criteria/pools.hpp"

namespace solidus::results {

namespace {

std::vector<Column> pool_columns() {
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

/// What people read first, and the names that the summary has for it.
struct Line {
  std::string_view text, finding, unit;
  double factor;
};
constexpr Line k_lines[] = {{"freezes last", "solidified_at_max", "s", 1},
                            {"longest local solidification time", "local_solidification_time_max", "s", 1},
                            {"largest arm spacing", "secondary_arm_spacing_max", "um", 1e6},
                            {"least Niyama", "niyama_min", "K0.5 s0.5/mm", 1e-3},
                            {"least dimensionless Niyama", "dimensionless_niyama_min", "", 1},
                            {"largest estimate of shrinkage porosity", "shrinkage_porosity_max", "%", 100},
                            {"closed-off pools of melt", "closed_off_pools", "", 1}};

}  // namespace

PoolTable::PoolTable(const std::filesystem::path& path, std::optional<double> from)
    : table_(make_table(path, from)) {}

void PoolTable::add(const coupling::State& state) {
  for (const criteria::Record& record : state.criteria.records) {
    if (record.name != criteria::Pools::k_name) continue;
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

std::string findings_text(const std::vector<criteria::Finding>& found) {
  std::string text;
  for (const Line& line : k_lines) {
    const auto f = std::find_if(found.begin(), found.end(), [&](const criteria::Finding& finding) {
      return finding.name == line.finding;
    });
    if (f == found.end()) continue;
    text += fmt::format("  {:<40}{:>10.4g} {}", line.text, f->value * line.factor, line.unit);
    if (f->somewhere)
      text += fmt::format("  at ({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * f->where[0], 1e3 * f->where[1],
                          1e3 * f->where[2]);
    text += '\n';
  }
  return text;
}

}  // namespace solidus::results
