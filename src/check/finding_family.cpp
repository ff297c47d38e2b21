/// The list of families in the order of their numbers.
#include "check/finding_family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "check/built_in_findings.hpp"

namespace solidus::check {

namespace {

void insert(std::vector<FindingFamily>& families, FindingFamily family) {
  for (const FindingFamily& other : families)
    if (other.name == family.name || other.place == family.place)
      throw std::logic_error(
          fmt::format("the findings '{}' at place {} and '{}' at place {}: one of both is taken", family.name,
                      family.place, other.name, other.place));
  const auto next = std::ranges::upper_bound(families, family.place, {}, &FindingFamily::place);
  families.insert(next, std::move(family));
}

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<FindingFamily>& families() {
  static std::vector<FindingFamily> all = [] {
    std::vector<FindingFamily> built_in;
    for (FindingFamily& family : built_in_findings()) insert(built_in, std::move(family));
    return built_in;
  }();
  return all;
}

}  // namespace

const std::vector<FindingFamily>& finding_families() {
  return families();
}

void add_findings(FindingFamily family) {
  insert(families(), std::move(family));
}

std::string number(double value) {
  constexpr double k_small = 1e-3, k_grouped = 1e3, k_large = 1e5;
  const double size = std::abs(value);
  if (size == 0 || (size >= k_small && size < k_grouped)) return fmt::format("{:.4g}", value);
  if (size >= k_grouped && size < k_large)
    return fmt::format("{:.0f} {:03.0f}", std::trunc(value / 1000), std::fmod(std::round(size), 1000));
  const double exponent = std::floor(std::log10(size) + 1e-9);
  return fmt::format("{:.4g}e{:.0f}", value / std::pow(10, exponent), exponent);
}

std::string percent(double share) {
  return number(100 * share) + " %";
}

}  // namespace solidus::check
