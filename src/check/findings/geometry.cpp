// Findings on bodies and their meshes: bodies that overlap or are glued together, and meshes that are too
// coarse.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

/// Bodies whose temperatures differ by less may share nodes with good reason [K].
constexpr double k_same_temperature = 50;
constexpr double k_overlap = 0.15;                        // of a face
constexpr double k_apart = 2e-3, k_apart_of_body = 0.02;  // [m]; of the size of the slave's body
constexpr double k_spanned = 0.5;                         // share of elements from skin to skin
constexpr double k_coarse = 2;                            // mean edge, of the depth
constexpr double k_coarse_mould = 2;                      // shortest edge, of the depth that heat reaches
// An edge over another one of its element. Layers of sand taper next to edges of a casting; nothing bends
// there where a body conducts heat alone.
constexpr double k_flat = 150, k_flat_in_layers = 300, k_flat_in_casting = 50;
constexpr double k_small = 3e-3;  // a casting [m]

/// In quotes.
std::string name_of(const cases::CaseSpec& spec, int body) {
  if (body == setup::k_several_bodies) return "several bodies";
  return body >= 0 ? "'" + spec.bodies[as_size(body)].name + "'" : "a tool";
}

/// Facets of two meshes on one curved skin overlap by a tenth of a face at most.
void overlaps(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t c = 0; c < m.contacts.size(); ++c) {
    const setup::ContactMeasures& contact = m.contacts[c];
    const double depth = -contact.least_start;
    if (contact.paired > 0 && depth > k_overlap * contact.face_size)
      findings.push_back({false, spec.contacts[c].where,
                          fmt::format("{} and {} of the contact '{}' overlap by up to {:.3g} mm at the start",
                                      name_of(spec, contact.slave_body), name_of(spec, contact.master_body),
                                      spec.contacts[c].name, 1e3 * depth),
                          "surfaces that touch; do the two geometries have the same size, place and unit?"});
  }
}

void far_apart(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t c = 0; c < m.contacts.size(); ++c) {
    const setup::ContactMeasures& contact = m.contacts[c];
    if (!(contact.paired > 0) || contact.slave_body < 0 || !spec.contacts[c].heat) continue;
    const BodyMeasures& body = m.bodies[as_size(contact.slave_body)];
    const double size = std::cbrt(body.volume);
    if (contact.least_start > k_apart && contact.least_start > k_apart_of_body * size)
      findings.push_back(
          {false, spec.contacts[c].where,
           fmt::format("the surfaces '{}' and '{}' of the contact '{}' are {:.3g} mm apart or more",
                       contact.slave, contact.master, spec.contacts[c].name, 1e3 * contact.least_start),
           "surfaces that touch, or a gap below a millimetre; is it the right pair?"});
  }
}

void same_body(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t c = 0; c < m.contacts.size(); ++c)
    if (m.contacts[c].slave_body >= 0 && m.contacts[c].slave_body == m.contacts[c].master_body)
      findings.push_back({false, spec.contacts[c].where,
                          fmt::format("both surfaces of the contact '{}' belong to the body {}",
                                      spec.contacts[c].name, name_of(spec, m.contacts[c].slave_body)),
                          "surfaces of two bodies, unless this one has a slit"});
}

bool is_deposited(const cases::CaseSpec& spec, const cases::BodySpec& body) {
  return std::ranges::any_of(spec.depositions,
                             [&](const cases::DepositionSpec& d) { return d.body == body.mesh_group(); });
}

void shared_nodes(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                  Findings& findings) {
  // Surfaces of a contact that share nodes are one body there. Apart from contacts, bodies that start at
  // different temperatures and share nodes are told, unless a contact has been told already.
  for (std::size_t c = 0; c < m.contacts.size(); ++c)
    if (m.contacts[c].shared_nodes > 0)
      findings.push_back(
          {false, spec.contacts[c].where,
           fmt::format("the surfaces of the contact '{}' share {} nodes: there the bodies are one, no gap "
                       "opens and heat passes without resistance",
                       spec.contacts[c].name, m.contacts[c].shared_nodes),
           "bodies with nodes of their own: no mesh.conforming, no common faces in the geometry"});
  if (!spec.has_heat()) return;
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    for (std::size_t other = 0; other < b; ++other) {
      const GlobalIndex n = m.bodies[b].shared_nodes[other];
      if (n == 0 || std::abs(a.start[b].high - a.start[other].low) < k_same_temperature ||
          std::abs(a.start[b].low - a.start[other].high) < k_same_temperature)
        continue;
      const bool told = std::any_of(m.contacts.begin(), m.contacts.end(),
                                    [](const setup::ContactMeasures& c) { return c.shared_nodes > 0; });
      if (told) continue;
      // Deposited metal grows on the body below it and shares its nodes on purpose.
      if (is_deposited(spec, spec.bodies[b]) || is_deposited(spec, spec.bodies[other])) continue;
      // Metals that are poured together may share nodes, and then want one temperature.
      const bool one_metal =
          a.materials[b].solidification() != nullptr && a.materials[other].solidification() != nullptr;
      findings.push_back(
          {false, spec.bodies[b].where,
           fmt::format(
               "the bodies '{}' and '{}', which start {:.0f} K apart, share {} nodes: no gap opens and "
               "heat passes without resistance",
               spec.bodies[other].name, spec.bodies[b].name, std::abs(a.start[b].high - a.start[other].high),
               n),
           one_metal ? "one temperature for what is poured together, as a riser with its casting"
                     : "between casting and mould bodies with nodes of their own and a [[contact]]"});
    }
}

void coarse_castings(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  // Without an estimate there is no depth to compare elements with.
  for (const Pour& pour : m.pours) {
    if (!pour.no_estimate.empty()) continue;
    const BodyMeasures& body = m.bodies[pour.body];
    const std::string& name = spec.bodies[pour.body].name;
    // The modulus of the casting is the half thickness of a plate that cools alike.
    const double modulus = body.volume / pour.cooled_area;
    const std::string usual = fmt::format(
        "four elements through a wall{}: {}",
        // Elements of second order know no pores, so that shrinkage strains them.
        spec.has_mechanics() ? "" : ", or two of second order",
        spec.mesh.sizes.empty() ? "mesh.element_size" : "smaller `size` and `smallest` of [[mesh.size]]");
    // Elements through the whole wall are worst, then those larger than the deepest place, then a single one.
    if (pour.spanned > k_spanned)
      findings.push_back(
          {false, spec.mesh.where,
           fmt::format(
               "{:.0f} % of the body '{}' are elements that reach from one cooled skin to another, of "
               "{:.3g} to {:.3g} mm; twice its volume over its cooled skin is {:.3g} mm",
               100 * pour.spanned, name, 1e3 * body.shortest_edge, 1e3 * body.longest_edge, 2e3 * modulus),
           usual});
    else if (body.mean_edge > k_coarse * std::max(pour.depth, modulus))
      findings.push_back(
          {false, spec.mesh.where,
           fmt::format(
               "the elements of the body '{}' have {:.3g} mm on average, but its deepest place is {:.3g} mm "
               "below the cooled skin",
               name, 1e3 * body.mean_edge, 1e3 * std::max(pour.depth, modulus)),
           usual});
    else if (body.elements == 1)
      findings.push_back({false, spec.mesh.where, fmt::format("the body '{}' is one element", name), usual});
  }
}

/// Elements whose edges differ so much that what crosses them and what runs along them cannot both be seen;
/// castings so small that their unit is in doubt.
void shapes_and_sizes(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const bool conducts = !spec.has_mechanics() || cases::only_conducts(spec.bodies[b]);
    // Layers of a mould that conducts may be flat, for heat crosses them in one direction; stresses
    // suffer from flatness.
    const double most = m.is_poured(b) ? k_flat_in_casting : conducts ? k_flat_in_layers : k_flat;
    if (m.bodies[b].flattest > most)
      findings.push_back({false, spec.mesh.where,
                          fmt::format("an element of the body '{}' is {:.0f} times as long as wide",
                                      spec.bodies[b].name, m.bodies[b].flattest),
                          "up to 10, in thin layers of a mould that conducts heat up to 200"});
  }
  for (const Pour& pour : m.pours) {
    // The largest extent of the casting against what is plausible: a file in metres read as
    // millimetres makes it tiny.
    const BodyMeasures& body = m.bodies[pour.body];
    double largest = 0;
    for (std::size_t d = 0; d < 3; ++d) largest = std::max(largest, body.high[d] - body.low[d]);
    if (largest < k_small)
      findings.push_back(
          {false, spec.mesh.where,
           fmt::format("the casting '{}' is {:.3g} mm large", spec.bodies[pour.body].name, 1e3 * largest),
           "is the unit of the mesh right?"});
  }
}

/// The mould's first element against the depth that heat reaches until the casting is solid.
void coarse_moulds(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (const Pour& pour : m.pours) {
    // Without a freezing time or where the mould is all soaked through there is no depth to
    // resolve.
    if (!pour.freezing.time || !(pour.freezing.mould_reach > 0)) continue;
    for (std::size_t c = 0; c < m.contacts.size(); ++c) {
      const setup::ContactMeasures& contact = m.contacts[c];
      const auto body = static_cast<int>(pour.body);
      // The mould is the other partner of whichever side the casting is on.
      const int other = contact.slave_body == body    ? contact.master_body
                        : contact.master_body == body ? contact.slave_body
                                                      : -1;
      if (other < 0) continue;
      const BodyMeasures& mould = m.bodies[as_size(other)];
      // One finding a casting is enough, as one size mends all.
      if (mould.shortest_edge < k_coarse_mould * pour.freezing.mould_reach) continue;
      findings.push_back(
          {false, spec.mesh.where,
           fmt::format(
               "the elements of the body '{}' have {:.3g} mm and more, but heat goes only {:.3g} mm deep "
               "until '{}' is solid",
               spec.bodies[as_size(other)].name, 1e3 * mould.shortest_edge, 1e3 * pour.freezing.mould_reach,
               spec.bodies[pour.body].name),
           "smaller elements at the cavity, or [[mesh.layers]] on it"});
      break;
    }
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  overlaps(spec, m, findings);
  far_apart(spec, m, findings);
  same_body(spec, m, findings);
  shared_nodes(spec, a, m, findings);
  coarse_castings(spec, m, findings);
  coarse_moulds(spec, m, findings);
  shapes_and_sizes(spec, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_geometry() {
  return {
      .name = "geometry",
      .place = 70,
      .find = &find,
      .rows = {
          {Topic::contacts, "bodies are glued together",
           fmt::format("surfaces in contact share some nodes; bodies whose initial temperatures differ by "
                       "more than {} K share nodes",
                       number(k_same_temperature))},
          {Topic::contacts, "bodies overlap",
           fmt::format("the surfaces overlap at the start by more than {} of a face's size, without the "
                       "effect of facets and what `touching` closes",
                       number(k_overlap))},
          {Topic::contacts, "surfaces are far apart",
           fmt::format("the smallest gap is above {} mm and {} of the body, without the effect of facets and "
                       "what `touching` closes",
                       number(1e3 * k_apart), percent(k_apart_of_body))},
          {Topic::contacts, "both surfaces belong to one body"},
          {Topic::mesh, "elements too large for the wall",
           fmt::format("{} of the casting are elements that reach from one cooled surface to the other, or "
                       "whose mean edge is {} times the depth of the wall, or the casting is one element",
                       percent(k_spanned), number(k_coarse))},
          {Topic::mesh, "elements too large for the mould",
           fmt::format(
               "the shortest is {} times the depth to which heat penetrates until the casting is solid",
               number(k_coarse_mould))},
          {Topic::mesh, "a small casting", fmt::format("below {} mm", number(1e3 * k_small))},
          {Topic::mesh, "flat elements",
           fmt::format("an edge {} times as long as another of the element, in a casting {} times, in a body "
                       "that only conducts heat {} times",
                       number(k_flat), number(k_flat_in_casting), number(k_flat_in_layers))}}};
}

}  // namespace solidus::check
