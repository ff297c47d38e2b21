/// The tables of a results folder as columns.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace solidus::results {

inline constexpr std::size_t k_most_rows = 5000;  ///< of a table in a page

struct TableColumn {
  std::string header;              ///< "T_center[degC]"
  std::vector<double> numbers;     ///< of a column of numbers
  std::vector<std::string> texts;  ///< of a column that holds anything else
};

struct ReportTable {
  std::vector<TableColumn> columns;
  std::size_t n_rows = 0;     ///< kept
  std::size_t n_in_file = 0;  ///< that the file has
};

/// Reads a CSV file that Solidus wrote (RFC 4180). A last row without its end, of a run that was killed while
/// it wrote, is left out. Of more than `most` rows every second, third … is kept, with the last one. Throws
/// InputError with file and line for rows with another number of cells than the header.
ReportTable read_table(const std::filesystem::path& file, std::size_t most);

}  // namespace solidus::results
