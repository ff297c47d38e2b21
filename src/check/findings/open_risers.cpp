// Findings on the open skin of risers: where it lies as gravity acts, and what takes heat from it.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/finding_family.hpp"
#include "mesh/body_faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_least_share_of_skin = 0.02;  // of the skin

/// The skin of a riser as gravity acts, areas in m², or lengths in m of a plane mesh.
struct OpenSkin {
  double all = 0;
  double up = 0, beside = 0;  ///< with neither a contact nor a condition of mechanics
  double bare_up = 0;         ///< upward, with neither a contact nor a condition of heat
};

std::set<std::string> contact_sides(const cases::CaseSpec& spec) {
  std::set<std::string> groups;
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& side : contact.sides()) groups.insert(side);
  return groups;
}

/// [body], for risers that are poured. Collective.
std::map<std::size_t, OpenSkin> open_skins(const cases::CaseSpec& spec, const setup::Assembly& a,
                                           const CaseMeasures& m, const std::array<double, 3>& up) {
  constexpr double k_upright = 0.7, k_beside = 0.3;  // of the normal along `up`
  // Only risers that are poured can be open on top.
  std::map<std::size_t, OpenSkin> skins;
  for (const Pour& pour : m.pours)
    if (spec.bodies[pour.body].role == cases::Role::riser) skins[pour.body] = {};
  if (skins.empty()) return skins;
  // A contact both holds and cools; a held temperature counts as an inlet, which is open to nothing.
  std::set<std::string> held = contact_sides(spec), cooled = held;
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) held.insert(c.group);
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    cooled.insert(c.group);
    if (c.kind == cases::ThermalConditionSpec::Kind::temperature) held.insert(c.group);  // as of an inlet
  }
  const auto held_faces = mesh::body_face_keys(a.mesh, held),
             cooled_faces = mesh::body_face_keys(a.mesh, cooled);
  // Areas by direction: up or sideways, held or free, cooled or bare.
  mesh::each_body_face(a.mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
    const auto found = skins.find(as_size(face.body));
    if (found == skins.end()) return;
    // The normal of each face of a riser's skin, against the direction that is up.
    std::vector<mesh::Point> corners;
    for (const Index node : face.vertices()) corners.push_back(a.mesh.x[as_size(node)]);
    const mesh::SkinFace skin = mesh::face_through(std::move(corners));
    const double along = skin.normal[0] * up[0] + skin.normal[1] * up[1] + skin.normal[2] * up[2];
    OpenSkin& sum = found->second;
    sum.all += skin.area;
    // Faces that another body has too are counted in the whole and are neither open nor bare.
    if (same.size() > 1) return;
    if (along > k_upright && !cooled_faces.contains(face.key)) sum.bare_up += skin.area;
    if (held_faces.contains(face.key)) return;
    if (along > k_upright) sum.up += skin.area;
    if (std::abs(along) < k_beside) sum.beside += skin.area;
  });
  // Every process has its part of the faces.
  for (auto& [body, sum] : skins)
    for (double* area : {&sum.all, &sum.up, &sum.beside, &sum.bare_up}) *area = parallel::global_sum(*area);
  return skins;
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  const double size = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  if (!spec.has_heat() || !(size > 0)) return;
  // Faces that look against gravity are the open top of a riser, if it has one.
  for (const auto& [body, skin] : open_skins(spec, a, m, {-g[0] / size, -g[1] / size, -g[2] / size})) {
    const cases::BodySpec& riser = spec.bodies[body];
    if (skin.bare_up > k_least_share_of_skin * skin.all)
      findings.push_back(
          {false, riser.where,
           fmt::format("{:.0f} % of the skin of the riser '{}' face up and have neither a thermal condition "
                       "nor a contact: no heat leaves there",
                       100 * skin.bare_up / skin.all, riser.name),
           "10 to 20 W/m2/K and radiation on open metal, 1 to 3 W/m2/K under a cover"});
    // A top that is all closed and sides that are open: gravity was given along the wrong axis.
    if (spec.has_mechanics() && skin.up < 0.1 * k_least_share_of_skin * skin.all &&
        skin.beside > k_least_share_of_skin * skin.all)
      findings.push_back(
          {false, spec.analysis.where,
           fmt::format("the riser '{}' is closed on top and open at its side, as gravity acts: {:.0f} % of "
                       "its skin there have neither a contact nor a support",
                       riser.name, 100 * skin.beside / skin.all),
           "is gravity_direction right? A riser is open on top, or its mould closes it all round"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_open_risers() {
  return {.name = "open risers",
          .place = 270,
          .find = &find,
          .rows = {{Topic::pour, "an open riser that nothing cools",
                    fmt::format("more than {} of its surface faces up, against gravity, with neither a "
                                "thermal condition nor a contact",
                                percent(k_least_share_of_skin))},
                   {Topic::pour, "a riser on its side",
                    fmt::format("where it deforms: no part of its free surface faces up, and more than {} of "
                                "it faces sideways",
                                percent(k_least_share_of_skin))}}};
}

}  // namespace solidus::check
