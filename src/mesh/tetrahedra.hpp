/// The linear tetrahedra of all bodies with what is around every node, for local changes of a mesh. Rank 0
/// only.
#pragma once

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

using Triangle = std::array<Index, 3>;

/// A tetrahedron and the body that it belongs to. Its nodes are ordered so that its volume is positive.
struct Tetrahedron {
  std::array<Index, 4> nodes{};
  int body = 0;

  bool has(Index node) const;
  bool has(Index a, Index b) const { return has(a) && has(b); }
  /// The two other nodes (p, q), so that (a, b, p, q) has a positive volume.
  std::pair<Index, Index> beside(Index a, Index b) const;
  /// The face across from a node, outward.
  Triangle across(Index node) const;
};

/// A face of two bodies, or of the skin of all, at a node.
struct SurfaceFace {
  Triangle nodes{};              ///< outward of `inside`
  int inside = 0, outside = -1;  ///< bodies; outside −1: nothing
};

/// Six times the volume of a tetrahedron [m³].
double volume_6(const Point& a, const Point& b, const Point& c, const Point& d);
/// The mean ratio (mesh/quality.hpp) 12 (3V)^(2/3) / Σ l², negative for an inverted tetrahedron.
double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d);

class Tetrahedra {
 public:
  /// Takes the tetrahedra out of a mesh; nodes of other elements and of surface groups are locked.
  explicit Tetrahedra(RawMesh& mesh);
  /// Puts them back: nodes that are in no element any more are left out of the mesh.
  void put_back();

  std::size_t count() const { return tets_.size(); }
  bool is_alive(std::size_t t) const { return alive_[t] != 0; }
  const Tetrahedron& operator[](std::size_t t) const { return tets_[t]; }
  const std::vector<std::size_t>& around(Index node) const { return around_[as_size(node)]; }
  /// The name of the body that a tetrahedron belongs to.
  const std::string& body_name(std::size_t t) const { return bodies_[as_size(tets_[t].body)]; }
  bool is_locked(Index node) const { return locked_[as_size(node)] != 0; }

  const Point& x(Index node) const { return mesh_.x[as_size(node)]; }
  void move(Index node, const Point& place) { mesh_.x[as_size(node)] = place; }
  double quality(const std::array<Index, 4>& nodes) const;

  /// Replaces tetrahedra by others.
  void replace(const std::vector<std::size_t>& old, const std::vector<Tetrahedron>& made);

 private:
  RawMesh& mesh_;
  std::vector<Tetrahedron> tets_;
  std::vector<GlobalIndex> number_;  ///< in the input, of each
  std::vector<char> alive_, locked_;
  std::vector<std::vector<std::size_t>> around_;  ///< those alive, of each node
  std::vector<std::string> bodies_;
  GlobalIndex next_number_ = 0;
};

double quality(const Tetrahedra& tets, std::size_t t);
/// Least quality around a node.
double quality_around(const Tetrahedra& tets, Index node);
std::vector<std::size_t> around_edge(const Tetrahedra& tets, Index a, Index b);
std::set<Index> neighbours(const Tetrahedra& tets, Index node);
/// Faces of bodies at a node, each once.
std::vector<SurfaceFace> surface_at(const Tetrahedra& tets, Index node);

}  // namespace solidus::mesh
