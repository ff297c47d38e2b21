// Findings on skins of castings that touch another body and are joined to it by nothing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/finding_family.hpp"
#include "mesh/body_faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

constexpr double k_near = 0.1;                  // a face on another body, of its size
constexpr double k_least_share_of_skin = 0.05;  // of the skin of the smaller body

using Key = std::array<GlobalIndex, 4>;

/// Keys of the faces of this process to which the case gives a contact or a thermal condition.
std::set<Key> faces_with_a_role(const cases::CaseSpec& spec, const mesh::Mesh& mesh) {
  std::set<std::string> groups;
  for (const cases::ContactSpec& contact : spec.contacts)
    for (const std::string& side : contact.sides()) groups.insert(side);
  for (const cases::ThermalConditionSpec& condition : spec.thermal_conditions) groups.insert(condition.group);
  return mesh::body_face_keys(mesh, groups);
}

mesh::SkinFace measured(const mesh::Mesh& mesh, const mesh::BodyFace& face) {
  std::vector<mesh::Point> corners;
  for (const Index node : face.vertices()) corners.push_back(mesh.x[as_size(node)]);
  return mesh::face_through(std::move(corners));
}

using Skins = std::vector<std::vector<mesh::SkinFace>>;  ///< [body][face], of this process

/// Returns the faces of the skins of castings that have no role and are no face of another body.
Skins bare_skins(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  const std::set<Key> roles = faces_with_a_role(spec, a.mesh);
  Skins skins(spec.bodies.size());
  mesh::each_body_face(a.mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
    const auto body = as_size(face.body);
    if (same.size() == 1 && m.is_poured(body) && !roles.contains(face.key))
      skins[body].push_back(measured(a.mesh, face));
  });
  return skins;
}

Skins all_skins(const cases::CaseSpec& spec, const setup::Assembly& a) {
  Skins skins(spec.bodies.size());
  mesh::each_body_face(a.mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace>) {
    skins[as_size(face.body)].push_back(measured(a.mesh, face));
  });
  return skins;
}

/// Faces of all processes that come near a box. Collective.
std::vector<mesh::SkinFace> gather_near(const std::vector<mesh::SkinFace>& faces, const mesh::Point& low,
                                        const mesh::Point& high, double margin) {
  std::vector<mesh::Point> mine;  // four a face, the last one repeated
  // A face comes near where its own box, widened by the margin, meets the box asked for.
  for (const mesh::SkinFace& face : faces) {
    bool near = true;
    for (std::size_t d = 0; d < 3 && near; ++d) {
      double least = face.corners[0][d], greatest = least;
      for (const mesh::Point& x : face.corners)
        least = std::min(least, x[d]), greatest = std::max(greatest, x[d]);
      near = greatest > low[d] - margin && least < high[d] + margin;
    }
    // Four corners for every face, so that the gathered points can be cut apart again.
    for (std::size_t i = 0; near && i < 4; ++i)
      mine.push_back(face.corners[std::min(i, face.corners.size() - 1)]);
  }
  const std::vector<mesh::Point> all = setup::gather(mine);
  std::vector<mesh::SkinFace> found;
  // Repeated corners at the end tell a triangle or a line from a quadrangle.
  for (std::size_t i = 0; i + 3 < all.size(); i += 4) {
    std::vector<mesh::Point> corners(all.begin() + static_cast<std::ptrdiff_t>(i),
                                     all.begin() + static_cast<std::ptrdiff_t>(i) + 4);
    while (corners.size() > 2 && corners.back() == corners[corners.size() - 2]) corners.pop_back();
    found.push_back(mesh::face_through(std::move(corners)));
  }
  return found;
}

/// The area of faces that lie on faces of another body: nearer than a tenth of their size. Collective.
double area_on(const std::vector<mesh::SkinFace>& faces, const std::vector<mesh::SkinFace>& others,
               double largest, int dimension) {
  if (others.empty()) return 0;
  const mesh::SkinSearch search(others, k_near * largest);
  double area = 0;
  for (const mesh::SkinFace& face : faces) {
    const double size = dimension == 3 ? std::sqrt(face.area) : face.area;
    const auto found = search.facing(face.centre, face.normal);
    if (found && found->distance < k_near * size) area += face.area;
  }
  return parallel::global_sum(area);
}

double total_area(const std::vector<mesh::SkinFace>& faces) {
  double area = 0;
  for (const mesh::SkinFace& face : faces) area += face.area;
  return parallel::global_sum(area);
}

/// Whether a contact or a node joins a body to any other one; where none does, findings/interface.cpp says
/// it.
bool is_joined(const CaseMeasures& m, std::size_t body) {
  return std::ranges::any_of(m.bodies[body].shared_nodes, [](GlobalIndex n) { return n > 0; }) ||
         std::ranges::any_of(m.contacts, [&](const setup::ContactMeasures& c) {
           const auto b = static_cast<int>(body);
           return c.slave_body == b || c.master_body == b || c.slave_body == setup::k_several_bodies ||
                  c.master_body == setup::k_several_bodies;
         });
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // Bare faces of a poured body that lie on another body without contact or shared nodes pass no heat. The
  // skins of both bodies are compared; of the other body only faces within the size of the largest bare face
  // are gathered.
  constexpr double k_same_temperature = 50;  // [K]: as in findings/interface.cpp
  if (!spec.has_heat() || spec.bodies.size() < 2 || m.pours.empty()) return;
  const Skins bare_faces = bare_skins(spec, a, m);
  if (!parallel::any_process(
          std::ranges::any_of(bare_faces, [](const auto& faces) { return !faces.empty(); })))
    return;
  const Skins skins = all_skins(spec, a);
  for (const Pour& pour : m.pours) {
    const std::size_t body = pour.body;
    const std::vector<mesh::SkinFace>& bare = bare_faces[body];
    double largest = 0;
    for (const mesh::SkinFace& face : bare)
      largest = std::max(largest, a.mesh.dimension == 3 ? std::sqrt(face.area) : face.area);
    largest = parallel::global_max(largest);
    if (!(largest > 0)) continue;
    const double skin = total_area(skins[body]);
    // A pair of poured bodies is reported once, and only bodies that share a stage. Pairs with different
    // temperatures at the start whose body nothing joins are left to findings/interface.cpp.
    for (std::size_t other = 0; other < spec.bodies.size(); ++other) {
      const bool both = m.is_poured(other);
      const bool alike = std::abs(a.start[body].high - a.start[other].low) < k_same_temperature;
      if (other == body || (both && other < body) ||
          !share_a_stage(spec.bodies[body].stages, spec.bodies[other].stages) ||
          (!alike && !is_joined(m, body)))
        continue;
      const double area =
          area_on(bare, gather_near(skins[other], m.bodies[body].low, m.bodies[body].high, largest), largest,
                  a.mesh.dimension);
      if (area < k_least_share_of_skin * std::min(skin, total_area(skins[other]))) continue;
      findings.push_back(
          {false, spec.bodies[body].where,
           fmt::format("'{}' lies on '{}' with {:.0f} % of its skin where nothing joins them: no heat "
                       "passes there{}",
                       spec.bodies[body].name, spec.bodies[other].name, 100 * area / skin,
                       both ? ", and one does not feed the other" : ""),
           both ? "metal that is poured together shares nodes: mesh.conforming, or one geometry"
                : "a [[contact]] for all faces that touch, as [[interface]] with bodies = \"all\" makes"});
    }
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_skins() {
  return {
      .name = "bare skins",
      .place = 80,
      .find = &find,
      .rows = {
          {Topic::contacts, "a casting lies on a body without contact or shared nodes there",
           fmt::format(
               "more than {} of the smaller surface is nearer than {} of a face's size, with neither "
               "contact, condition nor shared nodes: a forgotten side, a riser that was meshed separately",
               percent(k_least_share_of_skin), number(k_near))}}};
}

}  // namespace solidus::check
