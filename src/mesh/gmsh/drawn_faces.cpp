/// Faces of a solid that continue one another smoothly are joined by disjoint sets; each facet of the mesh
/// then gets the number of its joined face.
#include "mesh/gmsh/drawn_faces.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "mesh/surfaces/faces.hpp"

namespace solidus::mesh {

namespace {

/// The normal of a face at a place of one of its edges, in the sense of the face's own parameters; nothing
/// where the geometry has none there.
std::optional<Point> normal_at(int curve, double place, int face) {
  std::vector<double> on_face, normal;
  gmsh::model::reparametrizeOnSurface(1, curve, {place}, face, on_face);
  gmsh::model::getNormal(face, on_face, normal);
  if (normal.size() != 3) return {};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return Point{normal[0] / length, normal[1] / length, normal[2] / length};
}

/// Whether two faces of a solid, of which each has its sense, bend by less along all of a common edge.
bool continue_one_another(int curve, const std::pair<int, int>& faces, double sense, double least_cosine) {
  constexpr std::array k_places = {0.25, 0.5, 0.75};
  std::vector<double> low, high;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  if (low.size() != 1 || high.size() != 1) return false;
  for (const double place : k_places) {
    const double t = std::lerp(low[0], high[0], place);
    const std::optional<Point> a = normal_at(curve, t, faces.first), b = normal_at(curve, t, faces.second);
    if (!a || !b) return false;
    if (sense * ((*a)[0] * (*b)[0] + (*a)[1] * (*b)[1] + (*a)[2] * (*b)[2]) < least_cosine) return false;
  }
  return true;
}

/// The faces of the geometry, those that continue one another as one.
class SmoothFaces {
 public:
  explicit SmoothFaces(double angle) : least_cosine_(std::cos(angle)) {
    gmsh::vectorpair faces, solids;
    gmsh::model::getEntities(faces, 2);
    for (const auto& [dimension, face] : faces) root_[face] = face;
    gmsh::model::getEntities(solids, 3);
    for (const auto& [dimension, solid] : solids) join_faces_of(solid);
  }

  std::map<int, std::vector<int>> all() {
    std::map<int, std::vector<int>> joined;
    for (const auto& [face, root] : root_) joined[find(face)].push_back(face);
    return joined;
  }

 private:
  int find(int face) {
    while (root_[face] != face) face = root_[face] = root_[root_[face]];
    return face;
  }

  void join_faces_of(int solid) {
    // The faces of the solid with the sense in which they bound it.
    gmsh::vectorpair bounds;
    gmsh::model::getBoundary({{3, solid}}, bounds, false, true, false);
    // At a curve between two faces these are one when they continue one another smoothly.
    std::map<int, std::vector<std::pair<int, int>>> at_curve;  // faces with their sense
    for (const auto& [dimension, signed_face] : bounds) {
      const int face = std::abs(signed_face);
      std::string type;
      gmsh::model::getType(2, face, type);
      if (type == "Discrete surface" || !root_.contains(face)) continue;
      gmsh::vectorpair curves;
      gmsh::model::getBoundary({{2, face}}, curves, false, false, false);
      for (const auto& [one, curve] : curves)
        at_curve[std::abs(curve)].emplace_back(face, signed_face > 0 ? 1 : -1);
    }
    for (const auto& [curve, faces] : at_curve) {
      // Two faces that are one already need no test.
      if (faces.size() != 2 || find(faces[0].first) == find(faces[1].first)) continue;
      try {
        if (continue_one_another(curve, {faces[0].first, faces[1].first}, faces[0].second * faces[1].second,
                                 least_cosine_))
          root_[find(faces[0].first)] = find(faces[1].first);
      } catch (const std::string&) {  // NOLINT: where the CAD kernel finds no normal the faces stay two
      }
    }
  }

  double least_cosine_;
  std::map<int, int> root_;
};

void add_facets(int face, const std::unordered_map<std::size_t, Index>& index, DrawnFace& drawn) {
  // Gmsh's numbers of the shapes: corners come first, whatever the order of the element.
  struct Facet {
    int type;
    std::size_t corners, nodes;
  };
  for (const Facet& of : {Facet{2, 3, 3}, Facet{9, 3, 6}, Facet{3, 4, 4}, Facet{16, 4, 8}}) {
    std::vector<std::size_t> elements, tags;
    gmsh::model::mesh::getElementsByType(of.type, elements, tags, face);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      std::array<Index, 4> corners{};
      for (std::size_t a = 0; a < of.corners; ++a) corners[a] = index.at(tags[e * of.nodes + a]);
      drawn.facets.push_back(face_key(corners.data(), static_cast<int>(of.corners)).vertices);
    }
  }
}

/// The radius of a cylinder; zero of other faces.
double radius_of(int face) {
  std::string type;
  gmsh::model::getType(2, face, type);
  if (type != "Cylinder") return 0;
  std::vector<double> low, high, most, least, along_most, along_least;
  try {
    gmsh::model::getParametrizationBounds(2, face, low, high);
    gmsh::model::getPrincipalCurvatures(face,
                                        {0.5 * (low.at(0) + high.at(0)), 0.5 * (low.at(1) + high.at(1))},
                                        most, least, along_most, along_least);
  } catch (const std::string&) {
    return 0;
  }
  const double bend = std::max(std::abs(most.at(0)), std::abs(least.at(0)));
  return bend > 0 && std::isfinite(bend) ? 1 / bend : 0.0;
}

/// That of faces of one cylinder; zero where they are not.
double common_radius(const std::vector<int>& faces) {
  constexpr double k_same = 1e-6;
  const double radius = radius_of(faces.front());
  const bool same = std::ranges::all_of(
      faces, [&](int face) { return std::abs(radius_of(face) - radius) <= k_same * radius; });
  return same ? radius : 0.0;
}

}  // namespace

std::vector<DrawnFace> drawn_faces(const std::unordered_map<std::size_t, Index>& index, double angle,
                                   double unit) {
  std::vector<DrawnFace> all;
  for (const auto& [first, faces] : SmoothFaces(angle).all()) {
    DrawnFace drawn;
    for (const int face : faces) add_facets(face, index, drawn);
    if (drawn.facets.empty()) continue;
    drawn.radius = unit * common_radius(faces);
    all.push_back(std::move(drawn));
  }
  return all;
}

}  // namespace solidus::mesh
