#include "algebra/contribution.hpp"

#include <algorithm>

#include "algebra/parallel.hpp"

namespace solidus::algebra {

bool graph_outdated(std::span<Contribution* const> contributions) {
  const auto may_change = [](const Contribution* c) { return c->graph_may_change(); };
  if (std::none_of(contributions.begin(), contributions.end(), may_change)) return false;
  return any_process(std::any_of(contributions.begin(), contributions.end(),
                                 [](const Contribution* c) { return c->graph_outdated(); }));
}

}  // namespace solidus::algebra
