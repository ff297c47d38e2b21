#include "results/answers/tearing_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "criteria/hot_tearing.hpp"
#include "criteria/quantities.hpp"

namespace solidus::results {

std::string cut_tendency(const quantities::Quantity& field, double value) {
  const bool tendency =
      &field == &criteria::fields::k_tearing_tendency || &field == &criteria::fields::k_strained_tendency;
  if (!tendency || value < criteria::k_most_tendency) return {};
  return fmt::format("{:g} or more", criteria::k_most_tendency);
}

std::string by_shrinkage(const quantities::Quantity& field,
                         std::span<const criteria::CriterionResult> found) {
  const auto alone = std::ranges::find(found, criteria::fed_nowhere(), &criteria::CriterionResult::name);
  if (&field != &criteria::fields::k_tearing_tendency || alone == found.end() || !(alone->value > 0))
    return {};
  return fmt::format(" (by shrinkage alone in {:.3g} %)", 100 * alone->value);
}

}  // namespace solidus::results
