/// Whether any contribution has changed its pattern, over all processes.
#include "linear/contribution.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"

namespace solidus::linear {

bool graph_outdated(std::span<Contribution* const> contributions) {
  const auto may_change = [](const Contribution* c) { return c->graph_may_change(); };
  if (std::none_of(contributions.begin(), contributions.end(), may_change)) return false;
  return parallel::any_process(std::any_of(contributions.begin(), contributions.end(),
                                           [](const Contribution* c) { return c->graph_outdated(); }));
}

}  // namespace solidus::linear
