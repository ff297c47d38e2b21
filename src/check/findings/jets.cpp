/// Findings on jets of water: the mean coefficient of a circle is a film on the whole surface that is named.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

/// A surface that is so many times as large as the circle of its jet is cooled too much.
constexpr double k_larger = 2;

void find(const cases::CaseSpec& spec, const setup::Assembly& /*a*/, const CaseMeasures& m,
          Findings& findings) {
  // Only in space a surface has the area of the circle; a jet is the film of the condition with its name.
  if (spec.analysis.kind != AnalysisKind::solid) return;
  for (const cases::JetSpec& jet : spec.jets) {
    const auto film =
        std::ranges::find(spec.thermal_conditions, jet.name, &cases::ThermalConditionSpec::name);
    const auto t = as_size(film - spec.thermal_conditions.begin());
    if (film == spec.thermal_conditions.end() || t >= m.surfaces.size() || m.surfaces[t].body == -1) continue;
    const double circle = std::numbers::pi * jet.radius * jet.radius, area = m.surfaces[t].area;
    if (area <= k_larger * circle) continue;
    findings.push_back(
        {false, jet.where,
         fmt::format(
             "the jet '{}' cools a circle of {:.3g} cm2, and '{}' has {:.4g} cm2, all of which get its "
             "coefficient",
             jet.name, 1e4 * circle, jet.group, 1e4 * area),
         "a surface of about the circle, such as the end of the bore"});
  }
}

}  // namespace

FindingFamily findings_jets() {
  return {.name = "jets",
          .place = 287,
          .find = &find,
          .rows = {{Topic::conditions, "a jet on a large surface",
                    fmt::format("more than {} times the circle of its radius, in space", number(k_larger))}}};
}

}  // namespace solidus::check
