/// Tables of numbers that other programs write: columns with a header, in CSV (comma, semicolon, tab or
/// blanks) or JSON (an object of lists of equal length, or a list of objects).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "system/errors.hpp"

namespace solidus {

struct ColumnTable {
  struct Column {
    std::string header;          ///< as in the file, "Temperature [C]"
    std::string name, unit;      ///< of the header, "Temperature" and "C"; the unit may be empty
    std::vector<double> values;  ///< a cell that is empty or no number is NaN
    std::vector<int> lines;      ///< of the file, one for each value
  };
  std::string file;
  std::vector<Column> columns;

  std::vector<std::string> headers() const;
  SourceLocation place(const Column& column, std::size_t row) const { return {file, column.lines[row], 0}; }
};

/// "Temperature [C]" and "Temperature (C)" are a name and a unit; so is "Temperature, C".
struct HeaderText {
  std::string name, unit;
};
HeaderText split_header(const std::string& header);

/// Reads a file; JSON is told by its first character. Lines before the header of a CSV and comments (#) are
/// skipped. Throws InputError with the line for rows of unequal length and where no table is found.
ColumnTable read_column_table(const std::filesystem::path& file);
/// The same from memory; `name` stands for the file in messages.
ColumnTable parse_column_table(const std::string& text, const std::string& name);

}  // namespace solidus
