/// Measured points next to a computed history: they are read from CSV and compared with the history.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "point/record.hpp"
#include "system/errors.hpp"

namespace solidus::point {

/// Rows of numbers in the units in which the columns are shown; the first column is the abscissa.
struct Measured {
  std::vector<const RecordColumn*> columns;
  std::vector<std::vector<double>> rows;
};

/// @param where  the place that names the file
/// Throws InputError with file and line: a file that cannot be read, an unknown column or unit, a cell that
/// is no number, fewer than two columns, no rows.
Measured read_measured(const std::filesystem::path& file, const SourceLocation& where);

struct Deviation {
  const RecordColumn* column;
  double rms;      ///< in the column's unit
  double largest;  ///< measured value, by size, to compare with
  int points;      ///< that lie within the history
};

/// For each column but the abscissa, over the points that the history covers. Empty where the history's
/// abscissa does not rise or fall throughout, and where it covers no point.
std::vector<Deviation> deviations(const Measured& measured, const std::vector<MaterialPointRecord>& history);

}  // namespace solidus::point
