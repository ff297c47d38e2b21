/// A table is read back as columns with their units.
#include "results/report/report_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "system/errors.hpp"
#include "system/input_file.hpp"

namespace solidus::results {

namespace {

using Row = std::vector<std::string>;

/// Rows that end with a line end; a cell in quotes may hold commas, line ends and doubled quotes.
std::vector<Row> rows_of(const std::string& text) {
  // Quotes protect commas and line ends; a doubled quote is one.
  std::vector<Row> rows;
  Row row;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"')
        cell += c;
      else if (i + 1 < text.size() && text[i + 1] == '"')
        cell += text[++i];
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') {
        rows.push_back(std::move(row));
        row.clear();
      }
    } else if (c != '\r') {
      cell += c;
    }
  }
  return rows;
}

std::optional<double> number(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

TableColumn column(const std::vector<const Row*>& rows, std::size_t k, std::string header) {
  TableColumn out{std::move(header), {}, {}};
  for (const Row* row : rows) {
    const std::optional<double> value = number((*row)[k]);
    if (!value) break;
    out.numbers.push_back(*value);
  }
  if (out.numbers.size() == rows.size()) return out;
  out.numbers.clear();
  for (const Row* row : rows) out.texts.push_back((*row)[k]);
  return out;
}

}  // namespace

ReportTable read_table(const std::filesystem::path& file, std::size_t most) {
  constexpr double k_most_bytes = 4e9;
  require_readable(file, {file.string(), 0, 0}, k_most_bytes);
  std::string text;
  {
    std::FILE* in = std::fopen(file.c_str(), "rb");
    if (in == nullptr) throw InputError({file.string(), 0, 0}, "the file cannot be read");
    text.resize(std::filesystem::file_size(file));
    text.resize(std::fread(text.data(), 1, text.size(), in));
    std::fclose(in);
  }
  const std::vector<Row> rows = rows_of(text);
  ReportTable table;
  if (rows.empty()) return table;
  // Every row has as many cells as the header; of too many rows every so many is kept, and the last one.
  for (std::size_t r = 1; r < rows.size(); ++r)
    if (rows[r].size() != rows[0].size())
      throw InputError(
          {file.string(), static_cast<int>(r) + 1, 0},
          fmt::format("the row has {} cells where the header has {}", rows[r].size(), rows[0].size()));
  table.n_in_file = rows.size() - 1;
  const std::size_t stride = table.n_in_file > most ? (table.n_in_file + most - 1) / most : 1;
  // Rows thin out evenly, so that a curve keeps its shape.
  std::vector<const Row*> kept;
  for (std::size_t r = 1; r < rows.size(); ++r)
    if ((r - 1) % stride == 0 || r + 1 == rows.size()) kept.push_back(&rows[r]);
  table.n_rows = kept.size();
  for (std::size_t k = 0; k < rows[0].size(); ++k) table.columns.push_back(column(kept, k, rows[0][k]));
  return table;
}

}  // namespace solidus::results
