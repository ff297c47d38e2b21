/// Faces are sewn as one shell where they look like one; else copies are cut with each other, patches are
/// joined to shells, and shells are filled and nested.
#include "mesh/gmsh/closed_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/gmsh/open_faces.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

constexpr double k_joined = 1e-4;  ///< of the extent: faces that are no further apart meet

gmsh::vectorpair all_faces() {
  gmsh::vectorpair faces;
  occ::getEntities(faces, 2);
  return faces;
}

[[noreturn]] void refuse_open(const MeshSource& source) {
  throw UnusableGeometry(
      {source.path},
      "the geometry has no solid, and its faces do not close to one: " +
          open_faces_text(source.unit_in_metres),
      "a file with solids: close these openings in the CAD program and join the faces to a solid (stitch, "
      "sew, make solid); here they are joined where they meet within 0.01 % of the extent");
}

using Sides = std::map<int, int>;  ///< how often each curve is a side of a face

/// The curves around a face: twice that where the face meets itself, none without length, as the apex of a
/// cone.
Sides sides_of(int face) {
  gmsh::vectorpair boundary;
  gmsh::model::getBoundary({{2, face}}, boundary, false, true, false);
  Sides sides;
  for (const auto& [dimension, tag] : boundary) {
    double length = 0;
    occ::getMass(1, std::abs(tag), length);
    if (length > 0) ++sides[std::abs(tag)];
  }
  return sides;
}

/// Whether faces hang together as one shell at most, by curves that lie in one place: an IGES file has curves
/// for each face. Not, where more than two meet.
bool looks_like_one_shell(const gmsh::vectorpair& faces, double tolerance) {
  using Place = std::array<long, 7>;  // of a curve: its box and its length
  // Curves are known by their box and length: IGES gives each face curves of its own.
  std::map<Place, std::vector<std::size_t>> faces_at;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto& [curve, n] : sides_of(faces[f].second)) {
      std::array<double, 7> where{};
      gmsh::model::getBoundingBox(1, curve, where[0], where[1], where[2], where[3], where[4], where[5]);
      occ::getMass(1, curve, where[6]);
      Place place{};
      std::ranges::transform(where, place.begin(), [&](double x) { return std::lround(x / tolerance); });
      for (int side = 0; side < n; ++side) faces_at[place].push_back(f);
    }
  // Disjoint sets: faces with a common curve are one.
  std::vector<std::size_t> first(faces.size());
  std::iota(first.begin(), first.end(), 0U);
  const auto root = [&](std::size_t f) {
    while (first[f] != f) f = first[f];
    return f;
  };
  // A curve of more than two faces is where several shells meet.
  for (const auto& [place, sides] : faces_at) {
    if (sides.size() > 2) return false;
    for (const std::size_t f : sides) first[root(f)] = root(sides.front());
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (root(f) != root(0)) return false;
  return true;
}

/// All at once, which an empty list of shapes means and which replaces them: from 4.9 on Gmsh heals shapes
/// that are named one by one, and single faces are not sewn to each other.
void sew_all(double tolerance) {
  gmsh::vectorpair made;
  occ::healShapes(made, {}, tolerance, true, true, true, true, true);
  occ::synchronize();
}

/// A closed shell.
struct Shell {
  std::set<int> faces = {};
  bool twice = false;                      ///< the file has the faces twice
  int filled = -1;                         ///< a volume of all that is inside
  double volume = 0;                       ///< of that
  std::optional<std::size_t> around = {};  ///< the smallest shell around it
  bool solid = true;                       ///< what is inside, up to further shells
};

/// The faces of a geometry, each once, with common curves where they meet.
class Faces {
 public:
  /// @param all  which are made one of each; they are no more
  Faces(const gmsh::vectorpair& all, double tolerance);
  /// The shells that the faces close to; empty where some are left.
  std::vector<Shell> shells();
  const gmsh::vectorpair& all() const { return all_; }

 private:
  /// Those of n copies that hang together by curves at which no further face is left that no shell has.
  std::vector<std::set<int>> patches(int n) const;
  Sides sides(const std::set<int>& faces) const;
  bool is_closed(const std::set<int>& faces) const {
    return std::ranges::all_of(sides(faces), [](const auto& side) { return side.second == 2; });
  }
  bool touch(const std::set<int>& a, const std::set<int>& b) const {
    const Sides of_a = sides(a), of_b = sides(b);
    return std::ranges::any_of(of_a, [&](const auto& side) { return of_b.contains(side.first); });
  }
  void use(const std::set<int>& faces, bool twice, std::vector<Shell>& shells) {
    for (const int face : faces) copies_[face] -= twice ? 2 : 1;
    shells.push_back({faces, twice});
  }

  std::map<int, int> copies_;  ///< of each face, in the file; those that shells have are taken away
  std::map<int, Sides> sides_;
  gmsh::vectorpair all_;
};

Faces::Faces(const gmsh::vectorpair& all, double tolerance) {
  // All faces are cut along one another; a piece that two faces share counts twice.
  gmsh::vectorpair faces = all, out;
  std::vector<gmsh::vectorpair> pieces;
  const gmsh::vectorpair last = {faces.back()};
  faces.pop_back();
  gmsh::option::setNumber("Geometry.ToleranceBoolean", tolerance);
  occ::fragment(faces, last, out, pieces);
  gmsh::option::setNumber("Geometry.ToleranceBoolean", 0);
  occ::synchronize();
  for (const gmsh::vectorpair& of_face : pieces)  // Gmsh may list a piece of a face twice
    for (const auto& [dimension, tag] : std::set(of_face.begin(), of_face.end()))
      if (dimension == 2) ++copies_[tag];
  for (const auto& [face, n] : copies_) {
    sides_[face] = sides_of(face);
    all_.emplace_back(2, face);
  }
}

Sides Faces::sides(const std::set<int>& faces) const {
  Sides sum;
  for (const int face : faces)
    for (const auto& [curve, n] : sides_.at(face)) sum[curve] += n;
  return sum;
}

std::vector<std::set<int>> Faces::patches(int n) const {
  // Only faces with the number of copies asked for make patches; curves know all faces.
  std::map<int, std::vector<int>> faces_at;
  std::set<int> left;
  for (const auto& [face, copies] : copies_) {
    if (copies == n) left.insert(face);
    if (copies > 0)
      for (const auto& [curve, times] : sides_.at(face)) faces_at[curve].push_back(face);
  }
  // Faces that meet at a curve where no third one does are one patch.
  std::vector<std::set<int>> patches;
  while (!left.empty()) {
    std::set<int> patch;
    // From one face over its curves to the others, as far as no third face meets.
    std::vector<int> front = {*left.begin()};
    left.erase(left.begin());
    while (!front.empty()) {
      const int face = front.back();
      front.pop_back();
      patch.insert(face);
      for (const auto& [curve, times] : sides_.at(face))
        if (const std::vector<int>& beside = faces_at.at(curve); beside.size() == 2)
          for (const int other : beside)
            if (left.erase(other) > 0) front.push_back(other);
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

std::vector<Shell> Faces::shells() {
  std::vector<Shell> shells;
  // Shells of their own, also those that the file has twice: a cavity and the core in it.
  const std::vector<std::set<int>> shared = patches(2);
  for (const std::set<int>& patch : shared)
    if (is_closed(patch)) use(patch, true, shells);
  for (const std::set<int>& patch : patches(1)) {
    std::set<int> shell = patch;
    if (!is_closed(patch))  // a body that shares the rest of its skin with others
      for (const std::set<int>& other : shared)
        if (copies_.at(*other.begin()) > 0 && touch(patch, other)) shell.insert(other.begin(), other.end());
    if (is_closed(shell)) use(shell, false, shells);
  }
  // Bodies with neighbours on all sides.
  for (const std::set<int>& patch : patches(1))
    if (is_closed(patch)) use(patch, false, shells);
  const bool all = std::ranges::all_of(copies_, [](const auto& of) { return of.second == 0; });
  return all ? shells : std::vector<Shell>{};
}

double volume_of(const gmsh::vectorpair& volumes) {
  double sum = 0, one = 0;
  for (const auto& [dimension, tag] : volumes)
    if (dimension == 3) occ::getMass(3, tag, one), sum += one;
  return sum;
}

void fill(Shell& shell) {
  const int loop = occ::addSurfaceLoop({shell.faces.begin(), shell.faces.end()}, -1, true);
  shell.filled = occ::addVolume({loop});
  shell.volume = std::abs(volume_of({{3, shell.filled}}));
}

bool lies_in(const Shell& inner, const Shell& outer, const std::vector<Shell>& all) {
  // Boxes first, as they are quick: the inner one must fit into the outer one.
  if (inner.volume >= outer.volume) return false;
  const Extent a = extent_of({{3, inner.filled}}), b = extent_of({{3, outer.filled}});
  const double slack = 1e-6 * b.diagonal();
  for (std::size_t i = 0; i < 3; ++i)
    if (a.low[i] < b.low[i] - slack || a.high[i] > b.high[i] + slack) return false;
  // Then the volume that both have in common, which is all of the inner one if it lies inside.
  gmsh::vectorpair common;
  std::vector<gmsh::vectorpair> map;
  occ::intersect({{3, inner.filled}}, {{3, outer.filled}}, common, map, -1, false, false);
  const double volume = volume_of(common);
  // What is common may be one of the volumes itself.
  std::erase_if(common, [&](const auto& entity) {
    return std::ranges::any_of(
        all, [&](const Shell& s) { return entity.first == 3 && s.filled == entity.second; });
  });
  occ::remove(common, true);
  return volume > 0.5 * inner.volume;
}

/// Which shells lie in which, and what is solid.
void nest(std::vector<Shell>& shells) {
  for (Shell& inner : shells)
    for (std::size_t o = 0; o < shells.size(); ++o)
      if (&shells[o] != &inner && lies_in(inner, shells[o], shells) &&
          (!inner.around || shells[o].volume < shells[*inner.around].volume))
        inner.around = o;
  std::vector<std::size_t> order(shells.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return shells[a].volume > shells[b].volume; });
  for (const std::size_t s : order)
    if (Shell& shell = shells[s]; shell.around) shell.solid = shell.twice || !shells[*shell.around].solid;
}

/// Takes out of each body what lies in it, and cavities away.
void cut_cavities(std::vector<Shell>& shells) {
  for (std::size_t s = 0; s < shells.size(); ++s) {
    gmsh::vectorpair inside, out;
    for (const Shell& other : shells)
      if (other.around == s) inside.emplace_back(3, other.filled);
    std::vector<gmsh::vectorpair> map;
    if (shells[s].solid && !inside.empty())
      occ::cut({{3, shells[s].filled}}, inside, out, map, -1, true, false);
  }
  for (const Shell& shell : shells)
    if (!shell.solid) occ::remove({{3, shell.filled}}, true);
}

/// Leaves the faces as they are and answers false where they are no several shells.
bool close_several(const gmsh::vectorpair& faces, double tolerance) {
  // The trial works on copies, so that the faces stay as they were if it comes to nothing.
  gmsh::vectorpair copies;
  occ::copy(faces, copies);
  Faces complex(copies, tolerance);
  std::vector<Shell> shells = complex.shells();
  if (shells.size() < 2) {
    for (const auto& face : complex.all()) occ::remove({face}, true);
    occ::synchronize();
    return false;
  }
  // Shells become volumes, those inside of others cavities; faces of neither are removed.
  for (Shell& shell : shells) fill(shell);
  nest(shells);
  cut_cavities(shells);
  occ::synchronize();
  std::set<int> of_bodies;
  for (const auto& [dimension, volume] : all_volumes())
    for (const int face : boundary_of(volume)) of_bodies.insert(face);
  for (const auto& face : all_faces())
    if (!of_bodies.contains(face.second)) occ::remove({face}, true);
  occ::synchronize();
  return true;
}

bool is_plane() {
  const Extent extent = extent_of(all_faces());
  return extent.high[2] - extent.low[2] < 1e-6 * extent.diagonal();
}

}  // namespace

void close_to_solids(const MeshSource& source) {
  if (!all_volumes().empty()) return;
  const gmsh::vectorpair faces = all_faces();
  if (faces.empty()) {
    gmsh::vectorpair curves;
    occ::getEntities(curves, 1);
    throw UnusableGeometry(
        {source.path},
        "the geometry has " + std::to_string(curves.size()) + " curves, and neither faces nor a solid",
        "a file with solids");
  }
  const double tolerance = k_joined * extent_of(faces).diagonal();
  if (!looks_like_one_shell(faces, tolerance) && close_several(faces, tolerance)) return;
  sew_all(tolerance);
  if (all_volumes().empty()) refuse_open(source);
}

void close_to_solids_unless_plane(const MeshSource& source) {
  if (all_volumes().empty() && !all_faces().empty() && !is_plane()) close_to_solids(source);
}

}  // namespace solidus::mesh
