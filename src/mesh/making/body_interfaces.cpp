#include "mesh/making/body_interfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// The bodies at each node, in rising order. [raw node]
std::vector<std::vector<int>> bodies_at_nodes(const RawMesh& mesh, const std::vector<std::string>& bodies) {
  std::vector<std::vector<int>> here(mesh.x.size());
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b)
    for (const RawBlock& block : mesh.groups.at(bodies[as_size(b)]).blocks)
      for (const Index node : block.nodes)
        if (here[as_size(node)].empty() || here[as_size(node)].back() != b) here[as_size(node)].push_back(b);
  return here;
}

/// Groups the bodies at a node that stay connected: returns the number of the group of each, from zero.
std::vector<int> parts_of(const std::vector<int>& bodies, const std::set<BodyPair>& apart) {
  std::vector<int> part(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) part[i] = static_cast<int>(i);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (apart.contains({bodies[k], bodies[i]}) || part[i] == part[k]) continue;
      const int from = std::max(part[i], part[k]), to = std::min(part[i], part[k]);
      std::replace(part.begin(), part.end(), from, to);
    }
  return part;
}

/// Owners of the faces of all surface groups, before nodes are split.
FaceOwners owners_of_surfaces(const RawMesh& mesh, const std::vector<std::string>& bodies) {
  FaceOwners owners;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension - 1) continue;
    for (const RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f < block.nodes.size(); f += as_size(nn))
        owners.emplace(face_key(block.nodes.data() + f, nv), FaceOwner{});
    }
  }
  find_face_owners(mesh, bodies, owners);
  return owners;
}

/// A body's side of one pair.
struct Side {
  std::vector<const SkinFace*> faces;
  double area = 0, covered = 0, gap = 0, largest = 0;
};

bool lies_in(const std::optional<HalfSpace>& plane, const SkinFace& face) {
  constexpr double k_flat = 0.999, k_near = 1e-3;  // of the face's size
  if (!plane || face.normal[as_size(plane->axis)] < k_flat) return false;
  return std::abs(face.centre[as_size(plane->axis)] - plane->at) < k_near * std::sqrt(face.area);
}

/// Finds for each face of the skins the body whose face has the same corners, as faces of bodies have that
/// were meshed together; −1 where there is none. [body][face]
std::vector<std::vector<int>> coincident(const std::vector<std::vector<SkinFace>>& skins) {
  std::map<std::vector<Point>, std::pair<std::size_t, std::size_t>> first;  // by sorted corners
  std::vector<std::vector<int>> partner;
  for (std::size_t b = 0; b < skins.size(); ++b) {
    partner.emplace_back(skins[b].size(), -1);
    for (std::size_t f = 0; f < skins[b].size(); ++f) {
      std::vector<Point> corners(skins[b][f].corners.begin(), skins[b][f].corners.end());
      std::sort(corners.begin(), corners.end());
      const auto [other, is_new] = first.try_emplace(std::move(corners), b, f);
      if (is_new || other->second.first == b) continue;
      partner[b][f] = static_cast<int>(other->second.first);
      partner[other->second.first][other->second.second] = static_cast<int>(b);
    }
  }
  return partner;
}

/// The faces of a body that may face another one: those that coincide with a face of a third do not, though
/// it be near, as around the edge where three bodies meet.
std::vector<std::size_t> candidates(const std::vector<int>& partner, int other) {
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < partner.size(); ++f)
    if (partner[f] < 0 || partner[f] == other) faces.push_back(f);
  return faces;
}

}  // namespace

std::vector<SplitNodes> shared_by(const RawMesh& mesh, const std::vector<std::string>& bodies) {
  std::map<BodyPair, std::size_t> count;
  for (const std::vector<int>& here : bodies_at_nodes(mesh, bodies))
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) ++count[{here[k], here[i]}];
  std::vector<SplitNodes> shared;
  for (const auto& [pair, nodes] : count) shared.push_back({pair, nodes});
  return shared;
}

void split_nodes(RawMesh& mesh, const std::vector<std::string>& bodies, const std::set<BodyPair>& pairs) {
  // Bodies that share nodes are joined. Where they are to touch instead, each part of bodies gets nodes of
  // its own.
  const std::vector<std::vector<int>> here = bodies_at_nodes(mesh, bodies);
  const FaceOwners owners = owners_of_surfaces(mesh, bodies);
  GlobalIndex next = 0;
  for (const GlobalIndex number : mesh.input_node) next = std::max(next, number);
  std::map<std::pair<Index, int>, Index> copy;  // of a node for a body
  // For each shared node the bodies around it fall into parts that stay joined; the first part keeps the
  // node, each other one gets a copy.
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i].size() < 2) continue;
    const std::vector<int> part = parts_of(here[i], pairs);
    std::map<int, Index> of_part;
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (part[k] == 0) continue;
      const auto found = of_part.find(part[k]);
      Index node = found != of_part.end() ? found->second : as_index(mesh.x.size());
      if (found == of_part.end()) {
        const Point x = mesh.x[i];
        mesh.x.push_back(x);
        mesh.input_node.push_back(++next);
        of_part[part[k]] = node;
      }
      copy[{as_index(i), here[i][k]}] = node;
    }
  }
  // Elements of the bodies are renumbered first.
  if (copy.empty()) return;
  const auto renumber = [&](Index& node, int body) {
    if (const auto found = copy.find({node, body}); found != copy.end()) node = found->second;
  };
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b)
    for (RawBlock& block : mesh.groups.at(bodies[as_size(b)]).blocks)
      for (Index& node : block.nodes) renumber(node, b);
  // Faces of surfaces follow the body that owns them; a face of no body keeps its nodes.
  for (auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension - 1) continue;
    for (RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f < block.nodes.size(); f += as_size(nn)) {
        const FaceOwner& owner = owners.at(face_key(block.nodes.data() + f, nv));
        if (owner.body < 0) continue;
        for (std::size_t k = f; k < f + as_size(nn); ++k) renumber(block.nodes[k], owner.body);
      }
    }
  }
}

namespace {

/// Adds to a side the faces of a skin that face what is searched.
/// @param asked           which faces of the skin, by number
/// @param faces_somebody  of all faces of the skin; set for those that are added
void cover(const std::vector<SkinFace>& own, const std::vector<std::size_t>& asked, const SkinSearch& search,
           Side& side, std::vector<char>& faces_somebody) {
  for (const std::size_t f : asked) {
    const std::vector<Point> points = sample_points(own[f]);
    const double share = own[f].area / static_cast<double>(points.size());
    double covered = 0;
    for (const Point& p : points)
      if (const auto partner = search.facing(p, own[f].normal)) {
        covered += share;
        side.gap += share * partner->distance;
        side.largest = std::max(side.largest, partner->distance);
      }
    if (!(covered > 0)) continue;
    side.faces.push_back(&own[f]);
    side.area += own[f].area;
    side.covered += covered;
    faces_somebody[f] = 1;
  }
}

}  // namespace

std::vector<Facing> find_facing(RawMesh& mesh, const std::vector<std::string>& bodies,
                                const std::vector<std::string>& names, const std::vector<FacingWish>& wishes,
                                const std::optional<HalfSpace>& cut, const std::string& source) {
  std::vector<std::vector<SkinFace>> skins;
  std::vector<std::vector<char>> faces_somebody;
  for (const std::string& body : bodies) {
    skins.push_back(skin_of(mesh, body));
    faces_somebody.emplace_back(skins.back().size(), 0);
  }
  const std::vector<std::vector<int>> partner_of = coincident(skins);
  std::vector<Facing> found;
  for (const FacingWish& wish : wishes) {
    const std::array<int, 2> pair = {wish.bodies.first, wish.bodies.second};
    constexpr double k_share_of_edge = 0.25;
    const double edge = std::min(mean_edge(skins[as_size(pair[0])]), mean_edge(skins[as_size(pair[1])]));
    const double distance = wish.distance > 0 ? wish.distance : k_share_of_edge * edge;
    std::array<Side, 2> sides;
    for (std::size_t s = 0; s < 2; ++s) {
      const std::vector<SkinFace>& own = skins[as_size(pair[s])];
      std::vector<SkinFace> others;
      for (const std::size_t f : candidates(partner_of[as_size(pair[1 - s])], pair[s]))
        others.push_back(skins[as_size(pair[1 - s])][f]);
      const SkinSearch search(others, distance);
      cover(own, candidates(partner_of[as_size(pair[s])], pair[1 - s]), search, sides[s],
            faces_somebody[as_size(pair[s])]);
    }
    if (sides[0].faces.empty() || sides[1].faces.empty()) continue;
    Facing facing{wish.bodies, names[as_size(pair[0])] + "_to_" + names[as_size(pair[1])],
                  names[as_size(pair[1])] + "_to_" + names[as_size(pair[0])], distance};
    facing.area_a = sides[0].area;
    facing.area_b = sides[1].area;
    facing.covered_a = sides[0].covered;
    facing.covered_b = sides[1].covered;
    facing.mean_gap = sides[0].covered > 0 ? sides[0].gap / sides[0].covered : 0;
    facing.largest_gap = sides[0].largest;
    add_surface(mesh, facing.surface_a, sides[0].faces, source);
    add_surface(mesh, facing.surface_b, sides[1].faces, source);
    found.push_back(std::move(facing));
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<const SkinFace*> free, symmetric;
    // A face that is one with another body's is no free skin: the joint of a casting and its riser, which
    // share nodes, lies within the metal.
    for (std::size_t f = 0; f < skins[b].size(); ++f)
      if (faces_somebody[b][f] == 0 && partner_of[b][f] < 0)
        (lies_in(cut, skins[b][f]) ? symmetric : free).push_back(&skins[b][f]);
    if (!symmetric.empty()) add_surface(mesh, names[b] + "_symmetry", symmetric, source);
    if (!free.empty()) add_surface(mesh, names[b] + "_free", free, source);
  }
  return found;
}

}  // namespace solidus::mesh
