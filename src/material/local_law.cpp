/// Tables of local properties: their checks, and the power law between their points.
#include "material/local_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::material {

const std::vector<double>& LocalLaw::measure() const {
  if (!section.empty()) return section;
  return arm_spacing.empty() ? cooling_rate : arm_spacing;
}

std::optional<double> LocalLaw::value(std::span<const double> values, double at) const {
  const std::vector<double>& x = measure();
  if (values.size() != x.size() || !(at >= x.front()) || at > x.back()) return {};
  // The piece that holds the place, and the straight line in logarithms over it.
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto i = as_size(above - x.begin());
  const double share = std::log(at / x[i - 1]) / std::log(x[i] / x[i - 1]);
  return values[i - 1] * std::pow(values[i] / values[i - 1], share);
}

void check_local_law(const LocalLaw& law) {
  // One measure, which rises.
  const int measures = static_cast<int>(!law.section.empty()) + static_cast<int>(!law.arm_spacing.empty()) +
                       static_cast<int>(!law.cooling_rate.empty());
  if (measures != 1)
    throw InputError(law.where, "this [[local]] does not say along what its values are",
                     "one of section, arm_spacing and cooling_rate");
  const std::vector<double>& x = law.measure();
  if (x.size() < 2 || !(x.front() > 0) ||
      std::adjacent_find(x.begin(), x.end(), [](double a, double b) { return !(a < b); }) != x.end())
    throw InputError(law.where, "the measure of this [[local]] does not rise",
                     "at least two values above zero, the least one first");
  // As many values above zero of each property that is given, of which there is one at least.
  const std::pair<const char*, const std::vector<double>*> properties[] = {
      {"tensile_strength", &law.tensile_strength},
      {"elongation", &law.elongation},
      {"hardness", &law.hardness},
      {"grain_size", &law.grain_size}};
  bool any = false;
  for (const auto& [name, values] : properties) {
    if (values->empty()) continue;
    any = true;
    if (values->size() != x.size() || std::ranges::any_of(*values, [](double v) { return !(v > 0); }))
      throw InputError(law.where,
                       std::string(name) + " of this [[local]] has " + std::to_string(values->size()) +
                           " values for " + std::to_string(x.size()) +
                           " places, or one that is not above zero",
                       "a value above zero for each");
  }
  if (!any)
    throw InputError(law.where, "this [[local]] has no values",
                     "tensile_strength, elongation, hardness or grain_size");
  if (law.source.empty())
    throw InputError(law.where, "this [[local]] does not say where its values come from", "a source");
}

}  // namespace solidus::material
