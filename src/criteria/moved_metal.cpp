#include "criteria/moved_metal.hpp"

#include <algorithm>

#include "criteria/feeding.hpp"

namespace solidus::criteria {

NodalMetal metal_at_nodes(const CriteriaState& state) {
  const auto record = std::ranges::find(state.records, Feeding::k_name, &CriterionRecord::name);
  if (record == state.records.end()) return {};
  CriterionColumn column = record->columns.front();
  const FeedingRows rows(column.values);
  const std::size_t n = column.values.size() / k_feeding_numbers;
  NodalMetal metal{std::vector<double>(n, 1.0), std::vector<double>(n, 1.0)};
  // Nodes without metal of a casting keep one for both.
  for (std::size_t i = 0; i < n; ++i) {
    if (!(rows(i, k_room) > 0) || !(rows(i, k_poured) > 0)) continue;
    metal.held[i] = std::max(0.0, rows(i, k_metal) / rows(i, k_poured));
    metal.filled[i] = std::clamp(1 - rows.emptied(i), 0.0, 1.0);
  }
  return metal;
}

}  // namespace solidus::criteria
