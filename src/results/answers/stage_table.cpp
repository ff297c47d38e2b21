/// A row for each stage with what it has left in the bodies.
#include "results/answers/stage_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "coupling/columns.hpp"
#include "criteria/quantities.hpp"
#include "heat/thermal_phase.hpp"
#include "input/units.hpp"
#include "mechanics/quantities.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"
#include "results/answers/answers.hpp"
#include "results/fields/spots.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

namespace columns = coupling::columns;

constexpr double k_none = -1;
constexpr double k_no_temperature = -k_zero_celsius;  // of a run without heat [°C]
constexpr auto of_all = [](const StageRow&) { return true; };

constexpr auto k_stages = std::to_array<StageColumn>({
    {{.name = "time", .unit = "s", .label = "Ends at", .doc = "Time of its end", .listed = true},
     of_all,
     [](const StageRow& row) { return row.time; }},
    {{.name = "stage", .unit = "1", .label = "Stage", .doc = "Number of the stage in the case, from one"},
     of_all,
     [](const StageRow& row) { return static_cast<double>(row.stage); }},
    {{.name = "cycle",
      .unit = "1",
      .label = "Cycle",
      .doc = "How often the cycle has come round, from one; zero outside of cycles"},
     of_all,
     [](const StageRow& row) { return static_cast<double>(row.cycle); }},
    {{.name = "lowest_temperature",
      .unit = "degC",
      .label = "Lowest temperature",
      .doc = "Of what is cast; where nothing of it is there, of all bodies that are; -273.15 without heat",
      .no_value = k_no_temperature,
      .listed = true},
     of_all,
     [](const StageRow& row) { return row.lowest - k_zero_celsius; }},
    {{.name = "highest_temperature",
      .unit = "degC",
      .label = "Highest temperature",
      .doc = "Of the same bodies; -273.15 without heat",
      .no_value = k_no_temperature,
      .listed = true},
     of_all,
     [](const StageRow& row) { return row.highest - k_zero_celsius; }},
    {{.name = "largest_von_mises",
      .unit = "Pa",
      .label = "Largest von Mises stress",
      .doc = "Of the same bodies; -1 without deformation",
      .no_value = k_none,
      .listed = true},
     of_all,
     [](const StageRow& row) { return row.stress.value_or(k_none); }},
    {{.name = "mean_von_mises",
      .unit = "Pa",
      .label = "Mean von Mises stress",
      .doc = "Of the same bodies, by volume; -1 without deformation",
      .no_value = k_none,
      .listed = true},
     of_all,
     [](const StageRow& row) { return row.mean_stress.value_or(k_none); }},
    {{.name = "largest_distortion",
      .unit = "m",
      .label = "Largest distortion",
      .doc = "Of the same bodies; -1 where the run does not follow it",
      .no_value = k_none,
      .listed = true},
     of_all,
     [](const StageRow& row) { return row.distortion.value_or(k_none); }},
});

/// The reverse of the columns, for a table that a restart continues.
StageRow stage_of(const std::vector<double>& n) {
  const auto value = [](double number) { return number == k_none ? std::nullopt : std::optional(number); };
  return {.stage = static_cast<int>(n[1]),
          .cycle = static_cast<int>(n[2]),
          .time = n[0],
          .lowest = n[3] + k_zero_celsius,
          .highest = n[4] + k_zero_celsius,
          .stress = value(n[5]),
          .mean_stress = value(n[6]),
          .distortion = value(n[7])};
}

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  const std::vector<CsvColumn> head = head_of(stage_columns());
  return from ? CsvTable(path, head, *from) : CsvTable(path, head);
}

/// The bodies whose values count, [body of the mesh].
std::vector<char> bodies_that_count(const mesh::Mesh& mesh, const std::vector<CastBody>& castings,
                                    const linear::ActiveSet* active) {
  const auto there = [&](int body) { return active == nullptr || active->body(body); };
  std::vector<char> counts(mesh.bodies.size(), 0);
  for (const CastBody& cast : castings) counts[as_size(cast.body)] = there(cast.body) ? 1 : 0;
  if (std::ranges::find(counts, 1) != counts.end()) return counts;
  for (std::size_t body = 0; body < counts.size(); ++body)
    counts[body] = there(static_cast<int>(body)) ? 1 : 0;
  return counts;
}

/// The nodes of the elements of these bodies that are there, [local node].
std::vector<char> nodes_there(const mesh::Mesh& mesh, const FieldSet& fields,
                              const std::vector<char>& counts) {
  std::vector<char> nodes(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (counts[as_size(block.body)] == 0) continue;
    for (Index e = 0; e < block.size(); ++e)
      if (fields.there(block.input_element[as_size(e)]))
        for (int a = 0; a < mesh::node_count(block.shape); ++a) nodes[as_size(block.element(e)[a])] = 1;
  }
  return nodes;
}

/// The largest von Mises stress in the elements of some bodies and its mean by volume. Collective.
void add_stress(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields,
                const std::vector<char>& counts, StageRow& row) {
  const FieldValues stress(fields, mechanics::fields::k_von_mises.name);
  if (stress.empty()) return;
  double largest = 0;
  std::array<double, 2> sums{};  // of the stress times the volume, of the volume
  std::size_t first = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (counts[as_size(block.body)] != 0) {
      const PackVector<Lane> integrals = mesh::basis_integrals(mesh, block, kind);
      const auto n_nodes = as_size(mesh::node_count(block.shape));
      for (Index e = 0; e < block.n_counted; ++e) {
        if (!fields.there(block.input_element[as_size(e)])) continue;
        double volume = 0;
        for (std::size_t a = 0; a < n_nodes; ++a)
          volume += integrals[as_size(e / k_lanes) * n_nodes + a][e % k_lanes];
        const double value = stress[first + as_size(e)];
        largest = std::max(largest, value);
        sums[0] += value * volume;
        sums[1] += volume;
      }
    }
    first += as_size(block.size());
  }
  processes::sum(sums);
  row.stress = parallel::global_max(largest);
  row.mean_stress = sums[1] > 0 ? sums[0] / sums[1] : 0;
}

/// "35.2 min"
std::string time_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.4g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.4g} min", seconds / 60);
  return fmt::format("{:.4g} h", seconds / 3600);
}

std::string values_text(const StageRow& row, const DisplayUnits& units) {
  const auto shown = [](double value, const char* si, const std::string& unit) {
    return fmt::format("{:.4g} {}", units::to_display(value, si, unit), unit);
  };
  std::vector<std::string> parts;
  if (row.has_temperatures()) parts.push_back(shown(row.highest, "K", units.temperature));
  if (row.stress)
    parts.push_back(fmt::format("von Mises up to {}, mean {}", shown(*row.stress, "Pa", units.stress),
                                shown(*row.mean_stress, "Pa", units.stress)));
  if (row.distortion) parts.push_back("distortion up to " + shown(*row.distortion, "m", units.length));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::span<const StageColumn> stage_columns() {
  return k_stages;
}

StageRow stage_row(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::StepRecord& record,
                   const coupling::State& state, const std::vector<CastBody>& castings,
                   const FieldSet& fields) {
  StageRow row{.stage = record.stage_of_case, .cycle = record.cycle, .time = record.time};
  const std::vector<char> counts = bodies_that_count(mesh, castings, fields.active());
  const std::vector<char> nodes = nodes_there(mesh, fields, counts);
  const FieldValues distortion(fields, criteria::fields::k_distortion.name);
  double lowest = std::numeric_limits<double>::max(), highest = 0, farthest = 0;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
    const auto node = as_size(i);
    if (nodes[node] == 0) continue;
    if (phases.heat != nullptr) {
      lowest = std::min(lowest, state.heat.temperature[node]);
      highest = std::max(highest, state.heat.temperature[node]);
    }
    if (!distortion.empty()) farthest = std::max(farthest, distortion.length(node));
  }
  if (phases.heat != nullptr) {
    row.lowest = parallel::global_min(lowest);
    row.highest = parallel::global_max(highest);
  }
  if (!distortion.empty()) row.distortion = parallel::global_max(farthest);
  if (phases.mechanics != nullptr) add_stress(mesh, phases.mechanics->bodies().kind, fields, counts, row);
  return row;
}

StageTable::StageTable(const std::filesystem::path& path, std::optional<double> from)
    : table_(make_table(path, from)) {
  if (!from) return;
  // The rows of earlier stages, which the end of the run tells too.
  std::ifstream file(path, std::ios::binary);
  std::string line, cell;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::vector<double> numbers;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      numbers.push_back(std::strtod(cell.c_str(), nullptr));
    if (numbers.size() == table_.columns().size()) rows_.push_back(stage_of(numbers));
  }
}

void StageTable::add(const StageRow& row) {
  rows_.push_back(row);
  table_.add(row_of(stage_columns(), row));
}

const std::string& StageAnswers::name(const StageRow& row) const {
  return names.at(as_size(row.stage - 1));
}

std::string stage_lines(const StageAnswers& stages, const DisplayUnits& units) {
  std::string text;
  for (auto row = stages.rows.begin(); row != stages.rows.end(); ++row) {
    const auto same = [&](const StageRow& later) { return later.stage == row->stage; };
    if (std::any_of(row + 1, stages.rows.end(), same)) continue;
    text +=
        fmt::format("  {:<35} {}\n", fmt::format("end of '{}', {}", stages.name(*row), time_text(row->time)),
                    values_text(*row, units));
  }
  return text;
}

Json json(const StageAnswers& stages) {
  Json::Array all;
  for (const StageRow& row : stages.rows) {
    Json json;
    json.add("name", stages.name(row))
        .add("stage", row.stage)
        .add("cycle", row.cycle)
        .add("end[s]", row.time);
    if (row.has_temperatures())
      json.add("lowest_temperature[K]", row.lowest).add("highest_temperature[K]", row.highest);
    if (row.stress)
      json.add("largest_von_mises[Pa]", *row.stress).add("mean_von_mises[Pa]", *row.mean_stress);
    if (row.distortion) json.add("largest_distortion[m]", *row.distortion);
    all.push_back(std::move(json));
  }
  return Json(std::move(all));
}

}  // namespace solidus::results
