/// Bores are faces of one radius that run through the die; their film follows from the speed of the water.
#include "new_case/die_channels.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_set>

#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/skin.hpp"
#include "mesh/surfaces/smooth_parts.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

using mesh::Point;
using mesh::SkinFace;

constexpr double k_viscosity = 0.80e-6;  ///< ν of water at 30 °C [m²/s]

/// The faces of a skin that a surface group holds.
std::vector<const SkinFace*> faces_in(const mesh::RawGroup& group, const std::vector<SkinFace>& skin) {
  std::unordered_set<mesh::FaceKey, mesh::FaceKeyHash> keys;
  for (const mesh::RawBlock& block : group.blocks) {
    const auto nodes = as_size(mesh::node_count(block.shape));
    for (std::size_t e = 0; e < block.nodes.size(); e += nodes)
      keys.insert(mesh::face_key(&block.nodes[e], mesh::vertex_count(block.shape)));
  }
  std::vector<const SkinFace*> faces;
  for (const SkinFace& face : skin)
    if (keys.contains(mesh::face_key(face.nodes.data(), static_cast<int>(face.corners.size()))))
      faces.push_back(&face);
  return faces;
}

std::unordered_set<Index> nodes_of(const mesh::RawMesh& mesh, const std::vector<std::string>& groups) {
  std::unordered_set<Index> nodes;
  for (const std::string& group : groups)
    for (const mesh::RawBlock& block : mesh.groups.at(group).blocks)
      nodes.insert(block.nodes.begin(), block.nodes.end());
  return nodes;
}

Eigen::Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}

/// The radius of the drawn cylinder that a face is a facet of [m]; zero where there is none.
double radius_of(const SkinFace& face, const std::vector<mesh::DrawnFace>& drawn) {
  const mesh::FaceKey key = mesh::face_key(face.nodes.data(), static_cast<int>(face.corners.size()));
  for (const mesh::DrawnFace& of_geometry : drawn)
    if (std::ranges::count(of_geometry.facets, key.vertices) > 0) return of_geometry.radius;
  return 0;
}

/// Its measures where a part of a skin is a bore; else of diameter zero.
///
/// Over a tube the normals n of the area add up to nothing, and seen from a point inside ∫ n·x dA = −2 V
/// where they look at its axis, V the volume that it encloses. The axis is the direction that normals do not
/// have. The diameter is that of the drawing, where it is known, else that of the circle with the
/// cross-section V/L of the facets.
/// @param radius  of the cylinder that it was drawn as [m]; zero: not known
DieChannel bore(const std::vector<const SkinFace*>& part, double radius) {
  constexpr double k_closed = 0.1;  // of the area: what normals of a whole turn add up to, with a round end
  double area = 0, inward = 0, low = HUGE_VAL, high = -HUGE_VAL;
  Eigen::Vector3d centre{0, 0, 0}, normals{0, 0, 0};
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const SkinFace* face : part) {
    // Sums over the facets weigh each by its area, so that the division of the mesh does not count.
    const Eigen::Vector3d n = vector(face->normal);
    area += face->area;
    centre += face->area * vector(face->centre);
    normals += face->area * n;
    spread += face->area * n * n.transpose();
  }
  centre /= area;
  // A part of a tube, such as a fillet, has normals that add up to something.
  if (normals.norm() > k_closed * area) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(spread);  // the least one first
  const Eigen::Vector3d axis = directions.eigenvectors().col(0);
  for (const SkinFace* face : part) {
    inward -= face->area * vector(face->normal).dot(vector(face->centre) - centre);
    for (const Point& corner : face->corners) {
      const double along = axis.dot(vector(corner));
      low = std::min(low, along), high = std::max(high, along);
    }
  }
  // Where normals look away from the axis, the part is a pin and no bore.
  if (inward <= 0) return {};
  DieChannel channel;
  channel.place = part.front()->centre;
  channel.length = high - low;
  channel.diameter = radius > 0 ? 2 * radius : std::sqrt(2 * inward / (std::numbers::pi * channel.length));
  return channel;
}

}  // namespace

std::vector<DieChannel> die_channels(const mesh::RawMesh& mesh, const std::string& die,
                                     const std::string& free, const std::vector<std::string>& shared) {
  constexpr double k_slender = 2;  // a channel is so many times as long as it is wide; a hollow is not
  constexpr double k_narrowest = 4e-3, k_widest = 25e-3;  // [m]
  // Faces of the free skin of the die, in parts that bend no more than a curved surface does.
  const std::vector<SkinFace> skin = mesh::skin_of(mesh, die);
  const std::vector<const SkinFace*> faces = faces_in(mesh.groups.at(free), skin);
  const mesh::SmoothParts parts = mesh::smooth_parts(faces, mesh::k_smooth_bend, mesh.drawn_faces);
  // Nodes at surfaces that the die shares with others: a hole that ends there is for a pin.
  const std::unordered_set<Index> at_others = nodes_of(mesh, shared);
  std::map<std::size_t, std::vector<const SkinFace*>> faces_of;
  for (std::size_t f = 0; f < faces.size(); ++f) faces_of[parts.of_face[f]].push_back(faces[f]);
  // A smooth part of the free faces is a channel if it opens into no other body and is as slender and as wide
  // as bores for cooling are.
  std::vector<DieChannel> channels;
  for (const auto& [number, part] : faces_of) {
    const bool opens = std::ranges::any_of(part, [&](const SkinFace* face) {
      return std::ranges::any_of(face->nodes, [&](Index node) { return at_others.contains(node); });
    });
    if (opens) continue;
    // Axis, diameter and length as the faces of the part have them.
    DieChannel channel = bore(part, radius_of(*part.front(), mesh.drawn_faces));
    if (channel.diameter < k_narrowest || channel.diameter > k_widest ||
        channel.length < k_slender * channel.diameter)
      continue;
    channel.die = die;
    channels.push_back(channel);
  }
  // The longest first, as the report names them in this order.
  std::ranges::stable_sort(channels, std::ranges::greater{}, &DieChannel::length);
  return channels;
}

double speed_of_water(double diameter) {
  constexpr double k_usual = 1, k_turbulent = 1e4;
  // Water in bores runs at a metre in a second, or as fast as it takes to be turbulent [m/s].
  return std::max(k_usual, k_turbulent * k_viscosity / diameter);
}

double film_of_water(double diameter) {
  constexpr double k_conductivity = 0.615, k_prandtl = 5.4;  // at 30 °C
  // The formula of Dittus and Boelter holds for turbulent flow, which the speed makes certain.
  const double reynolds = speed_of_water(diameter) * diameter / k_viscosity;
  return 0.023 * std::pow(reynolds, 0.8) * std::pow(k_prandtl, 0.4) * k_conductivity / diameter;
}

}  // namespace solidus::new_case
