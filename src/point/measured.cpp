/// Columns are found by their headings and converted; deviations are taken where both curves have points.
#include "point/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "input/keys.hpp"
#include "input/units.hpp"
#include "system/input_file.hpp"

namespace solidus::point {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> result;
  while (true) {
    const std::size_t comma = line.find(',');
    result.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return result;
    line.remove_prefix(comma + 1);
  }
}

struct Heading {
  const RecordColumn* column;
  units::Conversion to_shown;
};

Heading heading(std::string_view text, const SourceLocation& where) {
  // A name of a column, and a unit in brackets that can be converted to that of the column.
  const std::size_t bracket = text.find('[');
  // The name decides the column, and the unit in brackets how its numbers are converted.
  const std::string name(trimmed(text.substr(0, bracket)));
  const RecordColumn* column = find_column(name);
  if (column == nullptr) {
    std::vector<std::string> names;
    for (const RecordColumn& each : columns()) names.push_back(each.name);
    throw InputError(where, fmt::format("the history has no column '{}'", name), one_of(names, name));
  }
  if (bracket == std::string_view::npos || text.back() != ']')
    throw InputError(where, fmt::format("the column '{}' has no unit", name),
                     fmt::format("{}, or another unit in the brackets", column->header()));
  const std::string unit(text.substr(bracket + 1, text.size() - bracket - 2));
  // A unit that does not fit is told with the place of its heading.
  try {
    return {column, units::conversion(unit, column->unit)};
  } catch (const std::invalid_argument& error) {
    throw InputError(where, fmt::format("the column '{}': {}", name, error.what()));
  }
}

double number(std::string_view cell, const SourceLocation& where) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw InputError(where, fmt::format("'{}' is no number", cell));
  return value;
}

/// The computed value at an abscissa; nothing outside the history.
std::optional<double> computed(const RecordColumn& x, const RecordColumn& y,
                               const std::vector<MaterialPointRecord>& history, double at) {
  for (std::size_t i = 1; i < history.size(); ++i) {
    const double from = x.shown(history[i - 1]), to = x.shown(history[i]);
    if (at < std::min(from, to) || at > std::max(from, to) || from == to) continue;
    const double part = (at - from) / (to - from);
    return (1 - part) * y.shown(history[i - 1]) + part * y.shown(history[i]);
  }
  return std::nullopt;
}

bool one_way(const RecordColumn& x, const std::vector<MaterialPointRecord>& history) {
  bool rises = false, falls = false;
  for (std::size_t i = 1; i < history.size(); ++i) {
    rises = rises || x.shown(history[i]) > x.shown(history[i - 1]);
    falls = falls || x.shown(history[i]) < x.shown(history[i - 1]);
  }
  return rises != falls;
}

}  // namespace

Measured read_measured(const std::filesystem::path& file, const SourceLocation& where) {
  require_readable(file, where);
  std::ifstream in(file);
  if (!in) throw InputError(where, fmt::format("the measured points '{}' cannot be read", file.string()));
  Measured measured;
  // Headings from the first row that holds something.
  std::vector<Heading> headings;
  std::string line;
  // The first row that is neither empty nor a comment holds the headings; each other one is a point.
  for (int n = 1; std::getline(in, line); ++n) {
    const SourceLocation here{file.string(), n, 0};
    if (trimmed(line).empty() || line.front() == '#') continue;
    const std::vector<std::string_view> row = cells(line);
    if (headings.empty()) {
      for (const std::string_view cell : row) headings.push_back(heading(cell, here));
      if (row.size() < 2)
        throw InputError(here, "the table has one column", "an abscissa and at least one more");
      for (const Heading& each : headings) measured.columns.push_back(each.column);
      continue;
    }
    if (row.size() != headings.size())
      throw InputError(here, fmt::format("there are {} cells for {} columns", row.size(), headings.size()));
    std::vector<double>& values = measured.rows.emplace_back();
    // Values are in the units in which the history is shown.
    for (std::size_t i = 0; i < row.size(); ++i) values.push_back(headings[i].to_shown(number(row[i], here)));
  }
  if (measured.rows.empty()) throw InputError({file.string(), 0, 0}, "the table has no rows");
  return measured;
}

std::vector<Deviation> deviations(const Measured& measured, const std::vector<MaterialPointRecord>& history) {
  std::vector<Deviation> result;
  const RecordColumn& x = *measured.columns.front();
  // Only where the abscissa runs one way does it tell a point of the history.
  if (!one_way(x, history)) return result;
  // The root of the mean square of the differences at those abscissas that the history reaches.
  for (std::size_t c = 1; c < measured.columns.size(); ++c) {
    double squares = 0, largest = 0;
    int points = 0;
    for (const std::vector<double>& row : measured.rows) {
      const std::optional<double> value = computed(x, *measured.columns[c], history, row.front());
      if (!value) continue;
      squares += (*value - row[c]) * (*value - row[c]);
      largest = std::max(largest, std::abs(row[c]));
      ++points;
    }
    if (points > 0) result.push_back({measured.columns[c], std::sqrt(squares / points), largest, points});
  }
  return result;
}

}  // namespace solidus::point
