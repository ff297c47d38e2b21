/// Skins of bodies are faces with places and normals; a rule picks those that fit, and of several strips
/// the nearest.
#include "mesh/surfaces/face_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "input/keys.hpp"
#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "mesh/surfaces/smooth_parts.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::mesh {

namespace {

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Says which share of a curved face was taken where facets of coarse elements meet there at more than
/// k_smooth_bend, so that a smooth part is a strip of it: every facet of the strip has a neighbour beyond its
/// border that bends by less than the edges of a drawing do.
void tell_strip(const std::vector<const SkinFace*>& faces, const SmoothParts& parts, std::size_t part,
                const std::string& group) {
  constexpr double k_of_a_drawing = 75 * std::numbers::pi / 180, k_whole = 0.95;
  constexpr double k_wider = 6;  // than the strip no other is, but the plane next to a chamfer
  const SmoothParts wider = smooth_parts(faces, k_of_a_drawing);
  std::set<std::pair<Index, Index>> beyond;  // edges of the rest of the wider part
  std::map<std::size_t, double> area_of;     // of each smooth part
  const auto edge = [](const SkinFace& face, std::size_t i) {
    const Index a = face.nodes[i], b = face.nodes[(i + 1) % face.corners.size()];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (wider.of_face[f] != wider.of_face[part]) continue;
    area_of[parts.of_face[f]] += faces[f]->area;
    if (parts.of_face[f] != part)
      for (std::size_t i = 0; i < faces[f]->corners.size(); ++i) beyond.insert(edge(*faces[f], i));
  }
  const double taken = area_of.at(part);
  double whole = 0;
  for (const auto& [other, area] : area_of) {
    if (area > k_wider * taken) return;
    whole += area;
  }
  if (taken > k_whole * whole) return;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    bool inside = parts.of_face[f] == part;
    for (std::size_t i = 0; inside && i < faces[f]->corners.size(); ++i)
      inside = !beyond.contains(edge(*faces[f], i));
    if (inside) return;
  }
  logging::warn(
      "the group '{}' takes {:.3g} of the {:.3g} cm2 of a curved face ({:.0f} %): its elements are so coarse "
      "that facets meet at more than 30 degrees. Smaller elements there, or 'lowest' and 'highest' of a box "
      "around the face in place of 'nearest', take all of it",
      group, 1e4 * taken, 1e4 * whole, 100 * taken / whole);
}

std::vector<const SkinFace*> only_nearest(const std::vector<const SkinFace*>& faces, const Point& point,
                                          const std::vector<DrawnFace>& drawn, const std::string& group) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (const double here = distance(nearest_on_face(*faces[f], point), point); here < least)
      least = here, best = f;
  const SmoothParts parts = smooth_parts(faces, k_smooth_bend, drawn);
  std::vector<const SkinFace*> kept;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (parts.of_face[f] == parts.of_face[best]) kept.push_back(faces[f]);
  const bool solid = faces[best]->corners.size() > 2;  // in the plane a face is a line
  if (solid) tell_strip(faces, parts, parts.of_face[best], group);
  return kept;
}

bool fits(const SkinFace& face, const FaceRule& rule, double slack) {
  if (rule.normal) {
    const double size = std::sqrt(dot(*rule.normal, *rule.normal));
    if (dot(*rule.normal, face.normal) < size * std::cos(rule.angle)) return false;
    if (rule.plane)
      for (const Point& p : face.corners) {
        const Point d = {p[0] - (*rule.plane)[0], p[1] - (*rule.plane)[1], p[2] - (*rule.plane)[2]};
        if (std::abs(dot(d, *rule.normal)) > size * slack) return false;
      }
  }
  if (rule.box)
    for (const Point& p : face.corners)
      for (std::size_t i = 0; i < 3; ++i)
        if (p[i] < (*rule.box)[0][i] - slack || p[i] > (*rule.box)[1][i] + slack) return false;
  return true;
}

}  // namespace

void add_faces_by_rule(RawMesh& mesh, const std::vector<std::string>& bodies, const FaceRule& rule,
                       const std::string& source) {
  // A rule may be of one body or of all.
  if (!rule.owner.empty() && std::find(bodies.begin(), bodies.end(), rule.owner) == bodies.end())
    throw InputError({source}, fmt::format("the group '{}': there is no body '{}'", rule.name, rule.owner),
                     one_of(bodies, rule.owner));
  // The slack follows from the extent of the mesh.
  Point low{}, high{};
  low.fill(std::numeric_limits<double>::max()), high.fill(std::numeric_limits<double>::lowest());
  for (const Point& p : mesh.x)
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  constexpr double k_slack = 1e-5;  // of the mesh: what facets of CAD planes leave
  const double slack = k_slack * distance(low, high);
  std::vector<std::vector<SkinFace>> skins;
  for (const std::string& body : bodies)
    if (rule.owner.empty() || body == rule.owner) skins.push_back(skin_of(mesh, body));
  // Faces of each body that fit, each once where two bodies share it; of them those nearest to a point, if
  // asked.
  std::vector<const SkinFace*> chosen;
  std::set<std::array<Index, 4>> seen;
  for (const std::vector<SkinFace>& skin : skins)
    for (const SkinFace& face : skin)
      if (fits(face, rule, slack) &&
          seen.insert(face_key(face.nodes.data(), static_cast<int>(face.corners.size())).vertices).second)
        chosen.push_back(&face);
  if (rule.nearest && !chosen.empty())
    chosen = only_nearest(chosen, *rule.nearest, mesh.drawn_faces, rule.name);
  if (chosen.empty())
    throw InputError({source}, fmt::format("no face of the mesh fits the rule of the group '{}'", rule.name),
                     "`solidus mesh-info` lists the faces with their normals and places");
  add_surface(mesh, rule.name, chosen, source);
}

}  // namespace solidus::mesh
