// Findings on supports and loads.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "check/findings.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"

namespace solidus::model {

namespace {

/// Nodes of each body, and how many of them are held in all directions, in the first stage. Collective.
struct Held {
  double nodes = 0, held = 0;
};

std::vector<Held> held_nodes(const CaseSpec& spec, const Assembly& a) {
  // For every node the directions in which conditions of the first stage hold it, as bits. In a plane about
  // an axis uz is the second component.
  const int components = displacement_components(spec.analysis.kind);
  std::vector<std::uint8_t> directions(a.mesh.x.size(), 0);
  for (const MechanicalConditionSpec& c : spec.mechanical_conditions) {
    const auto nodes = a.mesh.node_sets.find(c.group);
    if (nodes == a.mesh.node_sets.end()) continue;
    const bool held =
        c.kind == MechanicalConditionSpec::Kind::displacement && holds(c.stages, a.first_stage());
    unsigned bits = 0;
    if (held) bits = (c.ux || c.ur ? 1U : 0U) | (c.uy ? 2U : 0U) | (c.uz ? (components == 2 ? 2U : 4U) : 0U);
    for (const Index node : nodes->second)
      directions[static_cast<std::size_t>(node)] |= static_cast<std::uint8_t>(bits);
  }
  // Then the nodes of each body are counted once, and among them those that are held in all directions.
  const unsigned all = components == 2 ? 3U : 7U;
  std::vector<Held> of_body(spec.bodies.size());
  std::vector<int> last(a.mesh.x.size(), -1);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    for (const mesh::ElementBlock& block : a.mesh.blocks) {
      if (block.body != static_cast<int>(b)) continue;
      for (const Index node : block.nodes) {
        const auto i = static_cast<std::size_t>(node);
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

void supports(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  const std::vector<Held> held = held_nodes(spec, a);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const BodySpec& body = spec.bodies[b];
    if (only_conducts(body)) continue;
    const bool poured =
        std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) { return p.body == b; });
    if (poured && m.bodies[b].elements > 1 && held[b].nodes > 0 && held[b].held > 0.9 * held[b].nodes)
      findings.push_back(
          {false, body.where,
           fmt::format("{:.0f} % of the nodes of '{}' are held in all directions: it cannot shrink",
                       100 * held[b].held / held[b].nodes, body.name),
           "supports on a few nodes or a plane of symmetry; the mould holds it by contact"});
  }
}

/// A surface in contact whose nodes are all held leaves nothing to the contact.
void held_skins(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  for (const MechanicalConditionSpec& c : spec.mechanical_conditions) {
    const bool all =
        c.kind == MechanicalConditionSpec::Kind::displacement &&
        (spec.analysis.kind == AnalysisKind::solid ? c.ux && c.uy && c.uz : (c.ux || c.ur) && (c.uy || c.uz));
    if (!all) continue;
    for (std::size_t k = 0; k < m.contacts.size(); ++k) {
      const ContactMeasures& contact = m.contacts[k];
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
                 c.name, surface, spec.bodies[static_cast<std::size_t>(body)].name, spec.contacts[k].name),
             "supports beside the contact, on a few nodes"});
      }
    }
  }
}

/// A support along one axis on a surface of the casting is a plane of symmetry: no heat crosses it.
void films_on_planes_of_symmetry(const CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  using Film = ThermalConditionSpec::Kind;
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const ThermalConditionSpec& film = spec.thermal_conditions[t];
    const bool poured = std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) {
      return m.surfaces[t].body == static_cast<int>(p.body);
    });
    if (!poured || (film.kind != Film::film && film.kind != Film::radiation)) continue;
    for (const MechanicalConditionSpec& c : spec.mechanical_conditions) {
      const int held = (c.ux || c.ur ? 1 : 0) + (c.uy ? 1 : 0) + (c.uz ? 1 : 0);
      if (c.kind != MechanicalConditionSpec::Kind::displacement || c.group != film.group || held != 1)
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

/// Waves cross a casting in microseconds: inertia over steps so much longer only costs.
void useless_inertia(const CaseSpec& spec, Findings& findings) {
  constexpr double k_long = 0.1;  // [s]
  if (!spec.dynamics || !spec.time.step || *spec.time.step < k_long) return;
  findings.push_back({false, spec.time.where,
                      fmt::format("inertia with steps of {:g} s: waves cross the bodies within a millisecond",
                                  *spec.time.step),
                      "no [dynamics]: castings freeze in equilibrium; inertia is for shocks and vibrations"});
}

/// Springs of contacts.
void contact_numbers(const CaseSpec& spec, Findings& findings) {
  for (const ContactSpec& contact : spec.contacts)
    if (const double penalty = contact.penalty.value_or(1e12); penalty < 1e6 || penalty > 1e17)
      findings.push_back(
          {false, contact.where,
           fmt::format("the contact '{}' has a penalty of {:g} N/m3", contact.name, penalty),
           "1e8 N/m3 (sand that gives way) to 1e15 N/m3 (steel); without it the program chooses"});
}

/// Melt gives way to a pressure wherever its skin has neither a mould nor a support. Collective.
void pressed_melts(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  using Kind = MechanicalConditionSpec::Kind;
  constexpr double k_head = 5e4, k_free = 0.02;  // [Pa]: of some metres of melt; share of the skin
  const AnalysisKind kind = spec.analysis.kind;
  for (const MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.kind != Kind::pressure || !is_number(c.pressure) || c.pressure.table.value(0) < k_head) continue;
    if (!holds(c.stages, a.first_stage())) continue;
    // The skin of the pressed melt that has anything against it: shared nodes, supports, contacts and the
    // pressure itself.
    const SurfaceMeasures pressed = measure_surface(a.mesh, c.group, kind);
    for (const Pour& pour : m.pours) {
      const auto body = static_cast<int>(pour.body);
      if (pressed.body != body) continue;
      const BodyMeasures& measures = m.bodies[pour.body];
      double covered = std::accumulate(measures.shared.begin(), measures.shared.end(), 0.0);
      std::set<std::string> groups;
      for (const MechanicalConditionSpec& other : spec.mechanical_conditions) groups.insert(other.group);
      for (const ContactSpec& contact : spec.contacts)
        for (const std::string& side : contact.sides()) groups.insert(side);
      for (const std::string& group : groups)
        if (const SurfaceMeasures s = measure_surface(a.mesh, group, kind); s.body == body) covered += s.area;
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
void friction_numbers(const CaseSpec& spec, Findings& findings) {
  for (const ContactSpec& contact : spec.contacts) {
    if (!contact.friction || contact.friction->coefficient.empty()) continue;
    const Function& mu = contact.friction->coefficient.front();
    constexpr double k_least = 0.005, k_most = 2;  // a coefficient of zero is no slip
    const double most = mu.table.max_value();
    if (mu.place != nullptr || most == 0 || (most >= k_least && most <= k_most)) continue;
    findings.push_back({false, contact.friction->where,
                        fmt::format("the coefficient of friction of '{}' is {:g}", contact.name, most),
                        "0.05 to 1; 0.3 is 30 %"});
  }
}

/// Depths of wear that no surface loses.
void wear_numbers(const CaseSpec& spec, Findings& findings) {
  constexpr double k_least = 1e-10, k_most = 0.02, k_soft = 1e6, k_hard = 1e11;  // [1], [Pa]
  for (const ContactSpec& contact : spec.contacts) {
    if (!contact.wear) continue;
    if (const double k = contact.wear->archard; k < k_least || k > k_most)
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

void loads(const CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  // Displacements are compared with the largest body, pressures with what is usual. The messages ask for the
  // unit, which is what is mostly wrong.
  double largest = 0;
  for (const BodyMeasures& body : m.bodies)
    for (std::size_t d = 0; d < 3; ++d) largest = std::max(largest, body.high[d] - body.low[d]);
  using Kind = MechanicalConditionSpec::Kind;
  for (const MechanicalConditionSpec& c : spec.mechanical_conditions) {
    for (const auto* u : {&c.ux, &c.uy, &c.uz, &c.ur})
      if (c.kind == Kind::displacement && *u && (*u)->place == nullptr) {
        const double way = std::max(std::abs((*u)->table.min_value()), std::abs((*u)->table.max_value()));
        if (way > largest)
          findings.push_back({false, c.where,
                              fmt::format("'{}' moves '{}' by {:g} mm, farther than the largest body is long",
                                          c.name, c.group, 1e3 * way),
                              "is the unit right?"});
      }
    if (c.kind == Kind::pressure && c.pressure.place == nullptr)
      if (const double p =
              std::max(std::abs(c.pressure.table.min_value()), std::abs(c.pressure.table.max_value()));
          p > 1e10)
        findings.push_back({false, c.where, fmt::format("the pressure '{}' is {:g} GPa", c.name, 1e-9 * p),
                            "usual are 0.1 bar of melt to 1 GPa of forging"});
    constexpr double k_nothing = 100;  // [Pa]: 4 mm of molten aluminium
    if (c.kind == Kind::pressure && c.pressure.place == nullptr)
      if (const double p =
              std::max(std::abs(c.pressure.table.min_value()), std::abs(c.pressure.table.max_value()));
          p > 0 && p < k_nothing)
        findings.push_back(
            {false, c.where, fmt::format("the pressure '{}' is {:g} Pa at most", c.name, p),
             "is it in MPa? Usual are 0.1 bar of melt (1e4 Pa) to 100 MPa of a die casting's piston"});
  }
}

}  // namespace

void find_in_mechanics(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics()) return;
  supports(spec, a, m, findings);
  held_skins(spec, a, m, findings);
  contact_numbers(spec, findings);
  loads(spec, m, findings);
  pressed_melts(spec, a, m, findings);
  friction_numbers(spec, findings);
  wear_numbers(spec, findings);
  find_loose_bodies(spec, a, m, findings);
  find_turning_bodies(spec, a, m, findings);
  if (spec.has_heat()) films_on_planes_of_symmetry(spec, m, findings);
  useless_inertia(spec, findings);
}

}  // namespace solidus::model
