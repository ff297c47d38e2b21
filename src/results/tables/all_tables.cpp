/// The rooms declare the columns of their tables; this list joins them.
#include "results/tables/all_tables.hpp"

#include "coupling/columns.hpp"
#include "criteria/columns.hpp"
#include "results/answers/answer_rows.hpp"
#include "results/answers/stage_table.hpp"
#include "results/output/quantity_json.hpp"

namespace solidus::results {

namespace {

using quantities::Column;

template <class Rows>
std::vector<const Column*> columns_of(const Rows& rows) {
  std::vector<const Column*> columns;
  for (const auto& row : rows) columns.push_back(&row.column);
  return columns;
}

/// Time, stage and shot, then what coupling declares; the probes of the case stand between them.
std::vector<const Column*> columns_of_history() {
  namespace columns = coupling::columns;
  std::vector<const Column*> all = {&columns::k_time, &columns::k_stage, &columns::k_cycle, &columns::k_shot,
                                    &columns::k_since_pouring};
  const std::vector<const Column*> global = coupling::history_columns();
  all.insert(all.end(), global.begin(), global.end());
  return all;
}

Json column_json(const Column& column) {
  Json row;
  row.add("name", std::string(column.name))
      .add("unit", std::string(column.unit))
      .add("label", std::string(column.label));
  if (column.chart != quantities::Chart::of_unit) row.add("chart", std::string(name(column.chart)));
  if (column.no_value) row.add("no_value", *column.no_value);
  if (column.background) row.add("background", true);
  if (column.logarithmic) row.add("logarithmic", true);
  if (column.listed) row.add("listed", true);
  return row;
}

std::string_view owner(AnswerOf of) {
  switch (of) {
    case AnswerOf::run:
      return "run";
    case AnswerOf::casting:
      return "casting";
    case AnswerOf::contact:
      return "contact";
    case AnswerOf::criteria:
      return "criteria";
  }
  return {};
}

Json answer_json(const AnswerRow& row) {
  Json one = column_json(row.column);
  one.add("of", std::string(owner(row.of)));
  if (!row.number.empty()) one.add("number", std::string(row.number));
  one.add("shown", json(row.unit_shown()));
  return one;
}

}  // namespace

const std::vector<DeclaredTable>& all_tables() {
  static const std::vector<DeclaredTable> tables = {
      {"history",
       "A row for the start and one for each step. The probes of the case stand behind time, stage and shot. "
       "Energies and entropies are sums since the start, over the whole model; axisymmetric they are those "
       "of the "
       "whole revolution, in plane strain per metre.",
       columns_of_history()},
      {"steps", "A row for each step; energies are those of the step.", columns_of(coupling::step_columns())},
      {"pools", "A row for each pool of melt at each step, in runs with heat and metal that freezes.",
       columns_of(criteria::pool_columns())},
      {"feeding",
       "A row for each step where feeding is followed: volumes since pouring, in two dimensions per depth or "
       "revolution.",
       columns_of(criteria::feeding_columns())},
      {"shots", "A row for each shot that is over, in runs with shots.",
       columns_of(coupling::shot_columns())},
      {"stages", "A row for each stage that is over, in runs with stages.", columns_of(stage_columns())}};
  return tables;
}

Json tables_json() {
  Json tables, document;
  for (const DeclaredTable& table : all_tables()) {
    Json::Array rows;
    for (const Column* column : table.columns) rows.push_back(column_json(*column));
    tables.add(std::string(table.name), std::move(rows));
  }
  Json::Array charts;
  for (int i = 1; i < quantities::k_charts; ++i)
    charts.emplace_back(std::string(name(static_cast<quantities::Chart>(i))));
  Json::Array answers;
  for (const AnswerRow* row : answer::k_all) answers.push_back(answer_json(*row));
  document.add("tables", std::move(tables))
      .add("charts", std::move(charts))
      .add("answers", std::move(answers));
  return document;
}

}  // namespace solidus::results
