// Findings on numbers of the method: iterations, cuts of the step, the search of contacts and their meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

constexpr int k_least_iterations = 5;
constexpr double k_hardly = 0.8;  // a cut of the step
constexpr double k_least_search_distance = 2e-3,
                 k_largest_search_distance =
                     0.5;                // of the size of the slave's body: what castings shrink by; itself
constexpr double k_much_touching = 0.2;  // of the shortest side of the slave's body
constexpr double k_thinnest_air = 100, k_densest_air = 2e8;  // of vacuum furnaces, of die casting [Pa]
constexpr double k_coarse_nodes = 1.5, k_coarse_points = 3;  // faces of the slave, of those of the melt

void iterations(const cases::CaseSpec& spec, Findings& findings) {
  // Limits on iterations that would cut steps for no reason.
  const auto compare = [&](const char* key, int allowed, const char* usual) {
    if (allowed > 0 && allowed < k_least_iterations)
      findings.push_back(
          {false, spec.time.where,
           fmt::format("{} = {}: a step that needs more is cut, again and again", key, allowed), usual});
  };
  if (spec.has_heat())
    compare("heat.max_iterations", spec.heat.max_iterations, "30 to 200, or without the key");
  if (spec.has_mechanics())
    compare("mechanics.max_iterations", spec.mechanics.max_iterations, "20 to 100, or without the key");
  if (spec.time.cut > k_hardly)
    findings.push_back(
        {false, spec.time.where,
         fmt::format("time.cut = {:g}: a step that does not go through is tried again hardly shorter",
                     spec.time.cut),
         "0.25 to 0.5"});
}

/// Points look for partners no farther than that: beyond neither force nor heat passes.
void search_distances(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const cases::ContactSpec& contact = spec.contacts[c];
    if (!contact.search_distance || m.contacts[c].slave_body < 0) continue;
    const BodyMeasures& body = m.bodies[as_size(m.contacts[c].slave_body)];
    // The largest side of the slave's body is the measure, since castings shrink by a share of it.
    double size = 0;
    for (std::size_t d = 0; d < 3; ++d) size = std::max(size, body.high[d] - body.low[d]);
    const double distance = *contact.search_distance;
    if (distance >= k_least_search_distance * size && distance <= k_largest_search_distance * size) continue;
    findings.push_back(
        {false, contact.where,
         fmt::format("the contact '{}' looks for partners up to {:g} mm away, its body is {:.4g} mm large{}",
                     contact.name, 1e3 * distance, 1e3 * size,
                     distance < k_least_search_distance * size
                         ? ": heat ends where the gap of a casting is wider"
                         : ""),
         "a hundredth to a tenth of the body, or without the key"});
  }
}

/// Gaps that the data take as closed.
void touching_gaps(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const cases::ContactSpec& contact = spec.contacts[c];
    if (m.contacts[c].slave_body < 0 || !contact.touching) continue;
    const BodyMeasures& body = m.bodies[as_size(m.contacts[c].slave_body)];
    double size = std::numeric_limits<double>::max();
    for (std::size_t d = 0; d < 3; ++d)
      if (const double side = body.high[d] - body.low[d]; side > 0) size = std::min(size, side);
    if (*contact.touching > k_much_touching * size)
      findings.push_back({false, contact.where,
                          fmt::format("the contact '{}' takes gaps of up to {:g} mm as closed", contact.name,
                                      1e3 * *contact.touching),
                          "tenths of a millimetre between faceted surfaces"});
  }
}

/// Whether [[interface]] made a contact and nothing says which gaps count as closed.
bool is_by_itself(const cases::CaseSpec& spec, const cases::ContactSpec& contact) {
  return std::ranges::any_of(spec.interfaces, [&](const cases::BodyInterfaceSpec& section) {
    return !section.touching && section.where.text() == contact.where.text();
  });
}

/// Bodies that were found to face each other and do not touch, by more than facets of curved faces explain.
void gaps_of_interfaces(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  constexpr double k_least = 1e-7;  // [m]
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const setup::ContactMeasures& measures = m.contacts[c];
    if (!is_by_itself(spec, spec.contacts[c]) || !(measures.largest_start > k_least)) continue;
    findings.push_back(
        {false, spec.contacts[c].where,
         fmt::format("the interface '{}' begins with gaps of up to {:.2g} mm, {:.2g} mm in the mean, that "
                     "facets of curved faces do not explain",
                     spec.contacts[c].name, 1e3 * measures.largest_start, 1e3 * measures.mean_start),
         fmt::format("gaps that are meant, or touching = \"{:.2g} mm\"", 1.2e3 * measures.largest_start)});
  }
}

/// The pressure that holds melt on its wall.
void atmospheres(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::ContactSpec& contact : spec.contacts)
    if (contact.wet && contact.atmosphere > 0 &&
        (contact.atmosphere < k_thinnest_air || contact.atmosphere > k_densest_air))
      findings.push_back(
          {false, contact.where,
           fmt::format("melt is held on the wall of '{}' by {:g} Pa", contact.name, contact.atmosphere),
           "1e5 Pa in air, 1e3 Pa in a vacuum furnace, 1e7 to 1e8 Pa in a die under pressure"});
}

/// Points of a slave whose faces are larger than the master's leave nodes of the master between them: melt,
/// which resists no shear, runs through there.
void coarse_slaves(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   Findings& findings) {
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    // Nodes are one point a face, Gauss points several; segments of the mortar method see every
    // part of both sides.
    const setup::ContactMeasures& measures = m.contacts[c];
    const bool nodal = spec.contacts[c].integration == contact::IntegrationRule::nodal;
    const auto sliding = spec.contacts[c].formulation == contact::Formulation::large_sliding &&
                         spec.contacts[c].integration != contact::IntegrationRule::segments;
    const bool gauss = sliding || spec.contacts[c].integration == contact::IntegrationRule::gauss;
    const bool poured = std::any_of(m.pours.begin(), m.pours.end(), [&](const Pour& p) {
      return static_cast<int>(p.body) == measures.master_body;
    });
    if (!poured || !(nodal || gauss) || a.mesh.surfaces.count(measures.master) == 0) continue;
    // Where the melt is master its nodes between two points of the slave have nothing against them.
    const double ratio = measures.face_size / measures.master_face_size;
    if (!(ratio > (nodal ? k_coarse_nodes : k_coarse_points))) continue;
    findings.push_back(
        {false, spec.contacts[c].where,
         fmt::format("the faces of the slave '{}' are {:.2g} times as large as those of the melt on "
                     "it, '{}': melt runs through between its points",
                     measures.slave, ratio, measures.master),
         "the finer surface as slave, or integration = \"segments\""});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  iterations(spec, findings);
  search_distances(spec, m, findings);
  touching_gaps(spec, m, findings);
  gaps_of_interfaces(spec, m, findings);
  if (!spec.has_mechanics()) return;
  atmospheres(spec, findings);
  coarse_slaves(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_numerics() {
  return {
      .name = "numerics",
      .place = 230,
      .find = &find,
      .rows = {{Topic::contacts, "an interface begins with gaps",
                "bodies that an `[[interface]]` without `touching` has found are farther apart than facets "
                "of curved faces explain"},
               {Topic::contacts, "the slave is coarse",
                fmt::format("where melt is the master, its faces are more than {} (nodes) or {} times "
                            "(Gauss points) as large as those of the melt",
                            number(k_coarse_nodes), number(k_coarse_points))},
               {Topic::contacts, "`search_distance`, `touching`, `atmosphere`",
                fmt::format("below {} or above {} of the slave's body; above {} of its shortest side; "
                            "not zero, below {} Pa or above {} MPa",
                            percent(k_least_search_distance), percent(k_largest_search_distance),
                            percent(k_much_touching), number(k_thinnest_air), number(1e-6 * k_densest_air))},
               {Topic::conditions, "iterations, cuts",
                fmt::format("`max_iterations` of heat or mechanics below {}; `time.cut` above {}",
                            k_least_iterations, number(k_hardly))}}};
}

}  // namespace solidus::check
