// Findings on planes of symmetry that a condition cools.
#include <fmt/format.h>

#include <algorithm>

#include "check/finding_family.hpp"

namespace solidus::check {

namespace {

/// A support along one axis on a surface of the casting is a plane of symmetry: no heat crosses it.
void find(const cases::CaseSpec& spec, const setup::Assembly&, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat() || !spec.has_mechanics()) return;
  using Film = cases::ThermalConditionSpec::Kind;
  // Films and radiation on a skin of the casting, by the body that its surface belongs to.
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& film = spec.thermal_conditions[t];
    const bool poured = std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) {
      return m.surfaces[t].body == static_cast<int>(p.body);
    });
    if (!poured || (film.kind != Film::film && film.kind != Film::radiation)) continue;
    for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
      // Exactly one direction is held: two or three would be a clamp.
      const int held = (c.ux || c.ur ? 1 : 0) + (c.uy ? 1 : 0) + (c.uz ? 1 : 0);
      if (c.kind != cases::MechanicalConditionSpec::Kind::displacement || c.group != film.group || held != 1)
        continue;
      findings.push_back(
          {false, film.where,
           fmt::format("'{}' cools the surface '{}' of the casting, which '{}' holds along one axis, as on "
                       "a plane of symmetry",
                       film.name, film.group, c.name),
           "no heat crosses a plane of symmetry: no condition there"});
    }
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_symmetry_planes() {
  return {.name = "planes of symmetry",
          .place = 190,
          .find = &find,
          .rows = {{Topic::mechanics, "a film on a plane of symmetry",
                    "on a surface of the casting that is held along one axis"}}};
}

}  // namespace solidus::check
