/// Stresses at the points of a block, kept as a history of their own.
#pragma once

#include "mechanics/state/mechanical_state.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Zero at the points of a block with this history [Pa], six components.
inline BlockHistory no_stress(const BlockHistory& history) {
  constexpr int k_components = 6;
  BlockHistory stress{k_components, history.n_points, {}};
  if (history.n_components == 0) return stress;  // of a block that takes no part
  const std::size_t n_points = history.values.size() / as_size(history.n_components);
  stress.values.assign(n_points * k_components, Lane(0.0));
  return stress;
}

}  // namespace solidus::mechanics
