#include "mesh/face_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "input/keys.hpp"
#include "mesh/faces.hpp"
#include "mesh/skin.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_smooth = std::numbers::pi / 6;  ///< neighbours of a smooth part bend by less

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The number of the smooth part of each face, by edges (in the plane: points) that neighbours share, and
/// which parts meet in an edge.
struct Parts {
  std::vector<std::size_t> of_face;
  std::set<std::pair<std::size_t, std::size_t>> meet;
};

Parts smooth_parts(const std::vector<const SkinFace*>& faces, double angle) {
  std::vector<std::size_t> root(faces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<Index, Index>, std::vector<std::size_t>> edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::size_t n = faces[f]->corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = faces[f]->nodes[i], b = n == 2 ? a : faces[f]->nodes[(i + 1) % n];
      edges[{std::min(a, b), std::max(a, b)}].push_back(f);
    }
  }
  for (const auto& [edge, around] : edges)
    for (std::size_t i = 1; i < around.size(); ++i)
      if (dot(faces[around[0]]->normal, faces[around[i]]->normal) >= std::cos(angle))
        root[find(around[i])] = find(around[0]);
  Parts parts;
  for (std::size_t f = 0; f < faces.size(); ++f) parts.of_face.push_back(find(f));
  for (const auto& [edge, around] : edges)
    for (const std::size_t a : around)
      for (const std::size_t b : around)
        if (parts.of_face[a] != parts.of_face[b]) parts.meet.insert({parts.of_face[a], parts.of_face[b]});
  return parts;
}

std::vector<const SkinFace*> only_nearest(const std::vector<const SkinFace*>& faces, const Point& point) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (const double here = distance(nearest_on_face(*faces[f], point), point); here < least)
      least = here, best = f;
  const Parts parts = smooth_parts(faces, k_smooth);
  std::vector<const SkinFace*> kept;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (parts.of_face[f] == parts.of_face[best]) kept.push_back(faces[f]);
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
  if (!rule.owner.empty() && std::find(bodies.begin(), bodies.end(), rule.owner) == bodies.end())
    throw InputError({source}, fmt::format("the group '{}': there is no body '{}'", rule.name, rule.owner),
                     one_of(bodies, rule.owner));
  Point low{}, high{};
  low.fill(std::numeric_limits<double>::max()), high.fill(std::numeric_limits<double>::lowest());
  for (const Point& p : mesh.x)
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  constexpr double k_slack = 1e-5;  // of the mesh: what facets of CAD planes leave
  const double slack = k_slack * distance(low, high);
  std::vector<std::vector<SkinFace>> skins;
  for (const std::string& body : bodies)
    if (rule.owner.empty() || body == rule.owner) skins.push_back(skin_of(mesh, body));
  std::vector<const SkinFace*> chosen;
  std::set<std::array<Index, 4>> seen;
  for (const std::vector<SkinFace>& skin : skins)
    for (const SkinFace& face : skin)
      if (fits(face, rule, slack) &&
          seen.insert(face_key(face.nodes.data(), static_cast<int>(face.corners.size())).vertices).second)
        chosen.push_back(&face);
  if (rule.nearest && !chosen.empty()) chosen = only_nearest(chosen, *rule.nearest);
  if (chosen.empty())
    throw InputError({source}, fmt::format("no face of the mesh fits the rule of the group '{}'", rule.name),
                     "`solidus mesh-info` lists the faces with their normals and places");
  add_surface(mesh, rule.name, chosen, source);
}

std::vector<SkinPatch> skin_patches(const RawMesh& mesh, const std::vector<std::string>& bodies,
                                    double angle) {
  std::vector<SkinPatch> all;
  for (const std::string& body : bodies) {
    const std::vector<SkinFace> skin = skin_of(mesh, body);
    std::vector<const SkinFace*> faces;
    for (const SkinFace& face : skin) faces.push_back(&face);
    const Parts parts = smooth_parts(faces, angle);
    std::map<std::size_t, SkinPatch> patches;  // by the number of the part
    for (std::size_t f = 0; f < faces.size(); ++f) {
      SkinPatch& p = patches[parts.of_face[f]];
      const SkinFace& face = *faces[f];
      if (p.faces++ == 0) p.body = body, p.low = p.high = face.centre;
      p.area += face.area;
      for (std::size_t i = 0; i < 3; ++i) {
        p.centre[i] += face.area * face.centre[i];
        p.normal[i] += face.area * face.normal[i];
        for (const Point& x : face.corners)
          p.low[i] = std::min(p.low[i], x[i]), p.high[i] = std::max(p.high[i], x[i]);
      }
    }
    std::vector<std::size_t> order;
    for (auto& [number, p] : patches) {
      for (std::size_t i = 0; i < 3; ++i) p.centre[i] /= p.area, p.normal[i] /= p.area;
      order.push_back(number);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return patches.at(a).area > patches.at(b).area; });
    std::map<std::size_t, std::size_t> place;
    for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = all.size() + k;
    for (const auto& [a, b] : parts.meet) patches.at(a).neighbours.push_back(place.at(b));
    for (const std::size_t number : order) all.push_back(patches.at(number));
  }
  return all;
}

std::string to_text(const std::vector<SkinPatch>& patches) {
  std::string text = fmt::format("\n{:>4}  {:<20} {:>7} {:>11}  {:<27} {:<21} {:<24} {}\n", "face", "owner",
                                 "faces", "area [mm2]", "centre [mm]", "normal", "size [mm]", "neighbours");
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const SkinPatch& p = patches[k];
    std::string neighbours;
    constexpr std::size_t k_most = 12;
    for (std::size_t i = 0; i < std::min(k_most, p.neighbours.size()); ++i)
      neighbours += fmt::format("{}{}", i > 0 ? ", " : "", p.neighbours[i] + 1);
    if (p.neighbours.size() > k_most) neighbours += ", …";
    const bool plane = dot(p.normal, p.normal) > 0.999;
    const auto mm = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : 1e3 * x; };
    text += fmt::format(
        "{:>4}  {:<20} {:>7} {:>11.5g}  {:<27} {:<21} {:<24} {}\n", k + 1, p.body, p.faces, 1e6 * p.area,
        fmt::format("({:.4g}, {:.4g}, {:.4g})", mm(p.centre[0]), mm(p.centre[1]), mm(p.centre[2])),
        plane
            ? fmt::format("({:.2f}, {:.2f}, {:.2f})", p.normal[0] + 0.0, p.normal[1] + 0.0, p.normal[2] + 0.0)
            : std::string("curved"),
        fmt::format("{:.4g} x {:.4g} x {:.4g}", mm(p.high[0] - p.low[0]), mm(p.high[1] - p.low[1]),
                    mm(p.high[2] - p.low[2])),
        neighbours);
  }
  return text;
}

}  // namespace solidus::mesh
