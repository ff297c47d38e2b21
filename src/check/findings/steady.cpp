// Findings on the steady state: bodies whose temperature nothing holds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

constexpr double k_balanced = 1e-3;  // of the heat that passes

using Kind = cases::ThermalConditionSpec::Kind;

/// Bodies in groups that exchange heat with each other, through shared nodes or contacts: [body] the number
/// of its group.
std::vector<std::size_t> groups_of(const cases::CaseSpec& spec, const CaseMeasures& m) {
  std::vector<std::size_t> group(spec.bodies.size());
  std::iota(group.begin(), group.end(), 0);
  const auto join = [&](std::size_t a, std::size_t b) {
    const std::size_t from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
    std::ranges::replace(group, from, to);
  };
  for (std::size_t a = 0; a < group.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (m.bodies[a].shared_nodes[b] > 0) join(a, b);
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const setup::ContactMeasures& sides = m.contacts[c];
    if (!spec.contacts[c].heat || !(sides.paired > 0)) continue;
    const bool several =
        sides.slave_body == setup::k_several_bodies || sides.master_body == setup::k_several_bodies;
    for (std::size_t b = 1; several && b < group.size(); ++b) join(0, b);
    if (sides.slave_body >= 0 && sides.master_body >= 0)
      join(as_size(sides.slave_body), as_size(sides.master_body));
  }
  return group;
}

/// Marks the groups in which something has a temperature of its own: surroundings, a tool, a held node.
std::vector<char> held_groups(const cases::CaseSpec& spec, const CaseMeasures& m,
                              const std::vector<std::size_t>& group) {
  std::vector<char> held(group.size(), 0);
  // Where the body is not known the whole case counts as held: no finding is better than a wrong
  // one.
  const auto hold = [&](int body) {
    if (body >= 0)
      held[group[as_size(body)]] = 1;
    else  // of several bodies, or of nodes that may be any body's
      std::ranges::fill(held, 1);
  };
  // Three kinds of conditions know a temperature; fluxes and sources do not.
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t)
    if (const Kind kind = spec.thermal_conditions[t].kind;
        kind == Kind::temperature || kind == Kind::film || kind == Kind::radiation)
      hold(m.surfaces[t].body);
  // A tool with a temperature holds whatever its contact passes heat to.
  for (std::size_t c = 0; c < spec.contacts.size(); ++c)
    if (const cases::RigidSurfaceSpec* tool = spec.rigid_surface(m.contacts[c].master);
        tool != nullptr && tool->temperature && spec.contacts[c].heat)
      hold(m.contacts[c].slave_body);
  return held;
}

/// Heat into a group of bodies, and the sum of its parts without sign [W]; nothing where it changes with
/// place.
struct Supply {
  double net = 0, all = 0;
};
std::optional<Supply> supply_of(const cases::CaseSpec& spec, const CaseMeasures& m,
                                const std::vector<std::size_t>& group, std::size_t which) {
  Supply supply;
  // Heat of sources and fluxes alone, in W; without numbers for all of them nothing can be told of the
  // balance.
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[t];
    int body = m.surfaces[t].body;
    double heat = 0;
    if (c.kind == Kind::source) {
      const auto found = std::ranges::find(spec.bodies, c.group, &cases::BodySpec::mesh_group);
      if (found == spec.bodies.end() || !is_number(c.power)) return {};
      body = static_cast<int>(found - spec.bodies.begin());
      heat = c.power.table.value(0) * m.bodies[as_size(body)].volume;
    } else if (c.kind == Kind::flux) {
      if (!is_number(c.flux)) return {};
      heat = c.flux.table.value(0) * m.surfaces[t].area;
    } else {
      continue;
    }
    if (body < 0 || !is_number(c.factor)) return {};
    // Only what acts on this group counts; the absolute sum is the measure of balance.
    if (group[as_size(body)] != which) continue;
    heat *= c.factor.table.value(0);
    supply.net += heat;
    supply.all += std::abs(heat);
  }
  return supply;
}

void find(const cases::CaseSpec& spec, const setup::Assembly&, const CaseMeasures& m, Findings& findings) {
  // A steady state needs something that holds a temperature in each group of bodies that exchange heat.
  // Without it there is none, if more heat comes in than goes out, or one up to a constant.
  if (!spec.time.steady || !spec.has_heat()) return;
  const std::vector<std::size_t> group = groups_of(spec, m);
  const std::vector<char> held = held_groups(spec, m, group);
  for (std::size_t g = 0; g < group.size(); ++g) {
    if (group[g] != g || held[g] != 0) continue;
    // All bodies of the group are named, since a condition on any of them would do.
    std::vector<std::string> names;
    for (std::size_t b = 0; b < group.size(); ++b)
      if (group[b] == g) names.push_back(fmt::format("'{}'", spec.bodies[b].name));
    const std::string bodies = fmt::format("{}", fmt::join(names, ", "));
    const std::optional<Supply> supply = supply_of(spec, m, group, g);
    // Without balance there is no steady state, and this is an error; in balance the level is
    // arbitrary.
    if (supply && std::abs(supply->net) > k_balanced * supply->all)
      findings.push_back(
          {true, spec.time.where,
           fmt::format("nothing holds a temperature in {}: there is no steady state, for {:.4g} W more {}",
                       bodies, std::abs(supply->net),
                       supply->net > 0 ? "come in than go out" : "go out than come in"),
           "a film, radiation or a temperature on a surface; or fluxes and sources in balance; or a run in "
           "time"});
    else
      findings.push_back(
          {false, spec.time.where,
           fmt::format(
               "nothing holds a temperature in {}: the steady state is fixed up to a constant, and its "
               "level is that of the initial temperature",
               bodies),
           "a film, radiation or a temperature on a surface"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_steady() {
  return {.name = "steady",
          .place = 310,
          .find = &find,
          .rows = {
              {Topic::pour, "a steady state that nothing holds",
               fmt::format("no film, radiation or temperature acts on bodies that exchange heat with each "
                           "other; fluxes and sources that are numbers and do not balance to {} are an error",
                           percent(k_balanced)),
               "warning, error"}}};
}

}  // namespace solidus::check
