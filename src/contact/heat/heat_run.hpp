/// Consecutive points of the heat term that share their nodes, and the sum of their matrices.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::contact {

struct HeatRun {
  Index first = -1;
  std::vector<Index> nodes;
  std::vector<double> values;

  bool holds(std::span<const Index> other) const {
    return first >= 0 && std::equal(other.begin(), other.end(), nodes.begin(), nodes.end());
  }
  void start(Index point, std::span<const Index> of, std::size_t n_values) {
    first = point;
    nodes.assign(of.begin(), of.end());
    values.assign(n_values, 0.0);
  }
};

}  // namespace solidus::contact
