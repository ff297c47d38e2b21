// Findings on surroundings, gravity, steps and the size of everything.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "algebra/parallel.hpp"
#include "base/units.hpp"
#include "model/findings.hpp"

namespace solidus::model {

namespace {

void surroundings(const CaseSpec& spec, Findings& findings) {
  using Kind = ThermalConditionSpec::Kind;
  constexpr double k_coldest = 70, k_hottest = 1900;  // [K]: liquid nitrogen to furnaces
  for (const ThermalConditionSpec& t : spec.thermal_conditions) {
    const bool surrounded = t.kind == Kind::film || t.kind == Kind::radiation;
    if (surrounded && is_number(t.ambient))
      if (const double ambient = t.ambient.table.value(0); ambient < k_coldest || ambient > k_hottest)
        findings.push_back({false, t.where,
                            fmt::format("'{}' has surroundings of {:.0f} degC ({:.0f} K)", t.name,
                                        units::to_display(ambient, "K", "degC"), ambient),
                            "room temperature is 20 degC, 293 K"});
    if (t.kind == Kind::film && is_number(t.coefficient) && is_number(t.factor))
      if (const double h = t.coefficient.table.value(0); h > 1e6)
        findings.push_back({h > 1e8, t.where, fmt::format("the film '{}' has {:g} W/m2/K", t.name, h),
                            "usual are 5 to 100 W/m2/K in air, up to 50000 in water"});
  }
}

void gravity(const CaseSpec& spec, Findings& findings) {
  const double g = spec.analysis.gravity;
  if (g != 0 && (g < 1 || g > 30))
    findings.push_back(
        {false, spec.analysis.where, fmt::format("gravity is {:g} m/s2", g), "9.81 m/s2 on earth"});
}

void steps(const CaseSpec& spec, Findings& findings) {
  if (spec.time.steady || spec.time.adaptive || !spec.stages.empty() || !spec.time.end || !spec.time.step)
    return;
  if (*spec.time.step > 0.99 * *spec.time.end)
    findings.push_back({false, spec.time.where,
                        fmt::format("one step of {:g} s is the whole run", *spec.time.step),
                        "some hundred steps; time.adaptive chooses them"});
}

void size(const CaseSpec& spec, const Assembly& a, Findings& findings) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const mesh::Point& x : a.mesh.x) low = std::min(low, x[i]), high = std::max(high, x[i]);
    largest = std::max(largest, algebra::global_max(high) - algebra::global_min(low));
  }
  if (largest > 50 || largest < 1e-4)
    findings.push_back({false, spec.mesh.where, fmt::format("the mesh is {:.3g} m large", largest),
                        "is mesh.unit right? It is \"m\" unless the case says \"mm\""});
}

}  // namespace

void find_in_conditions(const CaseSpec& spec, const Assembly& a, Findings& findings) {
  if (spec.has_heat()) surroundings(spec, findings);
  gravity(spec, findings);
  steps(spec, findings);
  size(spec, a, findings);
}

}  // namespace solidus::model
