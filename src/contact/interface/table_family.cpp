/// Linear between the two tables whose temperatures enclose the one asked for; the nearest table beyond
/// them.
#include "contact/interface/table_family.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

TableFamily::TableFamily(Table table) : tables_{std::move(table)} {}

TableFamily::TableFamily(std::vector<double> temperature, std::vector<Table> tables)
    : temperature_(std::move(temperature)), tables_(std::move(tables)) {
  if (tables_.empty() || tables_.size() != temperature_.size())
    throw std::invalid_argument("a family needs a temperature for each of its tables");
  for (std::size_t i = 1; i < temperature_.size(); ++i)
    if (!(temperature_[i] > temperature_[i - 1]))
      throw std::invalid_argument("the temperatures of a family do not increase");
}

TableFamily::Value TableFamily::at(double argument, double temperature) const {
  // The first table that is hotter; the other neighbour is the one before it.
  const auto next =
      as_size(std::upper_bound(temperature_.begin(), temperature_.end(), temperature) - temperature_.begin());
  // Beyond the temperatures the nearest table holds; between two everything is linear.
  if (temperature_.size() < 2 || next == 0 || next == temperature_.size()) {
    const auto line = (next == 0 ? tables_.front() : tables_.back()).line(argument);
    return {line.value, line.slope, 0, 0};
  }
  const auto low = tables_[next - 1].line(argument), high = tables_[next].line(argument);
  const double span = temperature_[next] - temperature_[next - 1];
  const double share = (temperature - temperature_[next - 1]) / span;
  return {low.value + share * (high.value - low.value), low.slope + share * (high.slope - low.slope),
          (high.value - low.value) / span, (high.slope - low.slope) / span};
}

double TableFamily::min_value() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Table& table : tables_) least = std::min(least, table.min_value());
  return least;
}

}  // namespace solidus::contact
