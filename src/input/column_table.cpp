/// The kind of table is told by its first character; cells are split, headers matched with units, and rows
/// checked for their length.
#include "input/column_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "input/json.hpp"
#include "system/input_file.hpp"

namespace solidus {
namespace {

using Column = ColumnTable::Column;

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

/// Returns the position of the opening bracket that the last character closes; "k (W/(m K))" has another one
/// within.
std::size_t opening_bracket(const std::string& text) {
  int open = 0;
  for (std::size_t i = text.size(); i-- > 0;) {
    open += text[i] == ')' || text[i] == ']' ? 1 : text[i] == '(' || text[i] == '[' ? -1 : 0;
    if (open == 0) return i + 1 < text.size() ? i : std::string::npos;
  }
  return std::string::npos;
}

Column column_of(std::string header) {
  Column column{std::move(header), {}, {}, {}, {}};
  HeaderText parts = split_header(column.header);
  column.name = std::move(parts.name);
  column.unit = std::move(parts.unit);
  return column;
}
/// The number that the whole cell is.
std::optional<double> number(std::string cell, bool decimal_comma) {
  if (decimal_comma && cell.find('.') == std::string::npos) std::replace(cell.begin(), cell.end(), ',', '.');
  if (!cell.empty() && cell.front() == '+') cell.erase(0, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

/// Cells between separators; quotes hold separators together. Blanks count as one.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false;
  const auto finish = [&] {
    cells.push_back(trimmed(cell));
    cell.clear();
  };
  for (const char c : line) {
    // A quote begins and ends a part in which separators are text.
    if (c == '"') quoted = !quoted;
    const bool blank = separator == ' ' && (c == ' ' || c == '\t');
    if (!quoted && (c == separator || blank)) {
      // Several blanks are one separator; every other separator counts by itself, and leaves empty
      // cells.
      if (separator != ' ' || !trimmed(cell).empty()) finish();
    } else {
      cell += c;
    }
  }
  if (separator != ' ' || !trimmed(cell).empty()) finish();
  return cells;
}

/// Names between blanks may hold single blanks: "T (C)   fraction solid (wt%)" are two where the rows have
/// two cells.
std::vector<std::string> header_cells(const std::string& line, char separator, std::size_t columns) {
  std::vector<std::string> cells = cells_of(line, separator);
  if (separator != ' ' || cells.size() == columns) return cells;
  cells.clear();
  for (std::size_t from = 0; from < line.size();) {
    const std::size_t gap = std::min(line.find("  ", from), line.size());
    if (std::string cell = trimmed(std::string_view(line).substr(from, gap - from)); !cell.empty())
      cells.push_back(std::move(cell));
    from = gap + 2;
  }
  return cells;
}

struct Line {
  int number;
  std::string text;
};

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string content = trimmed(line);
    if (!content.empty() && content.front() != '#') lines.push_back({number, line});
  }
  return lines;
}

bool all_numbers(const std::vector<std::string>& cells, bool decimal_comma) {
  bool some = false;
  for (const std::string& cell : cells) {
    if (!cell.empty() && !number(cell, decimal_comma)) return false;
    some = some || !cell.empty();
  }
  return some;
}

/// The header is the last line before the first row of numbers; another separator gives another header.
struct Layout {
  char separator;
  std::size_t header;
  std::size_t columns;
};

std::optional<Layout> layout(const std::vector<Line>& lines, char separator) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto row = cells_of(lines[i].text, separator);
    const auto before = header_cells(lines[i - 1].text, separator, row.size());
    if (row.size() > 1 && before.size() == row.size() && all_numbers(row, separator != ',') &&
        !all_numbers(before, separator != ','))
      return Layout{separator, i - 1, row.size()};
  }
  return std::nullopt;
}

ColumnTable parse_csv(const std::string& text, const std::string& name) {
  const std::vector<Line> lines = lines_of(text);
  std::optional<Layout> found;
  // The separator is the one that gives the most columns below a line of names.
  for (const char separator : {';', '\t', ',', ' '})
    if (const auto one = layout(lines, separator); one && (!found || one->columns > found->columns))
      found = one;
  if (!found)
    throw InputError({name, lines.empty() ? 0 : lines.front().number, 0},
                     "there is no table: no line of names is followed by as many numbers",
                     "columns with a header, separated by commas, semicolons, tabs or blanks");
  ColumnTable table{name, {}};
  // A name for every column from the cells of the header.
  for (std::string& header : header_cells(lines[found->header].text, found->separator, found->columns))
    table.columns.push_back(column_of(std::move(header)));
  // A cell that is no number leaves a gap in its column; a line with another number of cells is an error.
  for (std::size_t i = found->header + 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i].text, found->separator);
    if (cells.size() != table.columns.size())
      throw InputError(
          {name, lines[i].number, 0},
          fmt::format("the line has {} cells, the header has {}", cells.size(), table.columns.size()),
          "one cell for each column");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto value = number(cells[c], found->separator != ',');
      table.columns[c].values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
      table.columns[c].lines.push_back(lines[i].number);
    }
  }
  return table;
}

void append(Column& column, const Value& value) {
  column.values.push_back(value.is_number() ? value.number() : std::numeric_limits<double>::quiet_NaN());
  column.lines.push_back(value.where.line);
}

/// { "T [K]": [..], "fraction_solid": [..], "method": "scheil" }: a value that is no list of numbers is no
/// column.
void read_lists(const Value& object, ColumnTable& table) {
  for (const auto& [key, where, value] : object.entries()) {
    if (!value.is_list() || value.items().empty() || !value.items().front().is_number()) continue;
    Column column = column_of(key);
    for (const Value& item : value.items()) append(column, item);
    table.columns.push_back(std::move(column));
  }
}

/// [ { "T [K]": 900, "fs": 0 }, … ]
void read_rows(const Value& rows, ColumnTable& table) {
  for (const Value& row : rows.items()) {
    if (!row.is_table())
      throw InputError(row.where, "found " + row.describe() + " in a list of rows", "an object");
    if (table.columns.empty())
      for (const auto& entry : row.entries())
        if (entry.value.is_number()) table.columns.push_back(column_of(entry.key));
    for (Column& column : table.columns) {
      const Value* value = row.find(column.header);
      if (value == nullptr) throw InputError(row.where, "the row has no '" + column.header + "'");
      append(column, *value);
    }
  }
}

ColumnTable parse_json_table(const std::string& text, const std::string& name) {
  const Value document = parse_json(text, name);
  ColumnTable table{name, {}};
  if (document.is_table()) read_lists(document, table);
  if (document.is_list()) read_rows(document, table);
  if (table.columns.empty())
    throw InputError({name, 0, 0}, "the JSON holds no columns of numbers",
                     "an object of lists of equal length, or a list of objects");
  return table;
}

}  // namespace

HeaderText split_header(const std::string& text) {
  HeaderText parts;
  // A unit in brackets at the end, or behind the last comma.
  const auto open = opening_bracket(text);
  const auto comma = text.rfind(", ");
  if (open != std::string::npos && open > 0) {
    parts.name = trimmed(std::string_view(text).substr(0, open));
    parts.unit = trimmed(std::string_view(text).substr(open + 1, text.size() - open - 2));
  } else if (comma != std::string::npos && comma > 0) {
    parts.name = trimmed(std::string_view(text).substr(0, comma));
    parts.unit = trimmed(std::string_view(text).substr(comma + 2));
  } else {
    parts.name = trimmed(text);
  }
  return parts;
}

std::vector<std::string> ColumnTable::headers() const {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.header);
  return names;
}

ColumnTable parse_column_table(const std::string& text, const std::string& name) {
  const auto first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos) throw InputError({name, 0, 0}, "the file is empty");
  return text[first] == '{' || text[first] == '[' ? parse_json_table(text, name) : parse_csv(text, name);
}

ColumnTable read_column_table(const std::filesystem::path& file) {
  const SourceLocation where{file.string(), 0, 0};
  return parse_column_table(read_text_file(file, where), file.string());
}

}  // namespace solidus
