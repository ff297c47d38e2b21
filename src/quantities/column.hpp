/// A column of a table that a run writes (history.csv, steps.csv and the others). Each is declared once, as a
/// row in the room that computes it; the table and its head, `solidus explain --tables`, the reference page,
/// the report, pictures and `compare` read the row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace solidus::quantities {

/// The chart of the report that shows a column. Columns of history.csv that name none are shown with those of
/// their unit, columns of other tables in none.
enum class Chart {
  of_unit,
  heat,
  mechanical_energies,
  energy_imbalance,
  stability,
  stability_of_phases,
  entropy,
  step,
  iterations,
  seconds,
  freezing_of_shots,
  die_of_shots
};
inline constexpr int k_charts = static_cast<int>(Chart::die_of_shots) + 1;

struct Column {
  /// As the head of the table has it, "stored_heat". One that begins with "_" is a column of each of several
  /// things (contacts, channels), whose name stands before it.
  std::string_view name;
  std::string_view unit;   ///< of the numbers in the file: "J", "degC"; "1" for a number; empty for a text
  std::string_view label;  ///< in legends and tables: "Stored heat"
  std::string_view doc;    ///< a sentence of the reference page, without its full stop
  std::string_view when = {};  ///< the runs that have it, "with contact"; empty: all
  Chart chart = Chart::of_unit;
  std::optional<double> no_value = {};  ///< stands for "nothing to say"; absent: every number counts
  bool background = false;              ///< a legend with many lines has it switched off
  bool logarithmic = false;             ///< its chart has a logarithmic axis
  bool listed = false;                  ///< the report shows it in its list of steps or shots, row by row
};

/// What a row of a table has in a column.
using Cell = std::variant<double, std::int64_t, std::string>;

/// A column with the runs that have it and what it takes from the source of a row.
template <class Parts, class Source, class Value = Cell>
struct ReadColumn {
  Column column;
  bool (*there)(const Parts& run);
  Value (*read)(const Source& source);
};

/// The title of a chart; empty for `of_unit`.
std::string_view name(Chart chart);

}  // namespace solidus::quantities
