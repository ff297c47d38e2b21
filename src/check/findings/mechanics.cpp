// Findings on supports and loads.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_all_held = 0.9;                                  // of the nodes of a casting
constexpr double k_softest_spring = 1e6, k_stiffest_spring = 1e17;  // [N/m³]
constexpr double k_head = 5e4, k_free = 0.02;  // of some metres of melt [Pa]; of the skin
constexpr double k_least_friction = 0.005, k_most_friction = 2;
constexpr double k_least_wear = 1e-10, k_most_wear = 0.02, k_soft = 1e6, k_hard = 1e11;  // [1], [Pa]
constexpr double k_most_pressure = 1e10;
constexpr double k_nothing = 100;  // 4 mm of molten aluminium [Pa]

/// Nodes of each body, and how many of them are held in all directions, in the first stage. Collective.
struct Held {
  double nodes = 0, held = 0;
};

std::vector<Held> held_nodes(const cases::CaseSpec& spec, const setup::Assembly& a) {
  // For every node the directions in which conditions of the first stage hold it, as bits. In a plane about
  // an axis uz is the second component.
  const int components = displacement_components(spec.analysis.kind);
  std::vector<std::uint8_t> directions(a.mesh.x.size(), 0);
  // Conditions come by their groups, whose nodes are those of a surface, a volume or a set.
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    const auto nodes = a.mesh.node_sets.find(c.group);
    if (nodes == a.mesh.node_sets.end()) continue;
    const bool held = c.kind == cases::MechanicalConditionSpec::Kind::displacement &&
                      cases::holds(c.stages, a.first_stage());
    // Components of one node may be held by different conditions, so that bits are collected.
    unsigned bits = 0;
    if (held) bits = (c.ux || c.ur ? 1U : 0U) | (c.uy ? 2U : 0U) | (c.uz ? (components == 2 ? 2U : 4U) : 0U);
    for (const Index node : nodes->second) directions[as_size(node)] |= static_cast<std::uint8_t>(bits);
  }
  // Then the nodes of each body are counted once, and among them those that are held in all directions.
  const unsigned all = components == 2 ? 3U : 7U;
  std::vector<Held> of_body(spec.bodies.size());
  std::vector<int> last(a.mesh.x.size(), -1);
  // A node of two bodies counts in both, and once in each.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    for (const mesh::ElementBlock& block : a.mesh.blocks) {
      if (block.body != static_cast<int>(b)) continue;
      for (const Index node : block.nodes) {
        const auto i = as_size(node);
        if (node >= a.mesh.n_owned_nodes || last[i] == static_cast<int>(b)) continue;
        last[i] = static_cast<int>(b);
        of_body[b].nodes += 1;
        of_body[b].held += directions[i] == all ? 1 : 0;
      }
    }
    of_body[b].nodes = parallel::global_sum(of_body[b].nodes);
    of_body[b].held = parallel::global_sum(of_body[b].held);
  }
  return of_body;
}

void supports(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
              Findings& findings) {
  const std::vector<Held> held = held_nodes(spec, a);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (cases::only_conducts(body)) continue;
    const bool poured =
        std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) { return p.body == b; });
    if (poured && m.bodies[b].elements > 1 && held[b].nodes > 0 && held[b].held > k_all_held * held[b].nodes)
      findings.push_back(
          {false, body.where,
           fmt::format("{:.0f} % of the nodes of '{}' are held in all directions: it cannot shrink",
                       100 * held[b].held / held[b].nodes, body.name),
           "supports on a few nodes or a plane of symmetry; the mould holds it by contact"});
  }
}

/// A surface in contact whose nodes are all held leaves nothing to the contact.
void held_skins(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                Findings& findings) {
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    const bool all =
        c.kind == cases::MechanicalConditionSpec::Kind::displacement &&
        (spec.analysis.kind == AnalysisKind::solid ? c.ux && c.uy && c.uz : (c.ux || c.ur) && (c.uy || c.uz));
    // Either side of a contact may be held; the casting's side is the one where no gap can open
    // then.
    if (!all) continue;
    for (std::size_t k = 0; k < m.contacts.size(); ++k) {
      const setup::ContactMeasures& contact = m.contacts[k];
      for (const auto& [surface, body] :
           {std::pair(contact.slave, contact.slave_body), std::pair(contact.master, contact.master_body)}) {
        const bool poured = std::any_of(m.pours.begin(), m.pours.end(), [&, b = body](const Pour& p) {
          return static_cast<int>(p.body) == b;
        });
        if (surface != c.group || !poured || a.mesh.surfaces.count(surface) == 0) continue;
        findings.push_back(
            {false, c.where,
             fmt::format(
                 "'{}' holds the surface '{}' of '{}', on which the contact '{}' acts: no gap can open",
                 c.name, surface, spec.bodies[as_size(body)].name, spec.contacts[k].name),
             "supports in addition to the contact, on a few nodes"});
      }
    }
  }
}

/// Springs of contacts.
void contact_numbers(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ContactSpec& contact : spec.contacts)
    if (const double penalty = contact.penalty.value_or(1e12);
        penalty < k_softest_spring || penalty > k_stiffest_spring)
      findings.push_back(
          {false, contact.where,
           fmt::format("the contact '{}' has a penalty of {:g} N/m3", contact.name, penalty),
           "1e8 N/m3 (sand that gives way) to 1e15 N/m3 (steel); without it the program chooses"});
}

/// Melt gives way to a pressure wherever its skin has neither a mould nor a support. Collective.
void pressed_melts(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   Findings& findings) {
  using Kind = cases::MechanicalConditionSpec::Kind;
  const AnalysisKind kind = spec.analysis.kind;
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    // Only pressures of one number that act from the start: melt freezes, and may be pressed later.
    if (c.kind != Kind::pressure || !is_number(c.pressure) || c.pressure.table.value(0) < k_head) continue;
    if (!cases::holds(c.stages, a.first_stage())) continue;
    // The skin of the pressed melt that has anything against it: shared nodes, supports, contacts and the
    // pressure itself.
    const setup::SurfaceMeasures pressed = setup::measure_surface(a.mesh, c.group, kind);
    for (const Pour& pour : m.pours) {
      const auto body = static_cast<int>(pour.body);
      if (pressed.body != body) continue;
      const BodyMeasures& measures = m.bodies[pour.body];
      // Shared faces are covered by the other body; every surface with a condition or a contact is
      // taken as covered too.
      double covered = std::accumulate(measures.shared.begin(), measures.shared.end(), 0.0);
      std::set<std::string> groups;
      for (const cases::MechanicalConditionSpec& other : spec.mechanical_conditions)
        groups.insert(other.group);
      for (const cases::ContactSpec& contact : spec.contacts)
        for (const std::string& side : contact.sides()) groups.insert(side);
      for (const std::string& group : groups)
        if (const setup::SurfaceMeasures s = setup::measure_surface(a.mesh, group, kind); s.body == body)
          covered += s.area;
      // What remains free must be a good part of the skin before it is told.
      if (covered > (1 - k_free) * measures.skin) continue;
      findings.push_back(
          {false, c.where,
           fmt::format("'{}' presses on the melt of '{}' with {:.3g} MPa, but {:.0f} % of its skin has "
                       "neither a contact nor a support: there it flows out",
                       c.name, spec.bodies[pour.body].name, 1e-6 * c.pressure.table.value(0),
                       100 * (1 - covered / measures.skin)),
           "a mould all around, a pressure that comes later ('stages', or a table of time)"});
    }
  }
}

/// Coefficients of friction beyond all metals.
void friction_numbers(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ContactSpec& contact : spec.contacts) {
    if (!contact.friction || contact.friction->coefficient.empty()) continue;
    const Function& mu = contact.friction->coefficient.front();
    const double most = mu.table.max_value();
    // A coefficient of zero is meant.
    if (mu.place != nullptr || most == 0 || (most >= k_least_friction && most <= k_most_friction)) continue;
    findings.push_back({false, contact.friction->where,
                        fmt::format("the coefficient of friction of '{}' is {:g}", contact.name, most),
                        "0.05 to 1; 0.3 is 30 %"});
  }
}

/// Depths of wear that no surface loses.
void wear_numbers(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ContactSpec& contact : spec.contacts) {
    if (!contact.wear) continue;
    if (const double k = contact.wear->archard; k < k_least_wear || k > k_most_wear)
      findings.push_back({false, contact.where,
                          fmt::format("the coefficient of wear of '{}' is {:g}", contact.name, k),
                          "1e-8 (lubricated) to 1e-3 (dry), without a unit"});
    const Function& hardness = contact.wear->hardness;
    const double hard = hardness.table.max_value();
    if (hardness.place == nullptr && (hard < k_soft || hard > k_hard))
      findings.push_back(
          {false, contact.where,
           fmt::format("the surface that '{}' wears has a hardness of {:g} MPa", contact.name, 1e-6 * hard),
           "100 MPa of soft to 10 GPa of hard metals; 100 HB are 981 MPa"});
  }
}

void loads(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  // Displacements are compared with the largest body, pressures with what is usual. The messages ask for the
  // unit, which is what is mostly wrong.
  double largest = 0;
  for (const BodyMeasures& body : m.bodies)
    for (std::size_t d = 0; d < 3; ++d) largest = std::max(largest, body.high[d] - body.low[d]);
  using Kind = cases::MechanicalConditionSpec::Kind;
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    // Motions of whatever direction; tables by their largest value on either side.
    for (const auto* u : {&c.ux, &c.uy, &c.uz, &c.ur})
      if (c.kind == Kind::displacement && *u && (*u)->place == nullptr) {
        const double way = std::max(std::abs((*u)->table.min_value()), std::abs((*u)->table.max_value()));
        if (way > largest)
          findings.push_back({false, c.where,
                              fmt::format("'{}' moves '{}' by {:g} mm, farther than the largest body is long",
                                          c.name, c.group, 1e3 * way),
                              "is the unit right?"});
      }
    // Pressures are told at both ends, since pascals and megapascals are confused in both
    // directions.
    if (c.kind == Kind::pressure && c.pressure.place == nullptr)
      if (const double p =
              std::max(std::abs(c.pressure.table.min_value()), std::abs(c.pressure.table.max_value()));
          p > k_most_pressure)
        findings.push_back({false, c.where, fmt::format("the pressure '{}' is {:g} GPa", c.name, 1e-9 * p),
                            "usual are 0.1 bar of melt to 1 GPa of forging"});
    if (c.kind == Kind::pressure && c.pressure.place == nullptr)
      if (const double p =
              std::max(std::abs(c.pressure.table.min_value()), std::abs(c.pressure.table.max_value()));
          p > 0 && p < k_nothing)
        findings.push_back(
            {false, c.where, fmt::format("the pressure '{}' is {:g} Pa at most", c.name, p),
             "is it in MPa? Usual are 0.1 bar of melt (1e4 Pa) to 100 MPa of a die casting's piston"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics()) return;
  supports(spec, a, m, findings);
  held_skins(spec, a, m, findings);
  contact_numbers(spec, findings);
  loads(spec, m, findings);
  pressed_melts(spec, a, m, findings);
  friction_numbers(spec, findings);
  wear_numbers(spec, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_mechanics() {
  return {
      .name = "supports and loads",
      .place = 160,
      .find = &find,
      .rows = {
          {Topic::mechanics, "a casting that cannot shrink",
           fmt::format("{} of its nodes are held in all directions, or its surface in contact is",
                       percent(k_all_held))},
          {Topic::mechanics, "springs of contacts",
           fmt::format("a penalty below {} or above {} N/m³", number(k_softest_spring),
                       number(k_stiffest_spring))},
          {Topic::mechanics, "supports and loads",
           fmt::format("a displacement larger than the largest body is long; a load of more than {} GPa, or "
                       "less than {} Pa",
                       number(1e-9 * k_most_pressure), number(k_nothing))},
          {Topic::mechanics, "pressure on a melt that nothing holds",
           fmt::format(
               "above {} bar at the start, where more than {} of its surface has neither contact nor support",
               number(1e-5 * k_head), percent(k_free))},
          {Topic::mechanics, "coefficient of friction",
           fmt::format("above {}, or between 0 and {}", number(k_most_friction), number(k_least_friction))},
          {Topic::mechanics, "wear",
           fmt::format("a coefficient below {} or above {}, a hardness below {} MPa or above {} GPa",
                       number(k_least_wear), number(k_most_wear), number(1e-6 * k_soft),
                       number(1e-9 * k_hard))}}};
}

}  // namespace solidus::check
