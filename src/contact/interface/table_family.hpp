/// Tables of one argument that change with the temperature: h(gap, Θ), h(pressure, Θ).
#pragma once

#include <vector>

#include "numbers/table.hpp"

namespace solidus::contact {

/// Between the temperatures of two tables the values are linear in it; outside, those of the nearest table.
class TableFamily {
 public:
  TableFamily() = default;
  /// One table whatever the temperature.
  explicit TableFamily(Table table);
  /// Throws std::invalid_argument unless there are tables, as many as temperatures, and these increase.
  TableFamily(std::vector<double> temperature, std::vector<Table> tables);

  struct Value {
    double value = 0, by_argument = 0, by_temperature = 0, mixed = 0;
  };
  /// The derivatives at a bend are those of the piece on its right.
  Value at(double argument, double temperature) const;

  bool empty() const { return tables_.empty(); }
  bool of_temperature() const { return tables_.size() > 1; }
  const std::vector<double>& temperatures() const { return temperature_; }
  double min_value() const;

 private:
  std::vector<double> temperature_;  ///< [K], one per table; empty with a single table
  std::vector<Table> tables_;
};

}  // namespace solidus::contact
