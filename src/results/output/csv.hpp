/// Tables that grow row by row: history.csv, steps.csv. Plain CSV (RFC 4180), one header row whose names
/// carry units: `time[s]`, `T_center[degC]`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quantities/column.hpp"
#include "results/output/output_file.hpp"

namespace solidus::results {

struct CsvColumn {
  std::string name;  ///< "T_center"
  std::string unit;  ///< "degC"; "1" for a pure number; empty for text
  /// "T_center[degC]", "reason".
  std::string header() const { return unit.empty() ? name : name + "[" + unit + "]"; }
};

/// @param of  what a column belongs to, whose name stands before its own; empty: the whole model
inline CsvColumn csv_column(const quantities::Column& column, const std::string& of = {}) {
  return {of + std::string(column.name), std::string(column.unit)};
}

/// A number of the run and the column that shows it.
using Reading = std::pair<CsvColumn, double>;

using CsvCell = quantities::Cell;

/// The head of a table whose columns are declared (quantities/column.hpp).
template <class Rows>
std::vector<CsvColumn> head_of(const Rows& rows) {
  std::vector<CsvColumn> head;
  for (const auto& row : rows) head.push_back(csv_column(row.column));
  return head;
}
/// A row of a table all of whose columns are numbers and in every run.
template <class Rows, class Source>
std::vector<double> row_of(const Rows& rows, const Source& source) {
  std::vector<double> cells;
  for (const auto& row : rows) cells.push_back(row.read(source));
  return cells;
}

/// One process writes it. Every row is handed to the system when it is added, so a run that is killed leaves
/// whole rows. Numbers are written with as few digits as give the same bits back.
class CsvTable {
 public:
  /// Replaces an older file. Throws OutputError.
  CsvTable(std::filesystem::path path, std::vector<CsvColumn> columns);
  /// Goes on with the file of an earlier run (a restart): keeps the rows whose first column is at most `time`
  /// and cuts a last row that was not finished. Throws OutputError when the columns are not the same.
  CsvTable(std::filesystem::path path, std::vector<CsvColumn> columns, double time);

  /// Throws std::invalid_argument for a wrong number of cells, NotFiniteError naming the column, OutputError.
  void add(std::span<const CsvCell> cells);
  void add(std::span<const double> cells);

  const std::vector<CsvColumn>& columns() const { return columns_; }

 private:
  std::vector<CsvColumn> columns_;
  OutputFile file_;
};

/// The last row of a table of numbers; empty where there is none.
std::vector<double> last_row(const std::filesystem::path& path);
/// The shortest text that reads back as the same number.
std::string number_text(double value);
/// A text as one CSV cell, quoted if it has to be.
std::string csv_text(std::string_view text);

}  // namespace solidus::results
