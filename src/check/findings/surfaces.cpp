// Findings on surfaces that have several conditions, of which one takes the other's place or works against
// it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "mesh/body_faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_least_ratio_of_films = 0.2;  // a film, of the other one on its face

using Heat = cases::ThermalConditionSpec::Kind;
using Motion = cases::MechanicalConditionSpec::Kind;

bool lies_on(const cases::ContactSpec& contact, const std::string& group) {
  const auto sides = contact.sides();
  return std::find(sides.begin(), sides.end(), group) != sides.end();
}

/// A surface in contact gives its heat to its partner. Films in addition to contacts: findings/interface.cpp.
void heat_beside_contacts(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    for (const cases::ContactSpec& contact : spec.contacts) {
      // Both act on one surface at one time, and the contact passes heat.
      if (!contact.heat || !lies_on(contact, c.group) || !share_a_stage(c.stages, contact.stages)) continue;
      if (c.kind == Heat::temperature && is_number(c.temperature))
        findings.push_back(
            {false, c.where,
             fmt::format(
                 "'{}' holds the surface '{}' at {:.0f} degC, on which the contact '{}' acts: what lies "
                 "behind it has no effect on the other body",
                 c.name, c.group, units::to_display(c.temperature.table.value(0), "K", "degC"), contact.name),
             "temperatures on outer surfaces alone, or channels"});
      // Numbers alone, since functions of place may be zero under the contact.
      const bool radiates = c.kind == Heat::radiation && is_number(c.emissivity) && is_number(c.factor);
      const bool flows = c.kind == Heat::flux && is_number(c.flux) && is_number(c.factor);
      if (radiates || flows)
        findings.push_back(
            {false, c.where,
             fmt::format("the {} '{}' lies on the surface '{}', through which heat passes by the "
                         "contact '{}' too",
                         radiates ? "radiation" : "flux", c.name, c.group, contact.name),
             radiates ? "radiation to surroundings on outer surfaces alone; between the two "
                        "surfaces: slave_emissivity and master_emissivity in [contact.heat]"
                      : "fluxes on outer surfaces alone"});
    }
}

/// A held temperature leaves nothing to another condition of its surface.
void beside_held_temperatures(const cases::CaseSpec& spec, Findings& findings) {
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const cases::ThermalConditionSpec& held = spec.thermal_conditions[i];
    if (held.kind != Heat::temperature) continue;
    for (std::size_t k = 0; k < spec.thermal_conditions.size(); ++k) {
      const cases::ThermalConditionSpec& other = spec.thermal_conditions[k];
      const bool twice = other.kind == Heat::temperature;
      // A pair of two held temperatures is told once, by the later of them.
      if (k == i || (twice && k > i) || other.in_volume() || other.group != held.group ||
          !share_a_stage(held.stages, other.stages))
        continue;
      findings.push_back(
          {false, held.where,
           fmt::format("'{}' holds the temperature of '{}', on which '{}' {}", held.name, held.group,
                       other.name, twice ? "holds another one" : "acts too, without effect"),
           "one condition for a surface"});
    }
  }
}

/// Two films on one face add up, as one of a channel and one of the whole outside around it. One of less than
/// a fifth of the other changes little. Films of one surface: findings/interface.cpp. Collective.
void films_in_one_place(const cases::CaseSpec& spec, const mesh::Mesh& mesh, Findings& findings) {
  // Films of one number are compared pair by pair over their faces, of whatever group they are.
  std::vector<const cases::ThermalConditionSpec*> films;
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    if (c.kind == Heat::film && is_number(c.coefficient) && is_number(c.factor)) films.push_back(&c);
  const auto strength = [](const cases::ThermalConditionSpec& c) {
    return c.coefficient.table.value(0) * c.factor.table.value(0);
  };
  for (std::size_t i = 0; i < films.size(); ++i) {
    const auto faces = mesh::body_face_keys(mesh, {films[i]->group});
    const double all = parallel::global_sum(static_cast<double>(faces.size()));
    for (std::size_t k = 0; k < i; ++k) {
      const double one = strength(*films[i]), other = strength(*films[k]);
      // Weak films along with strong ones are part of how a mould is cooled.
      if (films[i]->group == films[k]->group || !share_a_stage(films[i]->stages, films[k]->stages) ||
          std::min(one, other) < k_least_ratio_of_films * std::max(one, other))
        continue;
      // How many faces both have, over all processes.
      const auto others = mesh::body_face_keys(mesh, {films[k]->group});
      const double shared = parallel::global_sum(static_cast<double>(
          std::ranges::count_if(faces, [&](const auto& face) { return others.contains(face); })));
      if (!(shared > 0)) continue;
      findings.push_back(
          {false, films[i]->where,
           fmt::format("the films '{}' and '{}' both act on {:.0f} of the {:.0f} faces of '{}': they add up",
                       films[k]->name, films[i]->name, shared, all, films[i]->group),
           "one film for each face"});
    }
  }
}

/// A body all of whose nodes have their temperature prescribed.
void held_bodies(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    if (c.kind != Heat::temperature || !is_number(c.temperature) || !c.stages.empty()) continue;
    for (const cases::BodySpec& body : spec.bodies)
      if (body.mesh_group() == c.group)
        findings.push_back(
            {false, c.where,
             fmt::format("'{}' holds all of '{}' at {:.0f} degC: it takes any heat and never warms", c.name,
                         body.name, units::to_display(c.temperature.table.value(0), "K", "degC")),
             "initial_temperature of the body, and a condition on its outer surface"});
  }
}

/// Loads on surfaces in contact, and loads that pull.
void pressures(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.kind != Motion::pressure || !is_number(c.pressure)) continue;
    const double pressure = c.pressure.table.value(0);
    // A negative one pulls, which melt and sand cannot bear.
    if (pressure < 0)
      findings.push_back(
          {false, c.where,
           fmt::format("the pressure '{}' of {:.4g} MPa pulls at '{}'", c.name, 1e-6 * pressure, c.group),
           "a pressure is positive into the body"});
    // Where a contact acts its pressure is an unknown of the run, and a load adds to it.
    for (const cases::ContactSpec& contact : spec.contacts)
      if (lies_on(contact, c.group) && share_a_stage(c.stages, contact.stages))
        findings.push_back(
            {false, c.where,
             fmt::format("the pressure '{}' acts on the surface '{}', which the contact '{}' holds", c.name,
                         c.group, contact.name),
             "loads on free surfaces: the pressure between two bodies is found by the contact"});
  }
}

const std::optional<Function>& along(const cases::MechanicalConditionSpec& c, std::size_t axis) {
  const std::array<const std::optional<Function>*, 3> u{&c.ux, &c.uy, &c.uz};
  return axis == 0 && c.ur ? c.ur : *u[axis];
}

/// Two motions of the same nodes along the same axis.
void opposed_supports(const cases::CaseSpec& spec, Findings& findings) {
  for (std::size_t i = 0; i < spec.mechanical_conditions.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      // Only motions by numbers can be compared; equal ones may be stated twice.
      const cases::MechanicalConditionSpec &one = spec.mechanical_conditions[k],
                                           &two = spec.mechanical_conditions[i];
      if (one.kind != Motion::displacement || two.kind != Motion::displacement || one.group != two.group ||
          !share_a_stage(one.stages, two.stages))
        continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::optional<Function>&u = along(one, axis), &v = along(two, axis);
        if (!u || !v || !is_number(*u) || !is_number(*v) || u->table.value(0) == v->table.value(0)) continue;
        findings.push_back(
            {false, two.where,
             fmt::format("'{}' and '{}' move '{}' along the same axis, by {:g} and {:g} mm", one.name,
                         two.name, two.group, 1e3 * u->table.value(0), 1e3 * v->table.value(0)),
             "one condition for a surface and an axis"});
      }
    }
}

/// Which ends of a body along an axis a group of nodes is, none where it has other nodes of it as well.
/// Collective.
struct Ends {
  bool low = false, high = false;
};

Ends ends_of(const mesh::Mesh& mesh, const std::vector<Index>& group, const std::vector<char>& of_body,
             const BodyMeasures& body, std::size_t axis) {
  // Near is a thousandth of the length, which takes in the roughness of a mesh and no more.
  const double near = 1e-3 * (body.high[axis] - body.low[axis]);
  Ends found;
  bool elsewhere = false;
  // The nodes of the group at both ends of the body along the axis; a group that has others is no end.
  for (const Index node : group) {
    const auto i = as_size(node);
    if (of_body[i] == 0) continue;
    const double x = mesh.x[i][axis];
    if (x - body.low[axis] < near)
      found.low = true;
    else if (body.high[axis] - x < near)
      found.high = true;
    else
      elsewhere = true;
  }
  if (parallel::any_process(elsewhere)) return {};
  return {parallel::any_process(found.low), parallel::any_process(found.high)};
}

std::vector<char> nodes_of_body(const mesh::Mesh& mesh, std::size_t body) {
  std::vector<char> of_body(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body == static_cast<int>(body))
      for (const Index node : block.nodes) of_body[as_size(node)] = 1;
  return of_body;
}

/// Castings that supports hold at both ends of an axis cannot shrink along it. Collective.
void clamped_castings(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                      Findings& findings) {
  for (const Pour& pour : m.pours) {
    const cases::BodySpec& body = spec.bodies[pour.body];
    if (cases::only_conducts(body)) continue;
    const BodyMeasures& measures = m.bodies[pour.body];
    const std::vector<char> of_body = nodes_of_body(a.mesh, pour.body);
    // Along each axis the supports at both ends of the casting; the axis of revolution has no second end.
    for (std::size_t axis = 0; axis < as_size(a.mesh.dimension); ++axis) {
      const bool round = spec.analysis.kind == AnalysisKind::axisymmetric && axis == 0;
      const double extent = measures.high[axis] - measures.low[axis];
      if (round || !(extent > 0)) continue;
      // The last condition found at an end gives the name in the message.
      std::string low, high;
      for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
        const std::optional<Function>& u = along(c, axis);
        const auto nodes = a.mesh.node_sets.find(c.group);
        if (c.kind != Motion::displacement || !u || !is_number(*u) || nodes == a.mesh.node_sets.end() ||
            !cases::holds(c.stages, a.first_stage()))
          continue;
        const Ends ends = ends_of(a.mesh, nodes->second, of_body, measures, axis);
        if (ends.low) low = c.name;
        if (ends.high) high = c.name;
      }
      // Both ends are held from the start, along the same axis.
      if (low.empty() || high.empty()) continue;
      findings.push_back(
          {false, body.where,
           fmt::format(
               "'{}' and '{}' hold '{}' at both of its ends along {}, {:.4g} mm apart: it cannot shrink", low,
               high, body.name, std::string_view("xyz").substr(axis, 1), 1e3 * extent),
           "a support at one end: metals shrink by 1 to 2.5 % until they are cold, or tear"});
    }
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (spec.has_heat()) {
    heat_beside_contacts(spec, findings);
    beside_held_temperatures(spec, findings);
    films_in_one_place(spec, a.mesh, findings);
    held_bodies(spec, findings);
  }
  if (!spec.has_mechanics()) return;
  pressures(spec, findings);
  opposed_supports(spec, findings);
  clamped_castings(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_surfaces() {
  return {
      .name = "conditions of one surface",
      .place = 210,
      .find = &find,
      .rows = {
          {Topic::conditions, "two films on faces that two surface groups share",
           fmt::format("both constants, the weaker one at least {} of the other",
                       percent(k_least_ratio_of_films))},
          {Topic::conditions, "a temperature, radiation or flux on a surface in contact", "of one number"},
          {Topic::conditions, "a held temperature with another condition",
           "on the same surface, at the same time"},
          {Topic::conditions, "a body that is held at one temperature", "all of it"},
          {Topic::mechanics, "a negative pressure; a pressure on a surface in contact", "of one number"},
          {Topic::mechanics, "a casting between two supports", "they hold all ends along one axis"},
          {Topic::mechanics, "two motions of one surface along one axis", "of different size"}}};
}

}  // namespace solidus::check
