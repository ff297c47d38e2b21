// Findings on probes that measure nothing: fields that their body does not have, points where bodies touch.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "coupling/all_fields.hpp"
#include "mesh/locate.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

/// Whether a body that only conducts heat keeps the field as it is. A surface of it has values of contact.
bool deforms(const coupling::Quantity& field) {
  return field.needs.mechanics && !field.of_contact();
}

/// Whether the field says nothing of a body that cannot melt.
bool freezes(const coupling::Quantity& field) {
  return field.needs.melting;
}

/// The bodies that hold a point: two where they touch. Collective.
std::vector<std::size_t> bodies_at(const setup::Assembly& a, const CaseMeasures& m,
                                   const mesh::Point& point) {
  std::vector<std::size_t> found;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const double slack = 1e-3 * m.bodies[b].mean_edge;
    bool inside = true;
    for (std::size_t d = 0; d < as_size(a.mesh.dimension); ++d)
      inside = inside && point[d] > m.bodies[b].low[d] - slack && point[d] < m.bodies[b].high[d] + slack;
    if (inside && mesh::locate(a.mesh, point, static_cast<int>(b)).distance <= slack) found.push_back(b);
  }
  return found;
}

void compare(const cases::CaseSpec& spec, const setup::Assembly& a, const cases::ProbeSpec& probe,
             std::size_t b, Findings& findings) {
  const cases::BodySpec& body = spec.bodies[b];
  const coupling::Quantity& field = coupling::field_of(probe.field);
  const bool rigid = spec.has_heat() && spec.has_mechanics() && cases::only_conducts(body);
  // What only conducts keeps the displacement of zero; what cannot freeze keeps its fraction.
  if (deforms(field) && rigid)
    findings.push_back({false, probe.where,
                        fmt::format("the probe '{}' takes the {} of '{}', which only conducts heat: it stays "
                                    "as it is",
                                    probe.name, probe.field, body.name),
                        "a body that deforms"});
  else if (freezes(field) && a.materials[b].solidification() == nullptr)
    findings.push_back({false, probe.where,
                        fmt::format("the probe '{}' takes the {} of '{}', of '{}', which does not freeze",
                                    probe.name, probe.field, body.name, body.material),
                        "a body that is poured"});
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  for (const cases::ProbeSpec& probe : spec.probes) {
    // Differences and global sums are made of other probes or of the whole case.
    if (probe.kind == cases::ProbeSpec::Kind::difference || probe.kind == cases::ProbeSpec::Kind::global)
      continue;
    // Probes of a group are compared with the body that has it.
    if (probe.kind != cases::ProbeSpec::Kind::point) {
      for (std::size_t b = 0; b < spec.bodies.size(); ++b)
        if (spec.bodies[b].mesh_group() == probe.group) compare(spec, a, probe, b, findings);
      continue;
    }
    // A point of a plane case has two coordinates; the third stays zero.
    mesh::Point point{};
    std::copy_n(probe.point.begin(), std::min(probe.point.size(), point.size()), point.begin());
    std::vector<std::size_t> bodies;
    // Without a body the point is looked for in the boxes of all.
    if (!probe.body) {
      bodies = bodies_at(a, m, point);
    } else {
      for (std::size_t b = 0; b < spec.bodies.size(); ++b)
        if (spec.bodies[b].name == *probe.body) bodies.push_back(b);
    }
    if (bodies.empty()) continue;
    compare(spec, a, probe, bodies.front(), findings);
    // Bodies that share their nodes there have one temperature.
    const bool apart = bodies.size() > 1 && m.bodies[bodies[0]].shared_nodes[bodies[1]] == 0;
    if (apart)
      findings.push_back(
          {false, probe.where,
           fmt::format("the probe '{}' lies where '{}' and '{}' touch: it measures '{}'", probe.name,
                       spec.bodies[bodies[0]].name, spec.bodies[bodies[1]].name, spec.bodies[bodies[0]].name),
           "body = the one that is meant"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_probes() {
  return {
      .name = "probes",
      .place = 290,
      .find = &find,
      .rows = {{Topic::probes, "a probe that measures nothing",
                "a field of mechanics where the body only conducts heat, one of freezing where it does not "
                "freeze"},
               {Topic::probes, "a probe where two bodies touch", "without `body`; it measures the first"}}};
}

}  // namespace solidus::check
