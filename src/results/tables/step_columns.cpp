/// Rows of the two tables from the declarations of their columns.
#include "results/tables/step_columns.hpp"

#include <algorithm>

#include "coupling/energy_scale.hpp"

namespace solidus::results {

std::vector<CsvColumn> step_columns(StepTable table) {
  std::vector<CsvColumn> columns;
  for (const coupling::StepColumn& row : coupling::step_columns())
    if (row.there(table)) columns.push_back(csv_column(row.column));
  return columns;
}

std::vector<CsvCell> step_row(const coupling::StepRecord& r, StepTable table) {
  const coupling::StepSource source{r, coupling::total(r.contacts)};
  std::vector<CsvCell> cells;
  for (const coupling::StepColumn& row : coupling::step_columns())
    if (row.there(table)) cells.push_back(row.read(source));
  return cells;
}

std::vector<Reading> GlobalHistory::all() const {
  std::vector<Reading> all;
  for (const coupling::ReadValue& read : coupling::history_values(options_, now_))
    all.emplace_back(csv_column(*read.column, read.of), read.value);
  return all;
}

std::vector<Reading> GlobalHistory::entries() const {
  std::vector<Reading> all = this->all();
  std::erase_if(all, [this](const auto& entry) {
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const CsvColumn& c) { return c.header() == entry.first.header(); });
  });
  return all;
}

std::vector<CsvColumn> GlobalHistory::columns() const {
  std::vector<CsvColumn> columns;
  for (const auto& [column, value] : entries()) columns.push_back(column);
  return columns;
}

void GlobalHistory::start(const coupling::StepEffort& initial, const coupling::EnergyAudit& energy,
                          const coupling::StabilityAudit& stability, double heat_content,
                          double heat_of_bodies) {
  heat_content_ = heat_content;
  now_.last = initial;
  now_.heat_of_bodies = heat_of_bodies;
  now_.energy = energy;
  now_.energy.internal = initial.internal_energy - now_.energy.internal_at_start;
  now_.stability = stability;
}

void GlobalHistory::add(const coupling::StepEffort& step, double heat_of_bodies) {
  now_.last = step;
  now_.heat_of_bodies = heat_of_bodies;
  now_.energy += step.energy;
  now_.energy.internal = step.internal_energy - now_.energy.internal_at_start;
  now_.stability += step.stability;
}

std::vector<double> GlobalHistory::values() const {
  std::vector<double> values;
  for (const auto& [column, value] : entries()) values.push_back(value);
  return values;
}

double GlobalHistory::relative_defect() const {
  return coupling::relative_defect(now_.energy, heat_content_);
}

}  // namespace solidus::results
