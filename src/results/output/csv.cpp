/// Rows are written and flushed one by one; a restart cuts off what lies behind its checkpoint.
#include "results/output/csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace solidus::results {

std::string number_text(double value) {
  // -0 would read as a sign of something; it is zero.
  return fmt::format("{}", value == 0 ? 0.0 : value);
}

std::vector<double> last_row(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line, last, cell;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) last = line;
  std::vector<double> row;
  for (std::istringstream cells(last); std::getline(cells, cell, ',');)
    row.push_back(std::strtod(cell.c_str(), nullptr));
  return row;
}

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

namespace {

std::string header_row(const std::vector<CsvColumn>& columns) {
  std::string row;
  for (const CsvColumn& column : columns) row += (row.empty() ? "" : ",") + csv_text(column.header());
  return row + "\n";
}

// Cuts the file behind its last row that is finished and not later than `time`.
void cut_after(const std::filesystem::path& path, const std::vector<CsvColumn>& columns, double time) {
  std::ifstream file(path, std::ios::binary);
  // The columns must be those of this run, or later rows would mean something else.
  if (!file) throw OutputError(path.string(), "there is no table to go on with");
  std::stringstream buffer;
  buffer << file.rdbuf();
  const std::string text = buffer.str(), header = header_row(columns);
  if (text.compare(0, header.size(), header) != 0)
    throw OutputError(path.string(), "the columns of the earlier run are not those of this one",
                      "this run: " + header.substr(0, header.size() - 1));
  // Rows are kept up to the time of the checkpoint, and only whole ones.
  std::size_t end = header.size();
  while (end < text.size()) {
    const std::size_t next = text.find('\n', end);
    if (next == std::string::npos || !(std::strtod(text.c_str() + end, nullptr) <= time)) break;
    end = next + 1;
  }
  std::error_code error;
  std::filesystem::resize_file(path, end, error);
  if (error) throw OutputError(path.string(), "cannot write: " + error.message());
}

struct ToText {
  const CsvColumn& column;
  std::string operator()(double value) const {
    if (!std::isfinite(value)) throw NotFiniteError("column '" + column.header() + "'", {});
    return number_text(value);
  }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return csv_text(value); }
};

}  // namespace

CsvTable::CsvTable(std::filesystem::path path, std::vector<CsvColumn> columns)
    : columns_(std::move(columns)), file_(std::move(path)) {
  file_.write(header_row(columns_));
  file_.flush();
}

CsvTable::CsvTable(std::filesystem::path path, std::vector<CsvColumn> columns, double time)
    : columns_(std::move(columns)),
      file_((cut_after(path, columns_, time), std::move(path)), OutputFile::Mode::append) {}

void CsvTable::add(std::span<const CsvCell> cells) {
  if (cells.size() != columns_.size())
    throw std::invalid_argument(
        fmt::format("{}: {} cells for {} columns", file_.path().string(), cells.size(), columns_.size()));
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) row += ',';
    row += std::visit(ToText{columns_[i]}, cells[i]);
  }
  row += '\n';
  file_.write(row);
  file_.flush();
}

void CsvTable::add(std::span<const double> cells) {
  const std::vector<CsvCell> row(cells.begin(), cells.end());
  add(row);
}

}  // namespace solidus::results
