/// The heading tells the columns. Points that form a grid are interpolated along it, others by weights that
/// fall with the distance.
#include "input/point_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "input/keys.hpp"
#include "numbers/index_casts.hpp"
#include "system/input_file.hpp"

namespace solidus {

namespace {

constexpr std::array<std::string_view, 5> k_coordinates = {"x", "y", "z", "r", "t"};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

/// What stands between the columns, told by their heading. Where it is no comma, numbers may have a decimal
/// one.
char separator_of(std::string_view heading_line) {
  for (const char separator : {';', ',', '\t'})
    if (heading_line.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<std::string_view> cells(std::string_view line, char separator) {
  std::vector<std::string_view> result;
  // A tab between columns is no blank at the end of a line.
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  while (true) {
    const std::size_t end = line.find(separator);
    result.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return result;
    line.remove_prefix(end + 1);
  }
}

double number(std::string_view text, char separator, const SourceLocation& where) {
  double value = 0;
  std::string cell(text);
  if (separator != ',' && cell.find('.') == std::string::npos)
    std::replace(cell.begin(), cell.end(), ',', '.');
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw InputError(where, fmt::format("'{}' is no number", text));
  return value;
}

/// "z[mm]" -> "z" and "mm"; a "time" as of history.csv is the coordinate t.
struct Heading {
  std::string name, unit;
};

Heading heading(std::string_view cell, const SourceLocation& where) {
  const std::size_t bracket = cell.find('[');
  if (bracket == std::string_view::npos || cell.back() != ']')
    throw InputError(where, fmt::format("the column '{}' has no unit", cell),
                     "its unit in brackets: z[mm], t[s], h[W/m2/K]");
  std::string name(trimmed(cell.substr(0, bracket)));
  if (name == "time") name = "t";
  return {std::move(name), std::string(cell.substr(bracket + 1, cell.size() - bracket - 2))};
}

/// Columns that are read, and the conversion of their numbers to SI.
struct Layout {
  std::vector<std::size_t> columns;  ///< of the coordinates, t last, and of the value
  std::vector<units::Conversion> to_si;
  std::vector<std::string> names;  ///< of the coordinates
};

Layout layout(const std::vector<std::string_view>& row, const std::string& column, std::string_view unit,
              const SourceLocation& where) {
  // The heading says for every column its name and unit. Coordinates are found first, in the order in which
  // the interpolation takes them.
  std::vector<Heading> headings;
  for (const std::string_view cell : row) headings.push_back(heading(cell, where));
  Layout result;
  // Every column is kept with the conversion of its unit, so that rows are read without asking
  // again.
  const auto add = [&](std::size_t i, std::string_view si) {
    try {
      result.to_si.push_back(units::conversion(headings[i].unit, si));
    } catch (const std::invalid_argument& error) {
      throw InputError(where, fmt::format("the column '{}': {}", headings[i].name, error.what()));
    }
    result.columns.push_back(i);
  };
  std::vector<std::string> others;
  for (const std::string_view name : k_coordinates)
    for (std::size_t i = 0; i < headings.size(); ++i)
      if (headings[i].name == name && name != column) {
        if (std::find(result.names.begin(), result.names.end(), name) != result.names.end())
          throw InputError(where, fmt::format("there are two columns '{}'", name));
        result.names.emplace_back(name);
        add(i, name == "t" ? "s" : "m");
      }
  // Of the other columns one is the value: the one that is named, or the only one.
  for (const Heading& h : headings)
    if (std::find(k_coordinates.begin(), k_coordinates.end(), h.name) == k_coordinates.end())
      others.push_back(h.name);
  if (result.names.empty())
    throw InputError(where,
                     fmt::format("the table has no coordinate among its columns {}", fmt::join(others, ", ")),
                     fmt::format("columns of {}", fmt::join(k_coordinates, ", ")));
  // With one column of values no name is needed; with more it is.
  if (column.empty() && others.size() != 1)
    throw InputError(where, fmt::format("the table has {} columns of values", others.size()),
                     others.empty() ? "one besides the coordinates" : "column = \"...\", " + one_of(others));
  const std::string value = column.empty() ? others.front() : column;
  // The value is the last column of a point, behind its coordinates.
  const auto found =
      std::find_if(headings.begin(), headings.end(), [&](const Heading& h) { return h.name == value; });
  if (found == headings.end())
    throw InputError(where, fmt::format("the table has no column '{}'", value), one_of(others, value));
  add(as_size(found - headings.begin()), unit);
  return result;
}

}  // namespace

PointTable::PointTable(const std::filesystem::path& file, const std::string& column, std::string_view unit,
                       const SourceLocation& where) {
  require_readable(file, where);
  std::ifstream in(file);
  if (!in) throw InputError(where, fmt::format("the table of points '{}' cannot be read", file.string()));
  Layout columns;
  std::size_t n_cells = 0;
  char separator = ',';
  std::string line;
  // The first row that is neither empty nor a comment names the columns; each other one is a point.
  for (int n = 1; std::getline(in, line); ++n) {
    const SourceLocation here{file.string(), n, 0};
    // Editors of Windows put a mark of UTF-8 before the first line.
    if (n == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (columns.columns.empty()) separator = separator_of(line);
    const std::vector<std::string_view> row = cells(line, separator);
    if (columns.columns.empty()) {
      columns = layout(row, column, unit, here);
      n_cells = row.size();
      continue;
    }
    // A row that is short or long is told by its line number.
    if (row.size() != n_cells)
      throw InputError(here, fmt::format("there are {} cells for {} columns", row.size(), n_cells));
    std::vector<double>& point = points_.emplace_back();
    for (std::size_t i = 0; i < columns.columns.size(); ++i)
      point.push_back(columns.to_si[i](number(row[columns.columns[i]], separator, here)));
  }
  if (points_.empty()) throw InputError({file.string(), 0, 0}, "the table of points has no rows");
  names_ = columns.names;
  n_space_ = names_.size() - (names_.back() == "t" ? 1 : 0);
  arrange(file);
}

void PointTable::arrange(const std::filesystem::path& file) {
  // Rows in order of their coordinates, no point twice.
  const std::size_t n = names_.size();
  std::sort(points_.begin(), points_.end());
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (std::equal(points_[i].begin(), points_[i].end() - 1, points_[i - 1].begin()))
      throw InputError({file.string(), 0, 0},
                       fmt::format("two rows have the point ({:g})",
                                   fmt::join(points_[i].begin(), points_[i].end() - 1, ", ")));
  // The values of each coordinate: if every combination has a row it is a grid.
  std::size_t product = 1;
  std::vector<std::vector<double>> axes(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& point : points_) axes[i].push_back(point[i]);
    std::sort(axes[i].begin(), axes[i].end());
    axes[i].erase(std::unique(axes[i].begin(), axes[i].end()), axes[i].end());
    low_.push_back(axes[i].front());
    high_.push_back(axes[i].back());
    product *= axes[i].size();
  }
  // Different points of these coordinates, as many as the grid has: all of the grid's, in its order.
  if (product == points_.size()) {
    axes_ = std::move(axes);
    for (const auto& point : points_) values_.push_back(point.back());
    return;
  }
  // Scattered points are grouped by time, so that each time can be searched in space.
  if (n_space_ == 0 || n_space_ == n) return;
  std::stable_sort(points_.begin(), points_.end(),
                   [&](const auto& a, const auto& b) { return a[n_space_] < b[n_space_]; });
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (i == 0 || points_[i][n_space_] != points_[i - 1][n_space_]) {
      times_.push_back(points_[i][n_space_]);
      first_of_time_.push_back(i);
    }
  first_of_time_.push_back(points_.size());
}

double PointTable::on_grid(std::span<const double> at, std::size_t axis, std::size_t offset) const {
  if (axis == axes_.size()) return values_[offset];
  const std::vector<double>& x = axes_[axis];
  const std::size_t base = offset * x.size();
  if (x.size() == 1 || at[axis] <= x.front()) return on_grid(at, axis + 1, base);
  if (at[axis] >= x.back()) return on_grid(at, axis + 1, base + x.size() - 1);
  const auto next = as_size(std::upper_bound(x.begin(), x.end(), at[axis]) - x.begin());
  const double part = (at[axis] - x[next - 1]) / (x[next] - x[next - 1]);
  const double before = on_grid(at, axis + 1, base + next - 1);
  return part == 0 ? before : before + part * (on_grid(at, axis + 1, base + next) - before);
}

double PointTable::scattered(std::span<const double> at, std::size_t first, std::size_t last) const {
  // One neighbour more than is weighted: two a direction and direction's sign.
  const std::size_t n_near = std::min<std::size_t>(last - first, 4 * n_space_ + 1);
  std::vector<std::pair<double, std::size_t>> near;  // distance, point
  near.reserve(last - first);
  // Outside of the box of all points the nearest place on it counts.
  for (std::size_t k = first; k < last; ++k) {
    double squared = 0;
    for (std::size_t i = 0; i < n_space_; ++i) {
      const double d = std::clamp(at[i], low_[i], high_[i]) - points_[k][i];
      squared += d * d;
    }
    near.emplace_back(std::sqrt(squared), k);
  }
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n_near), near.end());
  // A point that is met exactly, or is the only one, gives its own value.
  if (near.front().first == 0 || n_near == 1) return points_[near.front().second].back();
  // The weight falls to zero at the farthest neighbour, so that values are continuous where
  // neighbours change.
  const bool all = n_near == last - first;
  const double reach = all ? 2 * near[n_near - 1].first : near[n_near - 1].first;
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < n_near; ++k) {
    const double root = (reach - near[k].first) / (reach * near[k].first);
    sum += root * root * points_[near[k].second].back();
    weights += root * root;
  }
  return weights > 0 ? sum / weights : points_[near.front().second].back();
}

double PointTable::value(std::span<const double> at) const {
  if (!axes_.empty()) return on_grid(at, 0, 0);
  if (times_.empty()) return scattered(at, 0, points_.size());
  const double t = std::clamp(at[n_space_], times_.front(), times_.back());
  const auto next = as_size(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
  const double before = scattered(at, first_of_time_[next - 1], first_of_time_[next]);
  if (next == times_.size() || t == times_[next - 1]) return before;
  const double after = scattered(at, first_of_time_[next], first_of_time_[next + 1]);
  return before + (t - times_[next - 1]) / (times_[next] - times_[next - 1]) * (after - before);
}

std::vector<double> PointTable::times() const {
  if (names_.back() != "t") return {};
  return grid() ? axes_.back() : times_;
}

bool PointTable::outside(std::span<const double> at) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const double margin = 1e-9 * std::max({high_[i] - low_[i], std::abs(low_[i]), std::abs(high_[i])});
    if (at[i] < low_[i] - margin || at[i] > high_[i] + margin) return true;
  }
  return false;
}

}  // namespace solidus
