/// A row for each shot with what changed since the one before.
#include "results/answers/shot_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "coupling/columns.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"
#include "results/answers/answers.hpp"

namespace solidus::results {

namespace columns = coupling::columns;

namespace {

/// A member of summary.json that is called as a column of shots.csv.
std::string member(const quantities::Column& column) {
  return csv_column(column).header();
}

constexpr double k_not_solid = -1;

std::vector<double> numbers_of(const ShotRow& row) {
  const coupling::ShotSource source{row.shot, row.time_to_solidify.value_or(k_not_solid)};
  return row_of(coupling::shot_columns(), source);
}

/// The reverse of numbers_of(), for a table that a restart continues.
ShotRow shot_of(const std::vector<double>& n) {
  const auto kelvin = [](double celsius) { return celsius + k_zero_celsius; };
  ShotRow row;
  row.shot = {static_cast<int>(n[1]),
              n[2],
              n[0],
              {kelvin(n[4]), kelvin(n[5]), kelvin(n[6])},
              {kelvin(n[7]), kelvin(n[8]), kelvin(n[9])},
              n[10],
              {n[11], n[12], n[13]},
              n[14] != 0};
  if (n[3] >= 0) row.time_to_solidify = n[3];
  return row;
}

CsvTable make_table(const std::filesystem::path& path, std::optional<double> from) {
  const std::vector<CsvColumn> head = head_of(coupling::shot_columns());
  return from ? CsvTable(path, head, *from) : CsvTable(path, head);
}

Json temperature_json(const coupling::DieTemperature& die) {
  Json json;
  json.add("mean[K]", die.mean).add("lowest[K]", die.lowest).add("highest[K]", die.highest);
  return json;
}

}  // namespace

std::optional<double> time_to_solidify(const mesh::Mesh& mesh, const FieldSet& fields,
                                       const std::vector<CastBody>& castings) {
  const Field* field = fields.find(criteria::fields::k_solidified_at.name);
  if (field == nullptr || castings.empty()) return {};
  // Without castings, or without the criterion that notes the time, nothing is known.
  std::vector<double> storage;
  const std::span<const double> solidified = field->read(storage);
  double last = 0;
  bool liquid = false;
  // The latest node of the castings; while one is liquid there is no time.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (std::none_of(castings.begin(), castings.end(),
                     [&](const CastBody& cast) { return cast.body == block.body; }))
      continue;
    for (const Index node : block.nodes) {
      if (node >= mesh.n_owned_nodes) continue;
      const double at = solidified[as_size(node)];
      liquid = liquid || at < 0;
      last = std::max(last, at);
    }
  }
  last = parallel::global_max(last);
  return parallel::any_process(liquid) ? std::nullopt : std::optional(last);
}

ShotTable::ShotTable(const std::filesystem::path& path, std::optional<double> from)
    : table_(make_table(path, from)) {
  if (!from) return;
  // A restart reads the rows of earlier shots, so that the end of the run can name the first one.
  std::ifstream file(path, std::ios::binary);
  std::string line, cell;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::vector<double> numbers;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      numbers.push_back(std::strtod(cell.c_str(), nullptr));
    if (numbers.size() == table_.columns().size()) rows_.push_back(shot_of(numbers));
  }
}

void ShotTable::add(const coupling::ShotRecord& record, std::optional<double> time_to_solidify) {
  rows_.push_back({record, time_to_solidify});
  table_.add(numbers_of(rows_.back()));
}

std::string shot_text(const ShotRow& row) {
  const coupling::ShotRecord& s = row.shot;
  return fmt::format(
      "shot {}: {}; the die had {:.4g} degC in the mean, {:.4g} degC at its hottest place when it began, and "
      "changed by {:.3g} K at most",
      s.number,
      row.time_to_solidify ? fmt::format("solid {:.4g} s after pouring", *row.time_to_solidify)
                           : std::string("not solid when it left"),
      s.at_pour.mean - k_zero_celsius, s.at_pour.highest - k_zero_celsius, s.change);
}

Json json(const std::vector<ShotRow>& rows) {
  Json::Array all;
  // Every shot as an object, with the state of the die before and after it.
  for (const ShotRow& row : rows) {
    const coupling::ShotRecord& s = row.shot;
    Json json;
    json.add(std::string(columns::k_shot.name), s.number)
        .add(member(columns::k_poured_at), s.poured)
        .add("end[s]", s.end);
    if (row.time_to_solidify) json.add(member(columns::k_time_to_solidify), *row.time_to_solidify);
    json.add("die_at_start", temperature_json(s.at_pour))
        .add("die_at_end", temperature_json(s.at_end))
        .add(member(columns::k_largest_change), s.change)
        .add(member(columns::k_heat_poured), s.heat.poured)
        .add(member(columns::k_heat_ejected), s.heat.ejected)
        .add(member(columns::k_heat_corrected), s.heat.corrected)
        .add(std::string(columns::k_periodic.name), s.periodic);
    all.push_back(std::move(json));
  }
  return Json(std::move(all));
}

}  // namespace solidus::results
