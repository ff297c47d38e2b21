/// A phase fraction as a table, linear between its points.
#pragma once

#include <fmt/format.h>

#include <stdexcept>

#include "material/laws/fraction_law.hpp"

namespace solidus::material {

struct TableFraction {
  static constexpr std::string_view name = "table", doc = "a table";
  std::vector<double> temperatures, fractions;  ///< [K], 1

  static void keys(Section<TableFraction>& s) {
    s.quantity("temperatures", &TableFraction::temperatures, "K")
        .positive()
        .doc("Rising or falling; the same temperature twice is an isothermal part.");
    s.key("fractions", &TableFraction::fractions)
        .range(0, 1)
        .doc("One for each temperature, from 1 at the coldest to 0 at the hottest.");
  }
  PhaseFraction curve() const {
    if (temperatures.size() != fractions.size())
      throw std::invalid_argument(
          fmt::format("there are {} temperatures and {} fractions", temperatures.size(), fractions.size()));
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < fractions.size(); ++i) points.emplace_back(temperatures[i], fractions[i]);
    return PhaseFraction::table(std::move(points));
  }
};

}  // namespace solidus::material
