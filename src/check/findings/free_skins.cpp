// Findings on the free skin of what is poured: where it lies as gravity acts, and what holds it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_closed = 0.02, k_open = 0.25;  // of the skin that faces up, that faces down
constexpr double k_least_share_of_skin = 0.02;    // of the skin

bool in_contact(const cases::CaseSpec& spec, const std::string& surface) {
  return std::ranges::any_of(spec.contacts, [&](const cases::ContactSpec& contact) {
    const auto sides = contact.sides();
    return std::ranges::find(sides, surface) != sides.end();
  });
}

/// Surfaces on which something keeps a melt: contacts, supports, loads and held temperatures, as of an inlet.
std::set<std::string> covered_surfaces(const cases::CaseSpec& spec) {
  std::set<std::string> groups;
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& side : contact.sides()) groups.insert(side);
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) groups.insert(c.group);
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    if (c.kind == cases::ThermalConditionSpec::Kind::temperature) groups.insert(c.group);
  return groups;
}

/// Area of the skin that faces along gravity or against it [m²], or [m] in a plane.
struct Facing {
  double all = 0, free = 0;
};

/// Melt stands in its mould with its free surface on top: one whose skin is closed above and open below has
/// run out, or gravity points the wrong way. Collective.
void melts_open_below(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                      Findings& findings) {
  constexpr double k_upright = 0.7;  // of the normal
  // The direction in which melt would flow; without gravity or without any contact nothing can be
  // said.
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  const double size = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  if (!(size > 0) || m.pours.empty() || spec.contacts.empty()) return;
  // Faces count as closed where a contact, a support or another body has them.
  const auto covered = mesh::body_face_keys(a.mesh, covered_surfaces(spec));
  Facing up, down;
  mesh::each_body_face(a.mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
    if (!m.is_poured(as_size(face.body))) return;
    // The normal of each face of the melt's skin against gravity: upright walls are neither above
    // nor below.
    std::vector<mesh::Point> corners;
    for (const Index node : face.vertices()) corners.push_back(a.mesh.x[as_size(node)]);
    const mesh::SkinFace skin = mesh::face_through(std::move(corners));
    const double along = (skin.normal[0] * g[0] + skin.normal[1] * g[1] + skin.normal[2] * g[2]) / size;
    if (std::abs(along) < k_upright) return;
    // Facing along gravity is facing down; areas add up, all and free.
    Facing& facing = along > 0 ? down : up;
    facing.all += skin.area;
    if (same.size() == 1 && !covered.contains(face.key)) facing.free += skin.area;
  });
  for (double* sum : {&up.all, &up.free, &down.all, &down.free}) *sum = parallel::global_sum(*sum);
  // Told only where the whole top is closed and a good part of the bottom is open: either alone is
  // usual.
  if (!(down.all > 0) || up.free > k_closed * up.all || down.free < k_open * down.all) return;
  findings.push_back(
      {false, spec.analysis.where,
       fmt::format(
           "the melt is open below, as gravity acts: {:.0f} % of its skin that faces down has neither "
           "a contact nor a support, and all that faces up has one",
           100 * down.free / down.all),
       "is gravity_direction right? A melt has its free surface on top; what holds it up from below, as in "
       "low-pressure casting, is a pressure on that skin"});
}

/// A support of all directions on a free surface of a casting keeps it from shrinking there.
void held_free_skins(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                     Findings& findings) {
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    // All components that the analysis has must be held; in a plane or about an axis these are two.
    const bool all =
        c.kind == cases::MechanicalConditionSpec::Kind::displacement &&
        (spec.analysis.kind == AnalysisKind::solid ? c.ux && c.uy && c.uz : (c.ux || c.ur) && (c.uy || c.uz));
    // Only what holds from the start, and where no contact acts, which another finding judges.
    if (!all || !cases::holds(c.stages, a.first_stage()) || in_contact(spec, c.group)) continue;
    const setup::SurfaceMeasures surface = setup::measure_surface(a.mesh, c.group, spec.analysis.kind);
    if (!m.is_poured(as_size(surface.body))) continue;
    const auto body = as_size(surface.body);
    // Small patches hold a casting in place, as they must.
    if (cases::only_conducts(spec.bodies[body]) || surface.area < k_least_share_of_skin * m.bodies[body].skin)
      continue;
    findings.push_back(
        {false, c.where,
         fmt::format(
             "'{}' holds the surface '{}' of '{}', {:.0f} % of its skin, in all directions: melt does "
             "not sink there, and metal cannot shrink",
             c.name, c.group, spec.bodies[body].name, 100 * surface.area / m.bodies[body].skin),
         "supports along one axis, on planes of symmetry, or on a few nodes; the mould holds a casting by "
         "contact"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics()) return;
  melts_open_below(spec, a, m, findings);
  held_free_skins(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_free_skins() {
  return {
      .name = "free skins",
      .place = 130,
      .find = &find,
      .rows = {{Topic::mechanics, "a free surface of the casting is held in all directions",
                fmt::format("more than {} of its surface, without contact", percent(k_least_share_of_skin))},
               {Topic::mechanics, "a melt that is open below",
                fmt::format("{} of its surface that faces down has neither contact, support, load nor "
                            "held temperature, and all of that which faces up has one",
                            percent(k_open))}}};
}

}  // namespace solidus::check
