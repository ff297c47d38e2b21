// Findings on conditions whose surface lies in a contact with a part of its faces. A rule for groups that
// takes too much makes such surfaces, for instance all faces of a body, or those whose normal is nearly an
// axis where a curved face begins. Conditions of a whole contact surface: findings/interface.cpp,
// findings/surfaces.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "mesh/body_faces.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

struct Condition {
  std::string kind, name, group;  ///< the kind in words
  const std::vector<std::string>* stages;
  SourceLocation where;
  bool of_heat;
};

bool has_one_strength(const cases::ThermalConditionSpec& c) {
  return is_number(c.coefficient) && is_number(c.flux) && is_number(c.emissivity) && is_number(c.factor);
}

std::vector<Condition> conditions_of_surfaces(const cases::CaseSpec& spec) {
  using Heat = cases::ThermalConditionSpec::Kind;
  using Motion = cases::MechanicalConditionSpec::Kind;
  std::vector<Condition> conditions;
  // Conditions of heat and of motion alike, as long as they act on a surface and with one strength
  // all over it.
  if (spec.has_heat())
    for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
      if (!c.in_volume() && has_one_strength(c))
        conditions.push_back({c.kind == Heat::temperature ? "held temperature"
                              : c.kind == Heat::flux      ? "flux"
                              : c.kind == Heat::film      ? "film"
                                                          : "radiation",
                              c.name, c.group, &c.stages, c.where, true});
  if (spec.has_mechanics())
    for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions)
      if (c.kind != Motion::plane && c.kind != Motion::body_force)
        conditions.push_back({c.kind == Motion::displacement ? "support"
                              : c.kind == Motion::traction   ? "traction"
                                                             : "pressure",
                              c.name, c.group, &c.stages, c.where, false});
  return conditions;
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  // A condition whose faces lie partly in a contact acts on what cannot be meant: the whole group or none.
  for (const Condition& condition : conditions_of_surfaces(spec)) {
    const auto faces = mesh::body_face_keys(a.mesh, {condition.group});
    const double all = parallel::global_sum(static_cast<double>(faces.size()));
    if (!(all > 0)) continue;
    // Only contacts that pass what the condition acts on, in a stage that both have.
    for (const cases::ContactSpec& contact : spec.contacts) {
      if ((condition.of_heat && !contact.heat) || !share_a_stage(*condition.stages, contact.stages)) continue;
      const std::array<std::string, 2> sides = contact.sides();
      const auto in_contact = mesh::body_face_keys(a.mesh, {sides[0], sides[1]});
      const double shared = parallel::global_sum(static_cast<double>(
          std::ranges::count_if(faces, [&](const auto& face) { return in_contact.contains(face); })));
      // No common face is the usual case, and all of them another finding.
      if (!(shared > 0) || shared == all) continue;
      findings.push_back(
          {false, condition.where,
           fmt::format("{:.0f} of the {:.0f} faces of '{}', on which the {} '{}' acts, lie in "
                       "the contact '{}'",
                       shared, all, condition.group, condition.kind, condition.name, contact.name),
           "groups of outer faces alone: a rule with `plane` or a smaller `angle`, or the "
           "group of what faces no body (NAME_free)"});
    }
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_partly_in_contact() {
  return {.name = "surfaces partly in contact",
          .place = 220,
          .find = &find,
          .rows = {{Topic::conditions, "a condition on a surface that is partly in contact",
                    "constant films, fluxes, held temperatures, supports and loads: perhaps the rule of the "
                    "group selects too many faces, such as all faces of a body, or a normal near that of a "
                    "curved face in contact"}}};
}

}  // namespace solidus::check
