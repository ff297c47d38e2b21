// Findings on the interfaces of the bodies: contacts, and films next to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "check/finding_family.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/spots_contact.hpp"
#include "contact/laws/tabulated.hpp"
#include "coupling/scheme_names.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/friction_input.hpp"

namespace solidus::check {

namespace {

/// Bodies whose temperatures differ by less need no way for heat [K].
constexpr double k_same_temperature = 50;
/// The heat capacity of an interface that stores more than a thin wall [J/(m² K)].
constexpr double k_most_capacity = 1e6;

/// Whether a condition holds while a contact is on: bodies come and leave. Collective.
bool beside(const cases::CaseSpec& spec, const setup::Assembly& a, const std::vector<std::string>& stages,
            const cases::ContactSpec& contact) {
  return a.stages.empty() || std::any_of(a.stages.begin(), a.stages.end(), [&](const cases::StageRun& stage) {
           return stage.cycle <= 1 && cases::holds(stages, &stage) &&
                  setup::holds(spec, contact, a.mesh, &stage);
         });
}

std::set<std::string> sides(const cases::ContactSpec& contact) {
  const auto pair = contact.sides();
  return {pair.begin(), pair.end()};
}

void contacts_given_twice(const cases::CaseSpec& spec, Findings& findings) {
  for (std::size_t i = 0; i < spec.contacts.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (sides(spec.contacts[i]) == sides(spec.contacts[k]) &&
          share_a_stage(spec.contacts[i].stages, spec.contacts[k].stages))
        findings.push_back({true, spec.contacts[i].where,
                            fmt::format("the contacts '{}' and '{}' join the same two surfaces",
                                        spec.contacts[k].name, spec.contacts[i].name),
                            "one contact for a pair of surfaces, whichever is named first"});
}

/// Groups of bodies that are connected by shared nodes and by contacts: the number of the first body of each
/// group.
class Groups {
 public:
  explicit Groups(std::size_t n_bodies) : first_(n_bodies) { std::iota(first_.begin(), first_.end(), 0); }
  void join(int a, int b) {
    const int low = std::min(root(a), root(b)), high = std::max(root(a), root(b));
    first_[as_size(high)] = low;
  }
  int root(int body) const {
    while (first_[as_size(body)] != body) body = first_[as_size(body)];
    return body;
  }

 private:
  std::vector<int> first_;
};

/// The bodies that meet in a node or an end of a contact, as seen from all processes.
std::vector<std::vector<int>> meetings(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                       bool with_heat_only) {
  const std::size_t n = spec.bodies.size();
  // A square of marks, any of which a process sets where it sees the two bodies in one node or one
  // contact.
  std::vector<double> meet(n * n, 0.0);
  const auto note = [&](const std::set<int>& bodies) {
    for (const int a : bodies)
      for (const int b : bodies) meet[as_size(a) * n + as_size(b)] = 1;
  };
  std::vector<std::set<int>> of_node(mesh.x.size());
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (const Index node : block.nodes) of_node[as_size(node)].insert(block.body);
  for (const std::set<int>& bodies : of_node)
    if (bodies.size() > 1) note(bodies);
  // Contacts join the bodies of all the faces on their two sides.
  for (const cases::ContactSpec& contact : spec.contacts) {
    if (with_heat_only && !contact.heat) continue;
    std::set<int> bodies;
    for (const std::string& side : contact.sides())
      if (const auto surface = mesh.surfaces.find(side); surface != mesh.surfaces.end())
        for (const mesh::ElementBlock& faces : surface->second.faces)
          if (faces.body >= 0) bodies.insert(faces.body);
    note(bodies);
  }
  std::vector<std::vector<int>> pairs;
  // The maximum over the processes makes all agree; pairs are given once.
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (parallel::global_max(meet[a * n + b]) > 0)
        pairs.push_back({static_cast<int>(a), static_cast<int>(b)});
  return pairs;
}

/// A hot body that no heat can leave toward a cold one.
void bodies_without_a_way_for_heat(const cases::CaseSpec& spec, const setup::Assembly& a,
                                   Findings& findings) {
  // Groups of bodies that heat joins, directly or over others, and groups that touch at all.
  Groups by_heat(spec.bodies.size()), by_anything(spec.bodies.size());
  for (const std::vector<int>& pair : meetings(spec, a.mesh, true)) by_heat.join(pair[0], pair[1]);
  for (const std::vector<int>& pair : meetings(spec, a.mesh, false)) by_anything.join(pair[0], pair[1]);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    for (std::size_t other = 0; other < b; ++other) {
      // Bodies in different groups never exchange heat; those that start equally hot need not.
      const int one = by_heat.root(static_cast<int>(b)), two = by_heat.root(static_cast<int>(other));
      if (one == two || std::abs(a.start[other].high - a.start[b].low) < k_same_temperature) continue;
      const bool touch = by_anything.root(static_cast<int>(b)) == by_anything.root(static_cast<int>(other));
      findings.push_back(
          {false, spec.bodies[b].where,
           fmt::format("no heat passes between the bodies '{}' and '{}', which start {:.0f} K apart: {}",
                       spec.bodies[other].name, spec.bodies[b].name,
                       std::abs(a.start[other].high - a.start[b].low),
                       touch ? "their contact has no [contact.heat]" : "no contact joins them, and no node"),
           touch ? "a [contact.heat] with a conductance" : "a [[contact]] between their surfaces"});
      return;  // one is enough: the others follow from it
    }
}

/// Films of place or time alternate: each is one where the others are none.
bool always_the_same(const cases::ThermalConditionSpec& film) {
  return is_number(film.coefficient) && is_number(film.factor);
}

void films_beside_contacts(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  using Kind = cases::ThermalConditionSpec::Kind;
  for (std::size_t i = 0; i < spec.thermal_conditions.size(); ++i) {
    const cases::ThermalConditionSpec& film = spec.thermal_conditions[i];
    if (film.kind != Kind::film) continue;
    // A film and a contact on one surface at one time cool it twice; two films add up too.
    for (const cases::ContactSpec& contact : spec.contacts)
      if (contact.heat && always_the_same(film) && sides(contact).contains(film.group) &&
          beside(spec, a, film.stages, contact))
        findings.push_back(
            {false, film.where,
             fmt::format("the film '{}' lies on the surface '{}', which the contact '{}' cools too",
                         film.name, film.group, contact.name),
             "a film on outer surfaces alone"});
    for (std::size_t k = 0; k < i; ++k)
      if (const cases::ThermalConditionSpec& other = spec.thermal_conditions[k];
          other.kind == Kind::film && always_the_same(other) && always_the_same(film) &&
          other.group == film.group && share_a_stage(film.stages, other.stages))
        findings.push_back({false, film.where,
                            fmt::format("the films '{}' and '{}' lie on the same surface '{}' and add up",
                                        other.name, film.name, film.group),
                            "one film for a surface"});
  }
}

void conductances(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ContactSpec& contact : spec.contacts) {
    // Capacities and emissivities that are out of range or meaningless alone, then what each law remarks of
    // its own numbers.
    if (const double capacity = contact.interface.heat_capacity; capacity > k_most_capacity)
      findings.push_back({false, contact.where,
                          fmt::format("the interface of '{}' stores {:g} J/m2/K", contact.name, capacity),
                          "1000 J/m2/K is a skin of 0.3 mm of steel"});
    if (!contact.heat) continue;
    // Radiation across a gap needs both sides: one emissivity alone is taken as none.
    const bool of_slave = contact.heat->slave_emissivity > 0, of_master = contact.heat->master_emissivity > 0;
    if (of_slave != of_master)
      findings.push_back({false, contact.where,
                          fmt::format("'{}' has an emissivity of its {} alone: nothing radiates across it",
                                      contact.name, of_slave ? "slave" : "master"),
                          "slave_emissivity and master_emissivity, or neither"});
    // Each law knows its own usual numbers, so that a new law brings its remarks along.
    for (const contact::ConductanceLaw* law : std::initializer_list<const contact::ConductanceLaw*>{
             contact.heat->contact_law.get(), contact.heat->gap_law.get()})
      for (const contact::Remark& remark : law->remarks(contact.name))
        findings.push_back({remark.error, contact.where, remark.found, remark.usual});
  }
}

/// 5.24 without a heat capacity would forbid every slip that changes the entropy: the interface keeps its
/// temperature instead, and the estimate of a split that holds entropies with it (5.13a).
void isentropic_friction(const cases::CaseSpec& spec, Findings& findings) {
  if (!spec.isentropic() || spec.coupling.scheme->traits().iterates) return;
  for (const cases::ContactSpec& contact : spec.contacts) {
    // Only contacts whose friction stores its work and whose interface stores no heat are
    // concerned.
    if (!contact.friction || contact.interface.heat_capacity > 0 ||
        contact.friction->internal_variable != contact::InternalVariable::normal_work)
      continue;
    const contact::FrictionCoefficient mu(setup::friction_spec(*contact.friction).coefficient);
    if (mu.hardening_depends_on_temperature())
      findings.push_back(
          {false, contact.friction->where,
           fmt::format(
               "the hardening of friction in '{}' depends on temperature, but its interface stores no "
               "heat: the {} scheme holds its temperature instead of its entropy there, and is stable only "
               "as "
               "one that holds temperatures is",
               contact.name, spec.coupling.scheme->name()),
           "[contact.interface] heat_capacity above zero (1000 J/m2/K is a skin of 0.3 mm of steel), or "
           "scheme = " +
               coupling::names_of_schemes([](const coupling::SchemeTraits& t) {
                 return t.iterates || t.mapping == mechanics::Mapping::simultaneous;
               })});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  contacts_given_twice(spec, findings);
  if (!spec.has_heat()) return;
  bodies_without_a_way_for_heat(spec, a, findings);
  films_beside_contacts(spec, a, findings);
  conductances(spec, findings);
  isentropic_friction(spec, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_interface() {
  using contact::GasGap, contact::PowerContact, contact::SpotsContact, contact::TableContact,
      contact::TableGap;
  return {
      .name = "interfaces",
      .place = 10,
      .find = &find,
      .rows = {{Topic::contacts, "two contacts join the same surfaces", "in either order, at the same time",
                "error"},
               {Topic::contacts, "no heat passes between two bodies",
                fmt::format("their initial temperatures differ by more than {} K, and neither a contact with "
                            "`[contact.heat]` nor shared nodes join them, directly or through other bodies",
                            number(k_same_temperature))},
               {Topic::contacts, "one emissivity alone", "nothing radiates across the contact"},
               {Topic::contacts, "a film lies on a surface in contact; two films on one surface",
                "both films are constants; films that depend on place or time may complement each other"},
               {Topic::contacts, "conductance of a contact",
                fmt::format("below {} or above {} W/m²K; above {} it is an error",
                            number(PowerContact::k_least_usual), number(PowerContact::k_most_usual),
                            number(PowerContact::k_most_possible)),
                "warning, error"},
               {Topic::contacts, "conductivity of the gas in a gap",
                fmt::format("below {} or above {} W/m/K (law `gas`)", number(GasGap::k_least_usual),
                            number(GasGap::k_most_usual))},
               {Topic::contacts, "roughness and slope of asperities",
                fmt::format("outside of {} to {} µm, a mean slope above {} (law `spots`)",
                            number(1e6 * SpotsContact::k_smoothest), number(1e6 * SpotsContact::k_roughest),
                            number(SpotsContact::k_steepest))},
               {Topic::contacts, "an interface stores much heat",
                fmt::format("above {} J/m²K", number(k_most_capacity))},
               {Topic::contacts, "hardness of the softer side",
                fmt::format("below {} MPa or above {} GPa, where the conductance follows the pressure",
                            number(1e-6 * PowerContact::k_softest), number(1e-9 * PowerContact::k_hardest))},
               {Topic::contacts, "a table of the gap",
                fmt::format("goes beyond {} mm, or conducts more at its end than at zero",
                            number(1e3 * TableGap::k_widest))},
               {Topic::contacts, "a table of the gap, of the pressure",
                fmt::format("ends at a gap below {} µm; at a pressure below {} kPa or above {} GPa",
                            number(1e6 * TableGap::k_narrowest), number(1e-3 * TableContact::k_least_usual),
                            number(1e-9 * TableContact::k_most_usual))},
               {Topic::contacts, "friction with hardening that depends on temperature",
                "on an interface without heat capacity, in an isentropic scheme: the scheme then holds the "
                "temperature of the interface instead of its entropy"}}};
}

}  // namespace solidus::check
